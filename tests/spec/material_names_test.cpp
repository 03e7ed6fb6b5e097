#include "clench/spec/material_names.h"

#include "clench/base/error.h"

using namespace clench;

TEST_CASE("the seven materials are known, and others are rejected with a near name or the list") {
  for (const auto name : material_names) CHECK_NOTHROW(check_material(name));
  CHECK_THROWS_WITH_AS(check_material("rubbr"), "unknown material 'rubbr'; did you mean 'rubber'?",
                       Error);
  CHECK_THROWS_WITH_AS(check_material("jelly"),
                       "unknown material 'jelly'; expected one of frictionless, glass, metal, "
                       "plastic, wood, rubber, stone",
                       Error);
}
