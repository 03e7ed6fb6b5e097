#include "clench/io/mjcf/mjcf_model.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/io/mjcf/document/mjcf_expand.h"
#include "clench/io/mjcf/document/solver_settings.h"
#include "clench/io/mjcf/joints/mjcf_couplings.h"
#include "clench/io/mjcf/joints/mjcf_spring_damper.h"
#include "clench/io/tree/tree_robot.h"

namespace clench {

MjcfModel::MjcfModel(const std::filesystem::path& path, FileCache& cache, const char* whole)
    : cache_(cache),
      whole_(whole),
      document_(path, cache),
      geoms_(expand_mjcf(document_, cache), cache, whole == std::string_view("world")),
      contacts_(document_, cache) {
  accept_written_settings(document_);
  name_ = document_.root().element.attribute("model").value_or("");
  if (name_.empty()) name_ = document_.path().stem().string();
  std::vector<std::string_view> known = {"compiler", "default", "asset",    "worldbody", "contact",
                                         "equality", "tendon",  "actuator", "size"};
  if (whole == std::string_view("world")) known.insert(known.end(), {"option", "keyframe"});
  for (const auto& node : document_.root().children)
    if (std::find(known.begin(), known.end(), node.name()) == known.end())
      leave_out(node);
    else if (node.name() == "size")
      document_.unused().attributes(node.element, {});
  worldbody_ = read_worldbody(document_, whole);
  names_.add(document_.root());
  for (const MjcfNode* node : document_.section("worldbody")) file_joints_.add(*node);
  for (const TopBody* tree : joint_trees()) count_joint_names(*tree->node, file_joints_.in_trees);
}

/// True if an <option> disables or enables actuators.
static bool switches_actuators(const MjcfNode& option) {
  const auto has = [](const XmlElement& element, const char* name) {
    return element.attribute(name).has_value();
  };
  return has(option.element, "actuatorgroupdisable") ||
         std::ranges::any_of(option.children, [&](const MjcfNode& child) {
           return child.name() == "flag" && has(child.element, "actuation");
         });
}

/// Reports the other settings of such an <option>, which are not used for a robot alone.
static void leave_out_rest(const MjcfNode& option, UnusedXml& unused) {
  unused.attributes(option.element, {"actuatorgroupdisable"});
  for (const MjcfNode& child : option.children)
    if (child.name() == "flag")
      unused.attributes(child.element, {"actuation"});
    else
      unused.element(child.element);
}

/// Reports a section that is not read. Keyframes are states of a world, not of a robot alone.
void MjcfModel::leave_out(const MjcfNode& section) {
  if (section.name() == "option" && switches_actuators(section))
    return leave_out_rest(section, document_.unused());
  if (section.name() != "keyframe") return document_.unused().element(section.element);
  if (section.children.empty()) return;
  cache_.diagnostics().warn(
      section.element.place(),
      "<keyframe> is not used for a robot alone; clench.load takes it with the option 'keyframe'");
}

std::vector<const TopBody*> MjcfModel::joint_trees() const {
  std::vector<const TopBody*> out;
  for (const TopBody& body : worldbody_.bodies)
    if (body.joints > 0) out.push_back(&body);
  return out;
}

MjcfTree MjcfModel::read_tree(const TopBody& body) {
  MjcfTreeReader reader(document_, geoms_, names_, cache_, whole_);
  if (body.own_joints) reader.add_world();
  reader.read_body(body, !body.own_joints);
  MjcfTree tree = reader.take();
  scale_masses(tree);
  return tree;
}

// --- masses ---

/// Total mass of the bodies of a file, without the world [kg].
static double mass_of_all(const std::filesystem::path& path, const ReadOptions& options) {
  ReadOptions quiet = options;
  quiet.diagnostics = {};
  const Loaders none = {};
  FileCache cache(quiet, none);
  MjcfDocument document(path, cache);
  MjcfGeoms geoms(expand_mjcf(document, cache), cache, true);
  MjcfNames names;
  names.add(document.root());
  double mass = 0;
  for (const TopBody& body : read_worldbody(document, "world").bodies) {
    MjcfTreeReader reader(document, geoms, names, cache, "world");
    reader.read_body(body, true);
    const MjcfTree tree = reader.take();
    for (size_t l = 0; l < tree.pieces.size(); ++l)
      if (tree.pieces[l].has_inertial) mass += tree.model.links[l].body.mass;
  }
  return mass;
}

void MjcfModel::scale_masses(MjcfTree& tree) {
  const double wanted = document_.settings(document_.root().element).total_mass;
  if (!(wanted > 0)) return;
  if (!mass_scale_) {
    const double mass = mass_of_all(document_.path(), cache_.options());
    mass_scale_ = mass > 0 ? wanted / mass : 1;
    if (std::abs(*mass_scale_ - 1) > 1e-9)
      cache_.diagnostics().note(
          Place(document_.file()),
          "settotalmass scales the masses of all bodies by {:.6g}, from {:.6g} to {:.6g} kg",
          *mass_scale_, mass, wanted);
  }
  for (size_t l = 0; l < tree.pieces.size(); ++l) {
    double& mass = tree.model.links[l].body.mass;
    if (tree.pieces[l].has_inertial && mass > mass_rule.min)
      mass = std::clamp(mass * *mass_scale_, mass_rule.min, mass_rule.max);
  }
}

// --- robots of a scene ---

MjcfRobot MjcfModel::scene_robot(const TopBody& body, bool first) {
  const bool alone = joint_trees().size() == 1;
  MjcfRobot out =
      make(read_tree(body), alone ? name_ : body.name, &body, first, !body.free && !body.mocap);
  out.robot.files.body = body.name;
  return out;
}

// --- collision filters ---

void MjcfModel::read_excludes(MjcfTree& tree) {
  const bool alone = whole_ == std::string_view("robot");
  for (const MjcfNode* node : document_.section("contact")) {
    if (node->name() == "pair") continue;
    if (node->name() != "exclude") {
      if (alone) document_.unused().element(node->element);
      continue;
    }
    if (alone) document_.unused().attributes(node->element, {"name", "class", "body1", "body2"});
    const XmlValues values(node->element);
    const auto a = tree.links.find(values.text("body1")), b = tree.links.find(values.text("body2"));
    if (a == tree.links.end() || b == tree.links.end()) {
      // a scene checks all of them, and a robot alone has no surroundings
      if (alone && values.text("body1") != "world" && values.text("body2") != "world")
        cache_.diagnostics().warn(node->element.place().of("exclude"),
                                  "'{}' and '{}' are not both bodies of the robot; not used",
                                  excerpt(values.text("body1")), excerpt(values.text("body2")));
    } else if (a != b) {
      tree.model.never_meet.emplace_back(a->second, b->second);
    }
  }
}

// --- robots ---

/// Reports joints whose reference is outside their limits, because a DOF must start within them.
void MjcfModel::warn_of_starts(const TreeModel& tree) const {
  constexpr double rounding = 1e-9;
  for (const TreeJoint& joint : tree.joints) {
    const double start = joint.motor.default_value;
    if (joint.leader >= 0 || joint.min == joint.max ||
        std::abs(start - joint.zero) <= rounding * std::max(1.0, std::abs(joint.zero)))
      continue;
    cache_.diagnostics().warn(
        joint.place.of("joint '{}'", excerpt(joint.name)),
        "expected a start within its limits [{:.6g}, {:.6g}] {}, got {:.6g}; it starts at {:.6g}",
        joint.min, joint.max, joint.kind == JointKind::revolute ? "rad" : "m", joint.zero, start);
  }
}

/// Links whose geoms give no friction are plastic, as in other formats.
void MjcfModel::set_materials(MjcfTree& tree, MjcfMaterials& materials) const {
  bool all_given = true;
  for (size_t i = 0; i < tree.geoms.size(); ++i) {
    BodySpec& body = tree.model.links[i].body;
    const bool given = is_friction_given(tree.geoms[i]);
    if (given) {
      body.material = materials.of(tree.geoms[i], body.name);
      body.material_from = Origin::file;
    }
    all_given = all_given && (given || !body.shape);
  }
  if (whole_ != std::string_view("world") && !all_given)
    cache_.diagnostics().note(
        Place(document_.file()),
        "read as a robot, its links whose geoms give no friction count as plastic; as a scene, by "
        "clench.load, they have MuJoCo's friction of 1");
}

MjcfRobot MjcfModel::make(MjcfTree tree, const std::string& robot_name, const TopBody* trunk,
                          bool tells, bool fixed_base) {
  TreeModel& model = tree.model;
  model.name = robot_name;
  model.class_name = document_.root().element.attribute("model").value_or("");
  read_excludes(tree);
  read_mjcf_couplings(document_, cache_, model, file_joints_, trunk ? trunk->node : nullptr, tells);
  warn_of_starts(model);
  for (size_t i = 0; i < tree.geoms.size(); ++i)
    for (const MjcfGeom& geom : tree.geoms[i]) {
      if (geom.collides()) tree.pieces[i].collision.push_back(geom.piece);
      if (geom.drawn) tree.pieces[i].visual.push_back(geom.piece);
    }
  dress_links(model, tree.pieces, geoms_.geometry(), document_.file(), cache_, true);
  contacts_.filter_links(tree, fixed_base);
  set_springs_and_dampers(model, !fixed_base);
  if (whole_ != std::string_view("world")) {
    std::set<std::string> names;
    for (const auto& geoms : tree.geoms)
      for (const MjcfGeom& geom : geoms) names.insert(geom.name);
    contacts_.tell([&](const std::string& name) { return names.contains(name); });
  }
  resolve_leaders(model);
  MjcfRobot out{{}, {}, {}, MjcfMaterials(document_.file())};
  set_materials(tree, out.materials);
  out.tree.model.joints = model.joints;
  const bool several = joint_trees().size() > 1 && whole_ == std::string_view("world");
  out.robot = make_robot(
      std::move(model),
      several ? fmt::format("{}: '{}'", document_.file(), excerpt(robot_name)) : document_.file(),
      cache_);
  out.robot.source = document_.path().generic_string();
  out.robot.frictions = out.materials.list();
  tree.faults.tell(cache_);
  out.tree.geoms = std::move(tree.geoms);
  out.tree.slots = std::move(tree.slots);
  out.tree.links = std::move(tree.links);
  // the order of the tree's links may have changed
  std::map<std::string, int> numbers;
  for (size_t l = 0; l < out.robot.links.size(); ++l)
    numbers[out.robot.links[l].body.name] = static_cast<int>(l);
  for (const auto& [name, number] : out.tree.links) {
    const auto found = numbers.find(out.robot.name + "_" + name);
    out.parts[name] = number == 0 || found == numbers.end() ? -1 : found->second;
  }
  return out;
}

void MjcfModel::tell() {
  document_.repairs().tell();
  document_.losses().tell();
  for (Diagnostic& loss : document_.unused().diagnostics())
    cache_.diagnostics().warn(std::move(loss));
}

}  // namespace clench
