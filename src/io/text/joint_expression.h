// `d4*0.33+-5.9`: dependence of a joint on a DOF, as in text files of robots.
#pragma once
#include <optional>
#include <string_view>

namespace clench {

/// joint value = ratio * DOF, plus a constant offset of its Denavit-Hartenberg variable, in the
/// units of the file (degrees or mm).
struct JointExpression {
  int dof = 0;
  double ratio = 1;
  double offset = 0;
};

/// Parses `dN`, `dN*ratio`, `dN+offset`, `dN-offset`, `dN*ratio+-offset`; empty for other texts.
std::optional<JointExpression> parse_joint_expression(std::string_view text);

}  // namespace clench
