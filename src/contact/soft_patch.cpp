#include "contact/soft_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "contact/cone.h"
#include "contact/patch_points.h"
#include "math/decompositions.h"

namespace clench {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static const double one_side = std::cos(40 * std::numbers::pi / 180);  // normals of one site
static constexpr double sharp_part = 0.15;    // of the relief: the fit does not follow
static constexpr double least_relief = 1e-4;  // of the radius: flat, whatever noise there is
static constexpr double whole_extent = 0.85;  // of the neighbourhood's: the surface goes on
static constexpr size_t least_points = 15;    // of the 197 of a disc; also what a jet needs

double neighbourhood_radius(double modulus) {
  const double radius = 0.4 / std::cbrt(modulus);
  return radius > 0.003 && radius < 0.01 ? radius : 0.005;
}

static double larger_modulus(const Elasticity& a, const Elasticity& b) {
  return std::max(a.modulus.value_or(0), b.modulus.value_or(0));
}

// --- sites ---

std::vector<SoftSitePtr> soft_sites(const ShapePtr& a, const ShapePtr& b, const Pose& X_AB,
                                    const Elasticity& elastic_a, const Elasticity& elastic_b,
                                    const std::vector<Touch>& touches) {
  const double radius = neighbourhood_radius(larger_modulus(elastic_a, elastic_b));
  const size_t count = touches.size();
  std::vector<Vector3d> points;
  for (const Touch& touch : touches) points.push_back(0.5 * (touch.p_a + touch.p_b));

  // what steps lead to gets the least number of all
  std::vector<size_t> group(count);
  std::iota(group.begin(), group.end(), size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t i = 0; i < count; ++i)
      for (size_t j = 0; j < i; ++j) {
        if (group[i] == group[j] || (points[i] - points[j]).norm() >= 2 * radius) continue;
        if (touches[i].normal_b.dot(touches[j].normal_b) < one_side) continue;
        group[i] = group[j] = std::min(group[i], group[j]);
        changed = true;
      }
  }

  std::vector<SoftSitePtr> out(count);
  for (size_t first = 0; first < count; ++first) {
    if (group[first] != first) continue;
    auto site = std::make_shared<SoftSite>();
    site->a = a, site->b = b, site->X_AB = X_AB;
    site->elastic_a = elastic_a, site->elastic_b = elastic_b;
    site->radius = radius;
    std::vector<size_t> members;
    for (size_t i = first; i < count; ++i)
      if (group[i] == first) members.push_back(i), out[i] = site;
    // sums in an order of their own: that of the touches must not matter
    std::sort(members.begin(), members.end(), [&](size_t i, size_t j) {
      const Vector3d &p = points[i], &q = points[j];
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    });
    site->centre_A = site->normal_A = Vector3d::Zero();
    for (const size_t i : members) {
      site->points_A.push_back(points[i]);
      site->centre_A += points[i] / static_cast<double>(members.size());
      site->normal_A += touches[i].normal_b;
    }
    site->normal_A.normalize();
  }
  return out;
}

// --- patches ---

static void check(const PatchOptions& options) {
  const auto length = [](const char* name, double x) {
    if (!(std::isfinite(x) && x > 0)) fail("contact patch: {} must be > 0 [m], got {}", name, x);
  };
  if (options.radius) length("radius", *options.radius);
  length("flat_radius", options.flat_radius);
}

namespace {

// points of one body over the lattice, and the fit; in the patch frame of that body
struct Side {
  Pose X_AP;  // +z into the body
  std::vector<std::optional<Vector3d>> over;
  std::vector<Vector3d> points;
  SurfaceFit fit;
  bool sharp = false;
};

}  // namespace

static Side make_side(const Shape& shape, const Pose& X_PB, const Pose& X_AP, const SoftSite& site,
                      const PatchLattice& lattice, PatchFit kind) {
  const Pose X_PA = X_AP.inverse();
  std::vector<Vector3d> sites;
  for (const Vector3d& p : site.points_A) sites.push_back(X_PA * p);
  const double radius = lattice.radius;
  Side side;
  side.X_AP = X_AP;
  side.over = patch_points(shape, X_PB, sites, lattice);
  for (const auto& p : side.over)
    if (p) side.points.push_back(*p);
  if (side.points.size() < least_points) {
    side.sharp = true;
    return side;
  }
  side.fit =
      kind == PatchFit::jet ? fit_jet(side.points, radius) : fit_quadric(side.points, radius);
  side.sharp =
      side.fit.residual > sharp_part * side.fit.relief && side.fit.relief > least_relief * radius;
  return side;
}

// curvatures as a form on the plane across `normal`, whose axes are `plane`
static Matrix2d curvature_form(const SurfaceFit& fit, const Vector3d& normal,
                               const Eigen::Matrix<double, 3, 2>& plane) {
  const Matrix3d turn = least_turn(fit.normal, normal).toRotationMatrix();
  const Eigen::Matrix2d directions = plane.transpose() * turn * fit.directions;
  return directions * fit.curvatures.asDiagonal() * directions.transpose();
}

static SurfaceFit turned(SurfaceFit fit, const Pose& X) {
  fit.directions = X.matrix() * fit.directions;
  fit.normal = X.rotation * fit.normal;
  return fit;
}

// how far both surfaces go along a direction from the middle, to the farther side; infinite where
// they go on
static double extent(const Side& a, const Side& b, const SoftSite& site, const Vector3d& direction,
                     double radius) {
  double far = 0, far_site = 0;
  for (size_t i = 0; i < a.over.size(); ++i)
    if (a.over[i] && b.over[i])
      far = std::max(far, std::abs(direction.dot(b.X_AP * *b.over[i] - site.centre_A)));
  for (const Vector3d& p : site.points_A)
    far_site = std::max(far_site, std::abs(direction.dot(p - site.centre_A)));
  const bool goes_on = far >= whole_extent * (far_site + radius);
  return goes_on ? std::numeric_limits<double>::infinity() : far;
}

SoftPatch soft_patch(const SoftSite& site, const PatchOptions& options) {
  check(options);
  const double radius = options.radius.value_or(site.radius);
  // the plane's axes come from the frame of a, so that where the bodies are together does not matter
  const Matrix3d axes_b = contact_frame(site.normal_A);
  Matrix3d axes_a = axes_b;
  axes_a.rightCols<2>() *= -1;
  const Pose X_AP_a = {Eigen::Quaterniond(axes_a), site.centre_A};
  const Pose X_AP_b = {Eigen::Quaterniond(axes_b), site.centre_A};
  std::vector<Vector2d> sites;
  for (const Vector3d& p : site.points_A) sites.push_back((X_AP_b.inverse() * p).head<2>());
  const PatchLattice lattice_b = patch_lattice(sites, radius);
  // the same places, numbered alike, as a sees them
  PatchLattice lattice_a = lattice_b;
  for (auto& p : lattice_a.places) p.y() = -p.y();
  for (auto& c : lattice_a.cells) c.y() = -c.y();
  const std::array<Side, 2> sides = {
      make_side(*site.a, X_AP_a.inverse(), X_AP_a, site, lattice_a, options.fit),
      make_side(*site.b, X_AP_b.inverse() * site.X_AB, X_AP_b, site, lattice_b, options.fit)};

  SoftPatch patch;
  patch.centre_A = site.centre_A;
  patch.normal_A = site.normal_A;
  patch.radius = radius;
  patch.elastic_a = site.elastic_a;
  patch.elastic_b = site.elastic_b;
  for (int i = 0; i < 2; ++i) {
    patch.surfaces[i] = turned(sides[i].fit, sides[i].X_AP);
    for (const Vector3d& p : sides[i].points) patch.points[i].push_back(sides[i].X_AP * p);
    patch.residual = std::max(patch.residual, sides[i].fit.residual);
    patch.sharp = patch.sharp || sides[i].sharp;
  }

  // the gap between the surfaces bends by the sum of both
  const Eigen::Matrix<double, 3, 2> plane = axes_b.leftCols<2>();
  const Matrix2d form = curvature_form(patch.surfaces[0], -site.normal_A, plane) +
                        curvature_form(patch.surfaces[1], site.normal_A, plane);
  const double mean = 0.5 * form.trace(), half = 0.5 * (form(0, 0) - form(1, 1));
  const double spread = std::hypot(half, form(0, 1));
  const double angle = 0.5 * std::atan2(form(0, 1), half);
  patch.directions.col(0) = plane * Vector2d(std::cos(angle), std::sin(angle));
  patch.directions.col(1) = plane * Vector2d(-std::sin(angle), std::cos(angle));
  const std::array<double, 2> curvatures = {mean + spread, mean - spread};
  for (int i = 0; i < 2; ++i) {
    patch.flat[i] = !(curvatures[i] > 1 / flattest_radius);
    patch.relative_radii[i] = patch.flat[i] ? options.flat_radius : 1 / curvatures[i];
    patch.extent[i] = extent(sides[0], sides[1], site, patch.directions.col(i), radius);
  }
  if (patch.flat[1])
    patch.relative_radii[1] = std::max(patch.relative_radii[0], patch.relative_radii[1]);
  return patch;
}

// --- pressing ---

// indentation by a pressure [m/Pa]
static double compliance(const SoftPatch& patch, ModulusRule rule) {
  const Elasticity &a = patch.elastic_a, &b = patch.elastic_b;
  if (rule == ModulusRule::larger) {
    const Elasticity& stiffer = a.modulus.value_or(0) >= b.modulus.value_or(0) ? a : b;
    return stiffer.layer / *stiffer.modulus;
  }
  double sum = 0;
  for (const Elasticity& e : {a, b})
    if (e.modulus) sum += e.layer * (1 - e.poisson * e.poisson) / *e.modulus;
  return sum;
}

ContactEllipse contact_ellipse(const SoftPatch& patch, double force, ModulusRule rule) {
  if (!(std::isfinite(force) && force >= 0))
    fail("contact patch: the normal force must be >= 0 [N], got {}", force);
  const double c = compliance(patch, rule);
  const auto& R = patch.relative_radii;
  ContactEllipse out;
  out.indentation = std::sqrt(force * c / (std::numbers::pi * std::sqrt(R[0] * R[1])));
  out.pressure = out.indentation / c;
  for (int i = 0; i < 2; ++i)
    out.semi_axes[i] = std::min(std::sqrt(2 * out.indentation * R[i]), patch.extent[i]);
  return out;
}

double torsion_radius(const SoftPatch& patch, double force, ModulusRule rule) {
  const auto [a, b] = contact_ellipse(patch, force, rule).semi_axes;
  return 8 * std::sqrt(a * b) / 15;
}

}  // namespace clench
