#include "clench/spec/inertia.h"

#include "clench/base/error.h"
#include "clench/math/decompositions.h"
#include "clench/spec/valid.h"

namespace clench {

// radii of gyration from a picometer to ten times the bound of coordinates
static constexpr double min_moment = 1e-24, max_moment = 1e20;
// of the largest moment: rounding
static constexpr double rounding = 1e-12;
// numbers of three digits have errors of half a percent, in opposite directions for a moment and
// for the sum of the others
static constexpr double triangle_rounding = 1.01;

InertiaFault inertia_fault(const Eigen::Matrix3d& per_mass) {
  if (!(per_mass.array().abs() <= max_moment).all()) return InertiaFault::not_definite;
  const double size = per_mass.cwiseAbs().maxCoeff();
  if ((per_mass - per_mass.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size)
    return InertiaFault::not_symmetric;
  const Eigen::Vector3d moments = eigenvalues(per_mass);
  if (!(moments[0] >= min_moment && moments[0] > rounding * moments[2]))
    return InertiaFault::not_definite;
  return moments[2] > triangle_rounding * (moments[0] + moments[1]) ? InertiaFault::breaks_triangle
                                                                    : InertiaFault::none;
}

void check_inertia(const Eigen::Matrix3d& per_mass, std::string_view subject) {
  switch (inertia_fault(per_mass)) {
    case InertiaFault::none:
      return;
    case InertiaFault::not_symmetric:
      fail("{}: inertia: expected a symmetric matrix, got one that is not", subject);
    case InertiaFault::not_definite:
      fail(
          "{}: inertia: expected a positive definite matrix with moments of {:g} to {:g} m^2 per "
          "kilogram, got another",
          subject, min_moment, max_moment);
    case InertiaFault::breaks_triangle: {
      const Eigen::Vector3d moments = eigenvalues(per_mass);
      fail(
          "{}: inertia: expected no moment above the sum of the others, got one of {:.4g} times "
          "that sum",
          subject, moments[2] / (moments[0] + moments[1]));
    }
  }
}

Eigen::Matrix3d with_triangle(const Eigen::Matrix3d& per_mass) {
  auto [moments, axes] = eigensystem(per_mass);
  const double missing = 0.5 * (moments[2] - moments[0] - moments[1]);
  moments[0] += missing;
  moments[1] += missing;
  const Eigen::Matrix3d out = axes * moments.asDiagonal() * axes.transpose();
  return 0.5 * (out + out.transpose());
}

Inertial repair_inertia(Eigen::Matrix3d& per_mass) {
  switch (inertia_fault(per_mass)) {
    case InertiaFault::none:
      return Inertial::sound;
    case InertiaFault::breaks_triangle:
      per_mass = with_triangle(per_mass);
      return Inertial::no_body;
    default:
      return Inertial::not_definite;
  }
}

std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows, const Place& place,
                                               const Diagnostics& diagnostics) {
  if (rows != rows.transpose())
    diagnostics.repaired(place, "inertia_matrix is not symmetric; its symmetric part is used");
  Eigen::Matrix3d symmetric = 0.5 * (rows + rows.transpose());
  const Inertial fault = repair_inertia(symmetric);
  if (fault == Inertial::no_body) diagnostics.repaired(place, "{}", raised_moments);
  if (fault != Inertial::not_definite) return symmetric;
  diagnostics.warn(place, "inertia_matrix is not positive definite; it is computed from the shape");
  return {};
}

}  // namespace clench
