#include "script_state.h"

using clench::test::Script;

TEST_CASE("a vec3 adds, scales and compares like a vector") {
  Script lua;
  CHECK(lua.text("clench.vec3(1, 2, 3) + {1, 1, 1}") == "(2, 3, 4)");
  CHECK(lua.text("{1, 1, 1} - clench.vec3(1, 2, 3)") == "(0, -1, -2)");
  CHECK(lua.text("2 * clench.vec3(1, 2, 3) / 4") == "(0.5, 1, 1.5)");
  CHECK(lua.text("-clench.vec3(0, 2, 3)") == "(0, -2, -3)");
  CHECK(lua.text("clench.vec3(1, 2, 3) == clench.vec3{1, 2, 3}") == "true");
  CHECK(lua.text("clench.vec3(1, 2, 3) == clench.vec3(1, 2, 4)") == "false");
  CHECK(lua.text("clench.vec3(1, 2, 3) == 1") == "false");
  CHECK(lua.text("#clench.vec3()") == "3");
}

TEST_CASE("a vec3 is indexed and iterated like a list of three") {
  Script lua;
  CHECK(lua.text("clench.vec3(4, 5, 6)[2]") == "5.0");
  CHECK(lua.text("clench.vec3(4, 5, 6)[4]") == "nil");
  CHECK(lua.text("clench.vec3(4, 5, 6)[1.5]") == "nil");
  CHECK(lua.text("table.unpack(clench.vec3(4, 5, 6))") == "4.0, 5.0, 6.0");
  CHECK(lua.run("local n = 0 for _, x in ipairs(clench.vec3(4, 5, 6)) do n = n + x end return n") ==
        "15.0");
}

TEST_CASE("operations that a vec3 does not support are reported") {
  Script lua;
  CHECK(lua.text("clench.vec3(1, 2, 3) * clench.vec3(1, 2, 3)") ==
        "test:1: vec3: two vectors have no product *; use a:dot(b) or a:cross(b)");
  CHECK(lua.text("clench.vec3(1, 2, 3) / 0") == "test:1: vec3: division by 0");
  CHECK(lua.text("clench.vec3(1, 2, 3) + 1") ==
        "test:1: vec3: right of +: expected a vec3 or {x, y, z}, got 1");
  CHECK(lua.text("clench.vec3(1, 2)") == "test:1: clench.vec3: z: expected a number, got nothing");
  CHECK(lua.text("clench.vec3(1, 2, 3, 4)") ==
        "test:1: clench.vec3: expected at most 3 arguments, got 4");
  CHECK(lua.text("clench.vec3(0, 0, 0):unit()") ==
        "test:1: vec3:unit: a vector of length 0 has no direction");
  CHECK(lua.text("clench.vec3(1, 2, 3).nrm") == "test:1: vec3 has no 'nrm'; did you mean 'norm'?");
  CHECK(lua.text("clench.vec3(1, 2, 3)[{}]") == "nil");
  CHECK(lua.run("clench.vec3(1, 2, 3).x = 1") == "test:1: vec3.x cannot be set: it is read only");
  CHECK(lua.run("clench.vec3(1, 2, 3).w = 1").starts_with("test:1: vec3 has no field 'w' to set"));
  CHECK(lua.run("clench.vec3(1, 2, 3)[1] = 1").find("expected a name of a field to set") !=
        std::string::npos);
}

TEST_CASE("a dot instead of a colon is pointed out") {
  Script lua;
  CHECK(lua.run("local v = clench.vec3(1, 2, 3) return v.dot{1, 2, 3}") ==
        "test:1: vec3:dot: expected a vec3 before the colon, got a table of 3; use vec3:dot(...)");
  CHECK(
      lua.run("local p = clench.pose{} return p.inverse()") ==
      "test:1: pose:inverse: expected a pose before the colon, got nothing; use pose:inverse(...)");
  CHECK(lua.run("return clench.pose{}.inverse(clench.vec3())").find("got a vec3") !=
        std::string::npos);
}

TEST_CASE("quat, matrix and rpy of one rotation give one pose") {
  Script lua;
  // a quarter turn about z; the conversions differ by rounding errors of a few ulp
  CHECK(lua.run(R"(
    local s = math.sqrt(0.5)
    local a = clench.pose{xyz = {1, 2, 3}, quat = {s, 0, 0, s}}
    local b = clench.pose{matrix = {{0, -1, 0, 1}, {1, 0, 0, 2}, {0, 0, 1, 3}}}
    local c = clench.pose{xyz = {1, 2, 3}, rpy = {0, 0, math.pi / 2}}
    local d = clench.pose{xyz = {1, 2, 3}, matrix = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}
    local e = clench.pose{matrix = a:matrix()}
    for _, p in ipairs{b, c, d, e} do
      local gap = a:inverse() * p
      if gap.position:norm() > 1e-15 or gap:angle() > 1e-15 then return p end
    end
    return "same")") == "same");
}

TEST_CASE("a pose returns its quaternion bit-exactly") {
  Script lua;
  CHECK(lua.run(R"(
    local q = clench.pose{quat = {0.5, 0.5, -0.5, 0.5}}.quat
    local again = clench.pose{quat = q}.quat
    return q[1] == 0.5 and q[3] == -0.5 and again[2] == q[2] and again[4] == q[4])") == "true");
  CHECK(
      lua.run(
          "local p = clench.pose{rpy = {0.1, 0.2, 0.3}} return clench.pose{quat = p.quat} == p") ==
      "true");
}

TEST_CASE("rpy is reproduced, also if pitch is a right angle") {
  Script lua;
  // atan2 of products of three factors, each rounded: a few 1e-16
  CHECK(lua.run(R"(
    for _, rpy in ipairs{{0.1, 0.2, 0.3}, {-3, 1.5, 2}, {0, math.pi / 2, 0.7}, {0, -math.pi / 2, -2}} do
      local pose = clench.pose{rpy = rpy}
      local gap = pose:inverse() * clench.pose{rpy = pose.rpy}
      if gap:angle() > 1e-14 then return pose end
    end
    return "same")") == "same");
}

TEST_CASE("poses compose and transform points") {
  Script lua;
  CHECK(lua.text("clench.pose{xyz = {1, 0, 0}} * clench.pose{xyz = {0, 2, 0}} * {0, 0, 3}") ==
        "(1, 2, 3)");
  CHECK(lua.text("clench.pose{xyz = {1, 0, 0}}:inverse() * clench.vec3(1, 2, 3)") == "(0, 2, 3)");
  CHECK(lua.text("clench.pose{} == clench.pose()") == "true");
  CHECK(lua.text("clench.pose(clench.pose{xyz = {1, 2, 3}}).position") == "(1, 2, 3)");
}

TEST_CASE("an invalid pose is rejected with the expected values") {
  Script lua;
  CHECK(lua.text("clench.pose{quat = {1, 0, 0}}") ==
        "test:1: clench.pose: quat: expected 4 numbers, got 3");
  CHECK(lua.text("clench.pose{quat = {0, 0, 0, 0}}") ==
        "test:1: clench.pose: quat: expected a unit quaternion {w, x, y, z}, got one of length 0");
  CHECK(lua.text("clench.pose{quat = {1e200, 1e200, 0, 0}}").find("of length 1.41421e+200") !=
        std::string::npos);
  CHECK(lua.text("clench.pose{rpy = {0, 0, 0}, quat = {1, 0, 0, 0}}") ==
        "test:1: clench.pose: expected one of rpy, quat, matrix, axis with angle, and two axes, "
        "got 2");
  CHECK(
      lua.text("clench.pose{matrix = {{1, 0}, {0, 1}}}") ==
      "test:1: clench.pose: matrix: expected 3 rows of 3 or 4 numbers, or 4 rows of 4, got 2 rows, "
      "the first of 2");
  CHECK(lua.text("clench.pose{matrix = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}").find("right-handed") !=
        std::string::npos);
  CHECK(
      lua.text("clench.pose{matrix = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 2}}}") ==
      "test:1: clench.pose: matrix: the last row must be 0 0 0 1");
  CHECK(lua.text(
            "clench.pose{xyz = {1, 2, 3}, matrix = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}") ==
        "test:1: clench.pose: expected the position once, got it from matrix and xyz");
  CHECK(lua.text("clench.pose{xyz = {0, 0 / 0, 0}}").find("xyz[2]: expected a finite number") !=
        std::string::npos);
  CHECK(lua.text("clench.pose{xzy = {1, 2, 3}}") ==
        "test:1: clench.pose: unknown key 'xzy', expected one of axis, angle, x_axis, y_axis, "
        "z_axis, rpy, quat, "
        "matrix, xyz; did you mean 'xyz'?");
  CHECK(lua.text("clench.pose{}:interpolate(clench.pose{}, 2)") ==
        "test:1: pose:interpolate: t: expected a number from 0 to 1, got 2");
  CHECK(lua.text("clench.pose{} * 2") ==
        "test:1: pose: right of *: expected a pose, a vec3 or {x, y, z}, got 2");
  CHECK(lua.text("2 * clench.pose{}") == "test:1: pose: left of *: expected a pose, got 2");
}

TEST_CASE("every value prints its contents") {
  Script lua;
  CHECK(lua.text("clench.vec3(-0.0, 1e-3, 123456.789)") == "(0, 0.001, 123457)");
  CHECK(lua.text("clench.pose{xyz = {1, 2, 3}}") == "pose{xyz = {1, 2, 3}, quat = {1, 0, 0, 0}}");
  CHECK(lua.text("clench.pose{}.quat") == "{1.0, 0.0, 0.0, 0.0}");
  CHECK(lua.text("clench.random(1)") == "random numbers");
}
