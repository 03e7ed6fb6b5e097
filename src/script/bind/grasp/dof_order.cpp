#include "clench/script/bind/grasp/dof_order.h"

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"

namespace clench {

NamedOrder read_dof_order(Table& options) {
  NamedOrder out;
  if (!options.has("dof_order")) return out;
  if (options.type("dof_order") != LUA_TTABLE) {
    out.order = options.choice("dof_order", {{"hand", DofOrder::hand}, {"isaac", DofOrder::isaac}},
                               DofOrder::unknown);
    return out;
  }
  options.each("dof_order", "a list of names", [&](int i, const What& what) {
    out.names.push_back(read_string(options.state(), i, what));
  });
  if (out.names.empty()) fail("{}: dof_order: expected names, got none", options.subject());
  check_dof_names(options.subject() + ": dof_order", out.names);
  return out;
}

void name_dofs(GraspSpec& grasp, const NamedOrder& order, const Robot* hand,
               const std::string& subject) {
  const auto names = order.names.empty() && hand
                         ? listed_dof_names(*hand, grasp.dofs.size(), order.order)
                         : order.names;
  if (names.empty())
    fail("{}: dof_order: expected the option 'hand' with it, or a list of names, got neither",
         subject);
  if (names.size() != grasp.dofs.size())
    fail("{}: dof_order: expected as many names as there are DOFs, {}, got {}", subject,
         grasp.dofs.size(), names.size());
  grasp.dof_names = names;
}

}  // namespace clench
