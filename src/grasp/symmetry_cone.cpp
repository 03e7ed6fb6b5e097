#include "grasp/symmetry_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace clench {

namespace {

using Vector = std::array<double, most_dimensions>;  // zeros beyond the dimension

// An image is a point of the set when it lies this near. A direction and the image of it in the cone are
// some few isometries apart, each of which may move what the set reaches by as much: below the 1e-12 that
// its ball is asked to.
constexpr double same_point = 2e-14;

// Lengths and heights of points of size one that differ by less may be alike: rounding is some 1e-15.
constexpr double alike = 1e-13;

// Products and sums of products, in float, of points whose longest has length one. They only choose what
// to try.
constexpr float nearly_alike = 1e-5f;

// Products compared and isometries found: what is found by then is used. A ring of 16 contacts takes a
// tenth of it.
constexpr int most_tries = 100'000, most_found = 256;

// any direction that no symmetric set is likely to have in a mirror
constexpr Vector generic = {0.61, -0.35, 0.47, 0.23, -0.41, 0.29};

double dot(const Vector& a, const Vector& b) {
  double sum = a[0] * b[0];
  for (int i = 1; i < most_dimensions; ++i) sum += a[i] * b[i];
  return sum;
}

void add_times(Vector& to, double factor, const Vector& what) {
  for (int i = 0; i < most_dimensions; ++i) to[i] += factor * what[i];
}

bool within(const Vector& a, const Vector& b, double distance) {
  Vector d = a;
  add_times(d, -1, b);
  return dot(d, d) <= distance * distance;
}

// Products of all points with all, and classes of points: only those of one class may be exchanged, since
// isometries of the set leave any sum over a point's products alone.
class PointClasses {
 public:
  PointClasses(const TellingPoints& points, double longest);

  float product(int i, int j) const { return products_[static_cast<size_t>(i) * row_ + j]; }
  bool alone(int i) const { return end_[i] - begin_[i] == 1; }
  std::span<const int> of(int i) const {
    return std::span(points_).subspan(begin_[i], end_[i] - begin_[i]);
  }
  /// those of the smallest classes first
  std::vector<int> rarest_first() const;

 private:
  static constexpr int lanes = 16;
  int row_;
  std::vector<float> products_;
  std::vector<int> points_, begin_, end_;  // by class; where each point's class is there
};

PointClasses::PointClasses(const TellingPoints& points, double longest)
    : row_((points.count + lanes - 1) / lanes * lanes),
      points_(points.count),
      begin_(points.count),
      end_(points.count) {
  const int count = points.count;
  // zeros beyond the last point and the dimension
  std::vector<float> x(static_cast<size_t>(row_) * most_dimensions);
  for (int row = 0; row < points.dimension; ++row)
    for (int i = 0; i < count; ++i)
      x[row * row_ + i] = static_cast<float>(points.coordinates[row * points.stride + i] / longest);
  products_.resize(static_cast<size_t>(count) * row_);
  std::vector<std::pair<float, int>> marks(count);
  for (int i = 0; i < count; ++i) {
    float* t = &products_[static_cast<size_t>(i) * row_];
    float own[most_dimensions], sums[lanes] = {};
    for (int row = 0; row < most_dimensions; ++row) own[row] = x[row * row_ + i];
    for (int start = 0; start < row_; start += lanes)
      for (int lane = 0; lane < lanes; ++lane) {
        const int j = start + lane;
        float sum = own[0] * x[j];
        for (int row = 1; row < most_dimensions; ++row) sum += own[row] * x[row * row_ + j];
        t[j] = sum;
        sums[lane] += sum * (0.37f + sum * (0.71f + sum * (0.53f + sum * 0.29f)));
      }
    float mark = 0;
    for (const float sum : sums) mark += sum;
    marks[i] = {mark / static_cast<float>(count), i};
  }
  std::sort(marks.begin(), marks.end());
  for (int first = 0, last = 0; first < count; first = last) {
    while (last < count &&
           (last == first || marks[last].first - marks[last - 1].first <= nearly_alike))
      ++last;
    for (int at = first; at < last; ++at) {
      points_[at] = marks[at].second;
      begin_[points_[at]] = first, end_[points_[at]] = last;
    }
  }
}

std::vector<int> PointClasses::rarest_first() const {
  std::vector<int> out = points_;
  std::sort(out.begin(), out.end(), [&](int a, int b) {
    const int more = (end_[a] - begin_[a]) - (end_[b] - begin_[b]);
    return more != 0 ? more < 0 : a < b;
  });
  return out;
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
  Isometries(const TellingPoints& points, double longest);
  DirectionCone cone();

 private:
  bool choose_frame(double new_part);
  bool find_duals();
  Vector in_frame(const Vector& v) const;
  Vector carried(const Vector& in_frame, const Image& image) const;
  void match(int depth);
  void sort_by_height();
  int point_at(const Vector& v) const;
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
  int tries_ = 0;
  std::vector<Isometry> found_, known_;
  std::vector<std::pair<double, int>> by_height_;  // points by their height along the centre
};

Isometries::Isometries(const TellingPoints& points, double longest)
    : dimension_(points.dimension),
      parts_(points.parts),
      classes_(points, longest),
      points_(points.count) {
  for (int row = 0; row < dimension_; ++row)
    for (int i = 0; i < points.count; ++i)
      points_[i][row] = points.coordinates[row * points.stride + i];
  std::copy_n(generic.begin(), dimension_, centre_.begin());
}

// Points that span the space, those first that have few others in their class.
// new_part  of a point's length that the points before do not span
// returns   whether there are such, and any is not alone in its class
bool Isometries::choose_frame(double new_part) {
  std::array<Vector, most_dimensions> basis;
  int size = 0;
  bool alone = true;
  for (const int i : classes_.rarest_first()) {
    Vector rest = points_[i];
    for (int k = 0; k < size; ++k) add_times(rest, -dot(rest, basis[k]), basis[k]);
    const double square = dot(rest, rest);
    if (!(square > new_part * new_part * dot(points_[i], points_[i]))) continue;
    const double length = std::sqrt(square);
    for (double& x : rest) x /= length;
    basis[size] = rest;
    frame_[size++] = i;
    alone &= classes_.alone(i);
    if (size == dimension_) return !alone;
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
  for (const int i : classes_.of(frame_[depth])) {
    bool fits = true;
    for (int k = 0; fits && k < depth; ++k)
      fits = ++tries_ && std::abs(classes_.product(image_[k], i) -
                                  classes_.product(frame_[k], frame_[depth])) <= nearly_alike;
    if (!fits) continue;
    image_[depth] = i;
    match(depth + 1);
    if (tries_ > most_tries || static_cast<int>(found_.size()) >= most_found) return;
  }
}

void Isometries::sort_by_height() {
  by_height_.resize(points_.size());
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    by_height_[i] = {dot(points_[i], centre_), i};
  std::sort(by_height_.begin(), by_height_.end());
}

// returns  -1: none
int Isometries::point_at(const Vector& v) const {
  const double height = dot(v, centre_);
  for (auto at =
           std::lower_bound(by_height_.begin(), by_height_.end(), std::pair(height - alike, 0));
       at != by_height_.end() && at->first <= height + alike; ++at)
    if (within(v, points_[at->second], same_point)) return at->second;
  return -1;
}

bool Isometries::carries_all(const Image& image) const {
  const size_t part_count = parts_.empty() ? 0 : static_cast<size_t>(parts_.back()) + 1;
  std::vector<int> part_to(part_count, -1), part_from(part_count, -1);
  for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
    const int at = point_at(carried(points_in_frame_[i], image));
    if (at < 0) return false;
    if (parts_.empty()) continue;
    int &to = part_to[parts_[i]], &from = part_from[parts_[at]];
    if (to < 0 && from < 0) to = parts_[at], from = parts_[i];
    if (to != parts_[at] || from != parts_[i]) return false;
  }
  return true;
}

// Is it one after the other, or one after the other's inverse, of isometries known to carry all points?
bool Isometries::follows(const Isometry& isometry) const {
  for (const Isometry& a : known_) {
    const Vector before = carried(in_frame(isometry.to), a.image);
    if (within(before, centre_, alike)) return true;
    for (const Isometry& b : known_)
      if (within(before, b.to, alike) ||
          within(carried(in_frame(b.to), a.image), isometry.to, alike))
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
    // the identity, and what does as good as nothing
    if (isometry.square < 1e-6) continue;
    if (!follows(isometry)) {
      if (!carries_all(isometry.image)) continue;
      known_.push_back(isometry);
    }
    double* wall = out.wall[out.walls++];
    for (int i = 0; i < dimension_; ++i)
      wall[i] = (isometry.to[i] - centre_[i]) / std::sqrt(isometry.square);
  }
  return out;
}

bool all_differ(std::span<const double> numbers) {
  for (size_t i = 0; i < numbers.size(); ++i) {
    const double own = numbers[i];
    int same = 0;
    for (size_t j = i + 1; j < numbers.size(); ++j) same += std::abs(numbers[j] - own) <= alike;
    if (same > 0) return false;
  }
  return true;
}

// Numbers that are alike for points that an isometry exchanges: their squared lengths, and, as isometries leave
// the mean m and the second moments C of all points alone, m . p + p . C p
std::vector<double> squared_lengths(const TellingPoints& points) {
  std::vector<double> out(points.count);
  for (int k = 0; k < points.dimension; ++k) {
    const double* x = points.coordinates + k * points.stride;
    for (int i = 0; i < points.count; ++i) out[i] += x[i] * x[i];
  }
  return out;
}

std::vector<double> moments(const TellingPoints& points) {
  std::vector<double> out(points.count);
  for (int k = 0; k < points.dimension; ++k) {
    const double* x = points.coordinates + k * points.stride;
    const double mean = std::accumulate(x, x + points.count, 0.0) / points.count;
    for (int i = 0; i < points.count; ++i) out[i] += mean * x[i];
    for (int j = 0; j <= k; ++j) {
      const double* y = points.coordinates + j * points.stride;
      const double second = std::inner_product(x, x + points.count, y, 0.0) / points.count;
      const double both = j < k ? 2 * second : second;
      for (int i = 0; i < points.count; ++i) out[i] += both * x[i] * y[i];
    }
  }
  return out;
}

}  // namespace

DirectionCone symmetry_cone(const TellingPoints& points) {
  // as of most sets
  const std::vector<double> squares = squared_lengths(points);
  if (all_differ(squares) || all_differ(moments(points))) return {};
  const double longest = std::sqrt(*std::max_element(squares.begin(), squares.end()));
  if (!(longest > 0)) return {};
  return Isometries(points, longest).cone();
}

}  // namespace clench
