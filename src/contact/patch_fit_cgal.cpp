#include "clench/base/error.h"
#include "clench/contact/patch_fit.h"

#ifdef CLENCH_CGAL
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#endif

namespace clench {

#ifdef CLENCH_CGAL

bool has_fit_jet() { return true; }

SurfaceFit fit_jet(std::span<const Eigen::Vector3d> points, double scale) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Fitting = CGAL::Monge_via_jet_fitting<Kernel>;
  constexpr size_t coefficients = 15;  // of degree 4
  if (points.size() < coefficients)
    fail("contact patch: a jet needs at least {} points, got {}", coefficients, points.size());

  // the fit is at its first point: the one nearest to the contact
  size_t nearest = 0;
  for (size_t i = 1; i < points.size(); ++i)
    if (points[i].head<2>().squaredNorm() < points[nearest].head<2>().squaredNorm()) nearest = i;
  std::vector<Kernel::Point_3> given;
  const auto add = [&](const Eigen::Vector3d& p) {
    given.emplace_back(p.x() / scale, p.y() / scale, p.z() / scale);
  };
  add(points[nearest]);
  for (size_t i = 0; i < points.size(); ++i)
    if (i != nearest) add(points[i]);

  Fitting fitting;
  auto monge = fitting(given.begin(), given.end(), 4, 2);
  monge.comply_wrt_given_normal(Kernel::Vector_3(0, 0, 1));
  const auto vector = [](const Kernel::Vector_3& v) {
    return Eigen::Vector3d(v.x(), v.y(), v.z());
  };
  SurfaceFit fit;
  fit.curvatures << monge.principal_curvatures(0) / scale, monge.principal_curvatures(1) / scale;
  fit.directions.col(0) = vector(monge.maximal_principal_direction());
  fit.directions.col(1) = vector(monge.minimal_principal_direction());
  fit.normal = vector(monge.normal_direction());
  const auto origin = monge.origin();
  measure_fit(points, scale * Eigen::Vector3d(origin.x(), origin.y(), origin.z()), fit);
  return fit;
}

#else

bool has_fit_jet() { return false; }

SurfaceFit fit_jet(std::span<const Eigen::Vector3d>, double) {
  fail("contact patch: this build has no CGAL; use the fit 'quadric'");
}

#endif

}  // namespace clench
