#include "clench/io/text/joint_expression.h"

#include "clench/base/text.h"

namespace clench {

std::optional<JointExpression> parse_joint_expression(std::string_view text) {
  if (text.empty() || text.front() != 'd') return {};
  text.remove_prefix(1);
  JointExpression out;

  // number of the DOF
  const size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  const auto dof = parse_integer(text.substr(0, digits));
  if (!dof) return {};
  out.dof = *dof;
  text.remove_prefix(digits);

  // a ratio, up to the sign of the offset; a sign after '*' or 'e' belongs to the ratio
  if (text.starts_with('*')) {
    size_t end = 2;
    while (end < text.size() &&
           ((text[end] != '+' && text[end] != '-') || (text[end - 1] | 32) == 'e'))
      ++end;
    const auto ratio = parse_number(text.substr(1, std::min(end, text.size()) - 1));
    if (!ratio) return {};
    out.ratio = *ratio;
    text.remove_prefix(std::min(end, text.size()));
  }
  if (text.empty()) return out;

  // an offset: +5, -5, +-5
  if (text.starts_with("+-")) text.remove_prefix(1);
  const auto offset = parse_number(text);
  if (!offset || (text.front() != '+' && text.front() != '-')) return {};
  out.offset = *offset;
  return out;
}

}  // namespace clench
