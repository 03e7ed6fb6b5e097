#include "io/closing_guess.h"

#include <numbers>

#include "io/read.h"
#include "io/tree_shapes.h"
#include "support/shared.h"

using namespace clench;
namespace fs = std::filesystem;

namespace {

/// Robots in a few lines: a palm, and fingers of box-shaped links.
struct Sketch {
  TreeModel tree;

  explicit Sketch(const Eigen::Vector3d& palm = {0.08, 0.03, 0.08}) {
    add("palm", -1, {}, palm, {0, 0, 0});
  }
  int add(const std::string& name, int parent, const Pose& X_PL, const Eigen::Vector3d& size,
          const Eigen::Vector3d& centre) {
    TreeLink link;
    link.body.name = name;
    link.parent = parent;
    link.X_PL = X_PL;
    if (size.x() > 0) {
      Mesh mesh = box_mesh(size);
      for (auto& p : mesh.vertices) p += centre;
      link.body.shape = Shape::make(std::move(mesh));
    }
    tree.links.push_back(link);
    return static_cast<int>(tree.links.size()) - 1;
  }
  int joint(int link, const Eigen::Vector3d& axis, double min, double max,
            JointKind kind = JointKind::revolute) {
    TreeJoint joint;
    joint.name = tree.links[link].body.name + "_joint";
    joint.axis = axis;
    joint.min = min, joint.max = max;
    joint.start = std::clamp(0.0, min, max);
    joint.kind = kind;
    tree.joints.push_back(joint);
    tree.links[link].joints.push_back(static_cast<int>(tree.joints.size()) - 1);
    return static_cast<int>(tree.joints.size()) - 1;
  }
  /// A phalanx of 40 mm that turns about x: along +z of its frame, closing towards -y.
  int phalanx(int parent, const Pose& X_PL, double min = -0.2, double max = 1.6) {
    const int link = add("phalanx" + std::to_string(tree.links.size()), parent, X_PL,
                         {0.014, 0.014, 0.036}, {0, 0, 0.02});
    joint(link, {1, 0, 0}, min, max);
    return link;
  }
  Eigen::Vector3d approach(const ClosingGuess& guess) const {
    REQUIRE(guess.X_BA);
    return guess.X_BA->rotation * Eigen::Vector3d::UnitZ();
  }
};

const Pose up40 = Pose::translation({0, 0, 0.04});

/// A hand like a human one: palm in the xz plane, facing -y, three fingers up, a thumb in front.
Sketch human_like() {
  Sketch hand;
  for (const double x : {-0.03, 0.0, 0.03}) {
    const int knuckle = hand.add("knuckle" + std::to_string(hand.tree.links.size()), 0,
                                 Pose::translation({x, 0, 0.04}), {0, 0, 0}, {0, 0, 0});
    hand.joint(knuckle, {0, 1, 0}, -0.35, 0.35);
    const int first = hand.phalanx(knuckle, {});
    hand.phalanx(hand.phalanx(first, up40), up40);
  }
  // the thumb points to -y from the palm's lower edge, and closes upwards
  const Pose X_PT{
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX())),
      {0, -0.015, -0.03}};
  hand.phalanx(hand.phalanx(0, X_PT, -1.6, 0.2), up40, -1.6, 0.2);
  return hand;
}

}  // namespace

TEST_CASE("fingers and thumb of a hand close towards each other, swings and palm stay") {
  const Sketch hand = human_like();
  const ClosingGuess guess = guess_closing(hand.tree);
  for (size_t j = 0; j < hand.tree.joints.size(); ++j) {
    INFO(hand.tree.joints[j].name);
    if (hand.tree.joints[j].name.starts_with("knuckle"))
      CHECK(guess.senses[j] == 0);
    else if (j < 12)
      CHECK(guess.senses[j] == 1);
    else
      CHECK(guess.senses[j] == -1);
  }
  CHECK(hand.approach(guess).y() < -0.9);
}

TEST_CASE("the guess does not depend on where the hand stands, nor on the sense of its axes") {
  Sketch hand = human_like();
  // an arm before the palm, and every other axis turned round
  Sketch other({0.1, 0.1, 0.1});
  const int wrist =
      other.add("wrist", 0, Pose::translation({1, 2, 3}), {0.05, 0.05, 0.05}, {0, 0, 0});
  other.joint(wrist, {1, 0, 0}, -1, 1);
  const int count = static_cast<int>(other.tree.links.size());
  for (TreeLink link : hand.tree.links) {
    link.parent = link.parent < 0 ? wrist : link.parent + count;
    for (int& j : link.joints) j += 1;
    other.tree.links.push_back(link);
  }
  for (TreeJoint joint : hand.tree.joints) {
    if (other.tree.joints.size() % 2) {
      joint.axis = -joint.axis;
      std::swap(joint.min, joint.max);
      joint.min = -joint.min, joint.max = -joint.max;
    }
    other.tree.joints.push_back(joint);
  }
  const auto plain = guess_closing(hand.tree), turned = guess_closing(other.tree);
  CHECK(turned.senses[0] == 0);
  for (size_t j = 0; j < hand.tree.joints.size(); ++j)
    CHECK(turned.senses[j + 1] == ((j + 1) % 2 ? -1 : 1) * plain.senses[j]);
}

TEST_CASE(
    "a joint that rolls a straight thumb is judged with the thumb bent, alike in both hands") {
  const auto with_thumb = [](double side) {
    Sketch hand;
    for (const double x : {-0.03, 0.0, 0.03}) {
      const int first = hand.phalanx(0, Pose::translation({x, 0, 0.04}));
      hand.phalanx(hand.phalanx(first, up40), up40);
    }
    // the thumb points to -y; its first joint rolls it about itself
    const Pose X_PT{
        Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX())),
        {side * 0.06, -0.015, -0.03}};
    const int root = hand.add("thumb", 0, X_PT, {0, 0, 0}, {0, 0, 0});
    hand.joint(root, {0, 0, side}, -0.1, 1.2);
    hand.phalanx(hand.phalanx(root, {}, -1.6, 0.2), up40, -1.6, 0.2);
    return guess_closing(hand.tree).senses;
  };
  const auto right = with_thumb(1), left = with_thumb(-1);
  CHECK(right == left);
  CHECK(right[9] == 1);
  CHECK(right[10] == -1);
}

TEST_CASE("the left and the right hand of a maker close alike") {
  REQUIRE_SHARED();
  const fs::path folder = test::shared() / "data/hands-urdf";
  ReadOptions options;
  options.packages[""] = folder;
  for (const std::string name : {"allegro_hand/allegro_hand_", "shadow_hand/shadow_hand_"}) {
    const RobotSpec left = read_robot(folder / (name + "left.urdf"), options),
                    right = read_robot(folder / (name + "right.urdf"), options);
    REQUIRE(left.dofs.size() == right.dofs.size());
    for (size_t d = 0; d < left.dofs.size(); ++d) {
      INFO(name << left.dofs[d].name);
      CHECK(left.dofs[d].default_velocity == right.dofs[d].default_velocity);
    }
  }
}

TEST_CASE("a gripper closes whether it is drawn open or shut") {
  for (const double open : {0.0, 0.04}) {
    Sketch gripper;
    for (const double side : {1.0, -1.0}) {
      const int finger = gripper.add(side > 0 ? "left" : "right", 0,
                                     Pose::translation({side * (0.005 + open), 0, 0.04}),
                                     {0.01, 0.02, 0.06}, {0, 0, 0.03});
      // q from -open to 0.04 - open: the fingers stand open or shut at 0
      gripper.joint(finger, {side, 0, 0}, -open, 0.04 - open, JointKind::prismatic);
    }
    const auto guess = guess_closing(gripper.tree);
    CHECK(guess.senses == std::vector<double>{-1, -1});
    CHECK(gripper.approach(guess).z() > 0.99);
  }
}

TEST_CASE("one DOF that moves both jaws closes them") {
  Sketch gripper;
  for (const double side : {1.0, -1.0}) {
    const int jaw =
        gripper.add(side > 0 ? "left" : "right", 0, Pose::translation({side * 0.04, 0, 0.04}),
                    {0.01, 0.02, 0.06}, {0, 0, 0.03});
    gripper.joint(jaw, {0, 1, 0}, -0.8, 0.8);
  }
  gripper.tree.joints[0].min = -0.8, gripper.tree.joints[0].max = 0;
  gripper.tree.joints[1].leader = 0;
  gripper.tree.joints[1].ratio = -1;
  // the left jaw stands at +x: a negative turn about y brings its tip to the middle
  CHECK(guess_closing(gripper.tree).senses == std::vector<double>{-1, 0});
}

TEST_CASE("fingers that turn about the palm's normal do not close it") {
  // two fingers lie flat to +y, one to -y; all curl up to +z, two spread about z
  Sketch hand({0.09, 0.09, 0.02});
  std::vector<int> spreads;
  for (const double x : {-0.025, 0.025, 0.0}) {
    const bool fixed = x == 0;
    const Pose X_PF{Eigen::Quaterniond(Eigen::AngleAxisd(fixed ? std::numbers::pi : 0.0,
                                                         Eigen::Vector3d::UnitZ())),
                    {x, 0, 0.01}};
    int carrier = 0;
    Pose X = X_PF;
    if (!fixed) {
      carrier = hand.add("turret", 0, X_PF, {0.02, 0.02, 0.02}, {0, 0, 0});
      spreads.push_back(hand.joint(carrier, {0, 0, 1}, x > 0 ? -3.1 : 0, x > 0 ? 0 : 3.1));
      X = Pose{};
    }
    const int first = hand.add("first", carrier, X * Pose::translation({0, 0.04, 0.01}),
                               {0.015, 0.06, 0.015}, {0, 0.03, 0});
    hand.joint(first, {1, 0, 0}, 0, 2.4);
    const int second = hand.add("second", first, Pose::translation({0, 0.06, 0}),
                                {0.015, 0.05, 0.015}, {0, 0.025, 0});
    hand.joint(second, {1, 0, 0}, 0, 0.8);
  }
  const auto guess = guess_closing(hand.tree);
  for (size_t j = 0; j < hand.tree.joints.size(); ++j) {
    const bool spread =
        std::find(spreads.begin(), spreads.end(), static_cast<int>(j)) != spreads.end();
    CHECK(guess.senses[j] == (spread ? 0 : 1));
  }
  CHECK(hand.approach(guess).z() > 0.9);
}

TEST_CASE("an arm has no DOF that closes it, a single jaw has one") {
  Sketch arm;
  int link = 0;
  for (int i = 0; i < 6; ++i) link = arm.phalanx(link, up40, -3, 3);
  const auto none = guess_closing(arm.tree);
  CHECK(none.senses == std::vector<double>(6, 0));
  CHECK_FALSE(none.X_BA);

  Sketch clip({0.02, 0.02, 0.1});
  clip.phalanx(0, Pose::translation({0, 0.03, 0}), -0.2, 1.2);
  // the palm stands at -y of the jaw, which turns there about +x
  CHECK(guess_closing(clip.tree).senses == std::vector<double>{1});
}

TEST_CASE("a camera on an arm does not make its wrist a finger") {
  Sketch hand = human_like();
  TreeModel tree;
  TreeLink base, forearm, camera;
  base.body.name = "base";
  forearm.body.name = "forearm";
  forearm.body.shape = Shape::make(box_mesh({0.1, 0.1, 0.3}));
  forearm.parent = 0;
  forearm.joints = {0};
  camera.body.name = "camera";
  camera.body.shape = Shape::make(box_mesh({0.03, 0.03, 0.03}));
  camera.parent = 1;
  tree.links = {base, forearm, camera};
  TreeJoint elbow, wrist;
  elbow.name = "elbow", wrist.name = "wrist";
  elbow.min = wrist.min = -1, elbow.max = wrist.max = 1;
  tree.joints = {elbow, wrist};
  for (TreeLink link : hand.tree.links) {
    for (int& j : link.joints) j += 2;
    if (link.parent < 0)
      link.parent = 1, link.joints = {1};
    else
      link.parent += 3;
    tree.links.push_back(link);
  }
  for (const auto& joint : hand.tree.joints) tree.joints.push_back(joint);
  const auto plain = guess_closing(hand.tree), carried = guess_closing(tree);
  CHECK(carried.senses[0] == 0);
  CHECK(carried.senses[1] == 0);
  for (size_t j = 0; j < hand.tree.joints.size(); ++j)
    CHECK(carried.senses[j + 2] == plain.senses[j]);
}

TEST_CASE("passive joints, frames without geometry and robots without joints are no matter") {
  Sketch hand = human_like();
  hand.tree.joints[1].passive = true;
  CHECK(guess_closing(hand.tree).senses[1] == 0);
  for (auto& link : hand.tree.links) link.body.shape = nullptr;
  CHECK(guess_closing(hand.tree).senses.size() == hand.tree.joints.size());
  const Sketch box;
  CHECK(guess_closing(box.tree).senses.empty());
}

TEST_CASE("a hand of hundreds of fingers closes all of them, in the time of one after the other") {
  // looking at the whole hand for each of its DOFs took 20 s
  Sketch sketch;
  constexpr int fingers = 400;
  for (int i = 0; i < fingers; ++i) {
    const double angle = 2 * std::numbers::pi * i / fingers;
    const Pose at = Pose::turn(angle, {0, 0, 1}) * Pose::translation({0.3, 0, 0});
    const int link = sketch.add("finger", 0, at, {0.005, 0.002, 0.1}, {0, 0, 0.05});
    sketch.joint(link, {0, 1, 0}, -1, 1);
  }
  const ClosingGuess guess = guess_closing(sketch.tree);
  CHECK(guess.senses == std::vector<double>(fingers, -1.0));
}
