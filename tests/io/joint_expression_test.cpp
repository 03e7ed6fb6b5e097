#include "clench/io/text/joint_expression.h"

using namespace clench;

static void check(const char* text, int dof, double ratio, double offset) {
  INFO(text);
  const auto e = parse_joint_expression(text);
  REQUIRE(e);
  CHECK(e->dof == dof);
  CHECK(e->ratio == ratio);
  CHECK(e->offset == offset);
}

TEST_CASE("a joint expression is a DOF, a ratio and an offset") {
  check("d0", 0, 1, 0);
  check("d12", 12, 1, 0);
  check("d0+90", 0, 1, 90);
  check("d4+-5.9", 4, 1, -5.9);
  check("d4-5.9", 4, 1, -5.9);
  check("d1*0.333333333+40", 1, 0.333333333, 40);
  check("d4*-1+-10", 4, -1, -10);
  check("d4*-1-10", 4, -1, -10);
  check("d4*.5", 4, 0.5, 0);
  check("d4*+2+1", 4, 2, 1);
  check("d4*1e-1+1", 4, 0.1, 1);
  check("d4+1e2", 4, 1, 100);
}

TEST_CASE("anything else is none") {
  for (const auto* bad : {"",         "d",      "0",     "x0",     "d-1",    "d0+",
                          "d0*",      "d0*+",   "d0*x",  "d0+x",   "d0 +1",  "d0++1",
                          "d0+--1",   "d0*2*3", "d0nan", "d0*nan", "d0+inf", "d99999999999",
                          "d0+1e999", "d0-",    "d0-+1", "d0/2"})
    CHECK_MESSAGE(!parse_joint_expression(bad), bad);
}
