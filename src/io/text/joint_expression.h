// `d4*0.33+-5.9`: how a joint of a text robot follows a DOF.
#pragma once
#include <optional>
#include <string_view>

namespace clench {

/// joint value = ratio * DOF, and a constant offset of its Denavit-Hartenberg variable, as written
/// (degrees or mm).
struct JointExpression {
  int dof = 0;
  double ratio = 1;
  double offset = 0;
};

/// `dN`, `dN*ratio`, `dN+offset`, `dN-offset`, `dN*ratio+-offset`; empty when it is anything else.
std::optional<JointExpression> parse_joint_expression(std::string_view text);

}  // namespace clench
