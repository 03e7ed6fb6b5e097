#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

static BodySpec body_with(const std::string& comments, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_body(folder.write("box.iv", "#Inventor V2.1 ascii\n" + comments + "\nCube { }\n"),
                   options);
}

TEST_CASE("grams, millimeters and their squares become kilograms, meters and theirs") {
  const BodySpec b = body_with(
      "#material plastic\n#mass 178.5\n#cog 0 40.1 -1\n#inertia_matrix\n#1043 1 0\n# 1 611 0\n#0 0 "
      "1043\n#youngs 1.5e6\n#useFlockOfBirds 2");
  CHECK(b.material == "plastic");
  CHECK(b.mass == doctest::Approx(0.1785));
  REQUIRE(b.com);
  CHECK((*b.com - Eigen::Vector3d(0, 0.0401, -0.001)).norm() < 1e-15);
  REQUIRE(b.inertia_per_mass);
  CHECK((*b.inertia_per_mass)(0, 0) == doctest::Approx(1043e-6));
  CHECK((*b.inertia_per_mass)(0, 1) == doctest::Approx(1e-6));
  CHECK(b.elastic_modulus == 1.5e6);
  CHECK(b.tracker == 2);
}

TEST_CASE("nothing said leaves the defaults") {
  const BodySpec b = body_with("");
  CHECK(b.material == "wood");
  CHECK(b.mass == doctest::Approx(0.3));
  CHECK_FALSE(b.com);
  CHECK_FALSE(b.inertia_per_mass);
  CHECK_FALSE(b.elastic_modulus);
  CHECK_FALSE(b.tracker);
}

TEST_CASE("other comments are comments: another key, a blank after the '#', another case") {
  const BodySpec b = body_with(
      "##youngs 3\n# mass 5\n#Mass of the thing\n#massive 7\n#--youngs\n#inertia_tensor\n#");
  CHECK(b.mass == doctest::Approx(0.3));
  CHECK_FALSE(b.elastic_modulus);
}

TEST_CASE("an indented line is a comment, and a key in it is told") {
  Warnings warnings;
  const BodySpec b =
      body_with(" #mass 20\n\t#of 3 parts\n#mass 30\n  #cog 1 2 3\r\n", warnings.options());
  CHECK(b.mass == doctest::Approx(0.03));
  CHECK_FALSE(b.com);
  CHECK(warnings.list == std::vector<std::string>{
                             "box.iv:2: #mass is a comment, because it does not begin its line",
                             "box.iv:5: #cog is a comment, because it does not begin its line"});
}

TEST_CASE("the last of a key counts") {
  CHECK(body_with("#mass 5\n#mass 7").mass == doctest::Approx(0.007));
}

TEST_CASE("an inertia that is not symmetric is made so, with a warning") {
  Warnings warnings;
  const BodySpec b = body_with("#inertia_matrix\n#5 0 1\n#0 5 2\n#1 0 5", warnings.options());
  CHECK((*b.inertia_per_mass)(1, 2) == doctest::Approx(1e-6));
  CHECK((*b.inertia_per_mass)(2, 1) == doctest::Approx(1e-6));
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0] ==
        "box.iv:2: inertia_matrix is not symmetric; its symmetric part is used");
}

TEST_CASE("an inertia that no body has is left to the shape, with a warning") {
  for (const std::string rows : {"#0 0 0\n#0 0 0\n#0 0 0", "#5 0 0\n#0 -5 0\n#0 0 5",
                                 "#1 2 0\n#2 1 0\n#0 0 1", "#-1 0 0\n#0 -1 0\n#0 0 -1"}) {
    Warnings warnings;
    CHECK_FALSE(body_with("#inertia_matrix\n" + rows, warnings.options()).inertia_per_mass);
    CHECK(warnings.list ==
          std::vector<std::string>{"box.iv:2: inertia_matrix is not positive definite; it is "
                                   "computed from the shape"});
  }
}

TEST_CASE(
    "an inertia of which one moment exceeds the others' sum keeps it, and the others are raised") {
  Warnings warnings;
  const BodySpec b = body_with("#inertia_matrix\n#1 0 0\n#0 1 0\n#0 0 3", warnings.options());
  CHECK((*b.inertia_per_mass)(2, 2) == doctest::Approx(3e-6));
  CHECK(warnings.list ==
        std::vector<std::string>{"box.iv:2: impossible inertia, as one moment exceeds the sum of "
                                 "the others; these are increased to equal it"});
  CHECK((*b.inertia_per_mass)(0, 0) == doctest::Approx(1.5e-6));
}

TEST_CASE("a row of an inertia has three numbers") {
  CHECK_THROWS_WITH_AS(body_with("#inertia_matrix\n#5 0 0\n#0 5 0 7\n#0 0 5"),
                       "box.iv:4: inertia_matrix: expected 3 numbers in a row, got 4", Error);
  CHECK(body_with("#inertia_matrix\n#5 0 0 # x\n#0 5 0\n#0 0 5").inertia_per_mass);
}

TEST_CASE("a modulus that looks like megapascals is kept, with a warning") {
  Warnings warnings;
  CHECK(body_with("#youngs 1.5", warnings.options()).elastic_modulus == 1.5);
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0] ==
        "box.iv:2: youngs 1.5 Pa is softer than any rubber; is it meant in MPa?");
}
