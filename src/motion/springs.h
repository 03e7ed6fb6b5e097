// Joints of compliant DOFs among contacts: where their springs draw them, and what holds them.
#pragma once
#include "clench/motion/blocked_joints.h"

namespace clench {

/// The tendon of a compliant DOF at q draws each of its joints to ratio * q by a spring of the
/// joint's stiffness k, so that they stand where sum 1/2 k (ratio q - joint)^2 is least among what
/// contacts and the joints' limits allow. Contacts push and rub, the friction cone as a pyramid of
/// eight edges; in a DOF that has a joint without a spring, all k are alike.
/// source  Dollar & Howe (2010), The highly adaptive SDM hand; a contact that slides leaves the
///         surface by its friction angle, as in Anitescu (2006), Optimization-based simulation of
///         nonsmooth rigid multibody dynamics
class SpringBalance {
 public:
  /// touching  contacts of these bodies of the robot
  /// sliding   do they rub as what slides, or as what stands still?
  SpringBalance(const World& world, Id<Robot> robot, const CarriedBodies& bodies,
                std::span<const Contact> touching, bool sliding = false);

  /// How far each joint has to go until springs and contacts are in balance, were they to stay as
  /// they are, and until no gap is below a fifth of the contact threshold; 0 for all joints of
  /// other DOFs [rad or m].
  JointSpeeds displacement() const;
  /// Whatever the DOF's tendon adds, in the sense of +1 or -1: do contacts and limits take it up,
  /// so that no joint moves?
  bool balanced_by_contacts(int dof, double sense) const;

 private:
  struct Sprung {
    int number;
    int dof;
    double ratio;
    double stiffness;
    double deflection;  ///< ratio * q - joint
  };
  void add_reactions(const World& world, Id<Robot> id, const CarriedBodies& bodies,
                     std::span<const Contact> touching, bool sliding);

  JointSpeeds none_;  // of all joints
  std::vector<Sprung> joints_;
  /// what contacts and limits can give to each joint over the root of its stiffness: a column each,
  /// times a number >= 0
  Eigen::MatrixXd reactions_;
  /// by how much each must open [m]
  Eigen::VectorXd opens_;
};

}  // namespace clench
