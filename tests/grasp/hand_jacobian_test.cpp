#include "clench/grasp/force/hand_jacobian.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/grasp/force/contact_forces.h"
#include "clench/grasp/force/link_weight.h"
#include "clench/io/read/read.h"
#include "support/chains.h"
#include "support/robots.h"

using namespace clench;
using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

namespace {

// a hand of models/, on an arm, with a contact at a random point of each of its parts
struct Arranged {
  World world;
  Grasp grasp;
  std::vector<Vector3d> p_L;  // contact points and normals in their links
  std::vector<Vector3d> n_L;
};

Arranged arrange(const std::string& hand, bool on_arm, Random& random) {
  Arranged a;
  const auto draw = [&] {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return Vector3d(x, y, z);
  };
  a.grasp.hand = a.world.add_robot(read_robot("models/hands/" + hand), Pose());
  if (on_arm) {
    const auto arm = a.world.add_robot(read_robot("models/arms/puma560/puma560.cfg"),
                                       Pose::translation({0.1, 0.2, 0.3}));
    a.world.mount(a.grasp.hand, arm, 0,
                  {Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2).normalized(), {0, 0.01, 0.05}});
  }
  a.grasp.object = a.world.add_body(test::body_spec("thing", test::box(0.1, 0.1, 0.1)),
                                    BodyKind::object, Pose::translation({3, 1, 2}));
  const Pose X_OW = a.world.pose(a.grasp.object).inverse();
  for (const auto robot : a.world.robots()) {
    VectorXd q = a.world.dofs(robot);
    for (int i = 0; i < q.size(); ++i) {
      const auto [low, high] = a.world.robot(robot).limits[i];
      q[i] = random.uniform(low, high);
    }
    a.world.set_dofs(robot, q);
  }
  for (const auto part : a.world.bodies_of(a.grasp.hand)) {
    const Pose& X_WL = a.world.pose(part);
    a.p_L.push_back(0.05 * draw());
    a.n_L.push_back(draw().normalized());
    Contact contact;
    contact.body = a.grasp.object;
    contact.other = part;
    contact.p_W = X_WL * a.p_L.back();
    contact.n_W = X_WL.rotation * a.n_L.back();
    a.grasp.contacts.push_back(contact);
    a.grasp.points.push_back({.p_O = X_OW * contact.p_W,
                              .n_O = (X_OW.rotation * contact.n_W).normalized(),
                              .mu = 0.5,
                              .torsion_radius = 0.01});
  }
  return a;
}

// motion of each contact's point and link per unit of a robot's DOF, in the contact's frame
VectorXd measured_column(const Arranged& a, Id<Robot> robot, int dof) {
  const double h = 1e-6;
  World plus = a.world, minus = a.world;
  const auto broken = a.world.own_joint_positions(robot);
  VectorXd q = a.world.dofs(robot);
  q[dof] += h;
  plus.set_dofs_unchecked(robot, q, broken);
  q[dof] -= 2 * h;
  minus.set_dofs_unchecked(robot, q, broken);
  VectorXd column(4 * a.p_L.size());
  for (size_t i = 0; i < a.p_L.size(); ++i) {
    const auto part = a.grasp.contacts[i].other;
    const Pose X_plus = plus.pose(part), X_minus = minus.pose(part);
    const Vector3d v = (X_plus * a.p_L[i] - X_minus * a.p_L[i]) / (2 * h);
    const Eigen::AngleAxisd turn(X_plus.rotation * X_minus.rotation.conjugate());
    const Vector3d w = turn.angle() * turn.axis() / (2 * h);
    const Eigen::Matrix3d frame =
        a.world.pose(a.grasp.object).matrix() * contact_frame(a.grasp.points[i].n_O);
    column.segment<4>(4 * i) << frame.col(2).dot(v), frame.col(0).dot(v), frame.col(1).dot(v),
        frame.col(2).dot(w);
  }
  return column;
}

}  // namespace

TEST_CASE("the hand Jacobian equals the motion of contacts when a DOF moves") {
  Random random(1);
  for (const char* hand :
       {"barrett/barrett.cfg", "dlr/dlr.cfg", "parallel_jaw/parallel_jaw.cfg",
        "adaptive_gripper/adaptive_gripper.cfg", "tendon_gripper/tendon_gripper.cfg"})
    for (const bool on_arm : {false, true}) {
      CAPTURE(hand);
      CAPTURE(on_arm);
      const Arranged a = arrange(hand, on_arm, random);
      const HandJacobian jacobian = hand_jacobian(a.world, a.grasp, {.arms = on_arm});
      const MatrixXd dofs = dof_jacobian(a.world, a.grasp, jacobian);
      for (int k = 0; k < dofs.cols(); ++k)
        // second differences divided by 1e-12, rounding divided by 1e-6
        CHECK((dofs.col(k) - measured_column(a, a.grasp.hand, k)).cwiseAbs().maxCoeff() < 1e-8);
      if (!on_arm) continue;
      const auto arm = a.world.robot(a.grasp.hand).mounting->parent;
      const Robot& robot = a.world.robot(arm);
      MatrixXd arms = MatrixXd::Zero(dofs.rows(), a.world.dofs(arm).size());
      for (size_t k = 0; k < jacobian.joints.size(); ++k) {
        const JointRef& ref = jacobian.joints[k];
        if (ref.robot != arm) continue;
        const JointSpec& joint = robot.joints[ref.joint];
        arms.col(joint.dof) += joint.ratio * jacobian.of_joints.col(static_cast<int>(k));
      }
      for (int k = 0; k < arms.cols(); ++k)
        CHECK((arms.col(k) - measured_column(a, arm, k)).cwiseAbs().maxCoeff() < 1e-8);
    }
}

TEST_CASE("a joint that has broken away is moved by no DOF, and held by its clutch") {
  Random random(2);
  Arranged a = arrange("barrett/barrett.cfg", false, random);
  const Robot& robot = a.world.robot(a.grasp.hand);
  auto broken = a.world.own_joint_positions(a.grasp.hand);
  int joint = 0;
  while (robot.dofs[robot.joints.at(joint).dof].kind != DofKind::breakaway) ++joint;
  broken[joint] = a.world.joints(a.grasp.hand)[joint];
  const int dof = robot.joints[joint].dof;
  a.world.set_dofs_unchecked(a.grasp.hand, a.world.dofs(a.grasp.hand), broken);
  const HandJacobian jacobian = hand_jacobian(a.world, a.grasp);
  const MatrixXd dofs = dof_jacobian(a.world, a.grasp, jacobian);
  CHECK((dofs.col(dof) - measured_column(a, a.grasp.hand, dof)).cwiseAbs().maxCoeff() < 1e-8);

  const JointBalance balance = joint_balance(a.world, a.grasp);
  REQUIRE(balance.refs.back().clutch.has_value());
  CHECK(balance.refs.back().clutch->joint == joint);
  const int last = static_cast<int>(balance.refs.size()) - 1;
  CHECK(balance.low[last] == 0);
  CHECK(balance.high[last] == doctest::Approx(0.5));  // [N m], from the file
  CHECK(balance.high[dof] == doctest::Approx(robot.dofs[dof].max_effort));
}

namespace {

// a hand of two fingers that has begun to close, far from the box to grasp
Grasp begun_grasp(World& world, const RobotSpec& spec) {
  Grasp grasp;
  grasp.hand = world.add_robot(spec, Pose());
  grasp.object = world.add_body(test::body_spec("thing", test::box(0.1, 0.1, 0.1)),
                                BodyKind::object, Pose::translation({1, 0, 0}));
  world.set_dofs(grasp.hand, Eigen::Vector2d(0.3, 0.5));
  return grasp;
}

}  // namespace

TEST_CASE("a rigid DOF has one balance equation, a compliant one has one per joint") {
  for (const auto kind : {DofKind::rigid, DofKind::compliant}) {
    RobotSpec spec = test::two_finger(kind);
    for (auto& link : spec.links)
      for (auto& joint : link.joints) joint.spring = 0.1, joint.rest = -0.2;
    World world;
    const Grasp grasp = begun_grasp(world, spec);
    const JointBalance balance = joint_balance(world, grasp);
    CHECK(balance.springs.size() == (kind == DofKind::rigid ? 2 : 4));
    // ratios 1 and 0.5: torque -k (q - rest) of each joint, its work along the DOF
    if (kind == DofKind::rigid)
      CHECK(balance.springs[0] == doctest::Approx(-0.1 * 0.5 - 0.5 * 0.1 * 0.35));
    else
      CHECK(balance.springs[1] == doctest::Approx(-0.1 * 0.35));
    CHECK(balance.high[0] == std::numeric_limits<double>::infinity());
  }
}

TEST_CASE(
    "the tendon of a compliant DOF balances all of its springs in free air, and does the DOF's "
    "work") {
  RobotSpec spec = test::two_finger(DofKind::compliant);
  for (const int c : {0, 1})
    test::joint_of(spec, c, 0).spring = 0.1, test::joint_of(spec, c, 1).spring = 0.3;
  World world;
  const Grasp grasp = begun_grasp(world, spec);
  const JointBalance balance = joint_balance(world, grasp);
  CHECK(balance.tendons[0] == doctest::Approx((0.1 + 0.25 * 0.3) * 0.3));
  CHECK((balance.efforts * balance.tendons + balance.springs).norm() < 1e-15);
  const Eigen::Vector4d ratios(1, 0.5, 1, 0.5);
  CHECK(balance.efforts.col(0).dot(ratios) == doctest::Approx(1));
}

namespace {

// potential energy of all robots, gravity along -z [J]
double height_energy(const World& world) {
  double sum = 0;
  for (const Id<Body> id : world.bodies()) {
    const Body& body = world.body(id);
    if (body.robot) sum += standard_gravity * body.mass * (world.pose(id) * body.com).z();
  }
  return sum;
}

}  // namespace

TEST_CASE("the weight of links in a joint is the derivative of their height with respect to it") {
  Random random(3);
  for (const char* hand : {"barrett/barrett.cfg", "parallel_jaw/parallel_jaw.cfg"}) {
    CAPTURE(hand);
    const Arranged a = arrange(hand, true, random);
    const HandJacobian jacobian = hand_jacobian(a.world, a.grasp, {.arms = true});
    double heaviest = 0;
    for (const JointRef& ref : jacobian.joints) {
      const double h = 1e-6;
      double energy[2];
      for (const int side : {0, 1}) {
        World moved = a.world;
        auto own = moved.own_joint_positions(ref.robot);
        own[ref.joint] = moved.joints(ref.robot)[ref.joint] + (side ? h : -h);
        moved.set_dofs_unchecked(ref.robot, moved.dofs(ref.robot), own);
        energy[side] = height_energy(moved);
      }
      // some 20 kg at a meter: 200 J, rounding of 1e-13 divided by 1e-6
      const double weight = link_weight(a.world, ref);
      CHECK(std::abs(weight + (energy[1] - energy[0]) / (2 * h)) < 1e-6);
      heaviest = std::max(heaviest, std::abs(weight));
    }
    CHECK(heaviest > 1);
    const JointBalance light = joint_balance(a.world, a.grasp, true),
                       heavy = joint_balance(a.world, a.grasp, true, true);
    CHECK(heavy.forces == light.forces);
    CHECK((heavy.springs - light.springs).norm() > 1);
  }
}

TEST_CASE("a grasp that no longer matches the world is reported") {
  World world;
  const auto hand = world.add_robot(test::two_finger(), Pose());
  const auto object = world.add_body(test::body_spec("thing", test::box(0.01, 0.01, 0.01)),
                                     BodyKind::object, Pose::translation({0, 0.06, 0}));
  const Grasp grasp = find_grasp(world, hand, object);
  CHECK_NOTHROW(hand_jacobian(world, grasp));
  // both together may move
  const Pose X =
      Pose::translation({3, 2, 1}) * Pose::turn(1, Eigen::Vector3d(1, 2, 3).normalized());
  world.set_pose(hand, X);
  world.set_pose(object, X * world.pose(object));
  CHECK_NOTHROW(hand_jacobian(world, grasp));
  world.set_dofs(hand, Eigen::Vector2d(0.1, 0));
  CHECK_THROWS_WITH_AS(hand_jacobian(world, grasp),
                       "grasp of thing by gripper: joints of the hand have moved since it was "
                       "measured; measure it anew",
                       Error);
  world.set_dofs(hand, Eigen::Vector2d(0, 0));
  world.set_pose(object, Pose());
  CHECK_THROWS_WITH_AS(contact_forces(world, grasp, {}),
                       "grasp of thing by gripper: hand and object have moved apart since it was "
                       "measured; measure it anew",
                       Error);
}
