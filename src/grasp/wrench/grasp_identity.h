// Fingerprints of the hand, the object and the settings with which a grasp was measured; a list of
// grasps is compared with a world by them.
#pragma once
#include <string>

#include "clench/grasp/wrench/grasp.h"
#include "clench/model/fingerprint.h"

namespace clench {

/// Stores fingerprints of hand, object and settings in a grasp of that world. The program sets the
/// version.
void identify(const World& world, Grasp& grasp, ShapeFingerprints& shapes);

/// Compares the hand's mechanism and the object's surface with those stored in the grasp.
/// returns  their difference, as "grasp of flask by dlr: ..."; empty if there is none, or if the
///          grasp does not store them
std::string identity_difference(const World& world, const GraspSpec& grasp, Id<Robot> hand,
                                Id<Body> object, ShapeFingerprints& shapes);

}  // namespace clench
