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
static constexpr double least_relief = 1e-4;  // of the radius: flat, whatever noise there is
static constexpr double alike = 0.05;  // difference of curvatures over their mean: as of a ball
static constexpr size_t least_points = 15;  // of the 197 of a disc; also what a jet needs

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

// one body, in the frame of the patch as it sees it
struct Side {
  Pose X_AP;  // +z into the body
  PatchSheet sheet;
  std::vector<Vector3d> points;
  SurfaceFit fit;
  double crease = 0;
};

}  // namespace

// 0 to 1 between two values, either of which may be the larger
static double ramp(double x, double zero, double one) {
  return std::clamp((x - zero) / (one - zero), 0.0, 1.0);
}

static double crease_of(const Side& side, double radius) {
  const SurfaceFit& fit = side.fit;
  if (side.points.size() < least_points) return 1;
  if (fit.relief <= least_relief * radius) return 0;
  return std::min(ramp(fit.residual / fit.relief, 0.1, 0.2),
                  ramp(side.sheet.crease_length() / radius, 0.2, 0.6));
}

static Side make_side(const Shape& shape, const Pose& X_PB, const Pose& X_AP, const SoftSite& site,
                      const PatchLattice& lattice, PatchFit kind) {
  const Pose X_PA = X_AP.inverse();
  std::vector<Vector3d> sites;
  for (const Vector3d& p : site.points_A) sites.push_back(X_PA * p);
  const double radius = lattice.radius;
  Side side{X_AP, PatchSheet(shape, X_PB, sites, radius), {}, {}};
  PatchPoints over = patch_points(side.sheet, lattice);
  side.points = std::move(over.points);
  if (side.points.size() >= least_points)
    side.fit = kind == PatchFit::jet ? fit_jet(side.points, radius)
                                     : fit_quadric(side.points, radius, over.weights);
  side.crease = crease_of(side, radius);
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

// beyond flattest_radius none is left by and by: that of flat surfaces stands for it
static double relative_radius(double curvature, double flat_radius) {
  const double flatness = ramp(curvature * flattest_radius, 1, 0.5);
  if (flatness == 0) return 1 / curvature;
  return std::pow(flat_radius, flatness) * std::pow(flattest_radius, 1 - flatness);
}

namespace {

// what meets at a depth
struct Meeting {
  Matrix2d moments;   // along the patch's directions [m^2]
  double unlike = 0;  // 0: an ellipse as the radii have it, 1: not at all
};

}  // namespace

// mean semi-axis of one region as a part of another's
static double part_of(const Matrix2d& moments, const Matrix2d& whole) {
  if (!(whole.determinant() > 0)) return 1;
  return std::pow(std::max(0.0, moments.determinant()) / whole.determinant(), 0.25);
}

static Meeting meeting(const SoftPatch& patch, double depth) {
  const auto& R = patch.relative_radii;
  const GapProfile fit = gap_profile(patch.gap->rays, Vector2d(1 / R[0], 1 / R[1]));
  const Matrix2d fitted = overlap(fit, depth), there = overlap(cut(fit, *patch.gap), depth);
  Meeting out{overlap(*patch.gap, depth), patch.crease};
  const double ends = ramp(part_of(there, fitted), 0.8, 0.6);
  const double widens = ramp(part_of(out.moments, there), 0.85, 0.5);
  out.unlike = std::max({out.unlike, ends, widens});
  return out;
}

// Less deep the facets of a mesh would tell: from there on the shape stays. A flat ellipse then is
// some 0.7 of the radius wide.
static double shallowest(const SoftPatch& patch) {
  return patch.radius * patch.radius / (4 * patch.flat_radius);
}

namespace {

// the tangent plane as each of the bodies sees it
struct PatchFrames {
  explicit PatchFrames(const SoftSite& site) : axes(contact_frame(site.normal_A)) {
    // the plane's axes come from the frame of a, so that where the bodies are together does not matter
    Matrix3d axes_a = axes;
    axes_a.rightCols<2>() *= -1;
    X_AP_a = {Eigen::Quaterniond(axes_a), site.centre_A};
    X_AP_b = {Eigen::Quaterniond(axes), site.centre_A};
    for (const Vector3d& p : site.points_A) sites.push_back((X_AP_b.inverse() * p).head<2>());
  }
  Eigen::Matrix<double, 3, 2> plane() const { return axes.leftCols<2>(); }

  Matrix3d axes;  // as b sees it
  Pose X_AP_a, X_AP_b;
  std::vector<Vector2d> sites;  // as b sees them
};

PatchRays as_a_sees(PatchRays rays) {
  for (auto& d : rays.directions) d.y() = -d.y();
  return rays;
}

}  // namespace

static void check_points(const SoftPatch& patch) {
  const size_t fewest = std::min(patch.points[0].size(), patch.points[1].size());
  if (fewest >= least_points) return;
  fail(
      "contact patch: a fit needs {} points of each surface, and within radius {} [m] one has {}; "
      "wanted more than the gap, and no more than the bodies",
      least_points, patch.radius, fewest);
}

// the patch's directions, the first at an angle in the plane, and the gap and the rim on rays along them
static void look_along(double angle, const PatchFrames& frames, std::array<Side, 2>& sides,
                       SoftPatch& patch) {
  const auto plane = frames.plane();
  patch.directions.col(0) = plane * Vector2d(std::cos(angle), std::sin(angle));
  patch.directions.col(1) = plane * Vector2d(-std::sin(angle), std::cos(angle));
  const PatchRays rays =
      patch_rays(plane.transpose() * patch.directions.col(0), frames.sites, patch.radius);
  const PatchRays rays_a = as_a_sees(rays);
  const RayHeights heights_a = ray_heights(sides[0].sheet, rays_a);
  const RayHeights heights_b = ray_heights(sides[1].sheet, rays);
  patch.gap = gap_profile(rays_a, heights_a, heights_b);
  patch.rim = patch_rim(heights_a.rim, heights_b.rim, rays.known);
}

// of curvatures in descending order
static void set_radii(const std::array<double, 2>& curvatures, double flat_radius,
                      SoftPatch& patch) {
  patch.flat_radius = flat_radius;
  for (int i = 0; i < 2; ++i) {
    patch.flat[i] = !(curvatures[i] > 1 / flattest_radius);
    patch.relative_radii[i] = relative_radius(curvatures[i], flat_radius);
  }
  patch.relative_radii[1] = std::max(patch.relative_radii[0], patch.relative_radii[1]);
}

SoftPatch soft_patch(const SoftSite& site, const PatchOptions& options) {
  check(options);
  const double radius = options.radius.value_or(site.radius);
  const PatchFrames frames(site);
  const Pose &X_AP_a = frames.X_AP_a, &X_AP_b = frames.X_AP_b;
  const PatchLattice lattice_b = patch_lattice(frames.sites, radius);
  // the same places, numbered alike, as a sees them
  PatchLattice lattice_a = lattice_b;
  for (auto& p : lattice_a.places) p.y() = -p.y();
  for (auto& c : lattice_a.cells) c.y() = -c.y();
  std::array<Side, 2> sides = {
      make_side(*site.a, X_AP_a.inverse(), X_AP_a, site, lattice_a, options.fit),
      make_side(*site.b, X_AP_b.inverse() * site.X_AB, X_AP_b, site, lattice_b, options.fit)};

  SoftPatch patch;
  patch.site = site;
  patch.centre_A = site.centre_A;
  patch.normal_A = site.normal_A;
  patch.radius = radius;
  patch.elastic_a = site.elastic_a;
  patch.elastic_b = site.elastic_b;
  for (int i = 0; i < 2; ++i) {
    patch.surfaces[i] = turned(sides[i].fit, sides[i].X_AP);
    for (const Vector3d& p : sides[i].points) patch.points[i].push_back(sides[i].X_AP * p);
    patch.residual = std::max(patch.residual, sides[i].fit.residual);
    patch.crease = std::max(patch.crease, sides[i].crease);
  }

  if (options.radius) check_points(patch);

  // the gap between the surfaces bends by the sum of both
  const Eigen::Matrix<double, 3, 2> plane = frames.plane();
  const Matrix2d form = curvature_form(patch.surfaces[0], -site.normal_A, plane) +
                        curvature_form(patch.surfaces[1], site.normal_A, plane);
  const double mean = 0.5 * form.trace(), half = 0.5 * (form(0, 0) - form(1, 1));
  const double spread = std::hypot(half, form(0, 1));
  // of what bends alike any will do
  const double angle = spread * radius > 1e-6 ? 0.5 * std::atan2(form(0, 1), half) : 0;
  look_along(angle, frames, sides, patch);
  // so the rim tells them, where there is one
  if (spread <= alike * std::max(mean, 1 / flattest_radius) && patch.rim.any_ended())
    look_along(angle + rim_angle(patch.rim), frames, sides, patch);
  set_radii({mean + spread, mean - spread}, options.flat_radius, patch);
  patch.sharp = meeting(patch, shallowest(patch)).unlike > 0.5;
  return patch;
}

// --- pressing ---

// as far around the sites as an ellipse with these semi-axes may want
static PatchRim farther_rim(const SoftPatch& patch, const std::array<double, 2>& semi_axes) {
  const SoftSite& site = patch.site;
  const auto [axes, X_AP_a, X_AP_b, sites] = PatchFrames(site);
  // across to its other side, and rays are not everywhere; no body is wider than its sphere
  const double widest = 2.2 * std::max(semi_axes[0], semi_axes[1]);
  const double body = 2.1 * std::min(site.a->radius(), site.b->radius());
  const double radius = std::max(patch.radius, std::min(widest, body));
  const PatchRays rays =
      patch_rays(axes.leftCols<2>().transpose() * patch.directions.col(0), sites, radius);
  const auto ends = [&](const Shape& shape, const Pose& X_PB, const Pose& X_PA,
                        const PatchRays& seen) {
    std::vector<Vector3d> there;
    for (const Vector3d& p : site.points_A) there.push_back(X_PA * p);
    return ray_rim(PatchSheet(shape, X_PB, there, radius), seen);
  };
  const Pose X_PA_a = X_AP_a.inverse(), X_PA_b = X_AP_b.inverse();
  return patch_rim(ends(*site.a, X_PA_a, X_PA_a, as_a_sees(rays)),
                   ends(*site.b, X_PA_b * site.X_AB, X_PA_b, rays), rays.known);
}

static std::array<double, 2> within_rim(const SoftPatch& patch,
                                        const std::array<double, 2>& semi_axes) {
  const RimEllipse near = make_room(patch.rim, semi_axes);
  if (near.sure) return near.semi_axes;
  return make_room(farther_rim(patch, semi_axes), semi_axes).semi_axes;
}

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

// of what gives way [m]
static double soft_height(const SoftPatch& patch, ModulusRule rule) {
  const Elasticity &a = patch.elastic_a, &b = patch.elastic_b;
  if (rule == ModulusRule::larger)
    return (a.modulus.value_or(0) >= b.modulus.value_or(0) ? a : b).layer;
  return (a.modulus ? a.layer : 0) + (b.modulus ? b.layer : 0);
}

// what the surfaces make of the ellipse that the radii tell
static void press_sharp(const SoftPatch& patch, double force, double c, ContactEllipse& out) {
  const auto room = within_rim(patch, out.semi_axes);
  if (room != out.semi_axes) {
    out.semi_axes = room;
    const double area = std::numbers::pi * room[0] * room[1];
    if (area > 0) out.indentation = 2 * force * c / area;
  }
  // what is sure to touch
  const double flat = std::sqrt(force * c / (std::numbers::pi * patch.flat_radius));
  const double depth = std::max(flat, shallowest(patch));
  const auto [moments, unlike] = meeting(patch, depth);
  if (unlike == 0) return;
  const Vector2d axes = std::sqrt(flat / depth) * 2 * moments.diagonal().cwiseSqrt();
  // one that lies across the directions is not as wide as it is long along both
  const double product = moments(0, 0) * moments(1, 1);
  const double narrow =
      product > 0 ? std::pow(std::max(0.0, moments.determinant()) / product, 0.25) : 0;
  for (int i = 0; i < 2; ++i) {
    double& a = out.semi_axes[i];
    const double sure = std::min(a, narrow * axes[i]);
    a = std::pow(a, 1 - unlike) * std::pow(sure, unlike);
  }
  // where the springs under the gap as it is make up the force
  if (const auto deep = depth_of(*patch.gap, force * c))
    out.indentation = std::pow(out.indentation, 1 - unlike) * std::pow(*deep, unlike);
}

ContactEllipse contact_ellipse(const SoftPatch& patch, double force, ModulusRule rule) {
  if (!(std::isfinite(force) && force >= 0))
    fail("contact patch: the normal force must be >= 0 [N], got {}", force);
  const double c = compliance(patch, rule);
  const auto& R = patch.relative_radii;
  ContactEllipse out;
  out.indentation = std::sqrt(force * c / (std::numbers::pi * std::sqrt(R[0] * R[1])));
  for (int i = 0; i < 2; ++i) out.semi_axes[i] = std::sqrt(2 * out.indentation * R[i]);
  if (patch.gap) press_sharp(patch, force, c, out);
  out.pressure = out.indentation / c;
  out.beyond_layer = out.indentation > soft_height(patch, rule);
  return out;
}

double torsion_radius(const SoftPatch& patch, double force, ModulusRule rule) {
  const auto [a, b] = contact_ellipse(patch, force, rule).semi_axes;
  return 8 * std::sqrt(a * b) / 15;
}

}  // namespace clench
