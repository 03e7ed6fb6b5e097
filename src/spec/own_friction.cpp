#include "clench/spec/own_friction.h"

#include <fmt/format.h>

#include <algorithm>

namespace clench {

double combined(const OwnFriction& a, const OwnFriction& b) {
  const auto alone = [](const OwnFriction& f) { return f.frictionless ? 0 : f.mu; };
  if (a.priority != b.priority) return alone(a.priority > b.priority ? a : b);
  return a.frictionless && b.frictionless ? 0 : std::max(a.mu, b.mu);
}

std::string material_name(const OwnFriction& friction) {
  std::string out = fmt::format("friction {}", friction.mu);
  if (friction.frictionless) out += " frictionless";
  if (friction.priority != 0) out += fmt::format(" priority {}", friction.priority);
  return out;
}

}  // namespace clench
