#include "clench/scene/scene.h"

#include <cmath>
#include <set>
#include <string>

#include "clench/base/error.h"
#include "clench/model/find.h"
#include "clench/scene/cones.h"
#include "clench/scene/palette.h"
#include "clench/scene/touched.h"
#include "support/robots.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

namespace {

BodySpec body(const char* name, const Mesh& mesh) {
  BodySpec spec;
  spec.name = name;
  spec.shape = Shape::make(mesh);
  return spec;
}

// a robot that consists of its base
RobotSpec block(const Mesh& mesh) {
  RobotSpec robot;
  robot.name = "block";
  robot.base = body("palm", mesh);
  return robot;
}

}  // namespace

TEST_CASE("bodies come in creation order, each with the color of its kind") {
  World world;
  world.add_body(body("table", box(1, 1, 0.1)), BodyKind::obstacle, {});
  world.add_body(body("tin", ball(0.1)), BodyKind::object, Pose::translation({3, 0, 0}));
  world.add_robot(block(box(0.1, 0.1, 0.1)), Pose::translation({0, 5, 0}));
  const Scene scene = make_scene(world);
  REQUIRE(scene.meshes.size() == 3);
  CHECK(scene.meshes[0].color == palette::of(BodyKind::obstacle).color);
  CHECK(scene.meshes[1].color == palette::of(BodyKind::object).color);
  CHECK(scene.meshes[2].color == palette::of(BodyKind::base).color);
  CHECK(scene.meshes[1].X_WM == Pose::translation({3, 0, 0}));
  CHECK(scene.meshes[0].opacity == 1);
  CHECK(scene.meshes[1].opacity < 0.5f);
  CHECK(make_scene(world, {.transparent_objects = false}).meshes[1].opacity == 1);
}

TEST_CASE("a file's own colors are used unless that is switched off") {
  World world;
  BodySpec spec = body("tin", box(1, 1, 1));
  spec.appearance.given = true;
  spec.appearance.color = {0.1f, 0.2f, 0.3f};
  spec.appearance.transparency = 0.9f;
  spec.appearance.triangle_colors.assign(12, {0.5f, 0, 0});
  world.add_body(spec, BodyKind::obstacle, {});
  const DrawMesh own = make_scene(world).meshes[0];
  CHECK(own.color == Eigen::Vector3f(0.1f, 0.2f, 0.3f));
  CHECK(own.triangle_colors.size() == 12);
  CHECK(own.opacity == doctest::Approx(0.1));
  const DrawMesh ours = make_scene(world, {.file_colors = false}).meshes[0];
  CHECK(ours.color == palette::of(BodyKind::obstacle).color);
  CHECK(ours.triangle_colors.empty());
  CHECK(ours.opacity == 1);
}

TEST_CASE(
    "a cone is at the center of each patch between a robot and an object, and opens into the "
    "object") {
  World world;
  // a palm under a box, a tenth of the threshold below it, and an obstacle on top at the same
  // distance
  const double gap = 0.1 * world.contact_threshold();
  const Id<Body> object = world.add_body(body("tin", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  world.add_robot(block(box(0.05, 0.05, 0.05)), Pose::translation({0, 0.01, -0.075 - gap}));
  world.add_body(body("lid", box(0.1, 0.1, 0.1)), BodyKind::obstacle,
                 Pose::translation({0, 0, 0.1 + gap}));
  const auto all = contacts(world);
  REQUIRE(all.size() >= 8);
  const Scene scene = make_scene(world);
  REQUIRE(scene.cones.size() == 1);
  const double mu =
      world.materials().friction(world.body(object).material, world.body(object).material).statics;
  const DrawCone& cone = scene.cones[0];
  CHECK((cone.apex - Eigen::Vector3d(0, 0.01, -0.05)).norm() < 1e-9);
  CHECK((cone.axis - Eigen::Vector3d::UnitZ()).norm() < 1e-9);
  CHECK(cone.half_angle == doctest::Approx(std::atan(mu)));
  CHECK(cone.height > 0);
  CHECK(cone.height < 0.05);
  CHECK(cone.shown == Shown{.kind = Shown::Kind::contact,
                            .body = object,
                            .other = world.robot(world.robots()[0]).base,
                            .index = 0});
  for (size_t i = 0; i < scene.meshes.size(); ++i)
    CHECK(scene.meshes[i].shown == Shown{.kind = Shown::Kind::body, .body = world.bodies()[i]});
  // a view includes the patch, with or without its cone
  CHECK(!scene.spots.empty());
  CHECK(make_scene(world, {.contacts = false}).cones.empty());
  CHECK(make_scene(world, {.contacts = false}).spots == scene.spots);
}

TEST_CASE("each face that a robot touches has a separate patch") {
  World world;
  world.add_body(body("tin", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  const double off = 0.075 + 1e-5;
  for (const Eigen::Vector3d& side :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0)})
    world.add_robot(block(box(0.05, 0.05, 0.05)), Pose::translation(off * side));
  const auto patches = touch_patches(contacts_on_objects(world));
  REQUIRE(patches.size() == 3);
  for (const TouchPatch& patch : patches) {
    CHECK(patch.contacts.size() >= 4);
    CHECK(patch.p_W.norm() == doctest::Approx(0.05));
    CHECK(patch.n_W.dot(patch.p_W) == doctest::Approx(-0.05));
  }
}

namespace {

// blocks of this width in a row under a tin, each a separate robot
void add_row(World& world, double side, int count) {
  world.add_body(body("tin", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  for (int i = 0; i < count; ++i)
    world.add_robot(block(box(side, side, 0.05)),
                    Pose::translation({1.5 * side * (i - 0.5 * (count - 1)), 0, -0.075 - 1e-5}));
}

}  // namespace

TEST_CASE("cones of neighboring patches do not touch each other, and stay visible") {
  for (const double side : {0.06, 0.01, 0.002}) {
    World world;
    add_row(world, side, 2);
    const std::vector<DrawCone> cones = make_scene(world).cones;
    REQUIRE(cones.size() == 2);
    // without a neighbor: 0.15 of the object's maximal radius
    const double usual = 0.15 * std::sqrt(3) * 0.05;
    for (const DrawCone& a : cones) {
      CHECK(a.height >= 0.199 * usual);
      CHECK(a.height <= 1.001 * usual);
      for (const DrawCone& b : cones) {
        const double reach = (a.height + b.height) * std::max(1.0, std::tan(a.half_angle));
        if (&a != &b && side > 0.005) CHECK(reach < (a.apex - b.apex).norm());
      }
    }
    if (side > 0.05) CHECK(cones[0].height == doctest::Approx(usual));
  }
}

TEST_CASE("cones have one size, or are proportional to friction or to force, as requested") {
  World world;
  add_row(world, 0.01, 3);
  const double usual = 0.15 * std::sqrt(3) * 0.05;
  const auto heights = [&](SceneOptions options) {
    std::vector<double> out;
    for (const DrawCone& cone : make_scene(world, options).cones) out.push_back(cone.height);
    return out;
  };
  for (const ConeSizes sizes : {ConeSizes::equal, ConeSizes::friction})
    for (const double height : heights({.cone_sizes = sizes}))
      CHECK(height == doctest::Approx(usual));
  for (const double height : heights({.cone_sizes = ConeSizes::equal, .cone_height = 0.02}))
    CHECK(height == 0.02);

  // a patch has the sum of the forces of its contacts: 1, 2 and 0, which has no cone
  const auto patches = touch_patches(contacts_on_objects(world));
  REQUIRE(patches.size() == 3);
  SceneOptions options{.cone_sizes = ConeSizes::force, .cone_height = 0.03};
  options.loads = {{patches[0].contacts[0].p_W, 1},
                   {patches[1].contacts[0].p_W, 1.5},
                   {patches[1].contacts[1].p_W, 0.5},
                   {patches[2].contacts[0].p_W, 0}};
  CHECK(heights(options) == std::vector<double>{0.015, 0.03});

  CHECK_THROWS_WITH_AS(make_scene(world, {.cone_height = -1}),
                       "picture: the height of cones must be >= 0 [m], got -1", Error);
  options.loads[0].force = NAN;
  CHECK_THROWS_WITH_AS(make_scene(world, options), "picture: forces must be finite numbers", Error);
}

TEST_CASE("a view contains the touched objects and the links that hold them, or everything") {
  World world;
  world.add_body(body("tin", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  world.add_body(body("far", box(0.1, 0.1, 0.1)), BodyKind::object, Pose::translation({3, 0, 0}));
  const auto framed = [&](Framing framing) {
    std::vector<bool> out;
    for (const DrawMesh& mesh : make_scene(world, {.framing = framing}).meshes)
      out.push_back(mesh.framed);
    return out;
  };
  // without contacts everything
  CHECK(framed(Framing::contacts) == std::vector{true, true});
  // a palm without links
  world.add_robot(block(box(0.05, 0.05, 0.05)), Pose::translation({0, 0, -0.075 - 1e-5}));
  CHECK(framed(Framing::contacts) == std::vector{true, false, true});
  CHECK(framed(Framing::all) == std::vector{true, true, true});
}

TEST_CASE("for a robot in contact, a view contains the links from its palm outward") {
  // base, forearm, knuckles, and two fingers of a link each
  RobotSpec robot = block(box(0.1, 0.1, 0.1));
  const auto add = [&](const char* name, int parent, const Eigen::Vector3d& p) {
    LinkSpec link{.body = body(name, box(0.04, 0.04, 0.04)), .parent = parent};
    JointSpec joint;
    joint.axis = Eigen::Vector3d::UnitY();
    joint.dof = static_cast<int>(robot.dofs.size());
    joint.X_PJ = Pose::translation(p);
    joint.min = -1, joint.max = 1;
    robot.dofs.push_back({});
    link.joints = {joint};
    robot.links.push_back(link);
  };
  add("forearm", -1, {0, 0, 0.2});
  add("knuckles", 0, {0, 0, 0.2});
  add("left", 1, {-0.1, 0, 0.1});
  add("right", 1, {0.1, 0, 0.1});
  World world;
  world.add_robot(robot, {});
  const auto framed = [&] {
    std::set<std::string> out;
    const auto contact_list = contacts(world);
    for (const Id<Body> id : touched_bodies(world, contact_list)) out.insert(world.body(id).name);
    return out;
  };
  CHECK(framed().empty());
  // one finger touches
  const Id<Body> tin = world.add_body(body("tin", box(0.16 - 2e-5, 0.1, 0.1)), BodyKind::object,
                                      Pose::translation({-0.2, 0, 0.5}));
  CHECK(framed() == std::set<std::string>{"knuckles", "left", "right", "tin"});
  // the forearm touches, and only the base has several branches
  world.set_pose(tin, Pose::translation({0.1, 0, 0.2}));
  CHECK(framed() == std::set<std::string>{"palm", "forearm", "knuckles", "left", "right", "tin"});
}

TEST_CASE("links of a transparent robot are transparent, its base and other robots are not") {
  World world;
  const Id<Robot> first = world.add_robot(two_finger(), {});
  world.add_robot(two_finger(), Pose::translation({1, 0, 0}));
  const Scene scene = make_scene(world, {.see_through = {first}});
  REQUIRE(scene.meshes.size() == world.bodies().size());
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const Body& body = world.body(world.bodies()[i]);
    const bool clear = body.kind == BodyKind::link && body.robot == first;
    CHECK((scene.meshes[i].opacity < 0.5f) == clear);
    CHECK(scene.meshes[i].hides == clear);
  }
}

TEST_CASE("a contact without friction is a needle") {
  World world;
  BodySpec slippery = body("tin", box(0.1, 0.1, 0.1));
  slippery.material = "frictionless";
  world.add_body(slippery, BodyKind::object, {});
  world.add_robot(block(box(0.05, 0.05, 0.05)), Pose::translation({0, 0, -0.075 - 1e-5}));
  const Scene scene = make_scene(world);
  REQUIRE(!scene.cones.empty());
  for (const DrawCone& cone : scene.cones) {
    CHECK(cone.half_angle == 0);
    CHECK(cone.color == palette::needle);
  }
}

TEST_CASE("the ground is at the lowest point, unless an obstacle is the floor") {
  World world;
  world.add_body(body("tin", box(0.1, 0.1, 0.4)), BodyKind::object, Pose::translation({0, 0, 1}));
  world.add_body(body("post", box(0.1, 0.1, 1)), BodyKind::obstacle,
                 Pose::translation({1, 0, 0.5}));
  CHECK(make_scene(world).ground.value() == doctest::Approx(0));
  CHECK(!make_scene(world, {.ground = false}).ground);
  world.add_body(body("floor", box(10, 10, 0.2)), BodyKind::obstacle,
                 Pose::translation({0, 0, -0.1}));
  const Scene scene = make_scene(world);
  CHECK(!scene.ground);
  CHECK(scene.meshes[2].background);
  CHECK(!scene.meshes[1].background);
  // an obstacle that does not extend below everything is not a floor
  world.add_body(body("far", box(1, 1, 1)), BodyKind::object, Pose::translation({50, 0, 1}));
  CHECK(make_scene(world).ground.value() == doctest::Approx(-0.2));
}

TEST_CASE("an empty world, and bodies without geometry, make an empty scene") {
  World world;
  CHECK(make_scene(world).meshes.empty());
  CHECK(!make_scene(world).ground);
  BodySpec frame;
  frame.name = "frame";
  world.add_body(frame, BodyKind::object, {});
  CHECK(make_scene(world).meshes.empty());
  CHECK(!make_scene(world).ground);
}

TEST_CASE("a camera is passed on") {
  World world;
  Eye eye;
  eye.eye = {1, 2, 3};
  CHECK(make_scene(world, {.eye = eye}).eye->eye == eye.eye);
  CHECK(!make_scene(world).eye);
}

TEST_CASE(
    "patches of soft contacts are drawn on request, inside the object for either order of bodies") {
  const Eigen::Vector3d middle(0, 0, 0.02 + 5e-5);
  BodySpec soft = body("ball", ball(0.02, 40, 80));
  soft.elastic_modulus = 1.5e6;
  for (const bool ball_first : {false, true}) {
    World world;
    const auto add_ball = [&] {
      return world.add_body(soft, BodyKind::object, Pose::translation(middle));
    };
    Id<Body> held;
    if (ball_first) held = add_ball();
    world.add_body(body("table", box(1, 1, 0.1)), BodyKind::obstacle,
                   Pose::translation({0, 0, -0.05}));
    if (!ball_first) held = add_ball();
    CHECK(make_scene(world).meshes.size() == 2);
    const Scene scene = make_scene(world, {.patches = true});
    REQUIRE(scene.meshes.size() == 4);
    const DrawMesh &surface = scene.meshes[2], &rim = scene.meshes[3];
    CHECK(surface.color == palette::patch);
    CHECK(rim.color == palette::ellipse);
    const Id<Body> table = world.find_body("table");
    for (const DrawMesh& mesh : {surface, rim})
      CHECK(mesh.shown ==
            Shown{.kind = Shown::Kind::site, .body = held, .other = table, .index = 0});
    // just inside the ball, and equally round
    for (const Eigen::Vector3d& p : surface.shape->mesh().vertices) {
      const double inside = 0.02 - (surface.X_WM * p - middle).norm();
      CHECK(inside > 0);
      CHECK(inside < 1.5e-4);
    }
    const double a = contact_ellipse(soft_patch(*contacts(world)[0].site), 5).semi_axes[0];
    CHECK(rim.shape->bounds().high.x() == doctest::Approx(a));
    world.set_elastic_modulus(held, std::nullopt);
    CHECK(make_scene(world, {.patches = true}).meshes.size() == 2);
  }
}
