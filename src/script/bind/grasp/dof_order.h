// The option `dof_order` of grasps whose DOFs have no names.
#pragma once
#include <string>
#include <vector>

#include "clench/grasp/wrench/grasp_dofs.h"
#include "clench/script/lua/table.h"

namespace clench {

/// An order, or the names in it.
struct NamedOrder {
  DofOrder order = DofOrder::unknown;
  std::vector<std::string> names = {};

  bool is_given() const { return order != DofOrder::unknown || !names.empty(); }
};

/// "hand", "isaac" or a list of names.
NamedOrder read_dof_order(Table& options);

/// Names the DOFs of a grasp that has no names.
/// hand    null: the order must be a list of names
/// throws  Error if the numbers of DOFs and names differ, or the hand has other DOFs
void name_dofs(GraspSpec& grasp, const NamedOrder& order, const Robot* hand,
               const std::string& subject);

}  // namespace clench
