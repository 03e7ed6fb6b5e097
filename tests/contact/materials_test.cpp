#include "clench/contact/materials.h"

#include <limits>

#include "clench/base/error.h"

using namespace clench;

TEST_CASE("the seven materials have a fixed order") {
  const MaterialTable table;
  const std::vector<std::string> names = {"frictionless", "glass",  "metal", "plastic",
                                          "wood",         "rubber", "stone"};
  CHECK(table.names() == names);
  for (int i = 0; i < 7; ++i) CHECK(table.index(names[i]) == i);
}

TEST_CASE("the table is symmetric, and kinetic friction is 0.1 below static friction") {
  const MaterialTable table;
  for (int a = 0; a < 7; ++a)
    for (int b = 0; b < 7; ++b) {
      CHECK(table.friction(a, b).statics == table.friction(b, a).statics);
      CHECK(table.friction(a, b).kinetic == table.friction(b, a).kinetic);
      if (a == 0 || b == 0) {
        CHECK(table.friction(a, b).statics == 0);
        CHECK(table.friction(a, b).kinetic == 0);
      } else {
        CHECK(table.friction(a, b).kinetic == table.friction(a, b).statics - 0.1);
      }
    }
  const auto mu = [&](const char* a, const char* b) {
    return table.friction(table.index(a), table.index(b)).statics;
  };
  CHECK(mu("rubber", "glass") == 1.0);
  CHECK(mu("rubber", "rubber") == 2.0);
  CHECK(mu("rubber", "stone") == 1.5);
  CHECK(mu("plastic", "plastic") == 0.3);
  CHECK(mu("metal", "glass") == 0.2);
  CHECK(mu("stone", "wood") == 0.6);
}

TEST_CASE("setting a pair changes both of its orders and no other pair") {
  MaterialTable table;
  const MaterialTable before = table;
  table.set_friction("wood", "glass", {.statics = 0.55, .kinetic = 0.5});
  for (int a = 0; a < 7; ++a)
    for (int b = 0; b < 7; ++b) {
      const bool changed = (a == 1 && b == 4) || (a == 4 && b == 1);
      CHECK(table.friction(a, b).statics == (changed ? 0.55 : before.friction(a, b).statics));
      CHECK(table.friction(a, b).kinetic == (changed ? 0.5 : before.friction(a, b).kinetic));
    }
}

TEST_CASE("a new material keeps the others' friction and has only the coefficients that are set") {
  MaterialTable table;
  const MaterialTable before = table;
  table.set_friction("cork", "felt", {.statics = 0.8, .kinetic = 0.7});
  table.set_friction("cork", "cork", {.statics = 0.9, .kinetic = 0.9});
  REQUIRE(table.names().size() == 9);
  for (int a = 0; a < 7; ++a) {
    for (int b = 0; b < 7; ++b)
      CHECK(table.friction(a, b).statics == before.friction(a, b).statics);
    CHECK(table.friction(a, table.index("cork")).statics == 0);
  }
  CHECK(table.friction(table.index("felt"), table.index("cork")).statics == 0.8);
  CHECK(table.friction(table.index("cork"), table.index("cork")).kinetic == 0.9);
  CHECK(table.friction(table.index("felt"), table.index("felt")).statics == 0);
}

TEST_CASE("bad coefficients and names are rejected, and leave the table unchanged") {
  MaterialTable table;
  const auto refuse = [&](const char* a, const char* b, Friction friction, const char* message) {
    CHECK_THROWS_WITH_AS(table.set_friction(a, b, friction), message, Error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse("cork", "glass", {-0.5, 0},
         "friction of cork and glass: static: expected a number from 0 to 1e+06, got -0.5");
  refuse("cork", "glass", {nan, 0},
         "friction of cork and glass: static: expected a number from 0 to 1e+06, got nan");
  refuse("cork", "glass", {1e300, 0.5},
         "friction of cork and glass: static: expected a number from 0 to 1e+06, got 1e+300");
  refuse("cork", "glass", {0.5, -1},
         "friction of cork and glass: kinetic: expected a number from 0 to 1e+06, got -1");
  refuse("cork", "glass", {0.5, 0.6}, "friction of cork and glass: kinetic 0.6 exceeds static 0.5");
  refuse("", "glass", {0.5, 0.4}, "friction of '' and 'glass': a material needs a name");
  CHECK(table.names().size() == 7);
  CHECK_THROWS_WITH_AS(
      table.index("rubbr"),
      "no material 'rubbr', expected one of frictionless, glass, metal, plastic, wood, "
      "rubber, stone; did you mean 'rubber'?",
      Error);
}

TEST_CASE("a table holds a limited number of materials") {
  MaterialTable table;
  const auto add = [&] {
    for (int i = 0; i < 500; ++i) table.set_friction("wood", fmt::format("m{}", i), {});
  };
  CHECK_THROWS_WITH_AS(add(), "material 'm493': expected at most 500 materials", Error);
}

TEST_CASE(
    "materials with a single coefficient combine with each other and with the standard ones") {
  MaterialTable table;
  const OwnFriction low{.mu = 0.05}, high{.mu = 0.9}, first{.mu = 0.2, .priority = 1},
      smooth{.mu = 0.3, .frictionless = true};
  for (const OwnFriction& own : {low, high, first, smooth, low}) table.add(own);
  CHECK(table.names().size() == 7 + 4);
  const auto mu = [&](const std::string& a, const std::string& b) {
    return table.friction(table.index(a), table.index(b)).statics;
  };
  const auto name = [](const OwnFriction& own) { return material_name(own); };
  CHECK(mu(name(low), name(low)) == 0.05);
  CHECK(mu(name(low), name(high)) == 0.9);
  CHECK(mu(name(first), name(high)) == 0.2);
  CHECK(mu(name(smooth), name(smooth)) == 0);
  CHECK(mu(name(smooth), name(low)) == 0.3);
  // the larger of the two coefficients
  CHECK(mu(name(low), "plastic") == 0.3);
  CHECK(mu(name(high), "plastic") == 0.9);
  CHECK(mu(name(high), "frictionless") == 0);
  CHECK(mu(name(smooth), "glass") == 0.2);
  CHECK(table.friction(table.index(name(low)), table.index("plastic")).kinetic == 0.3 - 0.1);
  // explicitly set coefficients are kept
  table.set_friction(name(low), name(high), {0.4, 0.4});
  table.add(low);
  CHECK(mu(name(low), name(high)) == 0.4);
  CHECK_THROWS_WITH_AS(table.add({.mu = -1}),
                       "friction -1: friction: expected a number from 0 to 1e+06, got -1", Error);
}
