#include "clench/spec/closing_guess.h"

#include <numbers>

#include "clench/spec/approach_guess.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace clench;

namespace {

/// Robots in a few lines: a palm, number 0, and fingers of box-shaped links. Each joint has its own
/// DOF.
struct Sketch {
  RobotSpec robot;

  explicit Sketch(const Eigen::Vector3d& palm = {0.08, 0.03, 0.08}) {
    robot.base = body("palm", palm, {0, 0, 0});
  }
  static BodySpec body(const std::string& name, const Eigen::Vector3d& size,
                       const Eigen::Vector3d& center) {
    BodySpec out;
    out.name = name;
    if (size.x() > 0)
      out.shape = Shape::make(
          test::moved(test::box(size.x(), size.y(), size.z()), Pose::translation(center)));
    return out;
  }
  int add(const std::string& name, int parent, const Pose& X_PL, const Eigen::Vector3d& size,
          const Eigen::Vector3d& center) {
    robot.links.push_back(
        {.body = body(name, size, center), .parent = parent - 1, .joints = {}, .X_JL = X_PL});
    return static_cast<int>(robot.links.size());
  }
  int joint(int number, const Eigen::Vector3d& axis, double min, double max,
            JointKind kind = JointKind::revolute) {
    LinkSpec& link = robot.links[number - 1];
    const int dof = static_cast<int>(robot.dofs.size());
    robot.dofs.push_back(
        {.name = link.body.name + "_joint", .default_value = std::clamp(0.0, min, max)});
    link.joints.push_back(
        {.kind = kind, .X_PJ = link.X_JL, .axis = axis, .dof = dof, .min = min, .max = max});
    link.X_JL = Pose{};
    return dof;
  }
  std::vector<double> guess() const {
    return guess_closing(robot, std::vector<bool>(robot.dofs.size()));
  }
  /// Appends the links of another sketch; its palm replaces the body of link `carrier`.
  void append(const Sketch& other, int carrier) {
    const int links = static_cast<int>(robot.links.size()),
              dofs = static_cast<int>(robot.dofs.size());
    robot.links[carrier - 1].body = other.robot.base;
    for (LinkSpec link : other.robot.links) {
      link.parent = link.parent < 0 ? carrier - 1 : link.parent + links;
      for (JointSpec& joint : link.joints) joint.dof += dofs;
      robot.links.push_back(link);
    }
    robot.dofs.insert(robot.dofs.end(), other.robot.dofs.begin(), other.robot.dofs.end());
  }
  /// A phalanx of 40 mm that turns about x: along +z of its frame, closing towards -y.
  int phalanx(int parent, const Pose& X_PL, double min = -0.2, double max = 1.6) {
    const int link = add("phalanx" + std::to_string(robot.links.size()), parent, X_PL,
                         {0.014, 0.014, 0.036}, {0, 0, 0.02});
    joint(link, {1, 0, 0}, min, max);
    return link;
  }
  /// approach frame of a hand that closes with these velocities
  Pose approach_frame_of(const std::vector<double>& senses) const {
    RobotSpec closing = robot;
    for (size_t d = 0; d < senses.size(); ++d) closing.dofs[d].default_velocity = senses[d];
    const auto X_BA = guess_approach(closing);
    REQUIRE(X_BA);
    return *X_BA;
  }
  Eigen::Vector3d approach(const std::vector<double>& senses) const {
    return approach_frame_of(senses).rotation * Eigen::Vector3d::UnitZ();
  }
};

const Pose up40 = Pose::translation({0, 0, 0.04});

/// A hand like a human one: palm in the xz plane, facing -y, three fingers up, a thumb in front.
Sketch human_like() {
  Sketch hand;
  for (const double x : {-0.03, 0.0, 0.03}) {
    const int knuckle = hand.add("knuckle" + std::to_string(hand.robot.links.size()), 0,
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

TEST_CASE(
    "fingers and thumb of a hand close towards each other, while spread joints and the palm stay") {
  const Sketch hand = human_like();
  const auto guess = hand.guess();
  for (size_t j = 0; j < hand.robot.dofs.size(); ++j) {
    INFO(hand.robot.dofs[j].name);
    if (hand.robot.dofs[j].name.starts_with("knuckle"))
      CHECK(guess[j] == 0);
    else if (j < 12)
      CHECK(guess[j] == 1);
    else
      CHECK(guess[j] == -1);
  }
  CHECK(hand.approach(guess).y() < -0.9);
}

TEST_CASE("the guess does not depend on the pose of the hand, nor on the signs of its axes") {
  Sketch hand = human_like();
  // an arm that carries the palm, and every other axis reversed
  Sketch other({0.1, 0.1, 0.1});
  const int wrist =
      other.add("wrist", 0, Pose::translation({1, 2, 3}), {0.05, 0.05, 0.05}, {0, 0, 0});
  other.joint(wrist, {1, 0, 0}, -1, 1);
  other.append(hand, wrist);
  for (LinkSpec& link : other.robot.links)
    for (JointSpec& joint : link.joints) {
      if (joint.dof % 2 == 0) continue;
      joint.axis = -joint.axis;
      std::swap(joint.min, joint.max);
      joint.min = -joint.min, joint.max = -joint.max;
    }
  const auto plain = hand.guess(), turned = other.guess();
  CHECK(turned[0] == 0);
  for (size_t j = 0; j < hand.robot.dofs.size(); ++j)
    CHECK(turned[j + 1] == ((j + 1) % 2 ? -1 : 1) * plain[j]);
}

TEST_CASE(
    "a joint that rolls a straight thumb is evaluated with the thumb bent, equally in both hands") {
  const auto with_thumb = [](double side) {
    Sketch hand;
    for (const double x : {-0.03, 0.0, 0.03}) {
      const int first = hand.phalanx(0, Pose::translation({x, 0, 0.04}));
      hand.phalanx(hand.phalanx(first, up40), up40);
    }
    // the thumb points to -y; its first joint rolls it about its own axis
    const Pose X_PT{
        Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX())),
        {side * 0.06, -0.015, -0.03}};
    const int root = hand.add("thumb", 0, X_PT, {0, 0, 0}, {0, 0, 0});
    hand.joint(root, {0, 0, side}, -0.1, 1.2);
    hand.phalanx(hand.phalanx(root, {}, -1.6, 0.2), up40, -1.6, 0.2);
    return hand.guess();
  };
  const auto right = with_thumb(1), left = with_thumb(-1);
  CHECK(right == left);
  CHECK(right[9] == 1);
  CHECK(right[10] == -1);
}

TEST_CASE(
    "fingers do not spread into the closing path of others, and a thumb is swung towards them") {
  for (const bool is_thumb : {false, true}) {
    CAPTURE(is_thumb);
    Sketch hand;
    for (const double x : {-0.03, 0.0}) {
      const int first = hand.phalanx(0, Pose::translation({x, 0, 0.04}));
      hand.phalanx(hand.phalanx(first, up40), up40);
    }
    // a bone in the palm's side swings the finger that it carries in front of the others, in one
    // direction only
    const int bone = hand.add("bone", 0, Pose::translation({0.03, 0, -0.02}), {0.014, 0.014, 0.05},
                              {0, 0, 0.025});
    const int swing = hand.joint(bone, Eigen::Vector3d(0, -1, 1).normalized(), 0, 0.8);
    // the thumb closes to -x, towards the others
    const Pose X{Eigen::Quaterniond(Eigen::AngleAxisd(is_thumb ? -std::numbers::pi / 2 : 0.0,
                                                      Eigen::Vector3d::UnitZ())),
                 {0, 0, 0.06}};
    hand.phalanx(hand.phalanx(hand.phalanx(bone, X), up40), up40);
    CHECK((hand.guess()[swing] != 0) == is_thumb);
  }
}

TEST_CASE("a gripper closes whether it is initially open or closed") {
  for (const double open : {0.0, 0.04}) {
    Sketch gripper;
    for (const double side : {1.0, -1.0}) {
      const int finger = gripper.add(side > 0 ? "left" : "right", 0,
                                     Pose::translation({side * (0.005 + open), 0, 0.04}),
                                     {0.01, 0.02, 0.06}, {0, 0, 0.03});
      // q from -open to 0.04 - open: the fingers are open or closed at 0
      gripper.joint(finger, {side, 0, 0}, -open, 0.04 - open, JointKind::prismatic);
    }
    const auto guess = gripper.guess();
    CHECK(guess == std::vector<double>{-1, -1});
    const Pose X_BA = gripper.approach_frame_of(guess);
    CHECK(X_BA.rotation.isApprox(Eigen::Quaterniond::Identity()));
    // between the pads, which extend from 40 to 100 mm
    CHECK(std::abs(X_BA.position.x()) < 1e-3);
    CHECK(std::abs(X_BA.position.y()) < 5e-3);
    CHECK(X_BA.position.z() > 0.04);
    CHECK(X_BA.position.z() < 0.1);
  }
}

TEST_CASE("a hand of twice the size approaches from the same side, from twice the distance") {
  const auto scaled = [](const BodySpec& body) {
    BodySpec out = body;
    if (!body.shape) return out;
    Mesh mesh = body.shape->mesh();
    for (auto& v : mesh.vertices) v *= 2;
    out.shape = Shape::make(mesh);
    return out;
  };
  const Sketch hand = human_like();
  Sketch twice = hand;
  twice.robot.base = scaled(hand.robot.base);
  for (LinkSpec& link : twice.robot.links) {
    link.body = scaled(link.body);
    link.X_JL.position *= 2;
    for (JointSpec& joint : link.joints) joint.X_PJ.position *= 2;
  }
  const auto senses = hand.guess();
  REQUIRE(twice.guess() == senses);
  const Pose one = hand.approach_frame_of(senses), two = twice.approach_frame_of(senses);
  CHECK(two.rotation.coeffs() == one.rotation.coeffs());
  CHECK((two.position - 2 * one.position).norm() < 1e-12);
  // in front of the palm, which faces -y, within the reach of fingers and thumb
  CHECK(one.position.y() < -0.015);
  CHECK(one.position.y() > -0.1);
  CHECK(std::abs(one.position.x()) < 0.02);
}

TEST_CASE("one DOF that moves both jaws closes them") {
  Sketch gripper;
  for (const double side : {1.0, -1.0}) {
    const int jaw =
        gripper.add(side > 0 ? "left" : "right", 0, Pose::translation({side * 0.04, 0, 0.04}),
                    {0.01, 0.02, 0.06}, {0, 0, 0.03});
    gripper.joint(jaw, {0, 1, 0}, -0.8, 0.8);
  }
  JointSpec &left = gripper.robot.links[0].joints[0], &right = gripper.robot.links[1].joints[0];
  left.min = -0.8, left.max = 0;
  right.dof = left.dof;
  right.ratio = -1;
  // the left jaw is at +x: a negative rotation about y moves its tip to the middle
  CHECK(gripper.guess() == std::vector<double>{-1, 0});
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
  const auto guess = hand.guess();
  for (size_t j = 0; j < hand.robot.dofs.size(); ++j) {
    const bool spread =
        std::find(spreads.begin(), spreads.end(), static_cast<int>(j)) != spreads.end();
    CHECK(guess[j] == (spread ? 0 : 1));
  }
  CHECK(hand.approach(guess).z() > 0.9);
}

TEST_CASE("an arm has no closing DOF, and a single jaw has one") {
  Sketch arm;
  int link = 0;
  for (int i = 0; i < 6; ++i) link = arm.phalanx(link, up40, -3, 3);
  const auto none = arm.guess();
  CHECK(none == std::vector<double>(6, 0));
  CHECK_FALSE(guess_approach(arm.robot));

  Sketch clip({0.02, 0.02, 0.1});
  clip.phalanx(0, Pose::translation({0, 0.03, 0}), -0.2, 1.2);
  // the palm is on the -y side of the jaw, which turns there about +x
  CHECK(clip.guess() == std::vector<double>{1});
}

TEST_CASE("a camera on an arm does not make its wrist a finger") {
  const Sketch hand = human_like();
  Sketch arm({0, 0, 0});
  const int forearm = arm.add("forearm", 0, {}, {0.1, 0.1, 0.3}, {0, 0, 0});
  arm.joint(forearm, {1, 0, 0}, -1, 1);
  arm.add("camera", forearm, {}, {0.03, 0.03, 0.03}, {0, 0, 0});
  const int palm = arm.add("palm", forearm, {}, {0, 0, 0}, {0, 0, 0});
  arm.joint(palm, {1, 0, 0}, -1, 1);
  arm.append(hand, palm);
  const auto plain = hand.guess(), carried = arm.guess();
  CHECK(carried[0] == 0);
  CHECK(carried[1] == 0);
  for (size_t j = 0; j < hand.robot.dofs.size(); ++j) CHECK(carried[j + 2] == plain[j]);
}

TEST_CASE("passive joints, frames without geometry and robots without joints are handled") {
  Sketch hand = human_like();
  std::vector<bool> passive(hand.robot.dofs.size());
  passive[1] = true;
  CHECK(guess_closing(hand.robot, passive)[1] == 0);
  for (auto& link : hand.robot.links) link.body.shape = nullptr;
  hand.robot.base.shape = nullptr;
  CHECK(hand.guess().size() == hand.robot.dofs.size());
  CHECK(hand.approach(hand.guess()).norm() == doctest::Approx(1));
  const Sketch box;
  CHECK(box.guess().empty());
}

TEST_CASE("a hand of hundreds of fingers closes all of them, in linear time") {
  // evaluating the complete hand for each of its DOFs took 20 s
  Sketch sketch;
  constexpr int fingers = 400;
  for (int i = 0; i < fingers; ++i) {
    const double angle = 2 * std::numbers::pi * i / fingers;
    const Pose at = Pose::turn(angle, {0, 0, 1}) * Pose::translation({0.3, 0, 0});
    const int link = sketch.add("finger", 0, at, {0.005, 0.002, 0.1}, {0, 0, 0.05});
    sketch.joint(link, {0, 1, 0}, -1, 1);
  }
  const auto guess = sketch.guess();
  CHECK(guess == std::vector<double>(fingers, -1.0));
  CHECK(sketch.approach(guess).z() > 0.99);
}
