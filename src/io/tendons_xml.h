// Tendons, the posts they wrap around, and tactile sensors in an XML robot.
#pragma once
#include <functional>

#include "io/repairs.h"
#include "io/xml.h"
#include "spec/robot_spec.h"

namespace clench {

/// Whether a part exists is for the caller to check: element by element, in their order in the spec.
using PartCheck = std::function<void(const XmlElement& element, const RobotPart& part)>;

/// <tendon> and <tendonWrapper>, millimetres; they are kept, and `warn` is told that they do not act.
/// throws Error  "hand.xml:31: tendon: expected at least 2 insertion points, got 1"
void read_tendons(const XmlElement& robot, const PartCheck& check,
                  const std::function<void(const std::string&)>& warn, Repairs& repairs,
                  RobotSpec& out);

/// The <filter> elements of a chain.
void read_tactile(const XmlElement& chain, int number, const PartCheck& check,
                  const std::function<void(const std::string&)>& warn, Repairs& repairs,
                  RobotSpec& out);

}  // namespace clench
