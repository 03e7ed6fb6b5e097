// Scenes of the dynamics bench as plain values, of which each engine makes its own.
#pragma once
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "clench/geometry/mesh/mesh.h"
#include "clench/math/pose.h"

namespace clench::bench {

enum class Form { box, cylinder, capsule, mesh };  ///< round ones about z

struct Part {
  Form form = Form::box;
  Eigen::Vector3d size =
      {};  ///< edges of a box or of what bounds a mesh; else radius, radius, length (of a capsule
           ///< without its caps) [m]
  double mass = 0;  ///< [kg]; 0: it stands
  Pose X_W = {};
  std::shared_ptr<const Mesh> mesh = {};  ///< with its centroid at the origin
};

/// A hinge or slider that moves a part against an earlier one or the world, at 0 where the scene
/// begins.
struct Link {
  int part = 0, parent = -1;
  bool slides = false;
  Eigen::Vector3d origin, axis;       ///< in the world
  double kp = 0, kd = 0, target = 0;  ///< a spring and a damper, of a hinge
  double effort = 0;                  ///< that acts always, of a slider [N]
  double viscous = 0;                 ///< damping of a slider [N s/m]
};

struct DynamicScene {
  std::string name;
  std::vector<Part> parts = {};
  std::vector<Link> links = {};
  double mu = 0.5;
  int watched = 0;  ///< the part that counts
};

/// A plate whose upper side is z = 0.
Part ground_part();
/// Four walls on the ground.
/// half  of the free width [m]
DynamicScene empty_bin(const std::string& name, double half, double height);

/// gap  between bodies that touch: each engine rests at its own [m]
DynamicScene stack_of_ten(double gap);
/// 20 boxes of many sizes that fall turned, one after another, into a bin of 30 cm.
DynamicScene boxes_in_a_bin(double gap);
DynamicScene slope(double degrees, double mu, double gap);
/// Three fingers of three hinges that hang about a cylinder of 0.3 kg and press with some 5 N each.
DynamicScene three_fingers(double gap);
/// Two pads on sliders that squeeze a capsule of 45 g, radius 4 mm, that lies across them
/// (mujoco#3328).
DynamicScene pinched_capsule(double force, double gap);
/// The same pads about a cube, whose weight is that which friction `share` of mu would just hold.
DynamicScene critical_grip(double share, double gap);

/// Closed and centered; round ones have corners at 0, 120 and 180 degrees, where our scenes touch
/// them.
Mesh mesh_of(const Part& part);

inline constexpr double gravity = 9.81;
inline constexpr double slope_angle = 30;

}  // namespace clench::bench
