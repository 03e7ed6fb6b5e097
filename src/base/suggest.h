// "did you mean": suggests the known name nearest to an unknown one.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// Number of single-character edits (insertion, deletion, substitution, swap of neighbors) from a
/// to b, ignoring case.
int edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'flask.iv'?" if a known name is near, or corresponds to a term of other
/// simulators (qpos: dofs), else "". Never the name itself, and nothing for a name of one or two
/// letters, to which every short name is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// ", expected one of dofs, speed", if they are few, and the nearest: the end of a sentence about
/// an unknown name.
std::string instead_of(std::string_view name, const std::vector<std::string>& known);

}  // namespace clench
