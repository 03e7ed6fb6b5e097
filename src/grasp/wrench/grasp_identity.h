// Fingerprints of the hand, the object and the settings with which a grasp was measured; a list of
// grasps is compared with a world by them.
#pragma once
#include <string>

#include "clench/grasp/wrench/grasp.h"
#include "clench/model/fingerprint.h"

namespace clench {

/// Notes fingerprints of hand, object and settings with a grasp of that world. The version is
/// noted by the program.
void identify(const World& world, Grasp& grasp, ShapeFingerprints& shapes);

/// Compares the hand's mechanism and the object's surface with those that the grasp notes.
/// returns  how they differ, as "grasp of flask by dlr: ..."; empty when they do not, or when the
///          grasp does not note them
std::string identity_difference(const World& world, const GraspSpec& grasp, Id<Robot> hand,
                                Id<Body> object, ShapeFingerprints& shapes);

}  // namespace clench
