// A grasp: one hand, one object, the contacts between them.
#pragma once
#include "clench/grasp/wrench/kept_spaces.h"
#include "clench/model/find.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// A grasp as it was measured in a world, and the wrench spaces that were asked of it since.
struct Grasp : GraspSpec {
  Id<Robot> hand;
  Id<Body> object;
  std::vector<Contact> contacts;  ///< on the object, world frame; the points are theirs
  int contacts_at_edges = 0;  ///< soft ones on corners or edges, where their patch is but a guess
  mutable KeptSpaces spaces = {};
};

/// The contacts of palm, links and mount with the object, now. None is no error: such a grasp
/// resists nothing.
/// throws Error when edges are neither 3 to max_edges nor round_edges, rho <= 0, normal forces are
///        not > 0 or not as many as the contacts, or the object is a part of a robot
Grasp measure_grasp(const World& world, Id<Robot> hand, Id<Body> object,
                    const GraspOptions& options = {});

/// Does the hand stand about the object as the grasp has it, to 1e-6 m and rad?
bool stands_as_grasped(const World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object);

/// What is asked of the world about a grasp wants hand and object to stand as they did when it was
/// measured, wherever both have been moved.
/// throws  Error when they do not
void check_unmoved(const World& world, const Grasp& grasp);

/// Puts hand and joints where they stood about the object, wherever that is now. Nothing else
/// moves; the hand may collide. DOFs are found by their names where the grasp has them; those that
/// it does not name stay.
/// throws Error when the world has no such hand or object, the hand has other DOFs or joints, a
///        value lies outside its limits, the grasp was put together by hand, or another robot
///        carries the hand and holds it elsewhere
void apply_grasp(World& world, const GraspSpec& grasp);
/// The same with another hand and object than those of its names.
void apply_grasp(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object);

/// throws  Error when edges, rho or coordinates are not as they should be
WrenchSpace wrench_space(const GraspSpec& grasp, const GraspSpaceOptions& options = {});

/// The same, made at the first call and kept with the grasp.
const WrenchSpacePtr& space_of(const Grasp& grasp, const GraspSpaceOptions& options = {});

}  // namespace clench
