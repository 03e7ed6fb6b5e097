#pragma once

#include "clench/grasp/wrench/grasp.h"
#include "clench/grasp/wrench/grasp_dofs.h"

namespace clench {

/// As apply_grasp, but an arm that carries the hand brings it to where the grasp has it, by inverse
/// kinematics; a hand that stands there already, or that no arm carries, is placed.
///
/// Throws  Error where the arm does not reach, or where apply_grasp throws; the arm then stands as
///         before
void apply_by_arm(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object,
                  const GraspDofOptions& options = {});

}  // namespace clench
