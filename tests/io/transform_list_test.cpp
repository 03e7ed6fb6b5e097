#include "clench/io/graspit/transform_list.h"

#include <numbers>

#include "clench/io/graspit/transform_tags.h"
#include "support/listening.h"

using namespace clench;

static Pose list(const std::string& text) {
  LineReader lines("x.cfg", text);
  return read_transform_list(lines);
}

static Pose tags(const std::string& text) {
  LineReader lines("x.wld", text);
  const Line first = lines.next();
  return read_tagged_transform(first, lines);
}

// angles in degrees and six digits of pi differ only by rounding
static bool same(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() < 1e-12 && (a.matrix() - b.matrix()).norm() < 1e-12;
}

static const double right = std::numbers::pi / 2;
static const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                             z = Eigen::Vector3d::UnitZ();

TEST_CASE("entries compose left to right, each in the frame reached so far") {
  CHECK(same(list("t 1 2 3\n"), Pose::translation({0.001, 0.002, 0.003})));
  CHECK(same(list("r 90 z\n"), Pose::turn(right, z)));
  CHECK(same(list("rr 0.5 Y\n"), Pose::turn(0.5, y)));
  CHECK(same(list("r 90 z\nt 10 0 0\n"), Pose::turn(right, z) * Pose::translation({0.01, 0, 0})));
  CHECK(same(list("t 10 0 0\nr 180 y\nr -90 x\n"),
             Pose::translation({0.01, 0, 0}) * Pose::turn(2 * right, y) * Pose::turn(-right, x)));
  CHECK(same(list(""), Pose()));
}

TEST_CASE("a full transform is a quaternion w x y z, made unit, and a position") {
  CHECK(same(list("T (+1 0 0 0)[+1 -2 3]"), Pose::translation({0.001, -0.002, 0.003})));
  CHECK(same(list("T(0 0 0 2)[0,0,0]"), Pose::turn(2 * right, z)));
  CHECK(list("T (0.5457 0.8332 0.0364 0.0818)[0 0 0]").rotation.norm() ==
        doctest::Approx(1).epsilon(1e-15));
}

TEST_CASE(
    "a quaternion of six digits is scaled in silence, one that is far from unit with a warning") {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& sentence) { warnings.push_back(sentence); };
  LineReader lines("x.cfg", "T (0.707107 0.707107 0 0)[0 0 0]\nT (2 0 0 0)[0 0 0]");
  CHECK(same(read_transform_list(lines, test::Listening{.warn = warn}),
             Pose::turn(right, Eigen::Vector3d::UnitX())));
  CHECK(warnings == std::vector<std::string>{
                        "x.cfg:2: the quaternion (2 0 0 0) is not of length 1; it is normalized"});
}

TEST_CASE("a unit quaternion with all its digits is kept to the bit") {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()));
  const Pose X = list(fmt::format("T ({} {} {} {})[0 0 0]", q.w(), q.x(), q.y(), q.z()));
  CHECK(X.rotation.coeffs() == q.coeffs());
}

TEST_CASE("the first three numbers of a rotation matrix are the image of the x axis") {
  const Pose X = list("t 0 0 5\nR\n0 1 0\n-1 0 0\n0 0 1\nd0 0 0 0");
  CHECK(same(X, Pose::translation({0, 0, 0.005}) * Pose::turn(right, z)));
  CHECK(same(list("R 0 1 0 -1 0 0 0 0 1"), Pose::turn(right, z)));
}

TEST_CASE("a comment behind an entry changes nothing, surplus words give a warning") {
  const Pose X = Pose::translation({0.001, 0.002, 0.003});
  CHECK(same(list("T (1 0 0 0)[1 2 3] # (0 0 0 0)[9]"), X));
  CHECK(same(list("R # x y z\n0 1 0 # x\n-1 0 0\n0 0 1 # z"), Pose::turn(right, z)));
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& sentence) { warnings.push_back(sentence); };
  LineReader lines("x.cfg", "t 1 2 3 # 4\nt 0 0 0 9 9\nr 0 x 9\nR\n1 0 0 0 1 0\n0 0 1 5\n");
  CHECK(same(read_transform_list(lines, test::Listening{.warn = warn}), X));
  CHECK(warnings == std::vector<std::string>{"x.cfg:2: 2 surplus words are not used",
                                             "x.cfg:3: 1 surplus word is not used",
                                             "x.cfg:6: 1 surplus word is not used"});
}

TEST_CASE("the list ends at the first line that is no transform") {
  LineReader lines("x.cfg", "# base\nt 1 0 0\n\n# turn\nr 90 z\nd0 0 0 0\n");
  read_transform_list(lines);
  CHECK(lines.next().word(0) == "d0");
}

TEST_CASE("transforms in tags mean what the lines mean") {
  CHECK(same(tags("<transform><fullTransform>(+1 0 0 0)[+1 2 3]</fullTransform></transform>"),
             Pose::translation({0.001, 0.002, 0.003})));
  CHECK(same(tags("<fullTransform>(1 0 0 0)[1 2 3]</fullTransform>"),
             Pose::translation({0.001, 0.002, 0.003})));
  CHECK(same(tags("<transform>\n  <translation>10 0 0</translation>\n  <rotation>90 "
                  "z</rotation>\n</transform>"),
             list("t 10 0 0\nr 90 z")));
  CHECK(same(tags("<rotationMatrix>0 1 0 -1 0 0 0 0 1</rotationMatrix>"), Pose::turn(right, z)));
  CHECK(same(tags("<transform></transform>"), Pose()));
}

TEST_CASE("a wrong number within tags is told by place") {
  CHECK_THROWS_WITH_AS(tags("<transform><translation>1 2 x</translation></transform>"),
                       "x.wld:1: translation z: expected a number, got 'x'", Error);
}
