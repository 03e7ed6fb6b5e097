// Soft fingers: the patch over which an elastic body presses on another, and its torsional
// friction.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "clench/contact/contact_set.h"
#include "clench/contact/patch_fit.h"
#include "clench/contact/patch_rings.h"
#include "clench/contact/patch_width.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// A body as a soft layer on a rigid core.
struct Elasticity {
  std::optional<double> modulus = {};  ///< Young's, > 0 [Pa]; none: rigid
  double layer = 0.003;                ///< height of the soft layer, > 0 [m]
  double poisson = 0;                  ///< Poisson's ratio, in [0, 0.5)
};

/// Radius of the surface considered around a contact: 0.4 m / cbrt(modulus of the stiffer elastic
/// body in Pa), and 5 mm if that is not between 3 and 10 mm.
double neighborhood_radius(double modulus);

/// One region where two bodies touch softly; immutable. Contacts whose neighborhoods overlap share
/// it.
struct SoftSite {
  ShapePtr a, b;
  Pose X_AB;
  Elasticity elastic_a, elastic_b;
  double radius = 0;                      ///< of the neighborhood of each point [m]
  std::vector<Eigen::Vector3d> points_A;  ///< of the contacts, half way between the surfaces [m]
  Eigen::Vector3d center_A;               ///< their mean
  Eigen::Vector3d normal_A;               ///< unit, into b: along the mean of their normals
};

using SoftSitePtr = std::shared_ptr<const SoftSite>;

/// The site of each touch, equal for those that share one: touches closer to each other than two
/// radii, whose normals differ by less than 40 degrees, and all that are reached by such steps,
/// independent of their order.
std::vector<SoftSitePtr> soft_sites(const ShapePtr& a, const ShapePtr& b, const Pose& X_AB,
                                    const Elasticity& elastic_a, const Elasticity& elastic_b,
                                    const std::vector<Touch>& touches);

struct PatchOptions {
  /// replaces the radius of the site, which follows from the bodies, > 0 [m]
  std::optional<double> radius = {};
  /// replaces the relative radius in a direction along which the surfaces do not separate, > 0 [m]
  double max_radius = 0.02;
  PatchFit fit = PatchFit::quadric;
};

/// larger relative radii count as infinite [m]
inline constexpr double flattest_radius = 1;

/// The surfaces of both bodies around a soft contact; all in the frame of a.
struct SoftPatch {
  Eigen::Vector3d center_A, normal_A;  ///< unit, into b
  double radius = 0;                   ///< of the neighborhood [m]
  /// of a and of b; their normals point into them
  std::array<SurfaceFit, 2> surfaces;
  std::array<std::vector<Eigen::Vector3d>, 2> points;  ///< points that were fitted
  /// Relative radii of the gap between the surfaces along `directions`, the more curved one first
  /// [m]. If they separate more slowly than a ball of twice flattest_radius from a plane, or not at
  /// all: max_radius, but no less than the first. Between flattest_radius and twice that the value
  /// changes gradually.
  std::array<double, 2> relative_radii = {};
  std::array<bool, 2> flat = {};
  /// Unit, orthogonal to each other and to the normal. If the curvatures of the gap are equal in
  /// all directions, to 5 %, they are the axes of the region where the surfaces touch.
  Eigen::Matrix<double, 3, 2> directions;
  bool directed = true;       ///< false if that is also isotropic: the directions are arbitrary
  double max_radius = 0.02;   ///< as requested [m]
  std::vector<GapPlace> gap;  ///< of the contact region; none: given by the radii
  std::array<PatchWidth, 2> widths;  ///< half widths of a and b, as far as they are known
  SoftSite site;                     ///< the bodies: larger patches query them for wider surfaces
  /// 0 to 1: is there a crease that the fit does not follow? 0 if the fit is off by 10 % of the
  /// surface's relief, or creases around a contact are as long as 0.2 of the radius; 1 from 20 %
  /// and 0.6 on, and if there is too little surface to fit.
  double crease = 0;
  /// root mean square distance of the points from their fit, of the worse surface [m]
  double residual = 0;
  /// Is there a corner or an edge? True if the weight w of contact_ellipse is above 0.5 for small
  /// indentations.
  bool at_edge = false;
  Elasticity elastic_a, elastic_b;
};

/// throws  Error if an option is out of range, the fit is not available in this build, or there is
///         too little surface within a radius that was requested
SoftPatch soft_patch(const SoftSite& site, const PatchOptions& options = {});

/// Contact region of two pressed bodies: an ellipse along the patch's directions.
struct ContactEllipse {
  std::array<double, 2> semi_axes = {};  ///< [m]
  double indentation = 0;                ///< at the center [m]
  double pressure = 0;                   ///< at the center, indentation / c [Pa]
  /// Is the indentation larger than the total height of the soft layers? The model of a thin layer
  /// is then invalid.
  bool exceeds_layer = false;
};

/// Mattress of springs: indentation = sqrt(F c / (pi sqrt(R1 R2))) with the compliance c, layer
/// over modulus; semi-axis = sqrt(2 indentation R). The pressure decreases as a paraboloid to the
/// rim: F = pi / 2 pressure a b.
///
/// The ellipse is in no direction wider than the surfaces: those of a pad end at its rim, those of
/// a round body where they lean by 73 degrees. If it is cut off there, it is deeper for the same F.
///
/// If the surfaces do not touch over such an ellipse, as at a corner or an edge, only the region of
/// certain contact counts: where the gap is no wider than the indentation of flat surfaces under
/// that force, that is, of R1 = R2 = max_radius. Sharper shapes penetrate deeper. The width of that
/// region follows from its moments. The two rules are blended as a^(1 - w) b^w. The weight w is the
/// larger of two: the patch's crease, and one for the width of the contact region relative to that
/// of the fitted surfaces, 0 if the mean semi-axis is 85 % of theirs, 1 at 65 %. The same weight
/// blends the indentation with that of the actual gap within the neighborhood, at which the springs
/// under it sum to the force. That indentation exceeds what the width of the region of certain
/// contact implies, and the pressure is not that of a paraboloid there.
///
/// force   normal, >= 0 [N]
/// throws  Error if it is negative or not finite
/// source  Johnson (1985), Contact mechanics, ch. 4.3: the elastic foundation
ContactEllipse contact_ellipse(const SoftPatch& patch, double force,
                               ModulusRule rule = ModulusRule::series);

/// 8 sqrt(ab) / 15 of the ellipse's semi-axes: friction mu resists a torque about the normal of up
/// to mu F times this [m]. Exact if a = b.
/// throws  as contact_ellipse
double torsion_radius(const SoftPatch& patch, double force, ModulusRule rule = ModulusRule::series);

}  // namespace clench
