// Measurements of the original.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace clench::test {

/// reference/NAME.json of the third-party data.   throws std::runtime_error if it is absent
nlohmann::json measured(const std::string& name);

}  // namespace clench::test
