// Checks names and units of DOFs in lists of grasps.
#pragma once
#include <string>
#include <vector>

namespace clench {

/// Checks the unit of a DOF: rad, m, or unknown (empty, or "rad or m" as written by this module).
/// throws Error  "g.csv:1: dof a [deg]: expected the unit rad or m, got 'deg'", beginning with
/// `place`
void check_dof_unit(const std::string& place, const std::string& unit);
void check_dof_units(const std::string& place, const std::vector<std::string>& units);

/// throws Error  "g.jsonl:2: dof_names: 'a' appears twice", beginning with `place`
void check_dof_names(const std::string& place, const std::vector<std::string>& names);

}  // namespace clench
