// Rows of a step that act on several coordinates of a tree: joint tendons, and dry resistance to
// free motion.
#pragma once
#include "clench/dynamics/control/motors.h"

namespace clench {

/// Limits, springs with dampers, and dry friction of the joint tendons of a tree's robots. Springs
/// are evaluated at the end of the step.
/// number  of the tree; h  length of the step [s]
void add_tendon_rows(const World& world, const Articulation& tree, int number, double h,
                     const DynamicState& state, std::vector<CoordinateRow>& out);

/// Dry resistance of a floating root: along the world's axes, and about its own.
void add_free_friction_rows(const World& world, const Articulation& tree, int number, double h,
                            std::vector<CoordinateRow>& out);

}  // namespace clench
