#include "contact/patch_points.h"

#include <algorithm>
#include <cmath>

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr int rings_of_places = 8;   // lattice points along a radius
static constexpr double full_facing = 0.7;  // cosine: what leans less counts wholly

bool weights_over(const Corners& c, const Vector2d& place, Vector3d& weights) {
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

void PatchHit::offer(const PatchSheet& sheet, int candidate, const Vector3d& at) {
  const Corners& c = sheet.corners(candidate);
  const double height = at[0] * c[0].z() + at[1] * c[1].z() + at[2] * c[2].z();
  if (std::abs(height) > sheet.highest()) return;
  if (triangle < 0 || std::abs(height) < std::abs(z))
    triangle = candidate, weights = at, z = height;
}

namespace {

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

}  // namespace

static std::vector<PatchHit> find_hits(const PatchSheet& sheet, const PatchLattice& lattice) {
  std::vector<PatchHit> hits(lattice.places.size());
  const CellIndex cells(lattice);
  const Vector2d margin = Vector2d::Constant(1e-6 * lattice.spacing);
  for (const int t : sheet.triangles()) {
    const Corners& c = sheet.corners(t);
    Vector2d low = c[0].head<2>(), high = low;
    for (const Vector3d& p : c) low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
    cells.within(low - margin, high + margin, lattice.spacing, [&](int place) {
      Vector3d weights;
      if (weights_over(c, lattice.places[place], weights)) hits[place].offer(sheet, t, weights);
    });
  }
  return hits;
}

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

PatchPoints patch_points(PatchSheet& sheet, const PatchLattice& lattice) {
  constexpr double range = full_facing - PatchSheet::least_facing;
  PatchPoints out;
  for (const PatchHit& hit : find_hits(sheet, lattice)) {
    if (hit.triangle < 0) continue;
    out.points.push_back(sheet.round_point(hit.triangle, hit.weights));
    const double part =
        std::min(1.0, (sheet.facing(hit.triangle) - PatchSheet::least_facing) / range);
    out.weights.push_back(part * part);
  }
  return out;
}

}  // namespace clench
