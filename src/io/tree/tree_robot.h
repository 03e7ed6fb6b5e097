// Converts a TreeModel into a RobotSpec: followers are expressed by the DOFs of their leaders, and
// the links of a chain are contiguous. Each link keeps its name and its pose for all joint values.
#pragma once
#include <functional>

#include "clench/io/text/file_cache.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// If a follower's limits leave its leader less than this fraction of its range, they are treated
/// as a mistake.
constexpr double min_follower_range = 0.1;

/// Guesses the closing directions and the approach frame that the options leave open, and reports
/// them. `file` is the name shown in messages.
/// throws  Error with the invalid joint, DOF or option
/// known  adds properties in the file that the tree does not contain; returns true if they include
///        closing directions, which are then not guessed. An approach frame that it sets is not
///        guessed either
RobotSpec make_robot(TreeModel tree, const std::string& file, const FileCache& cache,
                     const std::function<bool(RobotSpec&)>& known = {});

}  // namespace clench
