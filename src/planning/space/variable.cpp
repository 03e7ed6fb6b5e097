#include "clench/planning/space/variable.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

double inside(const Variable& variable, double value) {
  if (!variable.circular) return std::clamp(value, variable.min, variable.max);
  const double range = variable.max - variable.min;
  if (range > 0) value -= range * std::floor((value - variable.min) / range);
  return std::clamp(value, variable.min, variable.max);
}

void check_variable(const Variable& v) {
  const auto refuse = [&](const std::string& why) {
    fail("search variable '{}': {}", excerpt(v.name), why);
  };
  if (v.name.empty()) fail("a search variable: expected a name");
  if (!std::isfinite(v.min) || !std::isfinite(v.max))
    refuse(fmt::format("expected a finite range, got {} to {}", v.min, v.max));
  if (v.min > v.max) refuse(fmt::format("min {} exceeds max {}", v.min, v.max));
  if (!(v.value >= v.min && v.value <= v.max))
    refuse(fmt::format("the value must lie in [{}, {}], got {}", v.min, v.max, v.value));
  if (!(std::isfinite(v.jump) && v.jump > 0))
    refuse(fmt::format("the jump must be > 0, got {}", v.jump));
  if (v.target && !std::isfinite(*v.target))
    refuse(fmt::format("the target must be finite, got {}", *v.target));
  if (!(v.confidence >= 0 && v.confidence < 1))
    refuse(fmt::format("the confidence must lie in [0, 1), got {}", v.confidence));
}

int find_variable(const std::vector<Variable>& variables, const std::string& name) {
  std::vector<std::string> names;
  for (const Variable& v : variables) names.push_back(v.name);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    fail("no search variable '{}'{}", excerpt(name), instead_of(name, names));
  return static_cast<int>(found - names.begin());
}

}  // namespace clench
