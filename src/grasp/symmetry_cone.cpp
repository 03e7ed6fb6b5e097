#include "grasp/symmetry_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "grasp/facet_plane.h"

namespace clench {

namespace {

using Vector = std::array<double, most_dimensions>;  // zeros beyond the dimension

// An image is a point of the set when it lies this near. A direction and the image of it in the cone are
// some few isometries apart, each of which may move what the set reaches by as much: below the 1e-12 that
// its ball is asked to.
constexpr double same_place = 2e-14;

// Heights and products of points of size one that differ by less may be alike: rounding is some 1e-15.
constexpr double alike = 1e-13;

// Points tried and isometries found: what is found by then is used. A ring of 16 contacts takes a
// tenth of it.
constexpr int most_tries = 100'000, most_found = 256;

// An isometry that moves the centre by less makes no wall: rounding of the image turns walls the more,
// the shorter the way, by some 1e-13 then.
constexpr double least_way = 0.02;

// any direction that no symmetric set is likely to have in a mirror
constexpr Vector generic = {0.61, -0.35, 0.47, 0.23, -0.41, 0.29};

double dot(const Vector& a, const Vector& b) {
  return clench::dot<most_dimensions>(a.data(), b.data());
}

void add_times(Vector& to, double factor, const Vector& what) {
  for (int i = 0; i < most_dimensions; ++i) to[i] += factor * what[i];
}

bool within(const Vector& a, const Vector& b, double distance) {
  Vector d = a;
  add_times(d, -1, b);
  return dot(d, d) <= distance * distance;
}

// the points of the set that those of the frame are carried to
using Image = std::array<int, most_dimensions>;

struct Isometry {
  Image image;
  Vector to;      // where it carries the centre
  double square;  // of how far
};

class Isometries {
 public:
  Isometries(const TellingPoints& points, std::span<const double> marks);
  DirectionCone cone();

 private:
  bool choose_frame(double new_part);
  bool find_duals();
  Vector in_frame(const Vector& v) const;
  Vector carried(const Vector& in_frame, const Image& image) const;
  void match(int depth);
  void sort_by_height();
  int point_at(const Vector& v) const;
  bool keeps_lengths(const Image& image) const;
  bool carries_all(const Image& image) const;
  bool follows(const Isometry& isometry) const;

  int dimension_;
  std::span<const int> parts_;
  PointClasses classes_;
  std::vector<Vector> points_, points_in_frame_;
  Vector centre_ = {}, centre_in_frame_;
  Image frame_, image_;
  std::array<Vector, most_dimensions>
      duals_;  // duals_[k] . point frame_[j]: one where k is j, else zero
  std::array<std::vector<int>, most_dimensions> fitting_;
  int tries_ = 0;
  std::vector<Isometry> found_, known_;
  // points by their height along the centre
  std::vector<double> heights_;
  std::vector<int> by_height_;
};

Isometries::Isometries(const TellingPoints& points, std::span<const double> marks)
    : dimension_(points.dimension),
      parts_(points.parts),
      classes_(points, marks),
      points_(points.count) {
  for (int i = 0; i < points.count; ++i)
    for (int k = 0; k < dimension_; ++k)
      points_[i][k] = points.coordinates[k * points.stride + classes_.given(i)];
  std::copy_n(generic.begin(), dimension_, centre_.begin());
}

// Points that span the space, those first that have few others in their class.
// new_part  of a point's length that the points before do not span
// returns   whether there are such, and any is not alone in its class
bool Isometries::choose_frame(double new_part) {
  Basis<most_dimensions> basis;
  bool alone = true;
  for (const auto& alike_points : classes_.rarest_first())
    for (int i = alike_points.begin; i < alike_points.end; ++i) {
      Vector rest = points_[i];
      basis.reduce(rest.data());
      if (!(dot(rest, rest) > new_part * new_part * dot(points_[i], points_[i]))) continue;
      frame_[basis.count] = i;
      basis.add(rest.data());
      alone &= alike_points.size() == 1;
      if (basis.count == dimension_) return !alone;
    }
  return false;
}

// by elimination
bool Isometries::find_duals() {
  std::array<Vector, most_dimensions> m;
  for (int k = 0; k < dimension_; ++k) {
    m[k] = points_[frame_[k]];
    duals_[k] = {};
    duals_[k][k] = 1;
  }
  for (int k = 0; k < dimension_; ++k) {
    int pivot = k;
    for (int j = k + 1; j < dimension_; ++j)
      if (std::abs(m[j][k]) > std::abs(m[pivot][k])) pivot = j;
    if (!(std::abs(m[pivot][k]) > 0)) return false;
    std::swap(m[k], m[pivot]), std::swap(duals_[k], duals_[pivot]);
    const double factor = 1 / m[k][k];
    for (double& x : m[k]) x *= factor;
    for (double& x : duals_[k]) x *= factor;
    for (int j = 0; j < dimension_; ++j) {
      const double times = j == k ? 0 : -m[j][k];
      add_times(m[j], times, m[k]), add_times(duals_[j], times, duals_[k]);
    }
  }
  // the inverse has the duals as its columns
  for (int k = 0; k < dimension_; ++k)
    for (int j = 0; j < k; ++j) std::swap(duals_[k][j], duals_[j][k]);
  return true;
}

Vector Isometries::in_frame(const Vector& v) const {
  Vector out = {};
  for (int k = 0; k < dimension_; ++k) out[k] = dot(duals_[k], v);
  return out;
}

Vector Isometries::carried(const Vector& in_frame, const Image& image) const {
  Vector out = {};
  for (int k = 0; k < dimension_; ++k) add_times(out, in_frame[k], points_[image[k]]);
  return out;
}

// All images of the frame that agree with the first few and have the frame's lengths and angles.
void Isometries::match(int depth) {
  if (depth == dimension_) {
    Isometry isometry{image_, carried(centre_in_frame_, image_), 0};
    Vector way = isometry.to;
    add_times(way, -1, centre_);
    isometry.square = dot(way, way);
    found_.push_back(isometry);
    return;
  }
  const auto range = classes_.of(frame_[depth]);
  tries_ += range.size();
  auto& fitting = fitting_[depth];
  classes_.fitting(range, frame_[depth], std::span(frame_).first(depth),
                   std::span(image_).first(depth), fitting);
  for (const int i : fitting) {
    image_[depth] = i;
    match(depth + 1);
    if (tries_ > most_tries || static_cast<int>(found_.size()) >= most_found) return;
  }
}

void Isometries::sort_by_height() {
  std::vector<std::pair<double, int>> order(points_.size());
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    order[i] = {dot(points_[i], centre_), i};
  std::sort(order.begin(), order.end());
  for (const auto& [height, i] : order) heights_.push_back(height), by_height_.push_back(i);
}

// returns  -1: none
int Isometries::point_at(const Vector& v) const {
  const double height = dot(v, centre_);
  // halving without branches
  const double* low = heights_.data();
  for (size_t rest = heights_.size(); rest > 1; rest -= rest / 2)
    low += low[rest / 2 - 1] < height - alike ? rest / 2 : 0;
  for (size_t at = low - heights_.data(); at < heights_.size() && heights_[at] <= height + alike;
       ++at)
    if (within(v, points_[by_height_[at]], same_place)) return by_height_[at];
  return -1;
}

// Sheared a little, sets are carried onto themselves by maps that are nearly isometries.
bool Isometries::keeps_lengths(const Image& image) const {
  std::array<Vector, most_dimensions> axes;
  for (int k = 0; k < dimension_; ++k) {
    Vector axis = {};
    axis[k] = 1;
    axes[k] = carried(in_frame(axis), image);
    for (int j = 0; j <= k; ++j)
      if (!(std::abs(dot(axes[j], axes[k]) - (j == k)) <= alike)) return false;
  }
  return true;
}

bool Isometries::carries_all(const Image& image) const {
  const size_t part_count = parts_.empty() ? 0 : static_cast<size_t>(parts_.back()) + 1;
  std::vector<int> part_to(part_count, -1), part_from(part_count, -1);
  for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
    const int at = point_at(carried(points_in_frame_[i], image));
    if (at < 0) return false;
    if (parts_.empty()) continue;
    const int part = parts_[classes_.given(i)], other = parts_[classes_.given(at)];
    int &to = part_to[part], &from = part_from[other];
    if (to < 0 && from < 0) to = other, from = part;
    if (to != other || from != part) return false;
  }
  return true;
}

// Is it one after the other, or one after the other's inverse, of isometries known to carry all points?
bool Isometries::follows(const Isometry& isometry) const {
  for (const Isometry& a : known_) {
    const Vector before = carried(in_frame(isometry.to), a.image);
    if (within(before, centre_, same_place)) return true;
    for (const Isometry& b : known_)
      if (within(before, b.to, same_place) ||
          within(carried(in_frame(b.to), a.image), isometry.to, same_place))
        return true;
  }
  return false;
}

DirectionCone Isometries::cone() {
  DirectionCone out;
  if ((!choose_frame(0.5) && !choose_frame(0.1)) || !find_duals()) return out;
  // walls are told by small differences: once more for what rounding has left
  centre_in_frame_ = in_frame(centre_);
  Vector rest = centre_;
  add_times(rest, -1, carried(centre_in_frame_, frame_));
  add_times(centre_in_frame_, 1, in_frame(rest));
  match(0);
  std::sort(found_.begin(), found_.end(),
            [](const Isometry& a, const Isometry& b) { return a.square < b.square; });
  sort_by_height();
  for (const Vector& point : points_) points_in_frame_.push_back(in_frame(point));
  for (const Isometry& isometry : found_) {
    if (out.walls == DirectionCone::most_walls) break;
    // the identity among them
    if (isometry.square < least_way * least_way) continue;
    if (!follows(isometry)) {
      if (!keeps_lengths(isometry.image) || !carries_all(isometry.image)) continue;
      known_.push_back(isometry);
    }
    double* wall = out.wall[out.walls++];
    for (int i = 0; i < dimension_; ++i)
      wall[i] = (isometry.to[i] - centre_[i]) / std::sqrt(isometry.square);
  }
  return out;
}

}  // namespace

DirectionCone symmetry_cone(const TellingPoints& points) {
  const std::vector<double> marks = point_marks(points);
  return marks.empty() ? DirectionCone() : Isometries(points, marks).cone();
}

}  // namespace clench
