// The cone program of contact forces.
#pragma once
#include "clench/grasp/force/force_options.h"
#include "clench/math/cone_builder.h"

namespace clench {

/// f of the contacts, u of the joints, and further unknowns of the program, with the rows from
/// which a proof is read
struct ForceProgram {
  GraspMap map;
  Vector6d load_O = Vector6d::Zero();
  JointBalance joints;
  ConeBuilder builder;
  int f = 0, u = 0;
  // unbalanced wrench, multiple of the load, or distance of all forces from their boundaries
  int extra = 0;
  ConeRange balance;                   // its torques over arm
  double arm = 1;                      // longest lever arm of a contact, a power of two [m]
  std::vector<ConeRange> cones, caps;  // one per contact; caps empty if there are none
  Eigen::VectorXd low, high;           // of the efforts, with their bounds here
  Eigen::VectorXd at_rest;  // efforts due to springs and weights alone: u is relative to them
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
  forces,   ///< balances the load
  nearest,  ///< leaves the smallest part of it
  largest   ///< largest multiple of the load that is balanced
};

/// Builds and solves the program.
/// options  as checked by contact_forces
ForceProgram make_program(const World& world, const Grasp& grasp, const ForceOptions& options,
                          ForceQuestion question);

/// A program in which one preload of the hand's motors holds several loads.
struct LoadedProgram {
  /// minimizes `extra`: the largest effort as a fraction of its limit, times `unit`
  ForceProgram program;
  double unit = 1;               ///< largest limit, so that `extra` has the size of efforts
  std::vector<int> forces = {};  ///< per load: column of the contact forces
  int efforts = 0;               ///< column of the efforts of the preload, relative to `at_rest`
};

/// Motors exert the same efforts at each load.
/// loads_O  not empty
LoadedProgram make_constant_preload(const World& world, const Grasp& grasp,
                                    const ForceOptions& options,
                                    const std::vector<Vector6d>& loads_O);
/// Motors balance forces without a load; each load changes these forces by a given response.
LoadedProgram make_locked_preload(const World& world, const Grasp& grasp,
                                  const ForceOptions& options,
                                  const std::vector<Eigen::VectorXd>& responses);

}  // namespace clench
