// A world along the motion of one step: where everything is at a time, were it to go on with the velocities that it has.
#pragma once
#include "clench/dynamics/tree/articulation.h"

namespace clench {

class Mover {
 public:
  Mover(World& world, const System& system);

  /// Puts everything where it is s after the start [s].
  void place(double s);
  /// The same; what turns freely has then the velocity that keeps its angular momentum.
  void finish(double s);

 private:
  struct Part {  // a free body, or one that moves as it is told
    Id<Body> body;
    Pose X_WB;
    Twist twist;
    bool free = false;
  };
  struct Machine {  // a robot
    Id<Robot> robot;
    Pose X_WB;  // of its base, when nobody carries it
    Twist twist;
    std::vector<double> dofs, joints, dof_velocities, joint_velocities;
  };
  Pose moved(const Part& part, double s, Twist& after) const;
  void place(double s, bool finish);

  World& world_;
  std::vector<Part> parts_;
  std::vector<Machine> machines_;  // carriers before what they carry
};

}  // namespace clench
