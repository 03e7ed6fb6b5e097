#include "clench/grasp/wrench/expanding_polytope.h"

#include <cmath>
#include <cstring>

#include "clench/base/watched.h"
#include "clench/grasp/wrench/facet_complex.h"
#include "clench/grasp/wrench/facet_plane.h"
#include "clench/grasp/wrench/first_simplex.h"
#include "clench/grasp/wrench/offset_list.h"

namespace clench {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The deciding plane contains its corners within this tolerance.
constexpr double plane_noise = 2e-13;

// Largest shift of points per coordinate, by attempt: the first is without shifts. Brackets are
// widened by it.
constexpr double shifts[] = {0, 0, 0, 1e-11, 1e-11, 1e-11, 3e-11, 3e-11, 1e-10, 3e-10};

// Memory reused by all polytopes of a thread.
template <int D>
struct Room {
  FacetComplex<D> complex;
  OffsetList waiting;
};

template <int D>
class Growing {
 public:
  Growing(const SupportSet& set, int attempt, Room<D>& room)
      : set_(set),
        attempt_(static_cast<uint64_t>(attempt)),
        shift_(shifts[attempt]),
        complex_(room.complex),
        waiting_(room.waiting) {
    complex_.clear();
    waiting_.clear();
  }

  Ball ball(const BallOptions& options);
  Facets hull(const FacetsOptions& options);

  /// result so far
  double bound() const { return std::min(lower_ - slack(), upper_); }
  double upper() const { return upper_; }
  const double* direction() const { return direction_; }

 private:
  double support(const double* direction, double* point);
  SimplexEnd start(double zero);
  double exact_plane(int index, double unless);
  void grow(int first, const double* point);
  void wait(int index) {
    const double offset = complex_.facet(index).offset();
    // a facet beyond the upper bound cannot decide
    if (offset < limit_) waiting_.set(index, offset);
  }
  // no shifted point is farther from its original position
  double slack() const { return shift_ * std::sqrt(double(D)); }
  double enough(double tolerance) const { return std::max(tolerance, 2.5 * slack()); }

  const SupportSet& set_;
  uint64_t attempt_;
  double shift_;
  FacetComplex<D>& complex_;
  OffsetList& waiting_;
  double lower_ = -infinite;
  // the smallest support so far
  double upper_ = infinite, direction_[D];
  double limit_ = infinite;
};

// The set's own support, for the upper bound; the point may be shifted, always the same point by
// the same amount.
template <int D>
double Growing<D>::support(const double* direction, double* point) {
  check_stop();
  const double reach = set_.support(direction, point);
  if (reach < upper_) {
    upper_ = reach;
    std::copy_n(direction, D, direction_);
  }
  if (shift_ > 0) {
    uint64_t state = attempt_;
    for (int i = 0; i < D; ++i) {
      uint64_t bits;
      std::memcpy(&bits, &point[i], sizeof bits);
      state = Hasher::mix(state ^ bits);
    }
    for (int i = 0; i < D; ++i) {
      state = Hasher::mix(state + static_cast<uint64_t>(i) + 1);
      point[i] += shift_ * (static_cast<double>(state >> 11) * 0x1p-52 - 1);
    }
  }
  return reach;
}

template <int D>
SimplexEnd Growing<D>::start(double zero) {
  const auto ask = [&](const double* direction, double* point) {
    return support(direction, point);
  };
  const Simplex<D> simplex = first_simplex<D>(ask, attempt_, zero);
  if (simplex.end == SimplexEnd::flat) {
    std::copy_n(simplex.direction, D, direction_);
    upper_ = -infinite;
  }
  if (simplex.end != SimplexEnd::found) return simplex.end;
  for (const auto& point : simplex.point) complex_.add_point(point);
  complex_.start(simplex.plane);
  for (int k = 0; k <= D; ++k) wait(k);
  return simplex.end;
}

// Rotates the plane of a facet into the one spanned by its corners, as far as they determine it,
// and moves it in front of them.
// unless   it is within this distance of them
// returns  distance of the worst corner from it
template <int D>
double Growing<D>::exact_plane(int index, double unless) {
  auto& facet = complex_.facet(index);
  FacetCorners<D> corners;
  for (int k = 0; k < D; ++k) {
    const Eight& point = complex_.point(facet.corner[k]);
    std::copy_n(point.x, D, corners.x[k]);
  }
  Spread spread = spread_along<D>(facet.plane.x, corners);
  if (spread.width() > unless) spread = true_normal<D>(facet.plane.x, corners);
  facet.plane.x[behind] = -spread.low;
  return spread.width();
}

template <int D>
void Growing<D>::grow(int first, const double* point) {
  complex_.grow(first, point);
  for (const int gone : complex_.gone()) waiting_.drop(gone);
  for (const int made : complex_.made()) wait(made);
}

template <int D>
Ball Growing<D>::ball(const BallOptions& options) {
  const auto ended = [&](BallEnd end, double lower) {
    Ball ball;
    ball.end = end;
    lower_ = lower;
    ball.lower = bound();
    ball.upper = upper_;
    std::copy_n(direction_, D, ball.direction);
    ball.points = complex_.point_count();
    return ball;
  };
  switch (start(options.zero)) {
    case SimplexEnd::flat:
      return ended(BallEnd::flat, -infinite);
    case SimplexEnd::outside:
      return ended(BallEnd::outside, -infinite);
    default:
      break;
  }
  double p[D];
  while (true) {
    limit_ = upper_;
    const int nearest = waiting_.least();
    // no facet is nearer than the smallest support
    if (nearest < 0) return ended(BallEnd::inside, upper_);
    const auto& facet = complex_.facet(nearest);
    const double believed = facet.offset();
    if (exact_plane(nearest, seen) > plane_noise) throw BrokenSurface();
    if (facet.offset() > believed + plane_noise) {
      waiting_.drop(nearest);
      wait(nearest);
      continue;
    }
    lower_ = std::min(facet.offset(), upper_);
    const double reach = support(facet.plane.x, p);
    const double lower = lower_ = std::min(facet.offset(), upper_);
    if (upper_ <= options.zero) return ended(BallEnd::outside, lower);
    if (upper_ - lower <= enough(options.tolerance))
      return ended(BallEnd::inside, std::min(lower, upper_));
    if (options.at_least > 0 && (lower - slack() >= options.at_least || upper_ < options.at_least))
      return ended(BallEnd::decided, lower);
    if (complex_.point_count() >= options.max_points ||
        complex_.alive_count() >= options.max_facets || options.progress.stop_asked())
      return ended(BallEnd::stopped, lower);
    // a shifted point may lie below the set's support
    if (!(std::min(reach, dot<D>(facet.plane.x, p)) - facet.offset() > 10 * seen))
      throw BrokenSurface();
    grow(nearest, p);
  }
}

// determinant of D edges
template <int D>
double determinant(double (&m)[D][D]) {
  double product = 1;
  for (int k = 0; k < D; ++k) {
    int pivot = k;
    for (int j = k + 1; j < D; ++j)
      if (std::abs(m[j][k]) > std::abs(m[pivot][k])) pivot = j;
    if (pivot != k) std::swap_ranges(m[k], m[k] + D, m[pivot]), product = -product;
    product *= m[k][k];
    if (m[k][k] == 0) break;
    for (int j = k + 1; j < D; ++j) {
      const double factor = m[j][k] / m[k][k];
      for (int i = k + 1; i < D; ++i) m[j][i] -= factor * m[k][i];
    }
  }
  return product;
}

template <int D>
Facets Growing<D>::hull(const FacetsOptions& options) {
  Facets out;
  if (start(-infinite) != SimplexEnd::found) {
    out.end = FacetsEnd::flat;
    return out;
  }
  double p[D];
  for (int next = waiting_.least(); next >= 0; next = waiting_.least()) {
    const auto& plane = complex_.facet(next).plane;
    support(plane.x, p);
    if (dot<D>(plane.x, p) + plane.x[behind] <= enough(options.tolerance)) {
      waiting_.drop(next);
      continue;
    }
    grow(next, p);
    options.progress.check();
    if (complex_.alive_count() > options.max_facets) {
      out.end = FacetsEnd::too_many;
      return out;
    }
  }

  out.end = FacetsEnd::complete;
  for (int i = 0; i < complex_.point_count(); ++i)
    out.points.insert(out.points.end(), complex_.point(i).x, complex_.point(i).x + D);
  // simplices from an interior point; their signs agree
  double inner[D] = {};
  for (int k = 0; k <= D; ++k)
    for (int i = 0; i < D; ++i) inner[i] += complex_.point(k).x[i] / (D + 1);
  for (int index = 0; index < complex_.facet_count(); ++index) {
    auto& facet = complex_.facet(index);
    if (!facet.alive()) continue;
    if (facet.turned) std::swap(facet.corner[0], facet.corner[1]);
    out.corners.insert(out.corners.end(), facet.corner, facet.corner + D);
    double edges[D][D];
    for (int k = 0; k < D; ++k)
      for (int i = 0; i < D; ++i) edges[k][i] = complex_.point(facet.corner[k]).x[i] - inner[i];
    out.volume += determinant<D>(edges);
  }
  for (int k = 2; k <= D; ++k) out.volume /= k;
  out.volume = std::abs(out.volume);
  return out;
}

template <int D>
Room<D>& room() {
  thread_local Room<D> own;
  return own;
}

template <int D>
Ball ball_in(const SupportSet& set, const BallOptions& options) {
  Ball best;
  best.lower = -infinite, best.upper = infinite;
  for (int attempt = 0; attempt < static_cast<int>(std::size(shifts)); ++attempt) {
    Growing<D> growing(set, attempt, room<D>());
    try {
      return growing.ball(options);
    } catch (const BrokenSurface&) {
      best.lower = std::max(best.lower, growing.bound());
      if (growing.upper() < best.upper) {
        best.upper = growing.upper();
        std::copy_n(growing.direction(), D, best.direction);
      }
    }
  }
  if (best.upper <= options.zero) best.end = BallEnd::outside;
  return best;
}

template <int D>
Facets hull_in(const SupportSet& set, const FacetsOptions& options) {
  for (int attempt = 0; attempt < static_cast<int>(std::size(shifts)); ++attempt) {
    Growing<D> growing(set, attempt, room<D>());
    try {
      return growing.hull(options);
    } catch (const BrokenSurface&) {
    }
  }
  return {};
}

}  // namespace

Ball largest_ball(const SupportSet& set, const BallOptions& options) {
  switch (set.dimension()) {
    case 2:
      return ball_in<2>(set, options);
    case 3:
      return ball_in<3>(set, options);
    case 4:
      return ball_in<4>(set, options);
    case 5:
      return ball_in<5>(set, options);
    default:
      return ball_in<6>(set, options);
  }
}

Facets all_facets(const SupportSet& set, const FacetsOptions& options) {
  switch (set.dimension()) {
    case 2:
      return hull_in<2>(set, options);
    case 3:
      return hull_in<3>(set, options);
    case 4:
      return hull_in<4>(set, options);
    case 5:
      return hull_in<5>(set, options);
    default:
      return hull_in<6>(set, options);
  }
}

}  // namespace clench
