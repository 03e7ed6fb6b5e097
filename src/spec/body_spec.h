// A body as a file describes it: a plain value, in SI.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "clench/spec/mesh_report.h"
#include "clench/spec/valid.h"

namespace clench {

/// How a body looks; physics does not read it.
struct Appearance {
  /// linear part of the file's diffuse colour, 0..1
  Eigen::Vector3f color = Eigen::Vector3f(0.7f, 0.7f, 0.7f);
  float transparency = 0;                        ///< 0 opaque .. 1 invisible
  std::vector<Eigen::Vector3f> triangle_colors;  ///< one per triangle, or empty
  bool given = false;                            ///< does it come from the file?
  ShapePtr visual = {};  ///< drawn instead of the body's shape; null: that shape itself
};

/// Where a value comes from.
enum class Origin : char { assumed, file, script };

struct BodySpec {
  std::string name;    ///< file stem unless the user says otherwise
  std::string source;  ///< file it was read from, as it was named; empty when made in a script
  std::string file;    ///< the same, absolute
  ShapePtr shape;      ///< null: a frame without geometry, which never collides
  std::optional<MeshReport> mesh_report;  ///< of geometry from a file
  Appearance appearance;
  std::string material = "wood";
  double mass = 0.3;                                ///< [kg]
  Origin material_from = Origin::assumed, mass_from = Origin::assumed;
  bool assumptions_told = false;  ///< was it told that material or mass are assumed?
  bool inertia_told = false;  ///< was it told where an inertia not given comes from?
  /// centre of mass in the body frame [m]; else from the shape
  std::optional<Eigen::Vector3d> com;
  std::optional<Eigen::Matrix3d> inertia_per_mass;  ///< about com [m^2]; else from the shape
  std::optional<double> elastic_modulus;            ///< Young's modulus [Pa]; absent: rigid
  double soft_layer = 0.003;  ///< of an elastic body: height of its soft layer, > 0 [m]
  double poisson_ratio = 0;   ///< likewise, in [0, 0.5)
  double restitution = 0;     ///< speed after a blow by that before, in [0, 1]
  /// resistance of a body that moves freely, or of the base of a robot that floats: alike for the
  /// velocity of the origin of its frame [m/s] and for that of turning [rad/s]
  double free_damping = 0;   ///< [N s/m] and [N m s/rad]
  double free_friction = 0;  ///< dry, along each axis [N] and about each of its own axes [N m]
  double free_armature = 0;  ///< added inertia without weight [kg] and [kg m^2]
  double gravity_compensation = 0;  ///< part of its weight that simulations leave out
  std::optional<int> tracker;       ///< number of the position sensor that drives it
};

/// what    it is, before its name
/// throws  Error "body 'cup': mass: expected a number from 1e-12 to 1e+12 [kg], got 0" for a name
///         or number that its rule refuses
void check_body(const BodySpec& spec, std::string_view what);
void check_appearance(const Appearance& appearance, std::string_view subject);

/// Centre of mass as the spec gives it, else the solid's; of an open surface, the surface's [m].
Eigen::Vector3d com_of(const BodySpec& spec);
/// Inertia per mass about the centre of mass as the spec gives it, else the solid's; of an open
/// surface, or one folded on itself without a volume, that of a solid ball of the surface's radius
/// [m^2].
Eigen::Matrix3d inertia_of(const BodySpec& spec);
/// Is it that ball's?
bool inertia_is_of_ball(const BodySpec& spec);

}  // namespace clench
