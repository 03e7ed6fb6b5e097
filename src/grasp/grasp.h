// A grasp: one hand, one object, the contacts between them.
#pragma once
#include "grasp/per_contact.h"
#include "grasp/wrench_space.h"
#include "model/find.h"

namespace clench {

/// Lengths of an object that torques may be divided by.
enum class TorqueLength {
  largest_radius,   ///< of its surface, from its centre of mass
  gyration_radius,  ///< root mean square of its mass, from its centre of mass
};

struct GraspOptions {
  int edges = 8;                   ///< of the friction pyramids; round_edges: round cones
  std::optional<double> rho = {};  ///< torque length [m]; default: that of the object
  TorqueLength length = TorqueLength::largest_radius;
  bool soft = true;             ///< soft contacts transmit torsional friction; else all are points
  PerContact normal_force = 5;  ///< at which they are judged, > 0, one per contact >= 0 [N]
  ModulusRule modulus = ModulusRule::series;
};

/// How a hand stands about an object.
struct GraspPosture {
  Pose X_BO;                   ///< the object in the hand's base
  std::vector<double> joints;  ///< q of all [rad or m]
};

struct Grasp {
  Id<Robot> hand;
  Id<Body> object;
  std::vector<Contact> contacts;                   ///< on the object, world frame
  std::vector<PointContact> points;                ///< the same in the object frame
  Eigen::Vector3d com = Eigen::Vector3d::Zero();   ///< of the object, object frame [m]
  double rho = 1;                                  ///< [m]
  double largest_radius = 1, gyration_radius = 1;  ///< of the object; 1 when it has no extent [m]
  int edges = 8;
  GraspOptions options = {};                 ///< that it was measured with
  std::optional<GraspPosture> posture = {};  ///< as measured; empty: put together by hand
  int contacts_at_edges = 0;  ///< soft ones on corners or edges, where their patch is but a guess

  double length(TorqueLength which) const {
    return which == TorqueLength::largest_radius ? largest_radius : gyration_radius;
  }
};

/// The contacts of palm, links and mount with the object, now. None is no error: such a grasp resists nothing.
/// throws Error when edges are neither 3 to max_edges nor round_edges, rho <= 0, normal forces are
///        not > 0 or not as many as the contacts, or the object is a part of a robot
Grasp measure_grasp(const World& world, Id<Robot> hand, Id<Body> object,
                    const GraspOptions& options = {});

/// What is asked of the world about a grasp wants hand and object to stand as they did when it was measured, wherever
/// both have been moved.
/// throws  Error when they do not
void check_unmoved(const World& world, const Grasp& grasp);

/// Of the unit wrenches about the centre of mass. Edges and torque length are those of the grasp
/// unless the options say otherwise.
struct GraspSpaceOptions {
  WrenchSpaceOptions space = {};
  std::optional<int> edges = {};
  std::optional<double> rho = {};  ///< [m]

  bool operator==(const GraspSpaceOptions&) const = default;
};

/// throws  Error when edges, rho or coordinates are not as they should be
WrenchSpace wrench_space(const Grasp& grasp, const GraspSpaceOptions& options = {});

}  // namespace clench
