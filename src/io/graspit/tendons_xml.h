// Tendons, the posts they wrap around, and tactile sensors in an XML robot.
#pragma once
#include <functional>

#include "clench/io/text/repairs.h"
#include "clench/io/text/xml.h"
#include "clench/spec/chains.h"

namespace clench {

/// The caller's: the link at a place.   throws Error at the element when there is none
using FindLink = std::function<int(const XmlElement& element, ChainPlace place)>;

/// <tendon> and <tendonWrapper>, millimeters; they are kept, and `warn` is told that they do not act.
/// throws Error  "hand.xml:31: tendon: expected at least 2 insertion points, got 1"
void read_tendons(const XmlElement& robot, const FindLink& find, const Diagnostics& diagnostics,
                  Repairs& repairs, RobotSpec& out);

/// The <filter> elements of a chain.
void read_tactile(const XmlElement& chain, int number, const FindLink& find,
                  const Diagnostics& diagnostics, Repairs& repairs, RobotSpec& out);

}  // namespace clench
