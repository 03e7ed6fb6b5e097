// Cache of queries of a world.
#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "clench/base/progress.h"
#include "clench/geometry/query/queries.h"
#include "clench/model/world_model.h"

namespace clench {

/// Bounds of a body in the world, with rounding: a box along the world's axes, one along its own,
/// and a sphere.
struct BodyBox {
  Eigen::Vector3d low, high;
  Eigen::Matrix3d axes;  ///< of its own box, one per column
  Eigen::Vector3d middle, half;
  Eigen::Vector3d center;  ///< of the sphere
  double radius = 0;
};

/// A body of a sweep, and its index in the given list.
struct SweepItem {
  Id<Body> body;
  int position = 0;
  const BodyBox* box = nullptr;
};

/// May two bodies be within reach [m]? Never false for a pair that is.
bool within_reach(const BodyBox& a, const BodyBox& b, double reach);

/// One per thread. It makes answers faster without changing their bits: cached data is compared
/// with the present world, so that it need not be notified of changes, restored snapshots or
/// removed bodies.
class QueryContext {
 public:
  /// Begins a query of a world; if the world belongs to a different family than the last, the cache
  /// is cleared: ids refer to other bodies there.
  void attend(const std::shared_ptr<const void>& lineage, const WorldModel& model);
  /// body     with geometry
  /// returns  a reference that is valid until attend() is called for a larger model
  const BodyBox& box(Id<Body> id, const Body& body, const Pose& X_WB);
  /// Bodies with geometry of a small world, and the pairs of them that may collide, as indices into
  /// that list, both in creation order; updated if the world's model or settings have changed.
  struct Candidates {
    std::vector<Id<Body>> bodies;
    std::vector<std::pair<int, int>> pairs;
    /// The same pairs, those first that often collided recently, each with its memory if it has
    /// one.
    struct Likely {
      int i, j;
      PairCache* cache = nullptr;
      float hit_rate() const { return cache ? cache->hit_rate : 0; }
    };
    std::vector<Likely> likely;
  };
  Candidates& candidates(const WorldModel& model, const WorldSettings& settings);
  /// Bodies with geometry of a large world, in creation order if the world's model has changed,
  /// otherwise in the order of the last sweep: nearly sorted if little has moved.
  std::vector<SweepItem>& sweep_order(const WorldModel& model);
  /// Coherence memory of a pair, as returned by ordered().
  PairCache& pair(Id<Body> a, Id<Body> b);
  void forget(Id<Body> body);
  /// Progress of queries, and of motions of a world with this context; a stop request makes them
  /// throw Stopped.
  void watch(Progress progress) { progress_ = std::move(progress); }
  const Progress& progress() const { return progress_; }
  size_t bytes() const;

 private:
  struct Box {
    Id<Body> id;
    Pose X_WB;
    BodyBox box;
  };
  struct Pair {
    Id<Body> a, b;
    PairCache cache;
  };
  Progress progress_;
  std::shared_ptr<const void> lineage_;
  std::vector<Box> boxes_;                         // by index of the id
  uint64_t model_stamp_ = 0, settings_stamp_ = 0;  // of the candidates
  Candidates candidates_;
  uint64_t order_stamp_ = 0;  // the model's
  std::vector<SweepItem> sweep_order_;
  std::unordered_map<uint64_t, Pair> pairs_;
};

}  // namespace clench
