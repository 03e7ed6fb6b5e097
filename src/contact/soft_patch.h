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
#include "clench/contact/patch_room.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// A body as a soft layer on a rigid core.
struct Elasticity {
  std::optional<double> modulus = {};  ///< Young's, > 0 [Pa]; none: rigid
  double layer = 0.003;                ///< height of the soft layer, > 0 [m]
  double poisson = 0;                  ///< Poisson's ratio, in [0, 0.5)
};

/// How far around a contact the surface counts: 0.4 m / cbrt(modulus of the stiffer elastic body in
/// Pa), and 5 mm where that is not between 3 and 10 mm.
double neighbourhood_radius(double modulus);

/// One place where two bodies touch softly; never changes. Contacts whose neighbourhoods overlap
/// share it.
struct SoftSite {
  ShapePtr a, b;
  Pose X_AB;
  Elasticity elastic_a, elastic_b;
  double radius = 0;                      ///< of the neighbourhood of each point [m]
  std::vector<Eigen::Vector3d> points_A;  ///< of the contacts, half way between the surfaces [m]
  Eigen::Vector3d centre_A;               ///< their mean
  Eigen::Vector3d normal_A;               ///< unit, into b: along the mean of theirs
};

using SoftSitePtr = std::shared_ptr<const SoftSite>;

/// The site of each touch, equal for those that share one: touches nearer to each other than two
/// radii, whose normals differ by less than 40 degrees, and all that such steps lead to, in
/// whatever order they come.
std::vector<SoftSitePtr> soft_sites(const ShapePtr& a, const ShapePtr& b, const Pose& X_AB,
                                    const Elasticity& elastic_a, const Elasticity& elastic_b,
                                    const std::vector<Touch>& touches);

struct PatchOptions {
  std::optional<double> radius = {};  ///< instead of the site's, of the bodies' size, > 0 [m]
  /// stands for the relative radius of a direction along which the surfaces do not part, > 0 [m]
  double max_radius = 0.02;
  PatchFit fit = PatchFit::quadric;
};

/// beyond this, a relative radius counts as none [m]
inline constexpr double flattest_radius = 1;

/// The surfaces of both bodies around a soft contact; all in the frame of a.
struct SoftPatch {
  Eigen::Vector3d centre_A, normal_A;  ///< unit, into b
  double radius = 0;                   ///< of the neighbourhood [m]
  /// of a and of b; their normals go into them
  std::array<SurfaceFit, 2> surfaces;
  std::array<std::vector<Eigen::Vector3d>, 2> points;  ///< that the fits are of
  /// Of the gap between the surfaces along `directions`, the more curved one first [m]. Where they
  /// part slower than a ball of twice flattest_radius from a plane, or not at all: max_radius, but
  /// no less than the first. From flattest_radius on the one goes over into the other.
  std::array<double, 2> relative_radii = {};
  std::array<bool, 2> flat = {};
  /// Unit, orthogonal to each other and to the normal. Where the gap bends alike in all directions,
  /// to 5 %, they are those of the region where the surfaces meet.
  Eigen::Matrix<double, 3, 2> directions;
  bool directed = true;       ///< false where that is alike in all directions, too: they are any
  double max_radius = 0.02;   ///< as it was asked for [m]
  std::vector<GapPlace> gap;  ///< as it is; none: as the radii have it
  std::array<PatchRoom, 2> rooms;  ///< half widths of a and b, as far as they are known
  SoftSite site;                   ///< what it is of: larger patches look farther for room
  /// 0 to 1: is there a crease that the fit does not follow? 0 where the fit is off by 10 % of the
  /// surface's relief, or creases around a contact are as long as 0.2 of the radius, 1 from 20 %
  /// and 0.6 on, and where there is too little to fit.
  double crease = 0;
  /// root of the mean square that points lie from their fit, of the worse surface [m]
  double residual = 0;
  /// Is there a corner or an edge? The weight w of contact_ellipse is above 0.5 where the
  /// indentation is small.
  bool at_edge = false;
  Elasticity elastic_a, elastic_b;
};

/// throws  Error when an option is out of range, the fit is not in this build, or there is not
///         enough within a radius that was asked for
SoftPatch soft_patch(const SoftSite& site, const PatchOptions& options = {});

/// Where two bodies press on each other: an ellipse along the patch's directions.
struct ContactEllipse {
  std::array<double, 2> semi_axes = {};  ///< [m]
  double indentation = 0;                ///< in the middle [m]
  double pressure = 0;                   ///< in the middle, indentation / c [Pa]
  /// Is the indentation larger than the soft layers together are high? Then a thin layer is no
  /// model.
  bool exceeds_layer = false;
};

/// Mattress of springs: indentation = sqrt(F c / (pi sqrt(R1 R2))) with the compliance c, layer
/// over modulus; semi-axis = sqrt(2 indentation R). The pressure falls as a paraboloid to the rim:
/// F = pi / 2 pressure a b.
///
/// In no direction is the ellipse wider than the surfaces: those of a pad end at its rim, those of
/// a round body where they lean by 73 degrees. What is cut off makes it deeper, by the same F.
///
/// Where the surfaces do not meet over such an ellipse, as at a corner or an edge, only what is
/// sure to touch counts: where the gap is no wider than the indentation of flat surfaces under that
/// force, that is, of R1 = R2 = max_radius. What is sharper goes deeper. How wide that is its
/// moments tell. From the one rule to the other it goes by the weight w, as a^(1 - w) b^w, the
/// larger of two: the patch's crease, and how much narrower the surfaces meet than the fitted ones,
/// 0 where the mean semi-axis is 85 % of theirs, 1 at 65 %. The indentation goes by the same weight
/// to that of the gap as it is within the neighbourhood: where the springs under it make up the
/// force. It is more than what is sure to touch tells of the width, and the pressure is of no
/// paraboloid there.
///
/// force   normal, >= 0 [N]
/// throws  Error when it is negative or not finite
/// source  Johnson (1985), Contact mechanics, ch. 4.3: the elastic foundation
ContactEllipse contact_ellipse(const SoftPatch& patch, double force,
                               ModulusRule rule = ModulusRule::series);

/// 8 sqrt(ab) / 15 of the ellipse's semi-axes: friction mu resists a torque about the normal up to
/// mu F times this [m]. Exact where a = b.
/// throws  as contact_ellipse
double torsion_radius(const SoftPatch& patch, double force, ModulusRule rule = ModulusRule::series);

}  // namespace clench
