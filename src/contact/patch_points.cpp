#include "contact/patch_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/convert.h"
#include "base/error.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector2i;
using Eigen::Vector3d;

static constexpr int rings_of_places = 8;     // lattice points along a radius
static constexpr double full_facing = 0.7;    // cosine: what leans less counts wholly
static constexpr double least_radius = 1e-7;  // of the distance of contacts: cells have numbers

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

Vector2i floor_cell(const Vector2d& x) { return {floor_int(x.x()), floor_int(x.y())}; }

bool row_before(const Vector2i& a, const Vector2i& b) {
  return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
}

// Which place stands in a cell: no table, since sites may lie far apart.
class CellIndex {
 public:
  explicit CellIndex(const PatchLattice& lattice) : cells_(lattice.cells) {
    order_.resize(cells_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::sort(order_, row_before, [&](int i) { return cells_[i]; });
  }

  /// take(place) for those in the box
  template <class Take>
  void within(const Vector2d& low, const Vector2d& high, double spacing, Take take) const {
    const Vector2i from = floor_cell((low / spacing).array().ceil());
    const Vector2i to = floor_cell(high / spacing);
    for (auto at = first_from(from); at != order_.end() && cells_[*at].y() <= to.y();) {
      const Vector2i& cell = cells_[*at];
      if (cell.x() > to.x())
        at = first_from({from.x(), cell.y() + 1});
      else if (cell.x() < from.x())
        at = first_from({from.x(), cell.y()});
      else
        take(*at++);
    }
  }

 private:
  std::vector<int>::const_iterator first_from(const Vector2i& cell) const {
    return std::ranges::lower_bound(order_, cell, row_before, [&](int i) { return cells_[i]; });
  }
  const std::vector<Vector2i>& cells_;
  std::vector<int> order_;
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
  double farthest = 0;
  for (const Vector2d& site : sites) farthest = std::max(farthest, site.lpNorm<Eigen::Infinity>());
  const double least = std::max(1e-100, least_radius * farthest);
  if (!(radius > least))
    fail("contact patch: radius: wanted more than {:.3g} [m], got {}", least, radius);
  // a place on the rim is one however it is rounded
  const double rim = radius * (1 + 1e-9);
  // about each site, so that nothing is looked for between those that lie far apart
  for (const Vector2d& site : sites) {
    const Vector2i from = floor_cell((site.array() - radius) / out.spacing);
    const Vector2i to = floor_cell(((site.array() + radius) / out.spacing).ceil());
    for (int y = from.y(); y <= to.y(); ++y)
      for (int x = from.x(); x <= to.x(); ++x)
        if ((Vector2d(x * out.spacing, y * out.spacing) - site).norm() <= rim)
          out.cells.emplace_back(x, y);
  }
  std::ranges::sort(out.cells, row_before);
  out.cells.erase(std::ranges::unique(out.cells).begin(), out.cells.end());
  for (const Vector2i& cell : out.cells) out.places.push_back(cell.cast<double>() * out.spacing);
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
