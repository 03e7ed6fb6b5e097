// Robots from URDF and MJCF in a world: every link has the pose of the file's own tree, and hands
// close.
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <map>
#include <numbers>

#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "clench/io/write/write_robot.h"
#include "clench/model/build.h"
#include "clench/motion/drive.h"
#include "io/temporary.h"
#include "support/meshes.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

// poses are products of some ten to thirty rotations of doubles; lengths are meters or less
constexpr double urdf_rounding = 1e-11;

void check_equal(const Pose& a, const Eigen::Matrix4d& b) {
  CHECK((a.matrix() - b.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff() < urdf_rounding);
  CHECK((a.position - b.topRightCorner<3, 1>()).cwiseAbs().maxCoeff() <
        urdf_rounding * std::max(1.0, a.position.norm()));
}

Eigen::Matrix4d translation(double x, double y, double z) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topRightCorner<3, 1>() << x, y, z;
  return m;
}

Eigen::Matrix4d turn(double angle, const Eigen::Vector3d& axis) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return m;
}

/// Values of all DOFs by name, and by those of their leading joints, at random within the limits.
std::map<std::string, double> move_at_random(World& world, Id<Robot> id, Random& random) {
  const Robot& robot = world.robot(id);
  Eigen::VectorXd q(robot.dofs.size());
  std::map<std::string, double> named;
  for (int i = 0; i < q.size(); ++i) {
    q[i] = random.uniform(robot.limits[i][0], robot.limits[i][1]);
    named[robot.dofs[i].name] = q[i];
  }
  for (const Joint& joint : robot.joints)
    if (joint.ratio == 1) named.emplace(joint.name, q[joint.dof]);
  world.set_dofs(id, q);
  return named;
}

// --- URDF, by recursion over the tree of another reader ---

Eigen::Matrix4d matrix(const urdf::Pose& pose) {
  double x, y, z, w;
  pose.rotation.getQuaternion(x, y, z, w);
  Eigen::Matrix4d m = translation(pose.position.x, pose.position.y, pose.position.z);
  m.topLeftCorner<3, 3>() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  return m;
}

double value_of(const urdf::Joint& joint, const urdf::ModelInterface& model,
                const std::map<std::string, double>& q) {
  if (!joint.mimic) return q.at(joint.name);
  return joint.mimic->multiplier * value_of(*model.getJoint(joint.mimic->joint_name), model, q) +
         joint.mimic->offset;
}

void check_below(const World& world, const std::string& robot, const urdf::Link& link,
                 const urdf::ModelInterface& model, const Eigen::Matrix4d& X,
                 const std::map<std::string, double>& q, int& count) {
  INFO(link.name);
  const auto body = world.find_body(robot + "_" + link.name);
  REQUIRE(body);
  check_equal(world.pose(body), X);
  ++count;
  for (const auto& joint : link.child_joints) {
    Eigen::Matrix4d X_child = X * matrix(joint->parent_to_joint_origin_transform);
    const Eigen::Vector3d axis(joint->axis.x, joint->axis.y, joint->axis.z);
    if (joint->type == urdf::Joint::REVOLUTE || joint->type == urdf::Joint::CONTINUOUS)
      X_child = X_child * turn(value_of(*joint, model, q), axis.normalized());
    else if (joint->type == urdf::Joint::PRISMATIC) {
      const Eigen::Vector3d way = value_of(*joint, model, q) * axis.normalized();
      X_child = X_child * translation(way.x(), way.y(), way.z());
    }
    check_below(world, robot, *model.getLink(joint->child_link_name), model, X_child, q, count);
  }
}

void check_urdf(const fs::path& file, const ReadOptions& options, int times) {
  INFO(file.string());
  const auto model = urdf::parseURDF(read_text(file));
  REQUIRE(model);
  World world;
  const auto id = add_robot(world, read_robot(file, options), Pose{});
  const std::string name = world.robot(id).name;
  for (int i = 0; i < times; ++i) {
    Random random(23, static_cast<uint64_t>(i));
    const auto q = move_at_random(world, id, random);
    int count = 0;
    check_below(world, name, *model->getRoot(), *model, Eigen::Matrix4d::Identity(), q, count);
    CHECK(count == static_cast<int>(model->links_.size()));
    CHECK(world.bodies_of(id).size() == model->links_.size());
  }
}

std::string three(const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

/// A URDF tree of random joints, every third one fixed, some mimicking an earlier one.
std::string random_urdf(Random& random, int links) {
  std::string text = "<robot name='random'><link name='l0'/>";
  std::vector<int> leaders;
  for (int i = 1; i < links; ++i) {
    const int parent = static_cast<int>(random.bits() % static_cast<uint64_t>(i));
    const char* type = i % 3 == 0 ? "fixed" : i % 4 == 0 ? "prismatic" : "revolute";
    text += fmt::format(
        "<link name='l{0}'/><joint name='j{0}' type='{1}'><parent link='l{2}'/><child link='l{0}'/>"
        "<origin xyz='{3}' rpy='{4}'/><axis xyz='{5}'/><limit lower='-1' upper='1.5' effort='1' "
        "velocity='1'/>",
        i, type, parent, three(0.1 * random_point(random)), three(random_point(random)),
        three(random_direction(random)));
    const bool follows = i % 3 != 0 && i % 5 == 0 && !leaders.empty();
    if (follows)
      text += fmt::format("<mimic joint='j{}' multiplier='-0.7' offset='0.2'/>", leaders.front());
    else if (i % 3 != 0)
      leaders.push_back(i);
    text += "</joint>";
  }
  return text + "</robot>";
}

// --- MJCF, by matrices written together with the text ---

struct RandomModel {
  std::string text;
  struct Step {
    std::string joint;
    bool slides;
    Eigen::Vector3d axis, anchor;
    double zero;
  };
  struct Body {
    std::string name;
    int parent;
    Eigen::Matrix4d X;
    std::vector<Step> steps;
  };
  std::vector<Body> bodies;

  /// Attributes of a random rotation in one of the notations of MJCF, and its matrix.
  static std::string random_turn(Random& random, Eigen::Matrix3d& R) {
    const double degree = std::numbers::pi / 180;
    const Eigen::Vector3d v = random_direction(random);
    switch (random.bits() % 5) {
      case 0: {
        const Eigen::Quaterniond q = test::random_turn(random);
        R = q.toRotationMatrix();
        return fmt::format("quat='{} {} {} {}'", 2 * q.w(), 2 * q.x(), 2 * q.y(), 2 * q.z());
      }
      case 1: {
        const double angle = random.uniform(-180, 180);
        R = Eigen::AngleAxisd(angle * degree, v).toRotationMatrix();
        return fmt::format("axisangle='{} {}'", three(3 * v), angle);
      }
      case 2: {
        const Eigen::Vector3d a(random.uniform(-90, 90), random.uniform(-90, 90),
                                random.uniform(-90, 90));
        // "zyX": about z, then about the new y, then all of it about the fixed x
        R = (Eigen::AngleAxisd(a.z() * degree, Eigen::Vector3d::UnitX()) *
             Eigen::AngleAxisd(a.x() * degree, Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(a.y() * degree, Eigen::Vector3d::UnitY()))
                .toRotationMatrix();
        return fmt::format("euler='{}'", three(a));
      }
      case 3: {
        const Eigen::Vector3d w = random_direction(random), z = v.cross(w).normalized();
        R << v, z.cross(v), z;
        return fmt::format("xyaxes='{} {}'", three(2 * v), three(w));
      }
      default: {
        // about the common normal of z and the direction
        const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(v).normalized();
        R = Eigen::AngleAxisd(std::acos(v.z()), axis).toRotationMatrix();
        return fmt::format("zaxis='{}'", three(v));
      }
    }
  }

  void add(Random& random, int parent, int depth) {
    const int number = static_cast<int>(bodies.size());
    const Eigen::Vector3d p = 0.1 * random_point(random);
    Eigen::Matrix3d R;
    const std::string turned = random_turn(random, R);
    Body body{fmt::format("b{}", number), parent, translation(p.x(), p.y(), p.z()), {}};
    body.X.topLeftCorner<3, 3>() = R;
    text += fmt::format("<body name='{}' pos='{}' {}>", body.name, three(p), turned);
    const int joints = parent < 0 ? 0 : static_cast<int>(random.bits() % 4);
    for (int j = 0; j < joints; ++j) {
      Step step{fmt::format("j{}_{}", number, j), random.bits() % 3 == 0, random_direction(random),
                0.05 * random_point(random), random.uniform(-0.5, 0.5)};
      const double degree = step.slides ? 1 : std::numbers::pi / 180;
      text += fmt::format("<joint name='{}' type='{}' axis='{}' pos='{}' ref='{}' range='{} {}'/>",
                          step.joint, step.slides ? "slide" : "hinge", three(2 * step.axis),
                          three(step.anchor), step.zero / degree, -1 / degree, 1 / degree);
      body.steps.push_back(step);
    }
    bodies.push_back(body);
    const int children = depth == 0 ? 0 : 1 + static_cast<int>(random.bits() % 2);
    for (int i = 0; i < children; ++i) add(random, number, depth - 1);
    text += "</body>";
  }

  explicit RandomModel(Random& random) {
    text = "<mujoco model='random'><compiler eulerseq='zyX'/><worldbody>";
    add(random, -1, 4);
    text += "</worldbody></mujoco>";
  }

  std::vector<Eigen::Matrix4d> poses(const std::map<std::string, double>& q) const {
    std::vector<Eigen::Matrix4d> out;
    for (const Body& body : bodies) {
      // the base has the pose that the world gives it
      Eigen::Matrix4d X = body.parent < 0 ? Eigen::Matrix4d::Identity()
                                          : Eigen::Matrix4d(out[body.parent] * body.X);
      for (const Step& step : body.steps) {
        const double way = q.at(step.joint) - step.zero;
        const Eigen::Vector3d &a = step.axis, &p = step.anchor;
        if (step.slides)
          X = X * translation(way * a.x(), way * a.y(), way * a.z());
        else
          X = X * translation(p.x(), p.y(), p.z()) * turn(way, a) *
              translation(-p.x(), -p.y(), -p.z());
      }
      out.push_back(X);
    }
    return out;
  }
};

}  // namespace

TEST_CASE("links of a random URDF tree have the poses of the file's tree") {
  TemporaryFolder folder;
  for (int i = 0; i < 10; ++i) {
    Random random(29, static_cast<uint64_t>(i));
    check_urdf(folder.write("random.urdf", random_urdf(random, 25)), {}, 5);
  }
}

TEST_CASE("links of the test gripper have the poses of the file's tree") {
  ReadOptions options;
  options.packages[""] = "tests/data/urdf";
  check_urdf("tests/data/urdf/gripper.urdf", options, 10);
}

TEST_CASE("links of current commercial hands have the poses of the file's tree") {
  REQUIRE_SHARED();
  const fs::path folder = shared() / "data/hands-urdf";
  for (const auto* file : {"allegro_hand/allegro_hand_right.urdf", "barrett_hand/bhand_model.urdf",
                           "shadow_hand/shadow_hand_left.urdf"})
    check_urdf(folder / file, {}, 5);
}

TEST_CASE("links of a robot written as URDF have the poses of another reader") {
  TemporaryFolder folder;
  for (const auto* file :
       {"models/hands/barrett/barrett.cfg", "models/hands/parallel_jaw/parallel_jaw.cfg",
        "models/arms/ur5/ur5.cfg", "tests/data/mjcf/hand.mjcf"}) {
    INFO(file);
    write_robot(read_robot(file), folder.path() / "written.urdf");
    check_urdf(folder.path() / "written.urdf", {}, 5);
  }
}

TEST_CASE("links of a random URDF tree, written again, have the poses of the first file's tree") {
  TemporaryFolder folder;
  for (int i = 0; i < 10; ++i) {
    Random random(37, static_cast<uint64_t>(i));
    const RobotSpec robot = read_robot(folder.write("random.urdf", random_urdf(random, 25)));
    write_robot(robot, folder.path() / "again.urdf");
    World world, other;
    const auto id = add_robot(world, robot, Pose{}),
               again = add_robot(other, read_robot(folder.path() / "again.urdf"), Pose{});
    REQUIRE(other.bodies_of(again).size() == world.bodies_of(id).size());
    move_at_random(world, id, random);
    REQUIRE(other.dofs(again).size() == world.dofs(id).size());
    other.set_dofs(again, world.dofs(id));
    for (const auto body : world.bodies_of(id)) {
      const Pose& X = world.pose(body);
      const Pose& Y = other.pose(other.find_body(world.body(body).name));
      CHECK((X.inverse() * Y).angle() < urdf_rounding);
      CHECK((X.position - Y.position).norm() < urdf_rounding * std::max(1.0, X.position.norm()));
    }
  }
}

TEST_CASE("links of a random MJCF tree have the poses of the file's tree") {
  TemporaryFolder folder;
  for (int i = 0; i < 10; ++i) {
    Random random(31, static_cast<uint64_t>(i));
    const RandomModel model(random);
    const auto file = folder.write("random.xml", model.text);
    World world;
    const auto id = add_robot(world, read_robot(file), Pose{});
    REQUIRE(world.bodies_of(id).size() == model.bodies.size());
    for (int k = 0; k < 5; ++k) {
      const auto poses = model.poses(move_at_random(world, id, random));
      for (size_t b = 0; b < poses.size(); ++b)
        check_equal(world.pose(world.find_body("random_" + model.bodies[b].name)), poses[b]);
    }
  }
}

TEST_CASE("the test gripper closes until its fingers touch, and holds an object between them") {
  ReadOptions options;
  options.packages[""] = "tests/data/urdf";
  World world;
  const auto id = add_robot(world, read_robot("tests/data/urdf/gripper.urdf", options), Pose{});
  // initially closed: at its limit already
  CHECK(autograsp(world, id).stops == std::vector<DofStop>{DofStop::limit});
  autograsp(world, id, -1);
  CHECK(world.dofs(id)[0] == 0.05);
  BodySpec spec;
  spec.name = "bar";
  spec.shape = Shape::make(box(0.04, 0.04, 0.02));
  world.add_body(spec, BodyKind::object, Pose::translation({0, 0, 0.1}));
  CHECK(autograsp(world, id).stops == std::vector<DofStop>{DofStop::contact});
  CHECK(contacts(world).size() > 1);
}

TEST_CASE("pads that counter-rotate with their levers open after they have closed") {
  World world;
  const auto id = add_robot(world, read_robot("tests/data/urdf/linkage.urdf"), Pose{});
  const DriveResult closed = autograsp(world, id);
  CHECK(closed.stops == std::vector<DofStop>{DofStop::contact});
  CHECK(colliding_pairs(world).empty());
  // the pads touch when the levers, 8 cm long, have moved each pad 4.7 cm inward, minus a part of
  // its thickness
  const double meeting = std::asin((0.05 - 0.003) / 0.08);
  CHECK(world.dofs(id)[0] == doctest::Approx(meeting).epsilon(2e-3));  // the contact threshold
  const DriveResult opened = open_hand(world, id);
  CHECK(opened.moved);
  CHECK(world.dofs(id)[0] == 0);
}

TEST_CASE("the test hand closes without self-collision") {
  World world;
  const auto id = add_robot(world, read_robot("tests/data/mjcf/hand.mjcf"), Pose{});
  CHECK(colliding_pairs(world).empty());
  CHECK(autograsp(world, id).moved);
  CHECK(colliding_pairs(world).empty());
}

TEST_CASE("current commercial hands close without self-collision") {
  REQUIRE_SHARED();
  const fs::path folder = shared() / "data/hands-urdf";
  const std::pair<const char*, int> hands[] = {{"allegro_hand/allegro_hand_right.urdf", 16},
                                               {"allegro_hand/allegro_hand_left.urdf", 16},
                                               {"barrett_hand/bhand_model.urdf", 8}};
  for (const auto& [file, dofs] : hands) {
    INFO(file);
    World world;
    const auto id = add_robot(world, read_robot(folder / file), Pose{});
    CHECK(world.dofs(id).size() == dofs);
    CHECK(autograsp(world, id).moved);
    CHECK(colliding_pairs(world).empty());
  }
}
