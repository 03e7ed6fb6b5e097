#include "clench/grasp/wrench/grasp_identity.h"

#include <fmt/format.h>

#include "clench/base/hash.h"
#include "clench/model/fingerprint.h"

namespace clench {

static std::string surface_text(const Body& body, ShapeFingerprints& shapes) {
  return body.shape ? fingerprint_text(shapes.of(body.shape)) : "";
}

static std::string settings_text(const GraspSpec& grasp) {
  Hasher h;
  const GraspOptions& options = grasp.options;
  h.add(static_cast<uint64_t>(options.edges));
  h.add(grasp.rho);
  h.add(static_cast<uint64_t>(options.soft));
  for (const double force : options.normal_force.values) h.add(force);
  h.add(static_cast<uint64_t>(options.modulus));
  return fingerprint_text(h.value());
}

void identify(const World& world, Grasp& grasp, ShapeFingerprints& shapes) {
  grasp.hand_fingerprint = fingerprint_text(mechanism_fingerprint(world, grasp.hand, shapes));
  grasp.object_fingerprint = surface_text(world.body(grasp.object), shapes);
  grasp.settings_fingerprint = settings_text(grasp);
}

std::string identity_difference(const World& world, const GraspSpec& grasp, Id<Robot> hand,
                                Id<Body> object, ShapeFingerprints& shapes) {
  const auto differs = [](const std::string& noted, const std::string& present) {
    return !noted.empty() && noted != present;
  };
  const bool other_hand = differs(grasp.hand_fingerprint,
                                  fingerprint_text(mechanism_fingerprint(world, hand, shapes))),
             other_object =
                 differs(grasp.object_fingerprint, surface_text(world.body(object), shapes));
  if (!other_hand && !other_object) return "";
  return fmt::format("grasp of {} by {}: it was measured {}{}{}", world.body(object).name,
                     world.robot(hand).name,
                     other_hand ? "with another hand, of other shapes or joints" : "",
                     other_hand && other_object ? ", and " : "",
                     other_object ? "on another object, of another surface" : "");
}

}  // namespace clench
