// Several searches at once, each in a world of its own: what they find does not depend on how many
// threads there are.
#pragma once
#include <span>

#include "clench/planning/search/annealing.h"

namespace clench {

struct Share {
  Annealing* search = nullptr;
  int steps = 0;
  int taken = 0;  ///< of them, on return
};

/// Runs each its steps, on at most so many threads; those whose energy only the caller's thread may
/// ask run on it.
/// threads  >= 1
/// throws   Error when two share a world; what the first of them, in their order, threw; Stopped
///          once all have ended
void run_together(std::span<Share> shares, int threads, const Progress& progress = {});

}  // namespace clench
