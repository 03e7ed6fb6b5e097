// Reads tendons, the wrappers around which they run, and tactile sensors of an XML robot.
#pragma once
#include <functional>

#include "clench/io/text/repairs.h"
#include "clench/io/text/xml.h"
#include "clench/spec/chains.h"

namespace clench {

/// Provided by the caller: the link at a place.   throws Error at the element if there is none
using FindLink = std::function<int(const XmlElement& element, ChainPlace place)>;

/// <tendon> and <tendonWrapper>, in millimeters; they are stored, with a warning that they have no
/// effect.
/// throws Error  "hand.xml:31: tendon: expected at least 2 insertion points, got 1"
void read_tendons(const XmlElement& robot, const FindLink& find, const Diagnostics& diagnostics,
                  Repairs& repairs, RobotSpec& out);

/// Reads the <filter> elements of a chain.
void read_tactile(const XmlElement& chain, int number, const FindLink& find,
                  const Diagnostics& diagnostics, Repairs& repairs, RobotSpec& out);

}  // namespace clench
