#pragma once

#include "clench/grasp/wrench/grasp.h"
#include "clench/grasp/wrench/grasp_dofs.h"

namespace clench {

/// As apply_grasp, but an arm that carries the hand moves it to the grasp's pose by inverse
/// kinematics; a hand that is there already, or that no arm carries, is placed.
///
/// Throws  Error if the arm does not reach, or as apply_grasp; the arm then keeps its posture
void apply_by_arm(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object,
                  const GraspDofOptions& options = {});

}  // namespace clench
