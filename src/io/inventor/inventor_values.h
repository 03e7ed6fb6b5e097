// Values of Inventor nodes that say what cannot be meant.
#pragma once
#include "clench/io/inventor/inventor_nodes.h"

namespace clench {

/// Makes negative sizes positive and holds a complexity to 0..1; tells of these, of sizes and
/// factors of 0, of arrays without copies and of switches to a child that is not there.
void repair_values(InventorNode& node, InventorGraph& graph);

}  // namespace clench
