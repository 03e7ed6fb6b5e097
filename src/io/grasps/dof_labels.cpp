#include "clench/io/grasps/dof_labels.h"

#include <set>

#include "clench/base/text.h"

namespace clench {

void check_dof_unit(const std::string& place, const std::string& unit) {
  if (!unit.empty() && unit != "rad" && unit != "m" && unit != "rad or m")
    fail("{}: expected the unit rad or m, got {}", place, in_quotes(unit));
}

void check_dof_units(const std::string& place, const std::vector<std::string>& units) {
  for (const std::string& unit : units) check_dof_unit(place, unit);
}

void check_dof_names(const std::string& place, const std::vector<std::string>& names) {
  std::set<std::string> known;
  for (const std::string& name : names)
    if (!known.insert(name).second) fail("{}: {} appears twice", place, in_quotes(name));
}

}  // namespace clench
