// Couplings of joints in an MJCF model, to each other and to motors: equalities, fixed tendons and
// actuators.
#pragma once
#include <set>

#include "clench/io/mjcf/mjcf_document.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// Makes joints that must move together follow one of them, takes the limits and forces of
/// actuators, and marks joints that no actuator drives as passive if there are actuators. Warns of
/// couplings that cannot be followed.
/// elsewhere  joints of other robots of the file
/// tells      also warns of elements that concern no joint
void read_mjcf_couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree,
                         const std::set<std::string>& elsewhere, bool tells);

}  // namespace clench
