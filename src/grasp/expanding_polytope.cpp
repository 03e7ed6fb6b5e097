#include "grasp/expanding_polytope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "base/hash.h"

namespace clench {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// A facet sees a point that lies farther beyond its plane than this: rounding of planes and products
// is some 1e-15, and what is nearer counts as in the plane.
constexpr double seen = 1e-13;

// The deciding plane holds its corners within this.
constexpr double plane_noise = 2e-13;

// A set thinner than this is flat.
constexpr double flat = 1e-10;

// A first simplex thinner than this is built with more care.
constexpr double near = 1e-3;

// What all points are shifted by at most in one coordinate, attempt after attempt: the first with the
// points as they are. Brackets grow by it.
constexpr double shifts[] = {0, 0, 0, 1e-11, 1e-11, 1e-11, 3e-11, 3e-11, 1e-10, 3e-10};

// a surface that rounding broke
struct Broken {};

template <int D>
double dot(const double* a, const double* b) {
  // always the same order, in which compilers find pairs
  if constexpr (D == 6)
    return (a[0] * b[0] + a[2] * b[2] + a[4] * b[4]) + (a[1] * b[1] + a[3] * b[3] + a[5] * b[5]);
  double sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

// orthonormal directions, one by one
template <int D>
struct Basis {
  double q[D][D] = {};
  int count = 0;

  // what of v is normal to all of them
  void reduce(double* v) const {
    for (int pass = 0; pass < 2; ++pass)
      for (int k = 0; k < count; ++k) {
        const double along = dot<D>(q[k], v);
        for (int i = 0; i < D; ++i) v[i] -= along * q[k][i];
      }
  }
  // returns  how much of v is new
  double add(const double* v) {
    double* next = q[count];
    std::copy_n(v, D, next);
    reduce(next);
    const double length = std::sqrt(dot<D>(next, next));
    if (length > 0) {
      for (int i = 0; i < D; ++i) next[i] /= length;
      ++count;
    }
    return length;
  }
};

template <int D>
struct Facet {
  double normal[D];
  double offset;
  double height;  // of the new point, as of `mark`
  int corner[D], neighbour[D];
  int mark;   // the expansion that looked at it last
  int birth;  // the expansion that made it, -1: gone
};

// one side of a ridge that waits for the other
struct Ridge {
  uint64_t key;
  int stamp;
  int place;  // 8 facet + side; -1: both sides met
};

struct Waiting {
  double offset;
  int facet, birth;
  bool operator<(const Waiting& o) const {  // the least first
    return offset != o.offset ? offset > o.offset : facet > o.facet;
  }
};

struct Rim {
  int facet, side, beyond;
};

// Memory that a thread's polytopes use one after the other.
template <int D>
struct Room {
  std::vector<std::array<double, D>> points;
  std::vector<uint64_t> keys;
  std::vector<Facet<D>> facets;
  std::vector<int> free, seen, made;
  std::vector<Rim> rim;
  std::vector<Waiting> waiting;
  std::vector<Ridge> ridges;
  int ridge_stamp = 0;

  void clear() {
    // what few sets need is given back
    if (facets.capacity() > 20000) *this = Room();
    points.clear(), keys.clear(), facets.clear(), free.clear(), waiting.clear();
  }
};

template <int D>
class Growing {
 public:
  Growing(const SupportSet& set, int attempt, Room<D>& room)
      : set_(set),
        attempt_(attempt),
        shift_(shifts[attempt]),
        points_(room.points),
        keys_(room.keys),
        facets_(room.facets),
        free_(room.free),
        seen_(room.seen),
        made_(room.made),
        rim_(room.rim),
        waiting_(room.waiting),
        ridges_(room.ridges),
        ridge_stamp_(room.ridge_stamp) {
    room.clear();
  }

  Ball ball(const BallOptions& options);
  Facets hull(const FacetsOptions& options);

  /// what is known so far
  double bound() const { return std::min(lower_ - slack(), upper_); }
  double upper() const { return upper_; }
  const double* direction() const { return direction_; }

 private:
  double support(const double* direction, double* point);
  bool start(double zero);
  void plane_of(Facet<D>& facet, const double* inner);
  double true_plane(Facet<D>& facet);
  template <class Made>
  void expand(int first, const double* point, Made&& made);
  void join(int facet, int side, uint64_t key, size_t mask, int& open);
  // no shifted point is farther from where it was
  double slack() const { return shift_ * std::sqrt(double(D)); }
  int add_point(const double* point) {
    const int index = static_cast<int>(points_.size());
    std::array<double, D> p;
    std::copy_n(point, D, p.data());
    points_.push_back(p);
    keys_.push_back(Hasher::mix(static_cast<uint64_t>(index) + 1));
    return index;
  }
  bool alive(const Waiting& w) const { return facets_[w.facet].birth == w.birth; }

  const SupportSet& set_;
  int attempt_;
  double shift_;
  std::vector<std::array<double, D>>& points_;
  std::vector<uint64_t>& keys_;
  std::vector<Facet<D>>& facets_;
  std::vector<int>&free_, &seen_, &made_;
  std::vector<Rim>& rim_;
  std::vector<Waiting>& waiting_;
  std::vector<Ridge>& ridges_;
  int& ridge_stamp_;
  int expansion_ = 0;
  double lower_ = -infinite;
  // the least support so far
  double upper_ = infinite, direction_[D];
};

// The set's own support, for the upper bound; the point may be shifted, always the same point alike.
template <int D>
double Growing<D>::support(const double* direction, double* point) {
  const double reach = set_.support(direction, point);
  if (reach < upper_) {
    upper_ = reach;
    std::copy_n(direction, D, direction_);
  }
  if (shift_ > 0) {
    uint64_t state = static_cast<uint64_t>(attempt_);
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

// the plane through the corners, away from the inner point
template <int D>
void Growing<D>::plane_of(Facet<D>& facet, const double* inner) {
  const double* origin = points_[facet.corner[0]].data();
  Basis<D> basis;
  for (int k = 1; k < D; ++k) {
    double v[D];
    for (int i = 0; i < D; ++i) v[i] = points_[facet.corner[k]][i] - origin[i];
    basis.add(v);
  }
  double n[D];
  for (int i = 0; i < D; ++i) n[i] = origin[i] - inner[i];
  basis.reduce(n);
  const double length = std::sqrt(dot<D>(n, n));
  if (!(length > 0)) throw Broken();
  for (int i = 0; i < D; ++i) facet.normal[i] = n[i] / length;
  facet.offset = dot<D>(facet.normal, origin);
}

// Turns the plane of a facet into the one that its corners span, as far as they do.
// returns  how far the worst corner lies from it
template <int D>
double Growing<D>::true_plane(Facet<D>& facet) {
  const auto worst = [&](const double* n, double& low) {
    double high = -infinite;
    low = infinite;
    for (const int corner : facet.corner) {
      const double x = dot<D>(n, points_[corner].data());
      low = std::min(low, x), high = std::max(high, x);
    }
    return high - low;
  };
  double low;
  double spread = worst(facet.normal, low);
  if (spread > seen) {
    // longest edges first; what the shortest leave open stays as it was
    const double* origin = points_[facet.corner[0]].data();
    double edges[D - 1][D];
    for (int k = 1; k < D; ++k)
      for (int i = 0; i < D; ++i) edges[k - 1][i] = points_[facet.corner[k]][i] - origin[i];
    Basis<D> basis;
    for (int k = 0; k < D - 1; ++k) {
      int longest = k;
      double most = -1;
      for (int j = k; j < D - 1; ++j) {
        basis.reduce(edges[j]);
        const double square = dot<D>(edges[j], edges[j]);
        if (square > most) most = square, longest = j;
      }
      if (most < 1e-24) break;
      std::swap_ranges(edges[k], edges[k] + D, edges[longest]);
      basis.add(edges[k]);
    }
    double n[D];
    std::copy_n(facet.normal, D, n);
    basis.reduce(n);
    const double length = std::sqrt(dot<D>(n, n));
    if (length > 0.5) {
      for (int i = 0; i < D; ++i) n[i] /= length;
      double new_low;
      const double now = worst(n, new_low);
      if (now < spread) {
        std::copy_n(n, D, facet.normal);
        spread = now, low = new_low;
      }
    }
  }
  facet.offset = low;
  return spread;
}

// A first simplex, grown towards the origin.
// returns  false when the set leaves the origin outside or is flat: direction_ and upper_ tell which
template <int D>
bool Growing<D>::start(double zero) {
  // any direction that no symmetric set is likely to have a face for
  static constexpr double any[] = {0.61, -0.35, 0.47, 0.23, -0.41, 0.29};
  double u[D], p[D], origin[D];
  uint64_t state = static_cast<uint64_t>(attempt_);
  const auto random = [&] {
    state = Hasher::mix(state + 1);
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;
  };
  for (int i = 0; i < D; ++i) u[i] = attempt_ == 0 ? any[i] : random();
  double length = std::sqrt(dot<D>(u, u));
  for (int i = 0; i < D; ++i) u[i] /= length;
  if (support(u, origin) <= zero) return false;
  add_point(origin);
  Basis<D> basis;
  while (basis.count < D) {
    // from the flat through the points towards the origin
    double v[D];
    for (int i = 0; i < D; ++i) v[i] = -origin[i];
    basis.reduce(v);
    length = std::sqrt(dot<D>(v, v));
    double best = 0, far[D] = {};
    if (length > near) {
      for (int i = 0; i < D; ++i) u[i] = v[i] / length;
      const double reach = support(u, p);
      if (reach <= zero) return false;
      best = reach + length;
      std::copy_n(p, D, far);
    }
    // the origin is near, or beyond all points: both ways along one direction, and others where that
    // leads nowhere
    for (int trial = 0; trial < 8 && best < near; ++trial) {
      do {
        for (int i = 0; i < D; ++i) u[i] = random();
        basis.reduce(u);
        length = std::sqrt(dot<D>(u, u));
      } while (length < 1e-2);
      for (int i = 0; i < D; ++i) u[i] /= length;
      const double base = dot<D>(u, origin);
      for (const double side : {1.0, -1.0}) {
        double way[D];
        for (int i = 0; i < D; ++i) way[i] = side * u[i];
        if (support(way, p) <= zero) return false;
        const double extent = std::abs(dot<D>(u, p) - base);
        if (extent > best) best = extent, std::copy_n(p, D, far);
      }
    }
    if (best <= flat) {
      std::copy_n(u, D, direction_);
      upper_ = -infinite;
      return false;
    }
    double edge[D];
    for (int i = 0; i < D; ++i) edge[i] = far[i] - origin[i];
    if (basis.add(edge) <= 0.5 * flat) throw Broken();
    add_point(far);
  }

  double inner[D] = {};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k <= D; ++k) inner[i] += points_[k][i];
    inner[i] /= D + 1;
  }
  facets_.resize(D + 1);
  for (int k = 0; k <= D; ++k) {
    Facet<D>& facet = facets_[k];
    for (int j = 0, slot = 0; j <= D; ++j)
      if (j != k) facet.corner[slot] = facet.neighbour[slot] = j, ++slot;
    // all turned the same way
    if (k % 2) {
      std::swap(facet.corner[0], facet.corner[1]);
      std::swap(facet.neighbour[0], facet.neighbour[1]);
    }
    facet.mark = 0, facet.birth = 0;
    plane_of(facet, inner);
  }
  return true;
}

template <int D>
void Growing<D>::join(int facet, int side, uint64_t key, size_t mask, int& open) {
  for (size_t at = key & mask;; at = (at + 1) & mask) {
    Ridge& ridge = ridges_[at];
    if (ridge.stamp != ridge_stamp_) {
      ridge = {key, ridge_stamp_, 8 * facet + side};
      ++open;
      return;
    }
    if (ridge.key != key) continue;
    if (ridge.place < 0) throw Broken();  // three facets at a ridge
    facets_[facet].neighbour[side] = ridge.place / 8;
    facets_[ridge.place / 8].neighbour[ridge.place % 8] = facet;
    ridge.place = -1;
    --open;
    return;
  }
}

// Joins the rim of all facets that see the point to it; `made` is told of each new facet.
template <int D>
template <class Made>
void Growing<D>::expand(int first, const double* point, Made&& made) {
  ++expansion_;
  seen_.assign(1, first);
  rim_.clear();
  facets_[first].mark = expansion_;
  facets_[first].height = dot<D>(facets_[first].normal, point) - facets_[first].offset;
  facets_[first].birth = -1;
  for (size_t next = 0; next < seen_.size(); ++next) {
    const int a = seen_[next];
    for (int side = 0; side < D; ++side) {
      const int b = facets_[a].neighbour[side];
      Facet<D>& other = facets_[b];
      if (other.mark != expansion_) {
        other.mark = expansion_;
        other.height = dot<D>(other.normal, point) - other.offset;
        if (other.height > seen) {
          other.birth = -1;
          seen_.push_back(b);
        }
      }
      if (other.birth >= 0) rim_.push_back({a, side, b});
    }
  }
  if (rim_.size() < D) throw Broken();

  const int corner = add_point(point);
  size_t room = 64;
  while (room < 4 * D * rim_.size()) room *= 2;
  if (ridges_.size() < room) ridges_.assign(room, {0, 0, 0}), ridge_stamp_ = 0;
  ++ridge_stamp_;
  int open = 0;
  made_.clear();
  for (const Rim& rim : rim_) {
    int index;
    if (free_.empty()) {
      index = static_cast<int>(facets_.size());
      facets_.emplace_back();
    } else {
      index = free_.back();
      free_.pop_back();
    }
    made_.push_back(index);
    Facet<D>& facet = facets_[index];
    const Facet<D>& a = facets_[rim.facet];
    Facet<D>& b = facets_[rim.beyond];
    std::copy_n(a.corner, D, facet.corner);
    facet.corner[rim.side] = corner;
    facet.neighbour[rim.side] = rim.beyond;
    int back = 0;
    while (back < D && b.neighbour[back] != rim.facet) ++back;
    if (back == D) throw Broken();
    b.neighbour[back] = index;
    facet.mark = 0, facet.birth = expansion_;

    // of all planes through the ridge the one that holds the point
    double square = 0;
    for (int i = 0; i < D; ++i) facet.normal[i] = a.height * b.normal[i] - b.height * a.normal[i];
    square = dot<D>(facet.normal, facet.normal);
    const double length = std::sqrt(square);
    if (!(length > 1e-3 * seen)) throw Broken();
    const double scale = 1 / length;
    for (int i = 0; i < D; ++i) facet.normal[i] *= scale;
    facet.offset = (a.height * b.offset - b.height * a.offset) * scale;

    uint64_t all = 0;
    for (int k = 0; k < D; ++k) all += k == rim.side ? 0 : keys_[facet.corner[k]];
    for (int k = 0; k < D; ++k)
      if (k != rim.side) join(index, k, all - keys_[facet.corner[k]], room - 1, open);
  }
  if (open != 0) throw Broken();
  for (const int gone : seen_) free_.push_back(gone);
  for (const int index : made_) made(index);
}

template <int D>
Ball Growing<D>::ball(const BallOptions& options) {
  Ball ball;
  const auto ended = [&](BallEnd end, double lower) {
    ball.end = end;
    lower_ = lower;
    ball.lower = bound();
    ball.upper = upper_;
    std::copy_n(direction_, D, ball.direction);
    ball.points = static_cast<int>(points_.size());
    return ball;
  };
  if (!start(options.zero))
    return ended(upper_ == -infinite ? BallEnd::flat : BallEnd::outside, -infinite);
  std::vector<Waiting>& heap = waiting_;
  const auto wait = [&](int index) {
    if (facets_[index].offset >= upper_) return;  // it will not decide
    heap.push_back({facets_[index].offset, index, facets_[index].birth});
    std::push_heap(heap.begin(), heap.end());
  };
  for (int k = 0; k <= D; ++k) wait(k);

  const double enough = std::max(options.tolerance, 2.5 * slack());
  double p[D];
  while (true) {
    // facets farther than the least support have left the heap, so that is the bound when it is empty
    while (!heap.empty() && !alive(heap.front())) {
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();
    }
    if (heap.empty()) return ended(BallEnd::inside, upper_);
    const int nearest = heap.front().facet;
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();

    Facet<D>& facet = facets_[nearest];
    const double believed = facet.offset;
    if (true_plane(facet) > plane_noise) throw Broken();
    if (facet.offset > believed + plane_noise) {
      wait(nearest);
      continue;
    }
    const double lower = std::min(facet.offset, upper_);
    lower_ = lower;
    const double reach = support(facet.normal, p);
    if (upper_ <= options.zero) return ended(BallEnd::outside, lower);
    if (upper_ - lower <= enough) return ended(BallEnd::inside, lower);
    if (options.at_least > 0 && (lower - slack() >= options.at_least || upper_ < options.at_least))
      return ended(BallEnd::decided, lower);
    if (static_cast<int>(points_.size()) >= options.most_points)
      return ended(BallEnd::stopped, lower);
    // a shifted point may lie below what the set reaches
    if (!(std::min(reach, dot<D>(facet.normal, p)) - facet.offset > 10 * seen)) throw Broken();
    expand(nearest, p, wait);
  }
}

template <int D>
Facets Growing<D>::hull(const FacetsOptions& options) {
  Facets out;
  if (!start(-infinite)) {
    out.end = FacetsEnd::flat;
    return out;
  }
  std::vector<Waiting>& queue = waiting_;
  const auto wait = [&](int index) { queue.push_back({0, index, facets_[index].birth}); };
  for (int k = 0; k <= D; ++k) wait(k);
  const double enough = std::max(options.tolerance, 2.5 * slack());
  double p[D];
  for (size_t next = 0; next < queue.size(); ++next) {
    if (next > 100000 && 2 * next > queue.size()) {
      queue.erase(queue.begin(), queue.begin() + static_cast<long>(next));
      next = 0;
    }
    if (!alive(queue[next])) continue;
    const Facet<D>& facet = facets_[queue[next].facet];
    support(facet.normal, p);
    if (dot<D>(facet.normal, p) - facet.offset <= enough) continue;
    expand(queue[next].facet, p, wait);
    if (static_cast<int>(facets_.size() - free_.size()) > options.most_facets) {
      out.end = FacetsEnd::too_many;
      return out;
    }
  }

  out.end = FacetsEnd::complete;
  out.points.resize(points_.size() * D);
  for (size_t i = 0; i < points_.size(); ++i) std::copy_n(points_[i].data(), D, &out.points[i * D]);
  // simplices from an inner point; their signs agree
  double inner[D];
  for (int i = 0; i < D; ++i) {
    inner[i] = 0;
    for (int k = 0; k <= D; ++k) inner[i] += points_[k][i] / (D + 1);
  }
  for (const Facet<D>& facet : facets_) {
    if (facet.birth < 0) continue;
    out.corners.insert(out.corners.end(), facet.corner, facet.corner + D);
    double m[D][D], product = 1;
    for (int k = 0; k < D; ++k)
      for (int i = 0; i < D; ++i) m[k][i] = points_[facet.corner[k]][i] - inner[i];
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
    out.volume += product;
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
    } catch (const Broken&) {
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
    } catch (const Broken&) {
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
