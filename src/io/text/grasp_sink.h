// Where the readers of grasp lists put what they read, one grasp after the other, and how much
// memory that may take.
#pragma once
#include <functional>
#include <string>

#include "clench/io/text/memory_budget.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Receiver of the grasps of a file. Readers call it as they go, so that a long list is held once.
struct GraspSink {
  std::function<void(GraspSpec&&)> add;
  /// called before the first grasp with an upper bound of their number; may be empty
  std::function<void(size_t)> expect = {};
};

/// Memory that a grasp of a list takes, its names and numbers included [bytes].
size_t memory_of(const GraspSpec& grasp);

/// Passes grasps on and counts their memory.
class GraspCollector {
 public:
  /// bytes  size of the file
  GraspCollector(const std::string& file, size_t bytes, const GraspSink& sink)
      : budget_(file, bytes), sink_(sink) {}

  MemoryBudget& budget() { return budget_; }
  /// count  upper bound of the grasps to come
  void expect(size_t count);
  /// throws  Error as MemoryBudget
  void add(GraspSpec&& grasp);

 private:
  MemoryBudget budget_;
  const GraspSink& sink_;
};

}  // namespace clench
