// What ties joints of an MJCF model to each other and to motors: equalities, fixed tendons,
// actuators.
#pragma once
#include <set>

#include "clench/io/mjcf/mjcf_document.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// Makes joints that must move together follow one of them, takes the limits and forces of
/// actuators, and marks joints that none drives as passive, when there are actuators at all. Tells
/// what it cannot follow.
/// elsewhere  joints of other robots of the file; tells  of what concerns no joint at all, too?
void read_mjcf_couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree,
                         const std::set<std::string>& elsewhere, bool tells);

}  // namespace clench
