#include "clench/contact/soft_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clench/base/disjoint_sets.h"
#include "clench/base/error.h"
#include "clench/contact/cone.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// largest angle between normals of one site
static const double one_side = std::cos(40 * std::numbers::pi / 180);
// difference of curvatures relative to their mean: equal below it, as of a ball
static constexpr double alike = 0.05;
// fraction of the radius: below it the surface is flat, whatever the noise
static constexpr double min_relief = 1e-4;
// fraction of the disc: with less of a surface there is no fit
static constexpr double min_share = 0.07;

double neighborhood_radius(double modulus) {
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
  const double radius = neighborhood_radius(larger_modulus(elastic_a, elastic_b));
  const int count = static_cast<int>(touches.size());
  std::vector<Vector3d> points;
  for (const Touch& touch : touches) points.push_back(0.5 * (touch.p_a + touch.p_b));

  DisjointSets groups(points.size());
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j)
      if ((points[i] - points[j]).norm() < 2 * radius &&
          touches[i].normal_b.dot(touches[j].normal_b) >= one_side)
        groups.join(i, j);

  std::vector<SoftSitePtr> out(points.size());
  for (int first = 0; first < count; ++first) {
    if (groups.find(first) != first) continue;
    auto site = std::make_shared<SoftSite>();
    site->a = a, site->b = b, site->X_AB = X_AB;
    site->elastic_a = elastic_a, site->elastic_b = elastic_b;
    site->radius = radius;
    std::vector<int> members;
    for (int i = first; i < count; ++i)
      if (groups.find(i) == first) members.push_back(i), out[i] = site;
    // summed in a canonical order: the order of the touches must not matter
    std::sort(members.begin(), members.end(), [&](int i, int j) {
      const Vector3d &p = points[i], &q = points[j];
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    });
    site->center_A = site->normal_A = Vector3d::Zero();
    for (const int i : members) {
      site->points_A.push_back(points[i]);
      site->center_A += points[i] / static_cast<double>(members.size());
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
  length("max_radius", options.max_radius);
}

// smooth step from 0 to 1 between two values, either of which may be the larger
static double ramp(double x, double zero, double one) {
  return std::clamp((x - zero) / (one - zero), 0.0, 1.0);
}

namespace {

// the tangent plane in each body's view
struct PatchFrames {
  explicit PatchFrames(const SoftSite& site) : axes(contact_frame(site.normal_A)) {
    // the plane's axes come from the frame of a, so that the common pose of the bodies does not
    // matter
    Matrix3d axes_a = axes;
    axes_a.rightCols<2>() *= -1;
    X_AP = {Pose{Eigen::Quaterniond(axes_a), site.center_A},
            Pose{Eigen::Quaterniond(axes), site.center_A}};
    for (const Vector3d& p : site.points_A) spread = std::max(spread, (p - site.center_A).norm());
  }
  Eigen::Matrix<double, 3, 2> plane() const { return axes.leftCols<2>(); }

  Matrix3d axes;             // in b's view
  std::array<Pose, 2> X_AP;  // in a's and b's view
  double spread = 0;         // largest distance of contacts from the center
};

}  // namespace

static PatchSheet sheet_of(const SoftSite& site, const PatchFrames& frames, int body,
                           double radius) {
  const Pose X_PA = frames.X_AP[body].inverse();
  std::vector<Vector3d> sites;
  for (const Vector3d& p : site.points_A) sites.push_back(X_PA * p);
  return body == 0 ? PatchSheet(*site.a, X_PA, sites, radius)
                   : PatchSheet(*site.b, X_PA * site.X_AB, sites, radius);
}

static double crease_of(const PatchSheet& sheet, const SurfaceFit& fit, double radius) {
  if (fit.relief <= min_relief * radius) return 0;
  return std::min(ramp(fit.residual / fit.relief, 0.1, 0.2),
                  ramp(sheet.crease_length() / radius, 0.2, 0.6));
}

// curvatures as a quadratic form on the plane across `normal`, whose axes are `plane`
static Matrix2d curvature_form(const SurfaceFit& fit, const Vector3d& normal,
                               const Eigen::Matrix<double, 3, 2>& plane) {
  const Matrix3d turn = shortest_rotation(fit.normal, normal).toRotationMatrix();
  const Eigen::Matrix2d directions = plane.transpose() * turn * fit.directions;
  return directions * fit.curvatures.asDiagonal() * directions.transpose();
}

static SurfaceFit turned(SurfaceFit fit, const Pose& X) {
  fit.directions = X.matrix() * fit.directions;
  fit.normal = X.rotation * fit.normal;
  return fit;
}

// beyond flattest_radius the curvature fades out: the radius of flat surfaces replaces it
static double relative_radius(double curvature, double max_radius) {
  const double flatness = ramp(curvature * flattest_radius, 1, 0.5);
  if (flatness == 0) return 1 / curvature;
  return std::pow(max_radius, flatness) * std::pow(flattest_radius, 1 - flatness);
}

namespace {

// contact region at a given depth
struct Meeting {
  Matrix2d moments;   // along the patch's directions [m^2]
  double unlike = 0;  // 0: an ellipse that agrees with the radii, 1: not an ellipse at all
};

}  // namespace

// columns, in b's view of the plane
static Matrix2d directions_in_plane(const SoftPatch& patch) {
  return contact_frame(patch.normal_A).leftCols<2>().transpose() * patch.directions;
}

static Meeting meeting(const SoftPatch& patch, double depth) {
  const auto& R = patch.relative_radii;
  const Matrix2d axes = directions_in_plane(patch);
  const Matrix2d there = meeting_moments(patch.gap, depth);
  const double fitted =
      meeting_moments(round_gap(patch.gap, Vector2d(1 / R[0], 1 / R[1]), axes), depth)
          .determinant();
  const double part = fitted > 0 ? std::pow(std::max(0.0, there.determinant()) / fitted, 0.25) : 1;
  return {axes.transpose() * there * axes, std::max(patch.crease, ramp(part, 0.85, 0.65))};
}

// At smaller depths the facets of a mesh would show: from there on the shape is constant. A flat
// ellipse then has about 0.7 of the radius as its width.
static double shallowest(const SoftPatch& patch) {
  return patch.radius * patch.radius / (4 * patch.max_radius);
}

// with the first one at an angle in the plane
static void set_directions(double angle, const PatchFrames& frames, SoftPatch& patch) {
  patch.directions.col(0) = frames.plane() * Vector2d(std::cos(angle), std::sin(angle));
  patch.directions.col(1) = frames.plane() * Vector2d(-std::sin(angle), std::cos(angle));
}

// of curvatures in descending order
static void set_radii(const std::array<double, 2>& curvatures, SoftPatch& patch) {
  for (int i = 0; i < 2; ++i) {
    patch.flat[i] = !(curvatures[i] > 1 / flattest_radius);
    patch.relative_radii[i] = relative_radius(curvatures[i], patch.max_radius);
  }
  patch.relative_radii[1] = std::max(patch.relative_radii[0], patch.relative_radii[1]);
}

// the principal axis of a quadratic form, and whether it is defined
static double main_axis(const Matrix2d& form) {
  return 0.5 * std::atan2(2 * form(0, 1), form(0, 0) - form(1, 1));
}

static bool same_all_round(const Matrix2d& form, double min_mean) {
  const double mean = 0.5 * form.trace();
  return std::hypot(0.5 * (form(0, 0) - form(1, 1)), form(0, 1)) <=
         alike * std::max(mean, min_mean);
}

// Stores the fits of both surfaces.
// returns  curvature of the gap between them, the sum of both
static Matrix2d fit_surfaces(const std::array<PatchSheet, 2>& sheets, const PatchRings& rings,
                             const PatchFrames& frames, double radius, PatchFit kind,
                             SoftPatch& patch) {
  Matrix2d form = Matrix2d::Zero();
  for (int i = 0; i < 2; ++i) {
    const auto& [points, weights] = rings.surfaces[i];
    SurfaceFit fit;
    const bool enough = rings.shares[i] >= min_share;
    if (enough)
      fit = kind == PatchFit::jet ? fit_jet(points, radius) : fit_quadric(points, radius, weights);
    patch.crease = std::max(patch.crease, enough ? crease_of(sheets[i], fit, radius) : 1);
    patch.surfaces[i] = turned(fit, frames.X_AP[i]);
    patch.residual = std::max(patch.residual, fit.residual);
    for (const Vector3d& p : points) patch.points[i].push_back(frames.X_AP[i] * p);
    const Vector3d normal = i == 0 ? Vector3d(-patch.normal_A) : patch.normal_A;
    form += curvature_form(patch.surfaces[i], normal, frames.plane());
  }
  return form;
}

SoftPatch soft_patch(const SoftSite& site, const PatchOptions& options) {
  check(options);
  const PatchFrames frames(site);
  SoftPatch patch;
  patch.site = site;
  patch.center_A = site.center_A;
  patch.normal_A = site.normal_A;
  patch.radius = options.radius.value_or(site.radius);
  patch.elastic_a = site.elastic_a;
  patch.elastic_b = site.elastic_b;
  const double reach = std::max(patch.radius, frames.spread);
  std::array<PatchSheet, 2> sheets = {sheet_of(site, frames, 0, reach),
                                      sheet_of(site, frames, 1, reach)};
  patch.max_radius = options.max_radius;
  const PatchRings rings = patch_rings(sheets[0], sheets[1], reach, shallowest(patch));
  patch.gap = rings.gap;
  patch.widths = {patch_width(sheets[0], true), patch_width(sheets[1], false)};
  const Matrix2d form = fit_surfaces(sheets, rings, frames, reach, options.fit, patch);
  if (options.radius && std::min(rings.shares[0], rings.shares[1]) < min_share)
    fail(
        "contact patch: within radius {} [m] there is too little of a surface to fit; expected "
        "more "
        "than the gap, and no more than the bodies",
        patch.radius);

  const double mean = 0.5 * form.trace();
  const double spread = std::hypot(0.5 * (form(0, 0) - form(1, 1)), form(0, 1));
  set_radii({mean + spread, mean - spread}, patch);
  set_directions(main_axis(form), frames, patch);
  if (same_all_round(form, 1 / flattest_radius)) {
    const Matrix2d region = meeting_moments(patch.gap, shallowest(patch));
    set_directions(main_axis(region), frames, patch);
    patch.directed = !same_all_round(region, 0);
  }
  patch.at_edge = meeting(patch, shallowest(patch)).unlike > 0.5;
  return patch;
}

// --- pressing ---

static std::array<double, 2> within_room(const SoftPatch& patch,
                                         const std::array<double, 2>& semi_axes) {
  const Matrix2d axes = directions_in_plane(patch);
  const auto room_on = [&](const PatchWidth& room) {
    return make_room(room, axes, semi_axes, patch.directed);
  };
  if (room_on(patch.widths[0] + patch.widths[1]) == semi_axes) return semi_axes;
  // perhaps no more is known: a bound from the opposite side, as no body is wider than its sphere
  const SoftSite& site = patch.site;
  const PatchFrames frames(site);
  const double widest = 2.2 * std::max(semi_axes[0], semi_axes[1]);
  const double bodies = 2.1 * std::min(site.a->radius(), site.b->radius());
  const double radius = std::max(patch.radius, std::min(widest, bodies)) + frames.spread;
  const auto wide_room = [&](int body) {
    return patch_width(sheet_of(site, frames, body, radius), body == 0);
  };
  // the smaller mesh first: if it is the narrower one, the known widths of the other are sufficient
  const int small = site.a->mesh().triangles.size() <= site.b->mesh().triangles.size() ? 0 : 1;
  const PatchWidth first = wide_room(small);
  const auto alone = room_on(first);
  if (room_on(first + patch.widths[1 - small]) == alone) return alone;
  return room_on(first + wide_room(1 - small));
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

// height of the soft layers [m]
static double soft_height(const SoftPatch& patch, ModulusRule rule) {
  const Elasticity &a = patch.elastic_a, &b = patch.elastic_b;
  if (rule == ModulusRule::larger)
    return (a.modulus.value_or(0) >= b.modulus.value_or(0) ? a : b).layer;
  return (a.modulus ? a.layer : 0) + (b.modulus ? b.layer : 0);
}

// the ellipse given by the radii, limited by the surfaces
static void press_sharp(const SoftPatch& patch, double force, double c, ContactEllipse& out) {
  const auto room = within_room(patch, out.semi_axes);
  if (room != out.semi_axes) {
    out.semi_axes = room;
    const double area = std::numbers::pi * room[0] * room[1];
    if (area > 0) out.indentation = 2 * force * c / area;
  }
  // the region of certain contact within the neighborhood
  const double flat = std::sqrt(force * c / (std::numbers::pi * patch.max_radius));
  const double depth = std::max(flat, shallowest(patch));
  const auto [moments, unlike] = meeting(patch, depth);
  if (unlike == 0) return;
  const double to_axes = std::sqrt(4 * std::sqrt(std::numbers::pi) * flat / depth);
  // the axes need not be those of the region: then both widths along them overestimate an ellipse
  // of its area
  const double product = moments(0, 0) * moments(1, 1);
  const double narrow =
      product > 0 ? std::pow(std::max(0.0, moments.determinant()) / product, 0.25) : 0;
  for (int i = 0; i < 2; ++i) {
    double& a = out.semi_axes[i];
    const double sure = std::min(patch.radius, to_axes * narrow * std::sqrt(moments(i, i)));
    a = std::pow(a, 1 - unlike) * std::pow(std::min(a, sure), unlike);
  }
  // depth at which the springs under the actual gap sum to the force
  if (const double deep = depth_of(patch.gap, force * c); deep > 0)
    out.indentation = std::pow(out.indentation, 1 - unlike) * std::pow(deep, unlike);
}

ContactEllipse contact_ellipse(const SoftPatch& patch, double force, ModulusRule rule) {
  if (!(std::isfinite(force) && force >= 0))
    fail("contact patch: the normal force must be >= 0 [N], got {}", force);
  const double c = compliance(patch, rule);
  const auto& R = patch.relative_radii;
  ContactEllipse out;
  out.indentation = std::sqrt(force * c / (std::numbers::pi * std::sqrt(R[0] * R[1])));
  for (int i = 0; i < 2; ++i) out.semi_axes[i] = std::sqrt(2 * out.indentation * R[i]);
  if (!patch.gap.empty()) press_sharp(patch, force, c, out);
  out.pressure = out.indentation / c;
  out.exceeds_layer = out.indentation > soft_height(patch, rule);
  return out;
}

double torsion_radius(const SoftPatch& patch, double force, ModulusRule rule) {
  const auto [a, b] = contact_ellipse(patch, force, rule).semi_axes;
  return 8 * std::sqrt(a * b) / 15;
}

}  // namespace clench
