// Surface of a polytope in D dimensions: facets that are simplices and know their neighbors, and
// its expansion to a point outside. The facets visible from the point are removed, and the rim of
// the hole is joined to it. Includes no Eigen, as geometry/lanes.h does not.
//
// Most of the time is lost to mispredicted branches, not to arithmetic, so traversals have no
// branches that depend on which facets are visible from the point.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "clench/base/hash.h"
#include "clench/geometry/tree/lanes.h"
#include "clench/grasp/wrench/support_set.h"

namespace clench {

/// a surface broken by rounding
struct BrokenSurface {};

/// A facet is visible from a point that lies farther beyond its plane than this: rounding of planes
/// and products is about 1e-15, and smaller distances count as in the plane.
inline constexpr double seen = 1e-13;

/// A point, with 1 after its coordinates, or a plane, with minus its offset there: their product is
/// the point's height above the plane. The rest is zero.
struct alignas(64) Eight {
  double x[lane_count] = {};

  // element by element: as one block they would pass through the stack, in pieces
  CLENCH_INLINE DoubleLanes lanes() const {
    DoubleLanes out;
    for (int i = 0; i < DoubleLanes::chunks; ++i)
      std::memcpy(&out.chunk[i], x + i * DoubleLanes::width, sizeof out.chunk[i]);
    return out;
  }
  CLENCH_INLINE void set(const DoubleLanes& from) {
    for (int i = 0; i < DoubleLanes::chunks; ++i)
      std::memcpy(x + i * DoubleLanes::width, &from.chunk[i], sizeof from.chunk[i]);
  }
};

inline constexpr int behind = max_dimensions;

CLENCH_INLINE double dot(const DoubleLanes& a, const DoubleLanes& b) {
  const DoubleLanes c = a * b;
  // pairwise sums: the same result for every vector width
  auto sum = c.chunk[0] + c.chunk[c.chunks / 2];
  if constexpr (DoubleLanes::width == 2) return sum += c.chunk[1] + c.chunk[3], sum[0] + sum[1];
  return (sum[0] + sum[2 % DoubleLanes::width]) + (sum[1] + sum[3 % DoubleLanes::width]);
}
CLENCH_INLINE double dot(const Eight& a, const Eight& b) { return dot(a.lanes(), b.lanes()); }

template <int D>
class FacetComplex {
 public:
  struct alignas(64) Facet {
    Eight plane;                 // unit normal, outwards
    int corner[D], neighbor[D];  // neighbor k has all corners but corner k
    double height;               // height of the new point, valid if `mark` is current
    int mark;                    // the last expansion that visited it; -1: removed
    bool turned;                 // is the order of corners mirrored?

    double offset() const { return -plane.x[behind]; }
    bool alive() const { return mark >= 0; }
  };

  /// Keeps its memory.
  void clear();
  int add_point(const double* x);
  /// The facets of a simplex of points 0 to D, facet k without point k.
  void start(const Eight* planes);
  /// Joins the rim of all facets visible from the point to it.
  /// throws BrokenSurface
  void grow(int first, const double* point);
  /// of the last expansion
  std::span<const int> gone() const { return {seen_.data(), static_cast<size_t>(seen_count_)}; }
  std::span<const int> made() const { return made_; }

  const Eight& point(int index) const { return points_[index]; }
  int point_count() const { return static_cast<int>(points_.size()); }
  Facet& facet(int index) { return facets_[index]; }
  /// including removed ones
  int facet_count() const { return used_; }
  int alive_count() const { return used_ - static_cast<int>(free_.size()); }

 private:
  struct Rim {
    int facet, side, beyond;
  };
  void look(int first, const Eight& point);
  void reserve();
  void raise(int corner);
  void join();
  // of a new ridge; the same side if it is not visible
  uint32_t other_side(uint32_t own, int shift) {
    const uint32_t other = place(own, shift) ^ own;
    return other < ridges_.size() && ridges_[other] == ridges_[own] ? other : own;
  }
  uint32_t& place(uint32_t side, int shift) { return table_[(ridges_[side] >> shift) & mask_]; }

  std::vector<Eight> points_;
  std::vector<uint64_t> keys_;  // hash values of points; the sum identifies a ridge
  std::vector<Facet> facets_;
  int used_ = 0, growth_ = 0;
  std::vector<int> free_, seen_, made_;
  int seen_count_ = 0, rim_count_ = 0;
  std::vector<Rim> rim_;
  // of new facets: side k of the i-th is number 8 i + k
  std::vector<uint64_t> ridges_;
  std::vector<uint32_t> table_, unmatched_;
  size_t mask_ = 0;
};

template <int D>
void FacetComplex<D>::clear() {
  // memory that most sets do not need is released
  if (facets_.size() > 100000) *this = FacetComplex();
  points_.clear(), keys_.clear(), free_.clear();
  used_ = growth_ = 0;
}

template <int D>
int FacetComplex<D>::add_point(const double* x) {
  const int index = point_count();
  Eight& point = points_.emplace_back();
  std::copy_n(x, D, point.x);
  point.x[behind] = 1;
  keys_.push_back(Hasher::mix(static_cast<uint64_t>(index) + 1));
  return index;
}

template <int D>
void FacetComplex<D>::start(const Eight* planes) {
  used_ = D + 1;
  if (facets_.size() < D + 1) facets_.resize(D + 1);
  for (int k = 0; k <= D; ++k) {
    Facet& facet = facets_[k];
    facet.plane = planes[k];
    for (int j = 0, slot = 0; j <= D; ++j)
      if (j != k) facet.corner[slot] = facet.neighbor[slot] = j, ++slot;
    facet.turned = k % 2;
    facet.mark = 0;
  }
}

template <int D>
void FacetComplex<D>::grow(int first, const double* x) {
  const int corner = add_point(x);
  look(first, points_[corner]);
  if (rim_count_ < D) throw BrokenSurface();
  reserve();
  raise(corner);
  join();
  for (const int gone : this->gone()) facets_[gone].mark = -1, free_.push_back(gone);
}

// all facets visible from the point, and the rim around them
template <int D>
void FacetComplex<D>::look(int first, const Eight& point) {
  ++growth_;
  const DoubleLanes p = point.lanes();
  if (seen_.size() < D + 1) seen_.resize(64);
  seen_[0] = first, seen_count_ = 1, rim_count_ = 0;
  facets_[first].mark = growth_;
  facets_[first].height = dot(facets_[first].plane.lanes(), p);
  for (int next = 0; next < seen_count_; ++next) {
    if (static_cast<int>(seen_.size()) < seen_count_ + D) seen_.resize(2 * seen_.size());
    if (static_cast<int>(rim_.size()) < rim_count_ + D) rim_.resize(2 * rim_.size() + D);
    const int a = seen_[next];
    for (int side = 0; side < D; ++side) {
      const int b = facets_[a].neighbor[side];
      Facet& other = facets_[b];
      const double height = dot(other.plane.lanes(), p);
      const bool sees = height > seen, fresh = other.mark != growth_;
      other.height = height;
      other.mark = growth_;
      seen_[seen_count_] = b;
      seen_count_ += sees & fresh;
      rim_[rim_count_] = {a, side, b};
      rim_count_ += !sees;
    }
  }
}

// space for the new facets
template <int D>
void FacetComplex<D>::reserve() {
  made_.resize(rim_count_);
  const int old = std::min(rim_count_, static_cast<int>(free_.size()));
  for (int i = 0; i < old; ++i) made_[i] = free_[free_.size() - 1 - i];
  free_.resize(free_.size() - old);
  for (int i = old; i < rim_count_; ++i) made_[i] = used_++;
  // capacity is doubled, and its pages are not touched before they are used
  if (static_cast<int>(facets_.size()) < used_) facets_.resize(used_);
  ridges_.resize(8 * static_cast<size_t>(rim_count_));
  size_t size = 256;
  while (size < 32 * static_cast<size_t>(rim_count_)) size *= 2;
  table_.assign(size, 0);
  mask_ = size - 1;
}

// the new facets, each from one side of the rim to the point
template <int D>
void FacetComplex<D>::raise(int corner) {
  static constexpr Eight coordinates = {{1, 1, 1, 1, 1, 1, 0, 0}};
  const DoubleLanes normal_only = coordinates.lanes();
  double shortest = 1;
  int backs = 0;
  for (int i = 0; i < rim_count_; ++i) {
    const Rim rim = rim_[i];
    const Facet& a = facets_[rim.facet];
    Facet& b = facets_[rim.beyond];
    Facet& facet = facets_[made_[i]];

    // of all planes through the ridge the one that contains the point
    const DoubleLanes plane = b.plane.lanes() * a.height - a.plane.lanes() * b.height;
    const double length = std::sqrt(dot(plane, plane * normal_only));
    shortest = length < shortest ? length : shortest;
    facet.plane.set(plane * (1 / length));

    // the point is the last corner
    for (int k = 0; k < D; ++k) facet.corner[k] = a.corner[k];
    facet.corner[rim.side] = a.corner[D - 1];
    facet.corner[D - 1] = corner;
    facet.turned = a.turned != (rim.side != D - 1);
    facet.mark = 0;
    facet.neighbor[D - 1] = rim.beyond;
    int back = 0;
    for (int k = 0; k < D; ++k) {
      const int is = b.neighbor[k] == rim.facet;
      back += k * is, backs += is;
    }
    b.neighbor[back] = made_[i];

    // both sides of a new ridge store their numbers in its entry
    uint64_t own[D], all = 0x9e3779b97f4a7c15u;
    for (int k = 0; k < D - 1; ++k) own[k] = keys_[facet.corner[k]], all += own[k];
    uint64_t* ridge = &ridges_[8 * static_cast<size_t>(i)];
    for (int k = 0; k < D - 1; ++k) {
      ridge[k] = all - own[k];
      place(static_cast<uint32_t>(8 * i + k), 0) ^= static_cast<uint32_t>(8 * i + k);
    }
    for (int k = D - 1; k < 8; ++k) ridge[k] = 0;
  }
  if (!(shortest > 1e-3 * seen) || backs != rim_count_) throw BrokenSurface();
}

// Neighbors along the new ridges: both sides have stored their numbers in one entry of the table,
// combined by exclusive or, so that each finds the other unless a second ridge used the entry.
// Those that do not find each other try again with other entries.
template <int D>
void FacetComplex<D>::join() {
  unmatched_.clear();
  for (uint32_t i = 0; i < static_cast<uint32_t>(rim_count_); ++i) {
    Facet& facet = facets_[made_[i]];
    for (uint32_t k = 0; k < D - 1; ++k) {
      const uint32_t own = 8 * i + k, other = other_side(own, 0);
      if (other != own)
        facet.neighbor[k] = made_[other / 8];
      else
        unmatched_.push_back(own);
    }
  }
  for (int shift = 16; !unmatched_.empty(); shift += 16) {
    // the only one at a ridge, or the third
    if (shift > 48) throw BrokenSurface();
    for (const uint32_t own : unmatched_) place(own, shift) = 0;
    for (const uint32_t own : unmatched_) place(own, shift) ^= own;
    std::erase_if(unmatched_, [&](uint32_t own) {
      const uint32_t other = other_side(own, shift);
      facets_[made_[own / 8]].neighbor[own % 8] = made_[other / 8];
      return other != own;
    });
  }
}

}  // namespace clench
