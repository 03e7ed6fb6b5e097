// A grasp: one hand, one object, the contacts between them.
#pragma once
#include "clench/grasp/wrench/kept_spaces.h"
#include "clench/model/find.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// A grasp measured in a world, and the wrench spaces computed for it.
struct Grasp : GraspSpec {
  Id<Robot> hand;
  Id<Body> object;
  std::vector<Contact> contacts;  ///< on the object, world frame; includes the contact points
  int contacts_at_edges = 0;  ///< soft contacts on corners or edges, whose patch is only estimated
  mutable KeptSpaces spaces = {};
};

/// The present contacts of palm, links and mount with the object. An empty list is valid: such a
/// grasp resists nothing.
/// throws Error if edges are neither 3 to max_edges nor round_edges, rho <= 0, normal forces are
/// not > 0 or their number differs from that of the contacts, or the object is a part of a robot
Grasp find_grasp(const World& world, Id<Robot> hand, Id<Body> object,
                 const GraspOptions& options = {});

/// Is the hand's pose relative to the object that of the grasp, to 1e-6 m and rad?
bool stands_as_grasped(const World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object);

/// Queries of the world about a grasp require hand and object to have the relative pose and posture
/// in which it was measured, wherever both have been moved.
/// throws  Error if they do not
void check_unmoved(const World& world, const Grasp& grasp);

/// Puts hand and joints into the grasp's pose relative to the object at the object's present pose.
/// Nothing else moves; the hand may collide. DOFs are matched by name if the grasp names them; DOFs
/// that it does not name keep their values.
/// throws Error if the world has no such hand or object, the hand has other DOFs or joints, a value
/// lies outside its limits, the grasp has no pose, or another robot carries the hand and holds it
/// elsewhere
void apply_grasp(World& world, const GraspSpec& grasp);
/// The same with an explicit hand and object.
void apply_grasp(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object);

/// throws  Error if edges, rho or coordinates are invalid
WrenchSpace wrench_space(const GraspSpec& grasp, const GraspSpaceOptions& options = {});

/// The same, computed at the first call and stored with the grasp.
const WrenchSpacePtr& space_of(const Grasp& grasp, const GraspSpaceOptions& options = {});

}  // namespace clench
