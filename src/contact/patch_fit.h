// Curvature of a surface at a contact, fitted to points of it.
#pragma once
#include <Eigen/Core>
#include <span>

namespace clench {

/// Local shape of a surface at a contact, in the frame of its points, whose +z points into the
/// body.
struct SurfaceFit {
  /// principal curvatures, descending; positive for a convex surface such as a ball, negative for a
  /// concave one such as a socket [1/m]
  Eigen::Vector2d curvatures = Eigen::Vector2d::Zero();
  /// unit, one per column, orthogonal to each other and to the normal
  Eigen::Matrix<double, 3, 2> directions = Eigen::Matrix<double, 3, 2>::Identity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, into the body
  double residual = 0;  ///< root mean square distance of the points from the fit [m]
  /// root mean square distance of the points from their mean height over the tangent plane [m]
  double relief = 0;
};

enum class PatchFit {
  quadric,  ///< least squares, see fit_quadric
  jet       ///< CGAL's Monge_via_jet_fitting, in builds with CLENCH_CGAL
};

/// Least squares of z = c + Dx + Ey + Ax^2 + By^2 + Cxy + m/2 z^2, in the tangent plane: the frame
/// is rotated until D and E vanish, so that a tilt does not count as curvature. m is the curvature
/// in the point's direction: profiles are circles, so balls and cylinders of any size are exact.
///
/// points   surface points around (0, 0), at least 3, +z into the body [m]
/// scale    of their distances, > 0 [m]
/// weights  of the squares, one per point, >= 0; none: all 1
/// throws   Error for less than 3 points
SurfaceFit fit_quadric(std::span<const Eigen::Vector3d> points, double scale,
                       std::span<const double> weights = {});

/// The same by a polynomial of degree 4 and the Monge form.
///
/// throws  Error for less than 15 points, and in builds without CGAL
/// source  Cazals & Pouget (2005), Estimating differential quantities using polynomial fitting of
///         osculating jets
SurfaceFit fit_jet(std::span<const Eigen::Vector3d> points, double scale);

/// Is fit_jet available in this build?
bool has_fit_jet();

/// residual and relief of points in the frame of a fit's directions and normal, about `origin`
void measure_fit(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& origin,
                 SurfaceFit& fit, std::span<const double> weights = {});

}  // namespace clench
