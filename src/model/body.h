// A body of the world.
#pragma once
#include <optional>
#include <string>

#include "clench/base/id.h"
#include "clench/math/pose.h"
#include "clench/spec/body_spec.h"

namespace clench {

struct Robot;

enum class BodyKind { object, obstacle, base, link, mount };

struct Body {
  std::string name;    ///< unique in its world
  std::string source;  ///< file that it was read from; empty if made in a script
  std::string file;    ///< the same, absolute
  BodyKind kind = BodyKind::object;
  ShapePtr shape;  ///< null: a frame without geometry
  std::optional<MeshReport> mesh_report;
  Appearance appearance;
  int material = 0;  ///< index into the world's material table
  double mass = 0;   ///< [kg]
  Origin material_from = Origin::assumed, mass_from = Origin::assumed;
  Eigen::Vector3d com;                    ///< in the body frame [m]
  Eigen::Matrix3d inertia_per_mass;       ///< about com, body axes [m^2]
  std::optional<double> elastic_modulus;  ///< [Pa]
  double soft_layer = 0.003;              ///< of an elastic body: height of its soft layer [m]
  double poisson_ratio = 0;               ///< likewise
  double restitution = 0;                 ///< coefficient of restitution, in [0, 1]
  double free_damping = 0, free_friction = 0, free_armature = 0;  ///< as in BodySpec
  double gravity_compensation = 0;  ///< fraction of its weight that simulations compensate
  std::optional<int> tracker;

  // place in a robot, if it belongs to one
  Id<Robot> robot;
  int link = -1;  ///< -1: base or mount

  /// largest distance of the surface from the center of mass [m]; scales torques
  double max_radius() const;
};

/// Converts a spec; see com_of and inertia_of for values that it leaves open.
Body make_body(const BodySpec& spec, BodyKind kind);

}  // namespace clench
