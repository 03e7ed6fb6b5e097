// A robot as files of today describe it becomes ours: followers count by their leaders' DOFs, the
// links of a chain stand side by side. Each link keeps its name and its pose for all joint values.
#pragma once
#include <functional>

#include "clench/io/text/file_cache.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// A follower's limits that leave its leader less than this part of its range are taken for a slip.
constexpr double min_follower_range = 0.1;

/// Guesses what closes the hand and how it approaches, as far as the options do not say it, and
/// tells. `file` is the name shown in sentences.
/// throws  Error naming the joint, the DOF or the option that is wrong
/// known  gives it what its file says of it beyond its tree; true: also how it closes, of which
///        nothing is guessed then. Nor is its
/// approach where that is known
RobotSpec make_robot(TreeModel tree, const std::string& file, const FileCache& cache,
                     const std::function<bool(RobotSpec&)>& known = {});

}  // namespace clench
