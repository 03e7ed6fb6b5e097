// A body as a file describes it: a plain value, in SI.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "clench/spec/mesh_report.h"
#include "clench/spec/skin.h"
#include "clench/spec/valid.h"

namespace clench {

/// Appearance of a body; ignored by physics.
struct Appearance {
  /// linear part of the file's diffuse color, 0..1
  Eigen::Vector3f color = Eigen::Vector3f(0.7f, 0.7f, 0.7f);
  float transparency = 0;                        ///< 0 opaque .. 1 invisible
  std::vector<Eigen::Vector3f> triangle_colors;  ///< one per triangle, or empty
  bool given = false;                            ///< given by the file?
  ShapePtr visual = {};  ///< drawn instead of the body's shape; null: the shape is drawn
  SkinPtr skin = {};     ///< textures of the triangles that are drawn; null: none
};

/// Origin of a value.
enum class Origin : char { assumed, file, script };

struct BodySpec {
  std::string name;    ///< file stem unless the user sets another
  std::string source;  ///< file it was read from, as it was named; empty if made in a script
  std::string file;    ///< the same, absolute
  ShapePtr shape;      ///< null: a frame without geometry, which never collides
  std::optional<MeshReport> mesh_report;  ///< of geometry from a file
  Appearance appearance;
  std::string material = "wood";
  double mass = 0.3;  ///< [kg]
  Origin material_from = Origin::assumed, mass_from = Origin::assumed;
  bool assumptions_told = false;  ///< true once assumptions about material or mass are reported
  bool inertia_told = false;      ///< true once the source of a missing inertia is reported
  /// center of mass in the body frame [m]; absent: computed from the shape
  std::optional<Eigen::Vector3d> com;
  /// about com [m^2]; absent: computed from the shape
  std::optional<Eigen::Matrix3d> inertia_per_mass;
  std::optional<double> elastic_modulus;  ///< Young's modulus [Pa]; absent: rigid
  double soft_layer = 0.003;              ///< of an elastic body: height of its soft layer, > 0 [m]
  double poisson_ratio = 0;               ///< its Poisson's ratio, in [0, 0.5)
  double restitution = 0;                 ///< coefficient of restitution, in [0, 1]
  /// resistance of a free body, or of the floating base of a robot: to the velocity of the origin
  /// of its frame [m/s] and to its angular velocity [rad/s]
  double free_damping = 0;          ///< [N s/m] and [N m s/rad]
  double free_friction = 0;         ///< dry, along each axis of the body [N] and about it [N m]
  double free_armature = 0;         ///< added inertia without weight [kg] and [kg m^2]
  double gravity_compensation = 0;  ///< fraction of its weight that simulations compensate
  std::optional<int> tracker;       ///< number of the position sensor that drives it
};

/// what    kind of body, printed before its name
/// throws  Error "body 'cup': mass: expected a number from 1e-12 to 1e+12 [kg], got 0" for a name
///         or number that its rule rejects
void check_body(const BodySpec& spec, std::string_view what);
void check_appearance(const Appearance& appearance, std::string_view subject);

/// Center of mass of the spec, otherwise that of the solid; for an open surface, that of the
/// surface [m].
Eigen::Vector3d com_of(const BodySpec& spec);
/// Inertia per mass about the center of mass: that of the spec, otherwise that of the solid; for an
/// open surface, or one folded on itself without a volume, that of a solid ball with the surface's
/// radius [m^2].
Eigen::Matrix3d inertia_of(const BodySpec& spec);
/// Is the inertia that of such a ball?
bool inertia_is_of_ball(const BodySpec& spec);

}  // namespace clench
