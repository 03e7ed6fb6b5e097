// Numbers by name, as stored in grasps.
#pragma once
#include <map>
#include <string>

namespace clench {

/// The measure or note of that name; `other` if there is none.
inline double number_of(const std::map<std::string, double>& named, const std::string& name,
                        double other) {
  const auto found = named.find(name);
  return found == named.end() ? other : found->second;
}

}  // namespace clench
