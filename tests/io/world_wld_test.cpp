#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

/// A world in a folder with a box, a hand with a rigid and a breakaway DOF, and a robot without
/// DOFs.
static WorldSpec wld_world_of(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  const std::string box = "#Inventor V2.1 ascii\n#material rubber\nCube { }\n";
  folder.write("models/box.iv", box);
  folder.write("models/robots/iv/box.iv", box);
  folder.write("models/robots/hand.cfg",
               "Hand\nbox.iv\n3\nr 1 1e9 1e9 1e7 20\nb 1 1e9 1e9 1e7 20 0.5\nc 1 1e9 1e9 1e7 "
               "20\n1\n5\n1\nt 0 0 0\n0 d0 10 0 -10 90\n"
               "d1 0 10 0 -10 90\nd1*0.5 0 10 0 -10 90\nd2 0 10 0 -10 90\nd2 0 10 0 -10 "
               "90\nRevolute\nbox.iv 4\n");
  folder.write("models/robots/bare.cfg", "Robot\nbox.iv\n0\n0\n");
  return read_world(folder.write("worlds/w.wld", text), options);
}

static const std::string head = "#GraspIt! version 2.0 beta\n";
static const std::string stay = "T (+1 0 0 0)[0 0 0]\n";
static const std::string hand = "Robot\nmodels/robots/hand.cfg\n0 0 0 0 0\n" + stay;
static const std::string bare = "Robot\nmodels/robots/bare.cfg\n\n" + stay;

TEST_CASE("bodies stand where their blocks say, in the file's order") {
  const WorldSpec w =
      wld_world_of(head + "Obstacle\nmodels/box.iv\nwood\nT (+1 0 0 0)[+1 -2 3]\n\n" + hand +
                   "\nGraspableBody\nmodels/box.iv\nT (0 0 0 2)[0 0 0]\n");
  REQUIRE(w.bodies.size() == 2);
  CHECK(w.bodies[0].role == Role::obstacle);
  CHECK(w.bodies[0].body.name == "box");
  CHECK(w.bodies[0].body.source == "models/box.iv");
  CHECK((w.bodies[0].X_WB.position - Eigen::Vector3d(0.001, -0.002, 0.003)).norm() < 1e-15);
  CHECK(w.bodies[1].role == Role::object);
  CHECK(w.bodies[1].X_WB.rotation.z() == 1);
  CHECK(w.bodies[0].body.shape == w.bodies[1].body.shape);
  REQUIRE(w.order.size() == 3);
  CHECK(w.order[1].kind == WorldEntry::Kind::robot);
  CHECK(w.order[2].index == 1);
  CHECK_FALSE(w.camera);
}

TEST_CASE("an obstacle's material is the block's, or the file's where the block has none") {
  const WorldSpec w = wld_world_of(head + "Obstacle\nmodels/box.iv\nglass\n" + stay +
                                   "Obstacle\nmodels/box.iv\n" + stay);
  CHECK(w.bodies[0].body.material == "glass");
  CHECK(w.bodies[1].body.material == "rubber");
}

TEST_CASE("DOF values are written by kind: breakaway ones with the state of each joint") {
  const WorldSpec w =
      wld_world_of(head + "Robot\nmodels/robots/hand.cfg\n+5 +0.9 0 1 +0.25 -0.5 \n" + stay);
  const PlacedRobot& r = w.robots[0];
  REQUIRE(r.dofs.size() == 3);
  CHECK(r.dofs[0] == doctest::Approx(0.005));  // it slides: mm
  CHECK(r.dofs[1] == 0.9);
  CHECK(r.dofs[2] == -0.5);
  REQUIRE(r.joint_positions.size() == 5);
  CHECK_FALSE(r.joint_positions[1]);
  CHECK(r.joint_positions[2] == 0.125);  // 0.25 of the DOF, ratio 0.5
  CHECK_FALSE(r.joint_positions[3]);
}

TEST_CASE("a broken-away joint is written as the value of its DOF, and kept as its own") {
  const TemporaryFolder folder;
  const std::string box = "#Inventor V2.1 ascii\nCube { }\n";
  folder.write("iv/box.iv", box);
  folder.write("hand.cfg",
               "Hand\nbox.iv\n2\nb 1 1e9 1e9 1e7 20 0.5\nb 1 1e9 1e9 1e7 20 0.5\n1\n4\n1\nt 0 0 "
               "0\nd0 0 10 0 -10 90\nd0*0.333333333333 0 10 0 -10 90\n0 d1 10 0 -10 90\n"
               "0 d1*2 10 0 -10 90\nRevolute\nbox.iv 3\n");
  const auto file =
      folder.write("w.wld", head + "Robot\nhand.cfg\n+0.9 0 1 0.9 5 0 1 6 # broken away\n" + stay);
  const PlacedRobot r = read_world(file).robots[0];
  CHECK(r.dofs[0] == 0.9);
  CHECK_FALSE(r.joint_positions[0]);
  CHECK(*r.joint_positions[1] == doctest::Approx(0.3));
  CHECK_FALSE(r.joint_positions[2]);
  CHECK(*r.joint_positions[3] == doctest::Approx(0.012));  // 6 mm of the DOF are 12 of the joint
}

TEST_CASE("surplus words in a world are not used, with a warning") {
  Warnings warnings;
  wld_world_of(head + "Camera\n0 0 0 0 0 0 1 8 9 10\n" + hand + bare +
                   "Connection\n0 0 1 # two\n\n" + "T (1 0 0 0)[0 0 0] # at the wrist\n",
               warnings.options());
  CHECK(warnings.list == std::vector<std::string>{"w.wld:3: 3 surplus words are not used"});
}

TEST_CASE("one value per DOF is enough") {
  const WorldSpec w = wld_world_of(head + "Robot\nmodels/robots/hand.cfg\n1 2 3\n" + stay);
  CHECK(w.robots[0].dofs[1] == 2);
  CHECK(w.robots[0].dofs[2] == 3);
}

TEST_CASE("a robot without DOFs has an empty line for them, or none") {
  CHECK(wld_world_of(head + bare).robots.size() == 1);
  CHECK(wld_world_of(head + "Robot\nmodels/robots/bare.cfg\n" + stay).robots.size() == 1);
}

TEST_CASE(
    "a connection may come before its robots, and its mount may be an empty line or missing") {
  const std::string move = "T (+1 0 0 0)[0 0 +175.05]\n";
  for (const std::string mount : {"\n", "", "models/box.iv\n"}) {
    const WorldSpec w =
        wld_world_of(head + "Connection\n+0 +0 +1 \n" + mount + move + "\n" + hand + "\n" + bare);
    REQUIRE(w.connections.size() == 1);
    const Connection& c = w.connections[0];
    CHECK(c.parent == 0);
    CHECK(c.link == 0);
    CHECK(c.child == 1);
    CHECK(c.X_LB.position.z() == doctest::Approx(0.17505));
    CHECK(c.mount.has_value() == (mount.size() > 1));
  }
}

TEST_CASE("a camera's quaternion is x y z w, its place and focal distance millimeters") {
  const WorldSpec full = wld_world_of(head + "CameraFull\n+500 0 -1 0 0 1 0 +501\n");
  REQUIRE(full.camera);
  CHECK(full.camera->X_WC.rotation.z() == 1);
  CHECK(full.camera->X_WC.position.x() == doctest::Approx(0.5));
  CHECK(full.camera->focal_distance == doctest::Approx(0.501));
  const WorldSpec plain = wld_world_of(head + "Camera\n0 0 0 0 0 0 1\n");
  CHECK(plain.camera->X_WC.rotation.w() == 1);
  CHECK(plain.camera->focal_distance == doctest::Approx(0.1));
}

TEST_CASE("line ends, trailing blanks, comments and tagged transforms are tolerated") {
  const WorldSpec w = wld_world_of(
      "#GraspIt! version 2.0\r\n# a comment\r\nGraspableBody  \r\nmodels\\BOX.iv "
      "\r\n<transform>\r\n"
      "<fullTransform>(+1 +0 +0 +0)[+1 +0 "
      "+0]</fullTransform>\r\n</transform>\r\n\r\nObstacle\r\nmodels/box.iv\r\nwood \r\n(1 0 0 "
      "0)[0 0 0]\r\n");
  CHECK(w.bodies.size() == 2);
  CHECK(w.bodies[0].X_WB.position.x() == doctest::Approx(0.001));
}

TEST_CASE("a world without its first line is read, with a warning") {
  Warnings warnings;
  CHECK(wld_world_of("GraspableBody\nmodels/box.iv\n" + stay, warnings.options()).bodies.size() ==
        1);
  CHECK(warnings.list ==
        std::vector<std::string>{"w.wld:1: the first line '#GraspIt! version ...' is missing"});
}

TEST_CASE("an empty world is a world") { CHECK(wld_world_of(head).order.empty()); }

TEST_CASE("the test worlds of two fingers are read") {
  const WorldSpec w = read_world("tests/data/two_finger/claw.wld");
  CHECK(w.robots[0].joint_positions[1] == 0.01);  // 0.02 of the DOF, ratio 0.5
  CHECK(w.bodies[0].role == Role::obstacle);
  CHECK(read_world("tests/data/two_finger/pinch.wld").camera);
}
