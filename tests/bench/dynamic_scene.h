// Scenes of the dynamics bench as plain values, from which each engine builds its own.
#pragma once
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "clench/geometry/mesh/mesh.h"
#include "clench/math/pose.h"

namespace clench::bench {

enum class Form { box, cylinder, capsule, mesh };  ///< round forms about z

struct Part {
  Form form = Form::box;
  /// edges of a box or of the bounding box of a mesh; else radius, radius, length (of a capsule
  /// without its caps) [m]
  Eigen::Vector3d size = {};
  double mass = 0;  ///< [kg]; 0: fixed
  Pose X_W = {};
  std::shared_ptr<const Mesh> mesh = {};  ///< with its centroid at the origin
};

/// A hinge or slider between a part and an earlier part or the world, at 0 in the initial scene.
struct Link {
  int part = 0, parent = -1;
  bool slides = false;
  Eigen::Vector3d origin, axis;       ///< in the world frame
  double kp = 0, kd = 0, target = 0;  ///< of the spring and damper of a hinge
  double effort = 0;                  ///< constant force of a slider [N]
  double viscous = 0;                 ///< damping of a slider [N s/m]
};

struct DynamicScene {
  std::string name;
  std::vector<Part> parts = {};
  std::vector<Link> links = {};
  double mu = 0.5;
  int watched = 0;  ///< the measured part
};

/// A plate whose upper side is z = 0.
Part ground_part();
/// Four walls on the ground.
/// half  half of the free width [m]
DynamicScene empty_bin(const std::string& name, double half, double height);

/// gap  between touching bodies, which differs between engines [m]
DynamicScene stack_of_ten(double gap);
/// 20 boxes of many sizes that fall, each with another orientation, one after another into a bin of
/// 30 cm.
DynamicScene boxes_in_a_bin(double gap);
DynamicScene slope(double degrees, double mu, double gap);
/// Three fingers of three hinges each that hang around a cylinder of 0.3 kg and press with some 5 N
/// each.
DynamicScene three_fingers(double gap);
/// Two pads on sliders that squeeze a capsule of 45 g, radius 4 mm, that lies across them
/// (mujoco#3328).
DynamicScene pinched_capsule(double force, double gap);
/// The same pads with a cube; mu is `share` times the coefficient that just holds its weight.
DynamicScene critical_grip(double share, double gap);

/// Closed and centered; round meshes have vertices at 0, 120 and 180 degrees, at the contact points
/// of the scenes.
Mesh mesh_of(const Part& part);

inline constexpr double gravity = 9.81;
inline constexpr double slope_angle = 30;

}  // namespace clench::bench
