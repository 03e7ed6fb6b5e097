// Guesses of how hands approach, compared with files that specify it, and of how fast they close.
#include <map>

#include "clench/io/read/read.h"
#include "clench/io/tree/closing_choice.h"
#include "clench/spec/approach_guess.h"
#include "support/cases.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using Eigen::Vector3d;

namespace {

// DOFs of the joints on each link, and the link's parent
struct PacedLink {
  int parent;
  std::vector<int> dofs;
};

std::vector<double> paces(const std::vector<PacedLink>& rows, std::vector<double> velocities) {
  RobotSpec robot;
  robot.dofs.resize(velocities.size());
  for (size_t d = 0; d < velocities.size(); ++d) robot.dofs[d].default_velocity = velocities[d];
  for (const PacedLink& row : rows) {
    LinkSpec& link = robot.links.emplace_back();
    link.parent = row.parent;
    for (const int dof : row.dofs) link.joints.push_back({.dof = dof});
  }
  slow_distal_joints(robot);
  for (size_t d = 0; d < velocities.size(); ++d) velocities[d] = robot.dofs[d].default_velocity;
  return velocities;
}

}  // namespace

TEST_CASE("the approach of our hands is guessed as their files say it") {
  struct Hand {
    const char* file;
    double beside;  // from the guessed approach line [m]
  };
  // With 60 random approaches of a cube, a ball and a can, 57 along the file's line and 57 along
  // the guessed line end in force closure with the DLR hand, and 6 and 8 to 34 with Robonaut's
  // hand, within 10 mm: the lines are on wide plateaus.
  for (const Hand& hand : {Hand{"barrett/barrett.cfg", 0.015},
                           {"dlr/dlr.cfg", 0.05},
                           {"human/human16.cfg", 0.015},
                           {"human/human20.cfg", 0.015},
                           {"parallel_jaw/parallel_jaw.cfg", 0.002},
                           {"robonaut/robonaut.cfg", 0.03},
                           {"shadow/shadow.cfg", 0.016},
                           {"three_finger/three_finger.cfg", 0.015},
                           {"adaptive_gripper/adaptive_gripper.cfg", 0.002},
                           {"tendon_gripper/tendon_gripper.cfg", 0.002}}) {
    CAPTURE(hand.file);
    const RobotSpec robot = read_robot(std::filesystem::path("models/hands") / hand.file, {});
    const auto guess = guess_approach(robot);
    REQUIRE(guess);
    REQUIRE(robot.X_BA);
    const Vector3d z = robot.X_BA->rotation * Vector3d::UnitZ();
    CHECK(z.dot(guess->rotation * Vector3d::UnitZ()) > std::cos(0.26));  // 15 degrees
    const Vector3d way = guess->position - robot.X_BA->position;
    CHECK((way - way.dot(z) * z).norm() < hand.beside);
    // the approach point of files is in front of the palm
    CHECK(way.dot(z) > 0);
  }
}

TEST_CASE("joints behind another that closes close half as fast, each finger by itself") {
  // a finger of three joints, one of two on a single link, a slide with a jaw
  CHECK(paces({{-1, {0}}, {0, {1}}, {1, {2}}, {-1, {3, 4}}, {-1, {5}}, {4, {6}}},
              {1, -1, 1, -1, 1, 0.05, -1}) ==
        std::vector<double>{1, -0.5, 0.5, -1, 0.5, 0.05, -0.5});
}

TEST_CASE("a joint that does not close makes none behind it slower") {
  CHECK(paces({{-1, {0}}, {0, {1}}, {1, {2}}}, {0, 1, -1}) == std::vector<double>{0, 1, -0.5});
}

TEST_CASE("a DOF of several joints is slowed when all of them stand behind others") {
  // joints of DOF 0 in sequence, as with tendons
  CHECK(paces({{-1, {0}}, {0, {0}}, {1, {0}}}, {1}) == std::vector<double>{1});
  // DOF 1 bends one finger at its root, another beyond DOF 0
  CHECK(paces({{-1, {0}}, {0, {1}}, {-1, {1}}}, {1, 1}) == std::vector<double>{1, 1});
  // a joint of DOF 0 beyond DOF 1 does not slow it down
  CHECK(paces({{-1, {0}}, {0, {1}}, {1, {0}}}, {1, 1}) == std::vector<double>{1, 0.5});
}

TEST_CASE(
    "a hand whose file says nothing closes from the roots of its fingers, whichever way it is told "
    "to") {
  std::string links =
                  "<link name='palm'><collision><geometry><box size='0.1 0.1 "
                  "0.02'/></geometry></collision></link>",
              joints;
  for (const std::string side : {"a", "b"})
    for (const std::string part : {"1", "2"}) {
      const bool root = part == "1";
      links += "<link name='" + side + part +
               "'><collision><origin xyz='0 0 0.02'/><geometry><box size='0.01 0.01 "
               "0.04'/></geometry></collision></link>";
      joints += "<joint name='j" + side + part + "' type='revolute'><parent link='" +
                (root ? "palm" : side + "1") + "'/><child link='" + side + part +
                "'/><origin xyz='" +
                (!root         ? "0 0"
                 : side == "a" ? "0.04 0"
                               : "-0.04 0") +
                " 0.04'/><axis xyz='0 1 0'/><limit lower='-1.2' upper='1.2' effort='1' "
                "velocity='1'/></joint>";
    }
  TemporaryFolder folder;
  const auto file = folder.write("claw.urdf", "<robot name='claw'>" + links + joints + "</robot>");
  const auto velocities = [&](const ReadOptions& options) {
    std::map<std::string, double> out;
    for (const DofSpec& dof : read_robot(file, options).dofs) out[dof.name] = dof.default_velocity;
    return out;
  };
  // the finger at +x turns to -x to close
  const auto guessed = velocities({});
  CHECK(guessed.at("ja1") == -1);
  CHECK(guessed.at("ja2") == -0.5);
  CHECK(guessed.at("jb1") == 1);
  CHECK(guessed.at("jb2") == 0.5);
  // options of a script take precedence
  ReadOptions options;
  options.closing = {{"ja1", 0}, {"jb2", -1}};
  const auto chosen = velocities(options);
  CHECK(chosen.at("ja1") == 0);
  CHECK(chosen.at("ja2") == -1);
  CHECK(chosen.at("jb2") == -0.5);
}
