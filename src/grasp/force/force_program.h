// The cone program whose solution contact forces are.
#pragma once
#include "clench/grasp/force/force_options.h"
#include "clench/math/cone_builder.h"

namespace clench {

/// f of the contacts, u of the joints, and what else the program asks for, with the rows that a
/// proof is read from
struct ForceProgram {
  GraspMap map;
  Vector6d load_O = Vector6d::Zero();
  JointBalance joints;
  ConeBuilder builder;
  int f = 0, u = 0;
  int extra = 0;      // what is left, the multiple of the load, or how far inside all forces are
  ConeRange balance;  // its torques over arm
  double arm = 1;     // about the longest of a contact, a power of two [m]
  std::vector<ConeRange> cones, caps;  // one per contact; caps empty without
  Eigen::VectorXd low, high;           // of the efforts, as they are bounded here
  Eigen::VectorXd
      at_rest;  // efforts that springs and weights alone want: u is what is given beyond them
  std::vector<ConeRange> lows, highs;  // one per effort; count 0: no bound
  ConeProgram program;
  ConeSolution solution;

  int normal(int contact) const { return f + map.starts[contact]; }
};

/// a wrench in other axes
inline Vector6d turned_wrench(const Vector6d& wrench, const Eigen::Matrix3d& R) {
  Vector6d out;
  out << R * wrench.head<3>(), R * wrench.tail<3>();
  return out;
}

enum class ForceQuestion {
  forces,   ///< that balance the load
  nearest,  ///< that leave the least of it
  largest   ///< multiple of the load that some balance
};

/// Made and solved.   options  as contact_forces checks them
ForceProgram make_program(const World& world, const Grasp& grasp, const ForceOptions& options,
                          ForceQuestion question);

}  // namespace clench
