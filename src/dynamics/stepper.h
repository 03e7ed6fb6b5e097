// The step: bodies move with the velocities that they have, then contacts are found, then
// velocities are solved for.
// source  Stewart & Trinkle (1996), An implicit time-stepping scheme for rigid body dynamics with
//         inelastic collisions and Coulomb friction; de Saxce & Feng (1998) for the cone; Anitescu
//         & Hart (2004) for gaps in the right-hand side
#pragma once
#include "clench/dynamics/step/solve_islands.h"

namespace clench {

/// Steps a world. Holds only scratch memory; all state is in the World, so a new Stepper continues
/// bit-exactly. A step that is stopped (see base/watched.h) throws Stopped; a step that throws leaves
/// the world bit-exactly as it was before.
class Stepper {
 public:
  explicit Stepper(World& world);

  /// Moves everything with its velocity until dt has passed [s] or two approaching bodies touch.
  /// returns  the time that has passed, in (0, dt] [s]
  double move(double dt);
  /// Solves for the velocities after forces, contacts, limits and motors have acted for a time of h
  /// [s].
  void solve(double h);
  /// One step of a run that ends at a given time [s].
  /// returns  false if the run has ended and no step was made
  bool step(double end);
  /// Steps until exactly `duration` has passed [s].
  void run(double duration);

 private:
  void refresh();
  double move_bodies(double dt);
  void solve_velocities(double h);

  World& world_;
  System system_;
  uint64_t stamp_ = 0, settings_stamp_ = 0;  // model and settings that system_ was built for
  std::vector<unsigned char> follows_;       // joints that followed their DOF then
  StepProblem problem_;
  IslandSolver islands_;
};

}  // namespace clench
