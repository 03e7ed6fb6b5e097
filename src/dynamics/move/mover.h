// A world along the motion of one step: where everything is at a time, were it to go on with the
// velocities that it has. What is pressed to something and turns along with it has its velocity
// relative to that: along the tangent it would come away from the arc, step by step. So has what
// sticks to something that somebody gives another velocity: it would stay behind by a step.
#pragma once
#include <optional>

#include "clench/dynamics/tree/articulation.h"

namespace clench {

class Mover {
 public:
  /// system  outlives it
  Mover(World& world, const System& system);

  /// Puts everything where it is s after the start [s].
  void place(double s);
  /// Puts two bodies where they are s after the start [s]; other bodies may stay where they are.
  /// Afterwards both must be put back, at the time of the last place(), before other code uses
  /// their poses.
  void place_pair(double s, Id<Body> a, Id<Body> b);
  /// The same as place(); then free bodies and robots that float have the velocity that keeps their
  /// momentum.
  void finish(double s);

 private:
  struct Part {  // a free body with what is welded to it, or one that moves as it is told
    Id<Body> body;
    Pose X_WB;
    Twist twist;          // at com, at the start
    Eigen::Vector3d com;  // of all, in the frame of the body [m]
    std::optional<Eigen::Matrix3d>
        inertia;       // of all about it, in that frame [kg m^2]; none: it moves as it is told
    Twist after = {};  // where it was placed
    std::optional<Id<Body>> carrier = {};  // what it is pressed to, and goes along with
    Pose X_WC = {};                        // of that, at the start
    Twist relative = {};                   // to that, at com, in its axes
  };
  static Part free_part(const World& world, const Articulation& tree);
  class Carriers;
  void find_carriers(const System& system);
  void find_floating(const System& system);
  /// A tree of robots whose root floats.
  struct Floating {
    const Articulation* tree;
    Eigen::VectorXd v;  // of its coordinates, at the start
    Vector6d momentum;  // linear, and angular about the world's origin
  };
  struct RobotStart {  // a robot as it stood and moved when the step began
    Id<Robot> robot;
    Pose X_WB;  // of its base, when nobody carries it
    Twist twist;
    std::vector<double> dofs, joints, dof_velocities, joint_velocities;
    std::vector<int> picked_up = {};  // joints that their DOF has met, where it was placed
    bool rests() const;
  };
  Pose moved(const Part& part, double s, Twist& after) const;
  Pose carried(const Part& part, double s) const;
  void place_welded();
  void find_movers(const System& system);

  World& world_;
  double placed_ = -1;  // where everything is [s]; negative: nobody has been asked to move
  // by the index of the body's id: the index of its part, or one of these constants
  static constexpr int stands = -1, by_others = -2;
  std::vector<int> part_of_;
  std::vector<Part> parts_;         // carriers before what they carry
  std::vector<RobotStart> robots_;  // carriers before what they carry
  std::vector<Floating> floating_;
  struct Welded {
    Id<Body> body, to;
    Pose X_WB, X_WT;
  };
  std::vector<Welded> welded_;  // likewise
};

}  // namespace clench
