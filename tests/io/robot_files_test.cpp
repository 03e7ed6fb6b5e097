#include "clench/io/graspit/robot_files.h"

#include "clench/base/error.h"
#include "support/listening.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

namespace {

/// A hand with one DOF and one link, whose file names others.
class Hand {
 public:
  Hand() { folder.write("iv/box.iv", "#Inventor V2.1 ascii\nCube { }\n"); }
  RobotSpec read(const std::string& rest, const ReadOptions& options = {}) {
    return read_robot(folder.write("hand.cfg",
                                   "Hand\nbox.iv\n1\nr 1 5e9 1e9 1e7 20\n1\n1\n1\nd0 0 10 0 0 "
                                   "90\nRevolute\nbox.iv\n" +
                                       rest),
                      options);
  }
  TemporaryFolder folder;
};

const std::string eigengrasp_text = "DIMENSIONS 1\nEG\n0.5\n2\n";
const std::string sites = "hand\n1\n0 0\n0\n0 0 0\n1 0 0 0\n0 0 0\n0 0 1\n0.5\n";

}  // namespace

TEST_CASE("the files that a robot's file names are read with it") {
  Hand hand;
  hand.folder.write("eigen/a.egr", eigengrasp_text);
  hand.folder.write("a.vgr", sites);
  hand.folder.write("glove.txt", "1 2\n1 2\n3\n");
  const auto robot =
      hand.read("EigenGrasps\neigen/a.egr\nVirtualContacts\na.vgr\nCyberGlove\nglove.txt\n");
  REQUIRE(robot.eigengrasps);
  CHECK(robot.eigengrasps->grasps[0].vector[0] == 2);
  CHECK(robot.files.eigengrasps.ends_with("eigen/a.egr"));
  REQUIRE(robot.virtual_contacts);
  CHECK(robot.virtual_contacts->at(0).mu == 0.5);
  REQUIRE(robot.glove);
  CHECK(robot.glove->slopes(0, 1) == 2);
}

TEST_CASE("a malformed file that a robot names is an error at both places") {
  Hand hand;
  hand.folder.write("a.egr", "DIMENSIONS 1\nEG\nx\n2\n");
  CHECK_THROWS_WITH_AS(hand.read("EigenGrasps\na.egr\n"),
                       "hand.cfg:12: EigenGrasps: a.egr:3: eigengrasp 1: eigenvalue: expected a "
                       "number, got 'x'",
                       Error);
}

TEST_CASE("files that do not fit the robot are refused") {
  Hand hand;
  hand.folder.write("a.egr", "DIMENSIONS 2\nEG\n0.5\n2 1\n");
  CHECK_THROWS_WITH_AS(
      hand.read("EigenGrasps\na.egr\n"),
      "hand.cfg:12: EigenGrasps: eigengrasps of 2 DOFs do not fit 'hand', which has 1", Error);
  hand.folder.write("a.vgr", "hand\n1\n3 0" + sites.substr(10));
  CHECK_THROWS_WITH_AS(hand.read("VirtualContacts\na.vgr\n"),
                       "hand.cfg:12: VirtualContacts: contact 1: 'hand' has no chain 3", Error);
  hand.folder.write("a.vgr", "hand\n1\n0 7" + sites.substr(10));
  CHECK_THROWS_WITH_AS(hand.read("VirtualContacts\na.vgr\n"),
                       "hand.cfg:12: VirtualContacts: contact 1: chain 0 of 'hand' has no link 7",
                       Error);
  hand.folder.write("g.txt", "2 1\n1\n1\n0 0\n");
  CHECK_THROWS_WITH_AS(hand.read("CyberGlove\ng.txt\n"),
                       "hand.cfg:12: CyberGlove: a glove's calibration for 2 DOFs does not fit "
                       "'hand', which has 1",
                       Error);
}

TEST_CASE("the files that the options choose replace the robot's own, and must exist") {
  Hand hand;
  hand.folder.write("a.egr", eigengrasp_text);
  const auto chosen = hand.folder.write("b.egr", "DIMENSIONS 1\nEG\n0.5\n3\n");
  ReadOptions options;
  options.eigengrasps = chosen.string();
  const auto robot = hand.read("EigenGrasps\na.egr\n", options);
  CHECK(robot.eigengrasps->grasps[0].vector[0] == 3);
  CHECK(robot.files.eigengrasps == chosen.generic_string());
  options.eigengrasps = (hand.folder.path() / "c.egr").string();
  CHECK_THROWS_AS(hand.read("", options), Error);
  options.eigengrasps = hand.folder.write("d.egr", "DIMENSIONS 2\nEG\n0.5\n2 1\n").string();
  CHECK_THROWS_WITH_AS(hand.read("", options),
                       "d.egr: eigengrasps of 2 DOFs do not fit 'hand', which has 1", Error);
}

TEST_CASE("names are looked up in the folder of the options when the file lies elsewhere") {
  Hand hand;
  hand.folder.write("a.egr", eigengrasp_text);
  TemporaryFolder elsewhere;
  const auto copy = elsewhere.write("cut.cfg",
                                    "Hand\nbox.iv\n1\nr 1 5e9 1e9 1e7 20\n1\n1\n1\nd0 0 10 0 0 "
                                    "90\nRevolute\nbox.iv\nEigenGrasps\n"
                                    "a.egr\n");
  CHECK_THROWS_AS(read_robot(copy), Error);
  ReadOptions options;
  options.folder = hand.folder.path();
  const auto robot = read_robot(copy, options);
  CHECK(robot.base.shape);
  CHECK(robot.eigengrasps);
}

TEST_CASE("contacts made for another hand are used, and noted") {
  Hand hand;
  hand.folder.write("a.vgr", "other" + sites.substr(4));
  std::vector<std::string> notes;
  ReadOptions options;
  options.diagnostics =
      Listening{.note = [&](const std::string& sentence) { notes.push_back(sentence); }};
  CHECK(hand.read("VirtualContacts\na.vgr\n", options).virtual_contacts->size() == 1);
  REQUIRE(!notes.empty());
  CHECK(std::ranges::count_if(notes, [](const std::string& note) {
          return note.ends_with("a.vgr: virtual contacts made for 'other' are used for 'hand'");
        }) == 1);
}

TEST_CASE("the hands of the original come with what their files name") {
  REQUIRE_SHARED();
  const auto root = shared() / "data/graspit/models/robots";
  const auto human = read_robot(root / "HumanHand/HumanHand20DOF.cfg");
  CHECK(human.eigengrasps->grasps.size() == 2);
  CHECK(human.virtual_contacts->size() == 18);
  CHECK(human.glove->slopes.cols() == 24);
  CHECK(human.tracker->number == 1);
  CHECK(read_robot(root / "Barrett/Barrett.cfg").virtual_contacts->size() == 19);
}
