// What queries remember of a world from one to the next.
#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "clench/base/progress.h"
#include "clench/geometry/query/queries.h"
#include "clench/model/world_model.h"

namespace clench {

/// What holds a body in the world, its rounding included: a box along the world's axes, one along
/// its own, and a sphere.
struct BodyBox {
  Eigen::Vector3d low, high;
  Eigen::Matrix3d axes;  ///< of its own box, a column each
  Eigen::Vector3d middle, half;
  Eigen::Vector3d centre;  ///< of the sphere
  double radius = 0;
};

/// A body of a sweep, and its number in the list that was given.
struct SweepItem {
  Id<Body> body;
  int position = 0;
  const BodyBox* box = nullptr;
};

/// May two bodies be as near as reach [m]? True where they are.
bool within_reach(const BodyBox& a, const BodyBox& b, double reach);

/// One for each thread that asks. It makes answers faster and changes no bit of them: whatever it
/// remembers it compares with how the world is now, so that nobody has to tell it of changes,
/// restored snapshots or removed bodies.
class QueryContext {
 public:
  /// Begins a query of a world; of another family than the last, and all that was remembered is
  /// forgotten: ids mean other bodies there.
  void attend(const std::shared_ptr<const void>& lineage, const WorldModel& model);
  /// body     with geometry
  /// returns  stays where it is until attend() is called for a larger model
  const BodyBox& box(Id<Body> id, const Body& body, const Pose& X_WB);
  /// Bodies with geometry of a small world, and the pairs of them that may collide, as numbers in
  /// that list, both in creation order; found anew where the world is made or set otherwise than it
  /// was.
  struct Candidates {
    std::vector<Id<Body>> bodies;
    std::vector<std::pair<int, int>> pairs;
    /// The same pairs, those first that collided often of late, each with its memory once it has
    /// one.
    struct Likely {
      int i, j;
      PairCache* cache = nullptr;
      float hit_rate() const { return cache ? cache->hit_rate : 0; }
    };
    std::vector<Likely> likely;
  };
  Candidates& candidates(const WorldModel& model, const WorldSettings& settings);
  /// Bodies with geometry of a large world, in creation order where the world is made otherwise
  /// than it was, else as the last sweep has left them: nearly in order, when little has moved.
  std::vector<SweepItem>& sweep_order(const WorldModel& model);
  /// Coherence memory of a pair, as ordered() gives it.
  PairCache& pair(Id<Body> a, Id<Body> b);
  void forget(Id<Body> body);
  /// Who watches the queries, and the motions of a world that has this context; they throw Stopped.
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
