#include <cmath>

#include "script_state.h"

using clench::test::Script;

TEST_CASE("a vec3 adds, scales and compares like a vector") {
  Script lua;
  CHECK(lua.text("clench.vec3(1, 2, 3) + {1, 1, 1}") == "(2, 3, 4)");
  CHECK(lua.text("{1, 1, 1} - clench.vec3(1, 2, 3)") == "(0, -1, -2)");
}
