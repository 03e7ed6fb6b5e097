#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "support/listening.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

/// A library with a box and a hand of one joint, and a world in a separate folder.
static void write_library(const TemporaryFolder& folder) {
  folder.write("models/box.iv", "#Inventor V2.1 ascii\n#material rubber\nCube { }\n");
  folder.write("models/robots/iv/box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  folder.write("models/robots/hand.cfg",
               "Hand\nbox.iv\n1\nb 1 1e9 1e9 1e7 20 0.5\n1\n1\n1\nt 0 0 0\nd0 0 10 0 -10 "
               "90\nRevolute\nbox.iv 0\n");
}

static WorldSpec xml_world_of(const std::string& inside, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  write_library(folder);
  return read_world(
      folder.write("worlds/w.xml", "<?xml version=\"1.0\" ?>\n<world>\n" + inside + "</world>\n"),
      options);
}

static const std::string unmoved =
    "<transform><fullTransform>(+1 0 0 0)[0 0 0]</fullTransform></transform>\n";

TEST_CASE("bodies, robots, connections and the camera are read in the file's order") {
  const WorldSpec w = xml_world_of(
      "<obstacle><filename>models\\BOX.iv</filename><transform><translation>1 -2 "
      "3</translation></transform></obstacle>\n<robot><filename>models/robots/hand.cfg</"
      "filename><dofValues>0.5 1 +0.2</dofValues>" +
      unmoved + "</robot>\n<graspableBody><filename>models/box.iv</filename>" + unmoved +
      "</graspableBody>\n<robot><filename>models/robots/hand.cfg</filename>" + unmoved +
      "</robot>\n<connection><parentRobot>0</parentRobot><parentChain>0</parentChain><childRobot>1"
      "</childRobot><mountFilename>models/box.iv</mountFilename><transform><translation>0 0 "
      "5</translation></transform></connection>\n<camera><position>500 0 -1</position><orientation>"
      "0 0 1 0</orientation><focalDistance>501</focalDistance></camera>\n");
  REQUIRE(w.order.size() == 4);
  CHECK(w.order[1].kind == WorldEntry::Kind::robot);
  CHECK(w.bodies[0].role == Role::obstacle);
  CHECK(w.bodies[0].body.material == "rubber");
  CHECK((w.bodies[0].X_WB.position - Eigen::Vector3d(0.001, -0.002, 0.003)).norm() < 1e-15);
  CHECK(w.bodies[1].role == Role::object);
  CHECK(w.bodies[0].body.shape == w.bodies[1].body.shape);
  CHECK(w.robots[0].dofs == std::vector<double>{0.5});
  CHECK(*w.robots[0].joint_positions[0] == 0.2);
  CHECK(w.robots[1].dofs.empty());
  REQUIRE(w.connections.size() == 1);
  CHECK(w.connections[0].child == 1);
  CHECK(w.connections[0].mount->name == "box");
  CHECK(w.connections[0].X_LB.position.z() == doctest::Approx(0.005));
  CHECK(w.camera->X_WC.rotation.z() == 1);
  CHECK(w.camera->X_WC.position.x() == doctest::Approx(0.5));
  CHECK(w.camera->focal_distance == doctest::Approx(0.501));
}

TEST_CASE("a body may stand in the world itself") {
  const WorldSpec w = xml_world_of(
      "<graspableBody><filename>unspecified</filename><body><material>glass</material><mass>50</"
      "mass><geometryFile>../models/box.iv</geometryFile></body>" +
      unmoved + "</graspableBody>\n");
  CHECK(w.bodies[0].body.material == "glass");
  CHECK(w.bodies[0].body.mass == doctest::Approx(0.05));
  CHECK(w.bodies[0].body.name == "box");
  CHECK(w.bodies[0].body.shape);
  CHECK(w.bodies[0].body.file.empty());
}

TEST_CASE("an unknown element is warned of, and what stands nowhere is at the origin") {
  Warnings warnings;
  std::vector<std::string> notes;
  ReadOptions options = warnings.options();
  options.diagnostics =
      test::Listening{.warn = [before = options.diagnostics](
                                  const std::string& text) { before.warn(Diagnostic(text)); },
                      .note = [&](const std::string& s) { notes.push_back(s); }};
  const WorldSpec w = xml_world_of(
      "<grspableBody/>\n<graspableBody><filename>models/box.iv</filename></graspableBody>\n"
      "<robot><filename>models/robots/hand.cfg</filename></robot>\n",
      options);
  CHECK(w.bodies[0].X_WB == Pose{});
  CHECK(warnings.list ==
        std::vector<std::string>{"w.xml:3: unknown element <grspableBody> in <world> is not used; "
                                 "did you mean 'graspableBody'?"});
  REQUIRE(notes.size() == 8);
  CHECK(notes[0] == "w.xml:4: graspableBody: no <transform>; it is placed at the origin");
  CHECK(notes[1] ==
        "hand.cfg: no mass and no material is given; 0.3 kg of wood is assumed: 'hand_base', "
        "'hand_chain0_link0'");
  CHECK(notes[4] == "w.xml:5: robot: no <dofValues>; its DOFs start at their defaults");
  CHECK(notes[5] == "w.xml:5: robot: no <transform>; it is placed at the origin");
  CHECK(notes[6] == "w.xml: no mass is given; 0.3 kg is assumed");
}

TEST_CASE("a name of another generation finds the file of this one, and a note says so") {
  const TemporaryFolder folder;
  write_library(folder);
  std::vector<std::string> notes;
  ReadOptions options;
  options.diagnostics = test::Listening{.note = [&](const std::string& s) { notes.push_back(s); }};
  const auto file = folder.write(
      "worlds/w.xml", "<world>\n<robot><filename>models/robots/hand.xml</filename>" + unmoved +
                          "</robot><graspableBody>\n<filename>models/box.xml</filename>" + unmoved +
                          "</graspableBody></world>");
  const WorldSpec w = read_world(file, options);
  CHECK(w.robots[0].robot.name == "hand");
  CHECK(w.bodies[0].body.name == "box");
  CHECK(notes[0] == "w.xml:2: there is no models/robots/hand.xml; hand.cfg is used instead");
  CHECK(std::ranges::count(notes, "w.xml:4: there is no models/box.xml; box.iv is used instead") ==
        1);
  // and in the other direction: text worlds find XML files
  folder.write("models/robots/iv/part.xml", "<root><geometryFile>box.iv</geometryFile></root>");
  folder.write("models/robots/claw.xml", "<robot type=\"Hand\"><palm>part.iv</palm></robot>");
  const auto text =
      folder.write("worlds/w.wld",
                   "#GraspIt! version 2.0\nRobot\nmodels/robots/claw.cfg\n\nT (1 0 0 0)[0 0 0]\n");
  CHECK(read_world(text).robots[0].robot.base.shape);
}

TEST_CASE("what the root does not hold is taken from its other generation, with a warning") {
  const TemporaryFolder folder;
  folder.write("Lib-old/models/box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  folder.write("lib2/models/none", "");
  const auto file =
      folder.write("lib2/worlds/w.xml", "<world>\n<obstacle><filename>models/box.xml</filename>" +
                                            unmoved + "</obstacle></world>");
  for (const bool rooted : {true, false}) {
    Warnings warnings;
    ReadOptions options = warnings.options();
    if (rooted) options.root = folder.path() / "lib2";
    CHECK(read_world(file, options).bodies[0].body.name == "box");
    CHECK(warnings.list ==
          std::vector<std::string>{"w.xml:2: models/box.xml is not below the root; " +
                                   (folder.path() / "Lib-old/models/box.iv").generic_string() +
                                   " is used instead"});
  }
}

TEST_CASE("what only a stranger beside the root holds is not found") {
  const TemporaryFolder folder;
  folder.write("other/models/box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  folder.write("library/models/box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  folder.write("models/box.iv", "#Inventor V2.1 ascii\nCube { }\n");
  folder.write("lib/models/none", "");
  folder.write("lib-old/models/none", "");
  const auto file =
      folder.write("lib/worlds/w.xml", "<world>\n<obstacle><filename>models/box.xml</filename>" +
                                           unmoved + "</obstacle></world>");
  for (const bool rooted : {true, false}) {
    ReadOptions options;
    if (rooted) options.root = folder.path() / "lib";
    CHECK_THROWS_WITH_AS(read_world(file, options), "w.xml:2: no such file: models/box.xml", Error);
  }
}

TEST_CASE("a text world and an XML world that say the same are the same") {
  const TemporaryFolder folder;
  write_library(folder);
  const std::string q = "(0.54570395 0.83318187 0.036364501 0.081808911)[0.1 191.479 +38.2417]";
  const WorldSpec text = read_world(
      folder.write("worlds/w.wld", "#GraspIt! version 2.0\nGraspableBody\nmodels/box.iv\nT " + q +
                                       "\n\nRobot\nmodels/robots/hand.cfg\n0.3 1 0.1\nT " + q +
                                       "\n\nCameraFull\n1 2 3 0 0.6 0.8 0 7\n"));
  const WorldSpec xml = read_world(folder.write(
      "worlds/w.xml",
      "<world><graspableBody><filename>models/box.iv</filename><transform><fullTransform>" + q +
          "</fullTransform></transform></graspableBody><robot><filename>models/robots/hand.cfg</"
          "filename><dofValues>0.3 1 0.1</dofValues><transform><fullTransform>" +
          q +
          "</fullTransform></transform></robot><camera><position>1 2 3</position><orientation>0 "
          "0.6 "
          "0.8 0</orientation><focalDistance>7</focalDistance></camera></world>"));
  CHECK(text.bodies[0].X_WB == xml.bodies[0].X_WB);
  CHECK(text.robots[0].X_WB == xml.robots[0].X_WB);
  CHECK(text.robots[0].dofs == xml.robots[0].dofs);
  CHECK(text.robots[0].joint_positions == xml.robots[0].joint_positions);
  CHECK(text.camera->X_WC == xml.camera->X_WC);
  CHECK(text.camera->focal_distance == xml.camera->focal_distance);
}
