#include "contact/patch_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "contact/near_points.h"
#include "contact/near_surface.h"
#include "geometry/queries.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int rings_of_places = 8;    // lattice points along a radius
constexpr double least_facing = 0.3;  // cosine: what leans more belongs to the flank
const double least_smooth = std::cos(40 * std::numbers::pi / 180);  // cosine between neighbours
const double least_round = std::cos(60 * std::numbers::pi / 180);   // and around a corner: no spike
// Of two neighbours, one that goes on so much farther from their edge is flat beside a rounded edge,
// not a chord of a curve.
constexpr double most_height_ratio = 3;
constexpr double seed_distance = 1e-3;  // of the radius: triangles as near as the nearest
// a sphere around a site holds what lies over its disc, slopes of 45 degrees on the whole
const double patch_reach = std::sqrt(2.0);

// --- the sheet ---

class Sheet {
 public:
  Sheet(const Shape& shape, const Pose& X_PB, std::span<const Vector3d> sites, double radius)
      : shape_(shape),
        X_PB_(X_PB),
        triangles_(around(shape, X_PB, sites, radius)),
        near_(shape.mesh(), triangles_, X_PB) {
    const int count = static_cast<int>(triangles_.size());
    for (int t = 0; t < count; ++t) normals_.push_back(face_normal(near_.corners(t)));
    inside_.assign(count, 0);
    std::vector<int> open;
    for (const Vector3d& site : sites) {
      double least = std::numeric_limits<double>::infinity();
      std::vector<double> distances;
      for (int t = 0; t < count; ++t) {
        distances.push_back(point_triangle(site, near_.corners(t)).distance);
        least = std::min(least, distances.back());
      }
      for (int t = 0; t < count; ++t)
        if (distances[t] <= least + seed_distance * radius && faces(t) && !inside_[t])
          inside_[t] = 1, open.push_back(t);
    }
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k)
        for (const int slot : near_.at_corner(near_.corner(t, k)))
          if (const int next = slot / 3; !inside_[next] && faces(next))
            inside_[next] = 1, open.push_back(next);
    }
  }

  int size() const { return static_cast<int>(triangles_.size()); }
  bool holds(int t) const { return inside_[t]; }
  const Corners& corners(int t) const { return near_.corners(t); }

  /// of the smooth surface at a corner of a triangle, in either sense
  const Vector3d& corner_normal(int t, int k) {
    const auto [found, is_new] = corner_normals_.try_emplace({t, k});
    if (is_new) found->second = make_corner_normal(t, k);
    return found->second;
  }

 private:
  static std::vector<int> around(const Shape& shape, const Pose& X_PB,
                                 std::span<const Vector3d> sites, double radius) {
    std::vector<int> out;
    for (const Vector3d& site : sites) {
      const Vector3d p_B = X_PB.inverse() * site;
      const double far = closest_point(shape, p_B).distance;
      const auto more = region(shape, p_B, patch_reach * radius + far);
      out.insert(out.end(), more.begin(), more.end());
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  // does its outside look at what touches it? Open surfaces have two outsides
  bool faces(int t) const {
    const double outward = -normals_[t].z();
    if (!shape_.closed()) return std::abs(outward) > least_facing;
    return (shape_.solid().volume < 0 ? -outward : outward) > least_facing;
  }

  // triangles with a corner there
  const std::vector<int>& fan(int t, int k) {
    const int corner = near_.corner(t, k);
    const auto [found, is_new] = fans_.try_emplace(corner);
    if (is_new) {
      const Vector3d p_B = shape_.mesh().corners(triangles_[t])[k];
      found->second = region(shape_, p_B, touching());
    }
    return found->second;
  }
  double touching() const { return 1e-9 * (shape_.radius() + shape_.centre().norm()); }

  // Weighted over the triangles that one comes to from this one around the corner, across edges that
  // are none.
  Vector3d make_corner_normal(int t, int k) {
    const Corners own = shape_.mesh().corners(triangles_[t]);
    const Vector3d normal = face_normal(own), &centre = own[k];
    struct Blade {
      Vector3d one, two, normal;  // its two sides from the corner
      double twice_area;
      bool reached;
    };
    std::vector<Blade> blades;
    for (const int u : fan(t, k)) {
      const Corners c = shape_.mesh().corners(u);
      Vector3d n = face_normal(c);
      if (!shape_.closed() && n.dot(normal) < 0) n = -n;
      for (int l = 0; l < 3; ++l) {
        if ((c[l] - centre).norm() > touching()) continue;
        const Vector3d one = c[(l + 1) % 3] - c[l], two = c[(l + 2) % 3] - c[l];
        blades.push_back({one, two, n, one.cross(two).norm(), u == triangles_[t]});
        break;
      }
    }
    // beside triangles of one edge the areas are as the heights over it
    const auto smooth = [&](const Blade& from, const Blade& to) {
      bool beside = false;
      for (const Vector3d& p : {from.one, from.two})
        for (const Vector3d& q : {to.one, to.two}) beside = beside || (p - q).norm() <= touching();
      return beside && to.normal.dot(from.normal) > least_smooth &&
             to.normal.dot(normal) > least_round &&
             most_height_ratio * to.twice_area > from.twice_area &&
             most_height_ratio * from.twice_area > to.twice_area;
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (const Blade& from : blades)
        for (Blade& to : blades)
          if (from.reached && !to.reached && smooth(from, to)) to.reached = changed = true;
    }
    Vector3d sum = Vector3d::Zero();
    for (const Blade& b : blades)
      if (b.reached) sum += b.normal * (b.twice_area / (b.one.squaredNorm() * b.two.squaredNorm()));
    if (sum.isZero()) sum = normal;
    return X_PB_.rotation * sum.normalized();
  }

  const Shape& shape_;
  const Pose& X_PB_;
  std::vector<int> triangles_;
  NearSurface near_;
  std::vector<Vector3d> normals_;
  std::vector<char> inside_;
  std::map<int, std::vector<int>> fans_;
  std::map<std::pair<int, int>, Vector3d> corner_normals_;
};

// --- the points over the places ---

// which place stands in a cell; -1 for none
class CellIndex {
 public:
  explicit CellIndex(const PatchLattice& lattice) {
    low_ = high_ = lattice.cells[0];
    for (const auto& cell : lattice.cells) low_ = low_.cwiseMin(cell), high_ = high_.cwiseMax(cell);
    size_ = high_ - low_ + Eigen::Vector2i::Ones();
    at_.assign(static_cast<size_t>(size_.x()) * size_.y(), -1);
    for (size_t i = 0; i < lattice.cells.size(); ++i)
      at_[slot(lattice.cells[i])] = static_cast<int>(i);
  }

  /// take(place) for those in the box
  template <class Take>
  void within(const Vector2d& low, const Vector2d& high, double spacing, Take take) const {
    // clamped as numbers of any size before they become whole
    const auto whole = [&](const Vector2d& x) {
      return Eigen::Vector2i(x.cwiseMax((low_ - Eigen::Vector2i::Ones()).cast<double>())
                                 .cwiseMin((high_ + Eigen::Vector2i::Ones()).cast<double>())
                                 .cast<int>());
    };
    const Eigen::Vector2i from = whole((low / spacing).array().ceil().matrix()).cwiseMax(low_);
    const Eigen::Vector2i to = whole((high / spacing).array().floor().matrix()).cwiseMin(high_);
    for (int y = from.y(); y <= to.y(); ++y)
      for (int x = from.x(); x <= to.x(); ++x)
        if (const int place = at_[slot({x, y})]; place >= 0) take(place);
  }

 private:
  size_t slot(const Eigen::Vector2i& cell) const {
    const Eigen::Vector2i c = cell - low_;
    return static_cast<size_t>(c.y()) * size_.x() + c.x();
  }
  Eigen::Vector2i low_, high_, size_;
  std::vector<int> at_;
};

struct Hit {
  int triangle = -1;
  Vector3d weights = Vector3d::Zero();
  double z = 0;
};

// Barycentric weights of the point of the triangle over a place; false where there is none. Edges
// belong to both sides.
bool over(const Corners& c, const Vector2d& place, Vector3d& weights) {
  const auto cross = [](const Vector2d& u, const Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const Vector2d a = c[0].head<2>() - place, b = c[1].head<2>() - place, d = c[2].head<2>() - place;
  weights = Vector3d(cross(b, d), cross(d, a), cross(a, b));
  const double area = weights.sum();
  if (area == 0) return false;
  weights /= area;
  return weights.minCoeff() >= -1e-9;
}

std::vector<Hit> find_hits(const Sheet& sheet, const PatchLattice& lattice) {
  std::vector<Hit> hits(lattice.places.size());
  const CellIndex cells(lattice);
  for (int t = 0; t < sheet.size(); ++t) {
    if (!sheet.holds(t)) continue;
    const Corners& c = sheet.corners(t);
    const Vector2d margin = Vector2d::Constant(1e-6 * lattice.spacing);
    Vector2d low = c[0].head<2>(), high = low;
    for (const Vector3d& p : c) low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
    cells.within(low - margin, high + margin, lattice.spacing, [&](int place) {
      Vector3d weights;
      if (!over(c, lattice.places[place], weights)) return;
      const double z = weights[0] * c[0].z() + weights[1] * c[1].z() + weights[2] * c[2].z();
      Hit& hit = hits[place];
      // a sheet that lies over itself: what is nearer to the tangent plane
      if (std::abs(z) > patch_reach * lattice.radius) return;
      if (hit.triangle < 0 || std::abs(z) < std::abs(hit.z)) hit = {t, weights, z};
    });
  }
  return hits;
}

}  // namespace

PatchLattice patch_lattice(std::span<const Vector2d> sites, double radius) {
  PatchLattice out;
  out.radius = radius;
  out.spacing = radius / rings_of_places;
  Vector2d low = sites[0], high = low;
  for (const Vector2d& site : sites) low = low.cwiseMin(site), high = high.cwiseMax(site);
  const Eigen::Vector2i from = ((low.array() - radius) / out.spacing).floor().cast<int>();
  const Eigen::Vector2i to = ((high.array() + radius) / out.spacing).ceil().cast<int>();
  // a place on the rim is one however it is rounded
  const double rim = radius * (1 + 1e-9);
  for (int y = from.y(); y <= to.y(); ++y)
    for (int x = from.x(); x <= to.x(); ++x) {
      const Vector2d place(x * out.spacing, y * out.spacing);
      const bool near = std::any_of(sites.begin(), sites.end(), [&](const Vector2d& site) {
        return (place - site).norm() <= rim;
      });
      if (near) out.places.push_back(place), out.cells.emplace_back(x, y);
    }
  return out;
}

std::vector<std::optional<Vector3d>> patch_points(const Shape& shape, const Pose& X_PB,
                                                  std::span<const Vector3d> sites,
                                                  const PatchLattice& lattice) {
  Sheet sheet(shape, X_PB, sites, lattice.radius);
  std::vector<std::optional<Vector3d>> points(lattice.places.size());
  const auto hits = find_hits(sheet, lattice);
  for (size_t i = 0; i < hits.size(); ++i) {
    const Hit& hit = hits[i];
    if (hit.triangle < 0) continue;
    const Corners& c = sheet.corners(hit.triangle);
    Vector3d q = Vector3d::Zero(), lift = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) q += hit.weights[k] * c[k];
    // half way to the planes through the corners
    for (int k = 0; k < 3; ++k) {
      const Vector3d& n = sheet.corner_normal(hit.triangle, k);
      lift += 0.5 * hit.weights[k] * (c[k] - q).dot(n) * n;
    }
    points[i] = q + lift;
  }
  return points;
}

}  // namespace clench
