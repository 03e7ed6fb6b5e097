// Several searches at once, each in its own world: results do not depend on the number of threads.
#pragma once
#include <span>

#include "clench/planning/search/annealing.h"

namespace clench {

struct Share {
  Annealing* search = nullptr;
  int steps = 0;
  int taken = 0;  ///< of them, on return
};

/// Runs the steps of each search, on at most `threads` threads; those whose energy only the
/// caller's thread may evaluate run on that.
/// threads  >= 1
/// throws   Error if two share a world; the exception of the first of them, in their order; Stopped
///          after all have ended
void run_together(std::span<Share> shares, int threads, const Progress& progress = {});

}  // namespace clench
