#include "clench/grasp/wrench/unit_wrenches.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/contact/friction_edges.h"
#include "clench/grasp/wrench/expanding_polytope.h"

namespace clench {

UnitWrenches unit_wrenches(const PointContact& contact, const ConeOptions& options) {
  if (options.edges != round_edges) return {cone_wrenches(contact, options), {}};
  return {Wrenches(6, 0), round_cone(contact, options)};
}

// --- pyramids ---

namespace {

// Points of the unit sphere in two or three dimensions, and the radius of the ball within their
// hull.
struct SpherePoints {
  Eigen::MatrixXd points;
  double within;
};

SpherePoints sphere_points(Eigen::Index dimension, int edges) {
  // the circle, or half as many on the equator and rings beside it
  const FrictionEdges on =
      dimension == 2 ? friction_edges(0, edges) : friction_edges(1, std::max(3, edges / 2), 1);
  SpherePoints out{Eigen::MatrixXd(dimension, on.cols()), 0};
  out.points.topRows(2) = on.topRows(2);
  if (dimension == 3) out.points.row(2) = on.row(5);
  const ContactPart part{.points = out.points.data(), .count = static_cast<int>(on.cols())};
  const WrenchSupport reach(static_cast<int>(dimension), WrenchNorm::l1, std::span(&part, 1));
  out.within = largest_ball(reach).lower;
  return out;
}

}  // namespace

Wrenches pyramid_of(const RoundCone& cone, int edges, bool around) {
  if (cone.spread.cols() == 0) return cone.axis;
  const SpherePoints sphere = sphere_points(cone.spread.cols(), edges);
  return (cone.spread * (around ? sphere.points / sphere.within : sphere.points)).colwise() +
         cone.axis;
}

// --- scaling ---

int ContactWrenches::exponent() const {
  double largest = 0;
  for (const UnitWrenches& contact : contacts)
    contact.for_each([&](const auto& wrench) {
      for (const int row : coordinates) largest = std::max(largest, std::abs(wrench[row]));
    });
  return largest > 0 ? std::ilogb(largest) + 1 : 0;
}

double ContactWrenches::max_norm(int exponent) const {
  double square = 0;
  for (const UnitWrenches& contact : contacts) {
    check_stop();
    contact.for_each([&](const auto& wrench) {
      double sum = 0;
      for (const int row : coordinates) {
        const double x = std::ldexp(wrench[row], -exponent);
        sum += x * x;
      }
      square = std::max(square, sum);
    });
  }
  return std::sqrt(square);
}

Eigen::MatrixXd ContactWrenches::columns(int exponent) const {
  Eigen::Index count = 0, column = 0;
  for (const UnitWrenches& contact : contacts) count += contact.count();
  Eigen::MatrixXd all(dimension(), count);
  // ldexp is slow, and a product with a power of two is the same unless it leaves the doubles
  const bool common = std::abs(exponent) < 500;
  const double scale = common ? std::ldexp(1.0, -exponent) : 0;
  for (const UnitWrenches& contact : contacts) {
    check_stop();
    contact.for_each([&](const auto& wrench) {
      for (int i = 0; i < dimension(); ++i) {
        const double x = wrench[coordinates[i]];
        all(i, column) = common ? x * scale : std::ldexp(x, -exponent);
      }
      ++column;
    });
  }
  return all;
}

WrenchSupport ContactWrenches::support(WrenchNorm norm, int exponent) const {
  const Eigen::MatrixXd all = columns(exponent);
  std::vector<ContactPart> parts;
  const double* start = all.data();
  for (const UnitWrenches& contact : contacts) {
    ContactPart part;
    if (contact.round) {
      part.axis = start;
      part.spread = start + dimension();
      part.width = static_cast<int>(contact.round->spread.cols());
    } else {
      part.points = start;
      part.count = static_cast<int>(contact.edges.cols());
    }
    parts.push_back(part);
    start += dimension() * contact.count();
  }
  return WrenchSupport(dimension(), norm, parts);
}

}  // namespace clench
