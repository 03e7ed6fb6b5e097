#include "clench/model/world.h"

#include "clench/base/error.h"
#include "clench/model/build.h"
#include "clench/model/find.h"
#include "support/chains.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

static Id<Body> add_box(World& world, const std::string& name, const Eigen::Vector3d& at,
                        double size = 0.02) {
  return world.add_body(body_spec(name, box(size, size, size)), BodyKind::object,
                        Pose::translation(at));
}

TEST_CASE("setting a center of mass later gives the same inertia as in the spec") {
  const Eigen::Vector3d com(0.01, -0.02, 0.03);
  BodySpec spec = body_spec("box", box(0.1, 0.2, 0.3)), moved = spec;
  moved.com = com;
  World world;
  const auto later = world.add_body(spec, BodyKind::object, {}),
             at_once = world.add_body(moved, BodyKind::object, {});
  world.set_com(later, com);
  CHECK(world.body(later).inertia_per_mass == world.body(at_once).inertia_per_mass);
  // moved back, and with a given inertia
  world.set_com(later, com_of(spec));
  CHECK(world.body(later).inertia_per_mass == inertia_of(spec));
  world.set_inertia(later, Eigen::Vector3d(1, 2, 2).asDiagonal());
  const Eigen::Matrix3d given = world.body(later).inertia_per_mass;
  world.set_com(later, com);
  CHECK(world.body(later).inertia_per_mass == given);
}

TEST_CASE("a pose may be that of another body, also when the world grows") {
  World world;
  const auto first = add_box(world, "box", {1, 2, 3});
  for (int i = 0; i < 40; ++i) {
    const auto body = world.add_body(body_spec("box", box(0.02, 0.02, 0.02)), BodyKind::object,
                                     world.pose(first));
    CHECK(world.pose(body) == world.pose(first));
    const auto robot = world.add_robot(two_finger(), world.pose(first));
    CHECK(world.pose(world.robot(robot).base) == world.pose(first));
  }
}

TEST_CASE("names are unique: the second box of the same name gets a number") {
  World world;
  add_box(world, "box", {0, 0, 0});
  const auto second = add_box(world, "box", {1, 0, 0});
  CHECK(world.body(second).name == "box_2");
  CHECK_THROWS_WITH_AS(world.add_body(body_spec("x", box(1, 1, 1)), BodyKind::object, {}, "box"),
                       "the name 'box' is taken in this world", Error);
}

TEST_CASE("an error names a removed body") {
  World world;
  const auto id = add_box(world, "flask", {0, 0, 0});
  world.remove(id);
  CHECK_FALSE(world.alive(id));
  CHECK_THROWS_WITH_AS(world.body(id), "body 'flask' was removed from its world", Error);
  CHECK_THROWS_WITH_AS(world.set_pose(id, Pose{}), "body 'flask' was removed from its world",
                       Error);
}

TEST_CASE("restoring brings removed bodies back and makes newer ones stale for good") {
  World world;
  const auto old = add_box(world, "old", {0, 0, 0});
  const auto snapshot = world.snapshot();
  const uint64_t before = world.hash();
  world.remove(old);
  const auto young = add_box(world, "young", {0, 0, 0});
  world.restore(*snapshot);
  CHECK(world.hash() == before);
  CHECK(world.body(old).name == "old");
  const auto next = add_box(world, "next", {0, 0, 0});
  CHECK(next.index == young.index);
  CHECK_THROWS_WITH_AS(world.body(young), "this body is no longer in its world", Error);
}

TEST_CASE("mass properties are computed from the solid if the file gives none") {
  World world;
  auto spec = body_spec("block", moved(box(0.1, 0.2, 0.3), {0.05, 0, 0}));
  spec.mass = 2;
  const auto id = world.add_body(spec, BodyKind::object, {});
  const Body& body = world.body(id);
  // integrals of a dozen triangles: rounding only
  CHECK((body.com - Eigen::Vector3d(0.05, 0, 0)).norm() < 1e-15);
  CHECK(body.inertia_per_mass(0, 0) == doctest::Approx((0.04 + 0.09) / 12).epsilon(1e-12));
  CHECK(body.inertia_per_mass(2, 2) == doctest::Approx((0.01 + 0.04) / 12).epsilon(1e-12));
  CHECK(body.max_radius() == doctest::Approx(0.5 * std::sqrt(0.01 + 0.04 + 0.09)).epsilon(1e-12));
}

TEST_CASE("a center of mass away from the centroid adds the parallel axis term") {
  World world;
  auto spec = body_spec("block", box(0.1, 0.1, 0.1));
  spec.com = Eigen::Vector3d(0, 0, 0.02);
  const auto id = world.add_body(spec, BodyKind::object, {});
  const Eigen::Matrix3d inertia = world.body(id).inertia_per_mass;
  CHECK(inertia(0, 0) == doctest::Approx(0.01 / 6 + 0.0004).epsilon(1e-12));
  CHECK(inertia(2, 2) == doctest::Approx(0.01 / 6).epsilon(1e-12));
}

TEST_CASE("a body without geometry loads and never collides") {
  World world;
  BodySpec spec;
  spec.name = "frame";
  const auto frame = world.add_body(spec, BodyKind::obstacle, {});
  const auto block = add_box(world, "block", {0, 0, 0});
  CHECK_FALSE(world.may_collide(frame, block));
  CHECK(colliding_pairs(world).empty());
  CHECK(contacts(world).empty());
  const std::array a{frame}, b{block};
  CHECK(std::isinf(distance(world, a, b).distance));
}

TEST_CASE("links have the poses of their Denavit-Hartenberg parameters") {
  World world;
  const auto id = world.add_robot(two_finger(), Pose::translation({0, 0, 1}));
  const double q = 0.3;
  world.set_dofs(id, Eigen::Vector2d(q, 0));
  const Robot& robot = world.robot(id);
  // a planar arm of two 50 mm links that starts at (0.03, 0) along +y and turns left by q, then by
  // q/2 more
  const Eigen::Vector3d knuckle(0.03, 0, 1);
  const Eigen::Vector3d first = knuckle + 0.05 * Eigen::Vector3d(-std::sin(q), std::cos(q), 0);
  const Eigen::Vector3d second =
      first + 0.05 * Eigen::Vector3d(-std::sin(1.5 * q), std::cos(1.5 * q), 0);
  CHECK((world.pose(link_of(robot, 0, 0)).position - first).norm() < 1e-15);
  CHECK((world.pose(link_of(robot, 0, 1)).position - second).norm() < 1e-15);
  // the other finger mirrors it: straight up at rest
  CHECK((world.pose(link_of(robot, 1, 1)).position - Eigen::Vector3d(-0.03, 0.1, 1)).norm() <
        1e-15);
}

TEST_CASE("moving a robot moves its links rigidly") {
  World world;
  const auto id = world.add_robot(two_finger(), {});
  world.set_dofs(id, Eigen::Vector2d(0.4, 0.7));
  const auto link = link_of(world.robot(id), 1, 1);
  const Pose before = world.pose(link);
  const Pose X{Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 2) / 3)), {1, 2, 3}};
  world.set_pose(id, X);
  const Pose off = (X * before).inverse() * world.pose(link);
  CHECK(off.position.norm() < 1e-15);
  CHECK(off.angle() < 1e-15);
}

TEST_CASE("DOF values are rejected with expected and got values") {
  World world;
  const auto id = world.add_robot(two_finger(), {});
  CHECK_THROWS_WITH_AS(world.set_dofs(id, Eigen::Vector3d(1, 2, 3)),
                       "robot 'gripper': expected 2 DOF values, got 3", Error);
  CHECK_THROWS_WITH_AS(world.set_dofs(id, Eigen::Vector2d(NAN, 0)),
                       "robot 'gripper': DOF 1 must be finite, got nan", Error);
  CHECK_THROWS_WITH_AS(world.set_dofs(id, Eigen::Vector2d(0, -1)),
                       "robot 'gripper': DOF 2 must lie in [0, 1.571] rad, got -1", Error);
}

TEST_CASE("parts of a robot cannot be moved or removed separately") {
  World world;
  const auto id = world.add_robot(two_finger(), {});
  const auto link = link_of(world.robot(id), 0, 0);
  CHECK_THROWS_WITH_AS(world.set_pose(link, Pose{}),
                       "body 'gripper_chain0_link0' is a part of robot 'gripper': move the robot",
                       Error);
  CHECK_THROWS_WITH_AS(world.remove(link),
                       "body 'gripper_chain0_link0' is a part of robot 'gripper': remove the robot",
                       Error);
  world.remove(id);
  CHECK(world.bodies().empty());
  CHECK_THROWS_WITH_AS(world.robot(id), "robot 'gripper' was removed from its world", Error);
}

TEST_CASE("the manual's pairs are off after loading: base and first links, links of one chain") {
  World world;
  const auto id = world.add_robot(two_finger(), {});
  const Robot& robot = world.robot(id);
  const auto link = [&](int c, int l) { return link_of(robot, c, l); };
  CHECK_FALSE(world.may_collide(robot.base, link(0, 0)));
  CHECK_FALSE(world.may_collide(link(0, 0), link(0, 1)));
  CHECK(world.may_collide(robot.base, link(0, 1)));
  CHECK(world.may_collide(link(0, 0), link(1, 0)));
}

TEST_CASE("switches act on the world, a body, a pair") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0}), b = add_box(world, "b", {0.01, 0, 0});
  CHECK(colliding_pairs(world).size() == 1);
  world.set_collision(false, a, b);
  CHECK(colliding_pairs(world).empty());
  world.set_collision(true, b, a);
  world.set_collision(false, a);
  CHECK(colliding_pairs(world).empty());
  world.set_collision(true, a);
  world.set_collision(false);
  CHECK(colliding_pairs(world).empty());
  world.set_collision(true);
  CHECK(colliding_pairs(world).size() == 1);
}

TEST_CASE("a copy shares only meshes") {
  World world;
  const auto robot = world.add_robot(two_finger(), {});
  World copy = world;
  copy.set_dofs(robot, Eigen::Vector2d(1, 1));
  copy.set_friction("wood", "metal", {0.9, 0.8});
  CHECK(world.dofs(robot) == Eigen::Vector2d(0, 0));
  CHECK(world.materials().friction(4, 2).statics == doctest::Approx(0.3));
  CHECK(world.body(world.robot(robot).base).shape == copy.body(copy.robot(robot).base).shape);
  CHECK(world.hash() != copy.hash());
}

TEST_CASE("distance and contacts do not depend on the order of the pair") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0}),
             b = add_box(world, "b", {0.0200500001, 0.003, 0.001});
  const std::array ga{a}, gb{b};
  const auto ab = distance(world, ga, gb), ba = distance(world, gb, ga);
  CHECK(ab.distance == ba.distance);
  CHECK(ab.p_a == ba.p_b);
  CHECK((ab.p_a - ab.p_b).norm() == doctest::Approx(ab.distance).epsilon(1e-12));
  const auto on_b = contacts(world, ga, gb), on_a = contacts(world, gb, ga);
  REQUIRE(on_b.size() == on_a.size());
  REQUIRE(on_b.size() >= 4);
  for (size_t i = 0; i < on_b.size(); ++i) {
    CHECK(on_b[i].n_W == -on_a[i].n_W);
    CHECK(on_b[i].gap == on_a[i].gap);
    CHECK(on_b[i].n_W.x() == doctest::Approx(1));
  }
}

TEST_CASE("a hand follows the arm that carries it, and rigidly joined bodies never collide") {
  World world;
  const auto arm = world.add_robot(two_finger(), {});
  const auto hand = world.add_robot(two_finger(), Pose::translation({0, 1, 0}));
  CHECK(world.robot(hand).name == "gripper_2");
  CHECK(world.body(world.robot(hand).base).name == "gripper_2_base");
  const Pose X_LB = Pose::translation({0.1, 0, 0});
  const BodySpec piece = body_spec("adapter", box(0.02, 0.02, 0.02));
  world.mount(hand, arm, 1, X_LB, &piece);
  const auto last = link_of(world.robot(arm), 0, 1);
  const auto base = world.robot(hand).base;
  for (const double q : {0.0, 0.5}) {
    world.set_dofs(arm, Eigen::Vector2d(q, 0));
    const Pose off = (world.pose(last) * X_LB).inverse() * world.pose(base);
    CHECK(off.position.norm() < 1e-15);
    CHECK(world.pose(*world.robot(hand).mounting->piece) == world.pose(base));
  }
  CHECK_FALSE(world.may_collide(last, base));
  CHECK_FALSE(world.may_collide(last, *world.robot(hand).mounting->piece));
  CHECK_THROWS_WITH_AS(world.set_pose(hand, Pose{}),
                       "robot 'gripper_2' is carried by 'gripper': move that one", Error);
  CHECK_THROWS_WITH_AS(world.mount(arm, hand, 0, Pose{}),
                       "robot 'gripper' cannot be carried by 'gripper_2', which it carries itself",
                       Error);
  CHECK_THROWS_WITH_AS(world.mount(hand, arm, 1, Pose{}),
                       "robot 'gripper_2' is already carried by 'gripper'", Error);
  world.remove(arm);
  CHECK_FALSE(world.robot(hand).mounting);
  world.set_pose(hand, Pose{});
}

TEST_CASE("a mount on a missing link is rejected with the range") {
  World world;
  const auto arm = world.add_robot(two_finger(), {}), hand = world.add_robot(two_finger(), {});
  CHECK_THROWS_WITH_AS(world.mount(hand, arm, 4, Pose{}),
                       "robot 'gripper_2': expected a link of 'gripper', 0 to 3, got 4", Error);
}

TEST_CASE("invalid values of mass, inertia, modulus, threshold, material and name are rejected") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0});
  add_box(world, "b", {1, 0, 0});
  CHECK_THROWS_WITH_AS(world.set_mass(a, -1),
                       "body 'a': mass: expected a number from 1e-12 to 1e+12 [kg], got -1", Error);
  CHECK_THROWS_WITH_AS(world.set_com(a, {NAN, 0, 0}),
                       "body 'a': com: expected a number from -1e+09 to 1e+09 [m], got nan", Error);
  CHECK_THROWS_WITH_AS(world.set_inertia(a, Eigen::Vector3d(1, 1, -1).asDiagonal()),
                       "body 'a': inertia: expected a positive definite matrix with moments of "
                       "1e-24 to 1e+20 m^2 per kilogram, got another",
                       Error);
  CHECK_THROWS_WITH_AS(
      world.set_elastic_modulus(a, 0),
      "body 'a': elastic modulus: expected a number from 0.001 to 1e+15 [Pa], got 0", Error);
  CHECK_THROWS_WITH_AS(world.set_soft_layer(a, -1),
                       "body 'a': soft layer: expected a number from 1e-09 to 1e+09 [m], got -1",
                       Error);
  CHECK_THROWS_WITH_AS(world.set_poisson_ratio(a, 0.5),
                       "body 'a': Poisson's ratio: expected a number from 0 to 0.499999, got 0.5",
                       Error);
  CHECK_THROWS_WITH_AS(world.set_contact_threshold(0),
                       "world: contact threshold: expected a number from 1e-09 to 0.01 [m], got 0",
                       Error);
  CHECK_THROWS_WITH_AS(world.set_name(a, "b"), "the name 'b' is taken in this world", Error);
  CHECK_THROWS_WITH_AS(world.set_name(a, ""), "body 'a': a name may not be empty", Error);
  CHECK_THROWS_AS(world.set_material(a, "woood"), Error);
  CHECK_THROWS_WITH_AS(
      world.set_pose(a, Pose::translation({NAN, 0, 0})),
      "body 'a': expected a position within 1e+09 m of the origin, got (nan, 0, 0)", Error);
}

TEST_CASE("a body may not be farther than 1e9 m from the origin, nor have a robot's name") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0});
  world.add_robot(two_finger(), Pose::translation({1, 0, 0}));
  CHECK_THROWS_WITH_AS(
      world.set_pose(a, Pose::translation({0, 1e300, 0})),
      "body 'a': expected a position within 1e+09 m of the origin, got (0, 1e+300, 0)", Error);
  CHECK_THROWS_WITH_AS(world.set_name(a, "gripper"), "the name 'gripper' is taken in this world",
                       Error);
}

TEST_CASE("a robot with a link too far away is not added, moved, driven or mounted") {
  RobotSpec far = two_finger();
  joint_of(far, 0, 0).X_PJ.position.z() = 1e9;
  World world;
  add_box(world, "a", {0, 0, 0});
  const uint64_t empty = world.hash();
  CHECK_THROWS_WITH_AS(world.add_robot(far, Pose::translation({0, 0, 1e9})),
                       doctest::Contains("expected a position within 1e+09 m of the origin, got ("),
                       Error);
  CHECK(world.hash() == empty);
  CHECK(world.robots().empty());
  CHECK(world.bodies().size() == 1);

  const auto hand = world.add_robot(far, {}), other = world.add_robot(two_finger(), {});
  const uint64_t as_added = world.hash();
  CHECK_THROWS_AS(world.set_pose(hand, Pose::translation({0, 0, 1})), Error);
  CHECK_THROWS_AS(world.mount(other, hand, 0, Pose::translation({0, 0, 1e9})), Error);
  CHECK_THROWS_AS(world.mount(other, hand, 0, Pose::translation({0, 0, 1e308})), Error);
  CHECK(world.hash() == as_added);

  RobotSpec sliding = two_finger();
  for (const int j : {0, 1}) {
    JointSpec& joint = joint_of(sliding, 0, j);
    joint.kind = JointKind::prismatic;
    joint.min = 0, joint.max = 1e20;
  }
  World slides;
  const auto slider = slides.add_robot(sliding, {});
  const uint64_t before = slides.hash();
  Eigen::VectorXd q = slides.dofs(slider);
  q[0] = 1e15;
  CHECK_THROWS_AS(slides.set_dofs(slider, q), Error);
  CHECK(slides.hash() == before);
}

TEST_CASE(
    "an impossible inertia, a name with control characters and an invalid camera are rejected") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0});
  CHECK_THROWS_WITH_AS(world.set_inertia(a, Eigen::Vector3d(1, 1, 100).asDiagonal()),
                       "body 'a': inertia: expected no moment above the sum of the others, got one "
                       "of 50 times that sum",
                       Error);
  CHECK_THROWS_AS(world.set_mass(a, 5e-324), Error);
  CHECK_THROWS_AS(world.set_com(a, {1e200, 0, 0}), Error);
  world.set_com(a, {1e9, 0, 0});
  CHECK(world.body(a).inertia_per_mass.allFinite());
  CHECK_THROWS_WITH_AS(world.set_name(a, "a\nb"),
                       "body 'a': name: expected no control characters, got 'a?b'", Error);
  CHECK_THROWS_WITH_AS(world.set_friction("co\trk", "wood", {0.5, 0.4}),
                       "material: name: expected no control characters, got 'co?rk'", Error);
  CHECK_THROWS_AS(world.add_robot(two_finger(), {}, "\x1b[31m"), Error);
  CHECK_THROWS_WITH_AS(world.set_camera(Camera{.X_WC = {}, .focal_distance = -1}),
                       "camera: focal distance: expected a number from 1e-12 to 1e+09 [m], got -1",
                       Error);
  CHECK_FALSE(world.camera());
}

TEST_CASE("the names of parts of a robot with a long name have a limited length") {
  World world;
  const auto hand = world.add_robot(two_finger(), {}, std::string(250, 'x'));
  for (const auto body : world.bodies_of(hand)) CHECK(world.body(body).name.size() <= 252);
}

TEST_CASE("the hash depends on shapes and mountings") {
  World one, two;
  auto spec = body_spec("block", box(1, 1, 1));
  spec.com = Eigen::Vector3d(0, 0, 0);
  spec.inertia_per_mass = Eigen::Matrix3d::Identity();
  one.add_body(spec, BodyKind::object, {});
  spec.shape = Shape::make(box(2, 1, 1));
  two.add_body(spec, BodyKind::object, {});
  CHECK(one.hash() != two.hash());

  World apart, mounted;
  for (World* world : {&apart, &mounted})
    for (int i = 0; i < 2; ++i) world->add_robot(two_finger(), {});
  const Pose X_LB = Pose::translation({0.1, 0, 0});
  const auto last = link_of(apart.robot(apart.robots()[0]), 0, 1);
  apart.set_pose(apart.robots()[1], apart.pose(last) * X_LB);
  apart.set_collision(false, last, apart.robot(apart.robots()[1]).base);
  mounted.mount(mounted.robots()[1], mounted.robots()[0], 0, X_LB);
  CHECK(apart.hash() != mounted.hash());
}

TEST_CASE("the nearest points of a tie do not depend on earlier queries") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0}, 1), b = add_box(world, "b", {2, 0, 0}, 1);
  const std::array ga{a}, gb{b};
  const auto cold = distance(world, ga, gb);
  const auto snapshot = world.snapshot();
  for (int i = 0; i < 20; ++i) {
    world.set_pose(b, Pose::translation({2, 0.3 * i - 2, 0.1 * i}));
    distance(world, ga, gb);
    world.set_pose(b, Pose::translation({2, 0, 0}));
    const auto warm = distance(world, ga, gb);
    CHECK(warm.p_a == cold.p_a);
    CHECK(warm.p_b == cold.p_b);
  }
}

TEST_CASE("a thousand boxes of one name are numbered one by one") {
  World world;
  const auto spec = body_spec("box", box(0.01, 0.01, 0.01));
  for (int i = 0; i < 1000; ++i) world.add_body(spec, BodyKind::object, {});
  CHECK(world.body(world.bodies().back()).name == "box_1000");
}

TEST_CASE("the hash depends on every bit of the state") {
  World world;
  const auto a = add_box(world, "a", {0, 0, 0});
  const auto robot = world.add_robot(two_finger(), Pose::translation({1, 0, 0}));
  const uint64_t start = world.hash();
  const auto snapshot = world.snapshot();
  const auto changes = [&](auto change) {
    change();
    const bool differs = world.hash() != start;
    world.restore(*snapshot);
    return differs && world.hash() == start;
  };
  CHECK(changes([&] { world.set_pose(a, Pose::translation({0, 0, 1e-300})); }));
  CHECK(changes([&] { world.set_dofs(robot, Eigen::Vector2d(0, 1e-16)); }));
  CHECK(changes([&] { world.set_mass(a, 0.31); }));
  CHECK(changes([&] { world.set_material(a, "glass"); }));
  CHECK(changes([&] { world.set_friction("glass", "wood", {0.31, 0.2}); }));
  CHECK(changes([&] { world.set_collision(false, a); }));
  CHECK(changes([&] { world.set_contact_threshold(2e-4); }));
}
