#include "clench/spec/material_names.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

void check_material(std::string_view name) {
  if (std::find(material_names.begin(), material_names.end(), name) != material_names.end()) return;
  const std::string near = did_you_mean(name, {material_names.begin(), material_names.end()});
  if (!near.empty()) fail("unknown material '{}'{}", excerpt(name), near);
  fail("unknown material '{}'; expected one of {}", excerpt(name), name_list(material_names));
}

}  // namespace clench
