// Numbers by name, as grasps have them.
#pragma once
#include <map>
#include <string>

namespace clench {

/// A measure or note by its name, else `other`.
inline double number_of(const std::map<std::string, double>& named, const std::string& name,
                        double other) {
  const auto found = named.find(name);
  return found == named.end() ? other : found->second;
}

}  // namespace clench
