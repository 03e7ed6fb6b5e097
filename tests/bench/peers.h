// Other libraries with the same queries as Clench, for the benchmark of geometry queries.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "clench/geometry/query/queries.h"

namespace clench::bench {

/// One library's view of two meshes. Queries that the library lacks return nothing.
class PairPeer {
 public:
  virtual ~PairPeer() = default;
  virtual std::optional<bool> collide(const Pose&) { return {}; }
  virtual std::optional<double> distance(const Pose&) { return {}; }
};

/// One library's view of a mesh and points or rays.
class PointPeer {
 public:
  virtual ~PointPeer() = default;
  virtual std::optional<double> distance(const Eigen::Vector3d&) { return {}; }
  virtual std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d&) { return {}; }
  /// distance of the first hit; infinity without a hit
  virtual std::optional<double> cast(const Eigen::Vector3d&, const Eigen::Vector3d&) { return {}; }
};

using MakePair = std::unique_ptr<PairPeer> (*)(const Shape& a, const Shape& b);
using MakePoint = std::unique_ptr<PointPeer> (*)(const Shape&);

struct Peer {
  const char* name;
  MakePair pair = nullptr;
  MakePoint point = nullptr;
};

/// the libraries that this program was built with
std::vector<Peer> peers();

std::unique_ptr<PairPeer> fcl_pair(const Shape& a, const Shape& b);
std::unique_ptr<PairPeer> ode_pair(const Shape& a, const Shape& b);
std::unique_ptr<PairPeer> bullet_pair(const Shape& a, const Shape& b);
std::unique_ptr<PointPeer> cgal_point(const Shape&);
std::unique_ptr<PointPeer> embree_point(const Shape&);

}  // namespace clench::bench
