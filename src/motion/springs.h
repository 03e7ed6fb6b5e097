// Equilibrium of the joints of compliant DOFs with springs and contacts.
#pragma once
#include "clench/motion/blocked_joints.h"

namespace clench {

/// The tendon of a compliant DOF at q pulls each of its joints towards ratio * q by a spring of the
/// joint's stiffness k, so that they come to rest at the minimum of sum 1/2 k (ratio q - joint)^2
/// under the constraints of contacts and joint limits. Contacts exert normal and friction forces,
/// with the friction cone as a pyramid of eight edges; in a DOF that has a joint without a spring,
/// all k are equal.
/// source  Dollar & Howe (2010), The highly adaptive SDM hand; a contact that slides leaves the
///         surface by its friction angle, as in Anitescu (2006), Optimization-based simulation of
///         nonsmooth rigid multibody dynamics
class SpringBalance {
 public:
  /// touching  contacts of these bodies of the robot
  /// sliding   use kinetic friction instead of static friction?
  SpringBalance(const World& world, Id<Robot> robot, const CarriedBodies& bodies,
                std::span<const Contact> touching, bool sliding = false);

  /// Displacement of each joint to the equilibrium of springs and contacts, if the contacts did not
  /// change, and until no gap is below a fifth of the contact threshold; 0 for all joints of other
  /// DOFs [rad or m].
  JointSpeeds displacement() const;
  /// Do contacts and limits balance any additional pull of the DOF's tendon, in the sense of +1 or
  /// -1, so that no joint moves?
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

  JointSpeeds none_;  // zeros for all joints
  std::vector<Sprung> joints_;
  /// reactions of contacts and limits on each joint, divided by the root of its stiffness: one per
  /// column, each with a factor >= 0
  Eigen::MatrixXd reactions_;
  /// displacement by which each must open [m]
  Eigen::VectorXd opens_;
};

}  // namespace clench
