// "did you mean": the nearest of the known names to one that is unknown.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// Number of single-character edits (insert, drop, exchange, swap of neighbors) from a to b,
/// upper and lower case alike.
int edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'flask.iv'?" when a known name is near, or is what other simulators' word means
/// here (qpos: dofs), else "". Never the name itself, and nothing for a name of one or two letters,
/// to which everything short is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// ", expected one of dofs, speed", where they are few, and the nearest: what ends a sentence about
/// an unknown name.
std::string instead_of(std::string_view name, const std::vector<std::string>& known);

}  // namespace clench
