// What is guessed of hands whose files say how they approach.
#include "clench/io/read.h"
#include "clench/spec/approach_guess.h"
#include "support/cases.h"

using namespace clench;
using Eigen::Vector3d;

TEST_CASE("the approach of our hands is guessed as their files say it") {
  struct Hand {
    const char* file;
    double beside;  // of the guessed line of approach [m]
  };
  // Of 60 random approaches of a cube, a ball and a can along the file's line and along the guessed one, in force closure
  // end 57 and 57 of the DLR hand, 6 and 8 to 34 of Robonaut's, within 10 mm: their lines lie on wide plateaus.
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
    // what is held stands before the palm, where files have the point
    CHECK(way.dot(z) > 0);
  }
}
