// Energies that keep a hand where it may be: 0 where it is, growing with how far it is not.
#pragma once
#include "clench/planning/energy/energy.h"

namespace clench {

/// How much the approach direction leans from an axis beyond an angle [rad].
class ApproachCone : public Energy {
 public:
  /// axis  in world axes, of any length but 0;  max_angle  in [0, pi] [rad]
  ApproachCone(Id<Robot> hand, const Eigen::Vector3d& axis, double max_angle);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<ApproachCone>(*this); }

 private:
  Id<Robot> hand_;
  Eigen::Vector3d axis_;
  double max_angle_;
};

/// How deep the hand's bodies reach into a box of space, by the boxes around them [mm].
class KeepOutBox : public Energy {
 public:
  /// low, high  corners, along the axes of X_WK
  KeepOutBox(Id<Robot> hand, const Pose& X_WK, const Eigen::Vector3d& low,
             const Eigen::Vector3d& high);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<KeepOutBox>(*this); }

 private:
  Id<Robot> hand_;
  Pose X_KW_;
  Eigen::Vector3d low_, high_;
};

/// How much nearer than a distance the hand is to bodies that are not its own and not what it
/// grasps [mm].
class ClearanceEnergy : public Energy {
 public:
  ClearanceEnergy(const HandAndObject& who, double distance);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<ClearanceEnergy>(*this); }

 private:
  HandAndObject who_;
  double distance_;
};

/// How much farther than a radius the approach frame's origin is from a point: what an arm reaches
/// [mm].
class ReachEnergy : public Energy {
 public:
  ReachEnergy(Id<Robot> hand, const Eigen::Vector3d& p_W, double radius);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<ReachEnergy>(*this); }

 private:
  Id<Robot> hand_;
  Eigen::Vector3d p_W_;
  double radius_;
};

/// How deep the hand is in what it may not enter: over the pairs of bodies that collide the depth
/// of the deepest of some points on either surface, and a thousandth for each pair, so that it is 0
/// only where nothing collides [mm].
class PenetrationEnergy : public Energy {
 public:
  /// points  on each body of the hand, >= 1
  PenetrationEnergy(const World& world, Id<Robot> hand, int points = 64);
  double bounded_value(World& world, double bound) override;
  double lower_bound() const override { return 0; }
  EnergyPtr clone() const override { return std::make_unique<PenetrationEnergy>(*this); }

 private:
  double depth(World& world, Id<Body> part, Id<Body> other) const;

  Id<Robot> hand_;
  std::vector<Id<Body>> parts_;
  std::vector<std::vector<Eigen::Vector3d>> points_;  // of each part, in its frame
};

}  // namespace clench
