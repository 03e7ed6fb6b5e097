#include "clench/io/mjcf/mjcf.h"

#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/mjcf/mjcf_model.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

void tell_world_geoms(const Worldbody& world, const FileCache& cache) {
  if (world.geoms.empty()) return;
  const size_t count = world.geoms.size();
  cache.diagnostics().warn(
      world.geoms.front().node->element.place(),
      "{} of the world itself, on no body, {} no part of the robot and not used",
      count == 1 ? "a geom" : fmt::format("{} geoms", count), count == 1 ? "is" : "are");
}

/// Chooses the body with the most joints as the robot; other bodies that move freely are objects. A
/// single body without joints is the base; otherwise the world is.
/// fixed_base  output: true if the tree's first body is fixed to the world
MjcfTree read_one_robot(MjcfModel& model, FileCache& cache, bool& fixed_base) {
  std::vector<TopBody> bodies = model.worldbody().bodies;
  if (bodies.empty()) fail("{}: expected bodies in <worldbody>, got none", model.document().file());
  const auto robot =
      std::max_element(bodies.begin(), bodies.end(),
                       [](const TopBody& a, const TopBody& b) { return a.joints < b.joints; });
  const MjcfNode* kept = robot->node;
  std::erase_if(bodies, [&](const TopBody& body) {
    if (body.node == kept || !body.free) return false;
    cache.diagnostics().warn(body.node->element.place(),
                             "body '{}' moves separately from the robot; it is not read",
                             excerpt(body.node->element.attribute("name").value_or("")));
    return true;
  });
  std::vector<std::string> trees;
  for (const TopBody& body : bodies)
    if (body.joints > 0) trees.push_back(body.name);
  if (trees.size() > 1)
    cache.diagnostics().warn(Place(model.document().file()),
                             "these bodies are read as one robot: {}; the option 'body' reads one "
                             "of them, and clench.load a world with all of them",
                             name_list(trees));
  MjcfTreeReader reader(model.document(), model.geoms(), model.names(), cache, "robot");
  fixed_base = true;
  if (bodies.size() == 1 && !bodies.front().own_joints) {
    fixed_base = !bodies.front().free && !bodies.front().mocap;
    reader.read_body(bodies.front(), true);
  } else {
    reader.add_world();
    for (const TopBody& body : bodies) reader.read_body(body, false);
  }
  MjcfTree tree = reader.take();
  model.scale_masses(tree);
  return tree;
}

}  // namespace

RobotSpec read_robot_mjcf(const fs::path& path, FileCache& cache) {
  MjcfModel model(path, cache, "robot");
  tell_world_geoms(model.worldbody(), cache);
  bool fixed_base = true;
  MjcfTree tree = read_one_robot(model, cache, fixed_base);
  MjcfRobot made = model.make(std::move(tree), model.name(), nullptr, true, fixed_base);
  made.materials.tell(cache);
  model.tell();
  return std::move(made.robot);
}

RobotSpec read_robot_mjcf(const fs::path& path, const std::string& body, FileCache& cache) {
  MjcfModel model(path, cache, "world");
  std::vector<std::string> names;
  for (const TopBody* tree : model.joint_trees()) {
    if (tree->name == body) {
      MjcfRobot made = model.scene_robot(*tree, true);
      made.materials.tell(cache);
      return std::move(made.robot);
    }
    names.push_back(tree->name);
  }
  fail("{}: body: expected the root of a tree of joints, got {}{}", path.filename().string(),
       in_quotes(body), instead_of(body, names));
}

}  // namespace clench
