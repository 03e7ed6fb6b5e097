// Receivers for grasps that readers of lists pass on one by one, and a limit on the memory of these
// grasps.
#pragma once
#include <functional>
#include <string>

#include "clench/io/text/memory_budget.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Receiver of the grasps of a file. Readers call it during reading, so that a long list is stored
/// only once.
struct GraspSink {
  std::function<void(GraspSpec&&)> add;
  /// called before the first grasp with an upper bound of their number; may be empty
  std::function<void(size_t)> expect = {};
};

/// Memory used by a grasp in a list, including its names and numbers [bytes].
size_t memory_of(const GraspSpec& grasp);

/// Passes grasps on and limits their total memory.
class GraspCollector {
 public:
  /// bytes  size of the file
  GraspCollector(const std::string& file, size_t bytes, const GraspSink& sink)
      : budget_(file, bytes), sink_(sink) {}

  MemoryBudget& budget() { return budget_; }
  /// count  upper bound of the number of grasps that follow
  void expect(size_t count);
  /// throws  Error as MemoryBudget
  void add(GraspSpec&& grasp);

 private:
  MemoryBudget budget_;
  const GraspSink& sink_;
};

}  // namespace clench
