// Poses of a world along the motion of one step: where everything is at a given time if it keeps
// its present velocities. A body that presses on another and rotates along with it is moved
// relative to that: moving along the tangent, it would drift off the arc step by step. The same
// holds for a body that sticks to one whose velocity was set from outside: it would lag behind by
// one step.
#pragma once
#include <optional>

#include "clench/dynamics/tree/articulation.h"

namespace clench {

class Mover {
 public:
  /// system  must outlive the Mover
  Mover(World& world, const System& system);

  /// Places everything where it is s after the start [s].
  void place(double s);
  /// Places two bodies where they are s after the start [s]; other bodies may keep their poses.
  /// Both must be restored to the time of the last place() before other code uses their poses.
  void place_pair(double s, Id<Body> a, Id<Body> b);
  /// Like place(); then sets the velocities of free bodies and of floating robots that conserve
  /// their momentum.
  void finish(double s);

 private:
  struct Part {  // a free body with all that is welded to it, or a prescribed body
    Id<Body> body;
    Pose X_WB;
    Twist twist;          // at com, at the start
    Eigen::Vector3d com;  // of the whole part, in the frame of the body [m]
    // about com, in that frame [kg m^2]; none: prescribed motion
    std::optional<Eigen::Matrix3d> inertia;
    Twist after = {};                      // pose at the last placement
    std::optional<Id<Body>> carrier = {};  // the body that it presses on and moves along with
    Pose X_WC = {};                        // of the carrier, at the start
    Twist relative = {};                   // relative to the carrier, at com, in the carrier's axes
  };
  static Part free_part(const World& world, const Articulation& tree);
  class Carriers;
  void find_carriers(const System& system);
  void find_floating(const System& system);
  /// A tree of robots with a floating root.
  struct Floating {
    const Articulation* tree;
    Eigen::VectorXd v;  // of its coordinates, at the start
    Vector6d momentum;  // linear, and angular about the world's origin
  };
  struct RobotStart {  // pose and velocities of a robot when the step began
    Id<Robot> robot;
    Pose X_WB;  // of its base, if nothing carries it
    Twist twist;
    std::vector<double> dofs, joints, dof_velocities, joint_velocities;
    std::vector<int> picked_up = {};  // joints that their DOF has reached, at the last placement
    bool rests() const;
  };
  Pose moved(const Part& part, double s, Twist& after) const;
  Pose carried(const Part& part, double s) const;
  void place_welded();
  void find_movers(const System& system);

  World& world_;
  double placed_ = -1;  // current time of everything [s]; negative: nothing has been placed yet
  // by the index of the body's id: the index of its part, or one of these constants
  static constexpr int stands = -1, by_others = -2;
  std::vector<int> part_of_;
  std::vector<Part> parts_;         // carriers before the bodies that they carry
  std::vector<RobotStart> robots_;  // carriers before the bodies that they carry
  std::vector<Floating> floating_;
  struct Welded {
    Id<Body> body, to;
    Pose X_WB, X_WT;
  };
  std::vector<Welded> welded_;  // likewise
};

}  // namespace clench
