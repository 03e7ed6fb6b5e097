// What to draw, as a plain list: no world, no graphics library.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grasp/grasp.h"
#include "model/world.h"

namespace clench {

struct DrawMesh {
  std::shared_ptr<const Shape> shape;
  Pose X_WM;
  Eigen::Vector3f color;
  std::vector<Eigen::Vector3f> triangle_colors;  ///< one a triangle, or empty
  float opacity = 1;
};

/// Friction cone: apex at the contact, opening along the axis.
struct DrawCone {
  Eigen::Vector3d apex, axis;   ///< world; axis unit
  double half_angle = 0;        ///< [rad]
  double height = 0;            ///< [m]
  Eigen::Vector3f color;
};

struct Eye {
  Eigen::Vector3d eye, target, up;
  double field_of_view = 0.6;   ///< vertical [rad]
};

struct Scene {
  std::vector<DrawMesh> meshes;
  std::vector<DrawCone> cones;
  std::optional<double> ground;   ///< height of a floor plane that takes the shadow [m]
  std::optional<Eye> eye;         ///< empty: frame everything
};

struct SceneOptions {
  bool contacts = true;            ///< draw friction cones at the contacts of robots with objects
  bool ground = true;
  bool transparent_objects = true; ///< so that contacts show
  bool file_colors = true;         ///< colours of the files, where they give any; else by kind of body
  std::optional<Eye> eye;
};

/// source colours by kind: base, links, objects, obstacles each have one
Scene make_scene(const World& world, const SceneOptions& options = {});

}  // namespace clench
