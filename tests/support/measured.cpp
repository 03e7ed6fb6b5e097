#include "support/measured.h"

#include <fstream>
#include <stdexcept>

#include "support/shared.h"

namespace clench::test {

nlohmann::json measured(const std::string& name) {
  std::ifstream file(shared() / "reference" / (name + ".json"));
  if (!file) throw std::runtime_error("no measurement " + name);
  return nlohmann::json::parse(file);
}

}  // namespace clench::test
