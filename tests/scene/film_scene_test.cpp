#include "clench/scene/film_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

namespace {

BodySpec film_body(const char* name, const Mesh& mesh) {
  BodySpec spec;
  spec.name = name;
  spec.shape = Shape::make(mesh);
  return spec;
}

// a tin on a palm that rises, and a separate post
World lifted_tin() {
  World world;
  world.add_body(film_body("tin", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  world.add_body(film_body("post", box(0.1, 0.1, 1)), BodyKind::object,
                 Pose::translation({3, 0, 0}));
  RobotSpec robot;
  robot.name = "hand";
  robot.base = film_body("palm", box(0.05, 0.05, 0.05));
  world.add_robot(robot, Pose::translation({0, 0, -0.075 - 1e-5}));
  return world;
}

void move_by(World& world, const char* name, const Eigen::Vector3d& by) {
  const Id<Body> id = world.find_body(name);
  Pose pose = world.pose(id);
  pose.position += by;
  if (const Id<Robot> robot = world.body(id).robot)
    world.set_pose(robot, pose);
  else
    world.set_pose(id, pose);
}

bool is_within(const Bounds& bounds, const Eigen::Vector3d& p) {
  return (p.array() >= bounds.low.array() - 1e-9).all() &&
         (p.array() <= bounds.high.array() + 1e-9).all();
}

bool holds(const Scene& scene, const Eigen::Vector3d& p) {
  for (const DrawMesh& mesh : scene.meshes)
    if (mesh.framed && is_within(mesh.shape->bounds_at(mesh.X_WM), p)) return true;
  for (const Eigen::Vector3d& held : scene.held)
    if ((held - p).norm() < 1e-9) return true;
  return false;
}

}  // namespace

TEST_CASE(
    "a film of one state equals its scene, and a constant state adds no points to the frame") {
  const World world = lifted_tin();
  const World* const one[] = {&world};
  CHECK(make_film_scene(one).meshes.size() == make_scene(world).meshes.size());
  const World* const many[] = {&world, &world, &world};
  const Scene still = make_film_scene(many);
  CHECK(still.held.empty());
  CHECK(still.meshes.size() == make_scene(world).meshes.size());
  for (size_t i = 0; i < still.meshes.size(); ++i)
    CHECK(still.meshes[i].framed == make_scene(world).meshes[i].framed);
}

TEST_CASE("a film contains hand and object at all times, and not bodies that are never touched") {
  std::vector<std::unique_ptr<World>> states;
  std::vector<const World*> list;
  for (int i = 0; i < 40; ++i) {
    states.push_back(std::make_unique<World>(i == 0 ? lifted_tin() : World(*states.back())));
    // there and back, with the farthest point between two sampled states
    const double step = i < 1 ? 0 : i < 22 ? 0.05 : -0.05;
    for (const char* name : {"tin", "palm"}) move_by(*states.back(), name, {0, step, 0});
    list.push_back(states.back().get());
  }
  const Scene scene = make_film_scene(list);
  for (const World* world : list)
    for (const char* name : {"tin", "palm"}) {
      const Id<Body> id = world->find_body(name);
      const Bounds bounds = world->body(id).shape->bounds_at(world->pose(id));
      CHECK(holds(scene, bounds.low));
      CHECK(holds(scene, bounds.high));
    }
  CHECK(!holds(scene, {3, 0, 0}));
  const Scene all = make_film_scene(list, {.framing = Framing::all});
  CHECK(holds(all, {3, 0, 0}));
}

TEST_CASE("a lost object may leave the film") {
  std::vector<std::unique_ptr<World>> states;
  std::vector<const World*> list;
  for (int i = 0; i < 12; ++i) {
    states.push_back(std::make_unique<World>(i == 0 ? lifted_tin() : World(*states.back())));
    if (i > 5) move_by(*states.back(), "tin", {0, 0, 0.5});
    list.push_back(states.back().get());
  }
  const Scene scene = make_film_scene(list);
  CHECK(holds(scene, {0.05, 0.05, 0.05}));
  CHECK(!holds(scene, {0.05, 0.05, 3.05}));
}
