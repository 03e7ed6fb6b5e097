// Reads an MJCF scene as a world.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/io/mjcf/bodies/mjcf_tree_weight.h"
#include "clench/io/mjcf/document/mjcf_options.h"
#include "clench/io/mjcf/document/solver_settings.h"
#include "clench/io/mjcf/geoms/mjcf_materials.h"
#include "clench/io/mjcf/mjcf.h"
#include "clench/io/mjcf/mjcf_keyframes.h"
#include "clench/io/text/repair_names.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

// each pair takes about 100 bytes of memory in the world
constexpr size_t max_excluded = 500'000;
constexpr size_t max_robots = 1000;

/// A body or a part of a robot, with its data for collision filters.
struct ScenePart {
  PartRef ref;
  std::string name;
  std::vector<MjcfGeom> geoms;  // only colliding ones
  bool fixed = false;           // to the world
};

/// Equal for parts of one robot, different for all others.
std::pair<int, int> part_owner(const PartRef& ref) {
  return {static_cast<int>(ref.kind), ref.index};
}

std::array<int, 3> part_key(const PartRef& ref) {
  return {static_cast<int>(ref.kind), ref.index, ref.link};
}

class SceneReader {
 public:
  SceneReader(const fs::path& path, FileCache& cache)
      : cache_(cache), model_(path, cache, "world"), materials_(model_.document().file()) {}
  WorldSpec read();

 private:
  void add_geom(const WorldGeom& from);
  void add_body(const TopBody& body);
  void add_robot(const TopBody& body, SceneBody& scene);
  void add_object(const TopBody& body, SceneBody& scene);
  void add_obstacles(const TopBody& body, SceneBody& scene);
  int add_thing(const std::string& name, Role role, const Pose& X_WB, LinkPieces pieces,
                const std::vector<MjcfGeom>& geoms, const BodySpec* weighed);
  void dress_things();
  std::vector<OwnFriction> used_frictions(const RobotSpec& robot) const;
  void check_empty();
  void exclude();
  void set_bits();
  void add_part(PartRef ref, const std::string& name, const std::vector<MjcfGeom>& geoms,
                bool fixed);
  void keep_apart(PartRef a, PartRef b);
  const std::vector<PartRef>& parts_of(const XmlValues& exclude, const char* body);

  FileCache& cache_;
  MjcfModel model_;
  WorldSpec world_;
  TreeModel things_;  // bodies of the world outside of robots, one per link
  std::vector<LinkPieces> thing_pieces_;
  std::vector<ScenePart> parts_;
  std::map<std::array<int, 3>, size_t> part_numbers_;  // by kind, index and link
  MjcfListedBodies listed_;                            // of parts_
  std::map<std::string, std::vector<PartRef>> by_name_;
  std::vector<PartRef> of_world_;  // geoms of the world itself
  std::set<std::string> geom_names_;
  std::vector<SceneBody> scene_;  // one per body directly in the world
  MjcfMaterials materials_;
  int trees_ = 0;
};

// --- bodies ---

void SceneReader::add_part(PartRef ref, const std::string& name, const std::vector<MjcfGeom>& geoms,
                           bool fixed) {
  ScenePart part{ref, name, {}, fixed};
  for (const MjcfGeom& geom : geoms) {
    if (geom.collides()) part.geoms.push_back(geom);
    geom_names_.insert(geom.name);
  }
  part_numbers_.emplace(part_key(ref), parts_.size());
  parts_.push_back(std::move(part));
}

/// Adds an object or obstacle, whose shape is set when all are known.   returns  its index in the
/// world
int SceneReader::add_thing(const std::string& name, Role role, const Pose& X_WB, LinkPieces pieces,
                           const std::vector<MjcfGeom>& geoms, const BodySpec* weighed) {
  const int number = static_cast<int>(world_.bodies.size());
  TreeLink link;
  if (weighed) link.body = *weighed;
  link.body.name = name;
  link.body.source = model_.document().path().generic_string();
  pieces.has_inertial = weighed;
  things_.links.push_back(link);
  thing_pieces_.push_back(std::move(pieces));
  PlacedBody placed;
  placed.role = role;
  placed.X_WB = X_WB;
  placed.body.material = materials_.of(geoms, name);
  if (is_friction_given(geoms)) placed.body.material_from = Origin::file;
  world_.bodies.push_back(std::move(placed));
  world_.order.push_back({WorldEntry::Kind::body, number});
  const PartRef ref{WorldEntry::Kind::body, number, -1};
  add_part(ref, name, geoms, role == Role::obstacle);
  return number;
}

static void add_piece(LinkPieces& into, const MjcfGeom& geom, const Pose& X) {
  GeometryPiece piece = geom.piece;
  piece.X_LG = X * piece.X_LG;
  if (geom.collides()) into.collision.push_back(piece);
  if (geom.drawn) into.visual.push_back(piece);
}

void SceneReader::add_geom(const WorldGeom& from) {
  auto geom = model_.geoms().read(from.node->element, from.child_class, from.X_frame, true);
  if (!geom) return;
  const Pose X = geom->piece.X_LG;
  const std::string name = from.node->element.attribute("name").value_or("");
  LinkPieces pieces;
  pieces.place = from.node->element.place();
  add_piece(pieces, *geom, X.inverse());
  if (pieces.collision.empty() && pieces.visual.empty()) return;
  // the inverse has rounding errors
  for (auto* list : {&pieces.collision, &pieces.visual})
    for (GeometryPiece& piece : *list) piece.X_LG = Pose{};
  BodySpec weighed;
  weighed.mass = geom->mass;
  const int number =
      add_thing(name.empty() ? "world_geom" : name, Role::obstacle, X, std::move(pieces), {*geom},
                mass_rule.allows(geom->mass) ? &weighed : nullptr);
  of_world_.push_back({WorldEntry::Kind::body, number, -1});
}

/// Adds a free body and all bodies fixed to it as one body.
void SceneReader::add_object(const TopBody& body, SceneBody& scene) {
  MjcfTree tree = model_.read_tree(body);
  tree.faults.tell(cache_);
  const auto X = tree_poses(tree.model);
  LinkPieces pieces;
  pieces.place = body.node->element.place();
  std::vector<MjcfGeom> geoms;
  for (size_t i = 0; i < X.size(); ++i)
    for (const MjcfGeom& geom : tree.geoms[i]) {
      add_piece(pieces, geom, X[i]);
      geoms.push_back(geom);
    }
  const auto weighed = weigh_tree(tree, X);
  const int number = add_thing(body.name, Role::object, scene.X_WB, std::move(pieces), geoms,
                               weighed ? &*weighed : nullptr);
  const BodySpec& first = tree.model.links[0].body;
  BodySpec& made = things_.links.back().body;
  made.free_damping = first.free_damping;
  made.free_friction = first.free_friction;
  made.free_armature = first.free_armature;
  made.gravity_compensation = mean_gravity_compensation(tree);
  scene.bodies.push_back({number, Pose{}});
  scene.free = true;
  for (const auto& [name, link] : tree.links)
    by_name_[name] = {{WorldEntry::Kind::body, number, -1}};
}

/// Adds a fixed body and those attached to it as obstacles, one per body with geoms.
void SceneReader::add_obstacles(const TopBody& body, SceneBody& scene) {
  MjcfTree tree = model_.read_tree(body);
  const auto X = tree_poses(tree.model);
  for (size_t i = 0; i < X.size(); ++i) {
    LinkPieces pieces;
    pieces.place = tree.pieces[i].place;
    for (const MjcfGeom& geom : tree.geoms[i]) add_piece(pieces, geom, Pose{});
    if (pieces.collision.empty() && pieces.visual.empty()) continue;
    const std::string& name = tree.model.links[i].body.name;
    const int number =
        add_thing(name, Role::obstacle, scene.X_WB * X[i], std::move(pieces), tree.geoms[i],
                  tree.pieces[i].has_inertial ? &tree.model.links[i].body : nullptr);
    scene.bodies.push_back({number, X[i]});
    by_name_[name] = {{WorldEntry::Kind::body, number, -1}};
  }
}

void SceneReader::add_robot(const TopBody& body, SceneBody& scene) {
  const int number = static_cast<int>(world_.robots.size());
  if (world_.robots.size() == max_robots)
    body.node->element.fail(
        "expected at most {} trees of joints, each of which is a robot, got more", max_robots);
  MjcfRobot made = model_.scene_robot(body, trees_++ == 0);
  PlacedRobot placed;
  placed.X_WB = body.own_joints ? Pose{} : scene.X_WB;
  placed.floating = body.free;
  RobotSpec& robot = made.robot;
  std::vector<bool> fixed(robot.links.size());
  for (size_t l = 0; l < fixed.size(); ++l)
    fixed[l] = robot.links[l].joints.empty() &&
               (robot.links[l].parent < 0 || fixed[robot.links[l].parent]);
  const bool stands = !body.free && !body.mocap;
  for (const auto& [name, link] : made.parts) {
    const auto& geoms = made.tree.geoms[made.tree.links.at(name)];
    BodySpec& part = link < 0 ? robot.base : robot.links[link].body;
    part.material = materials_.of(geoms, part.name);
    if (is_friction_given(geoms)) part.material_from = Origin::file;
    const PartRef ref{WorldEntry::Kind::robot, number, link};
    add_part(ref, part.name, geoms, stands && (link < 0 || fixed[link]));
    by_name_[name] = {ref};
  }
  for (const DofSpec& dof : robot.dofs) placed.dofs.push_back(dof.default_value);
  scene.robot = number;
  scene.free = body.free;
  scene.slots = std::move(made.tree.slots);
  scene.joints = std::move(made.tree.model.joints);
  placed.robot = std::move(robot);
  world_.robots.push_back(std::move(placed));
  world_.order.push_back({WorldEntry::Kind::robot, number});
}

void SceneReader::add_body(const TopBody& body) {
  SceneBody scene;
  scene.mocap = body.mocap;
  scene.X_WB = body.X_frame * model_.document().pose(XmlValues(body.node->element));
  if (body.joints > 0)
    add_robot(body, scene);
  else if (body.free)
    add_object(body, scene);
  else
    add_obstacles(body, scene);
  scene_.push_back(std::move(scene));
}

/// Sets shapes and appearance of all bodies outside of robots.
void SceneReader::dress_things() {
  if (things_.links.empty()) return;
  dress_links(things_, thing_pieces_, model_.geoms().geometry(), model_.document().file(), cache_,
              true);
  for (size_t i = 0; i < things_.links.size(); ++i) {
    BodySpec& body = things_.links[i].body;
    repair_names(body, thing_pieces_[i].place, cache_.options());
    body.material = std::move(world_.bodies[i].body.material);
    body.material_from = world_.bodies[i].body.material_from;
    world_.bodies[i].body = std::move(body);
  }
}

/// Frictions of the scene that are used by parts of the robot.
std::vector<OwnFriction> SceneReader::used_frictions(const RobotSpec& robot) const {
  std::set<std::string> materials = {robot.base.material};
  for (const LinkSpec& link : robot.links) materials.insert(link.body.material);
  std::vector<OwnFriction> out = world_.frictions;
  std::erase_if(out,
                [&](const OwnFriction& own) { return !materials.contains(material_name(own)); });
  return out;
}

// --- collision filters ---

void SceneReader::keep_apart(PartRef a, PartRef b) {
  if (world_.never_meet.size() == max_excluded)
    fail("{}: expected at most {} pairs of excluded bodies, got more", model_.document().file(),
         max_excluded);
  world_.never_meet.push_back({a, b});
}

/// The parts created from a body named in an <exclude>; empty, with a warning, for an unknown body.
const std::vector<PartRef>& SceneReader::parts_of(const XmlValues& exclude, const char* body) {
  static const std::vector<PartRef> none;
  const std::string name = exclude.text(body);
  if (name == "world") return of_world_;
  if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
  cache_.diagnostics().warn(exclude.element().place().of("exclude"),
                            "no body {} was read; the exclusion is ignored", in_quotes(name));
  return none;
}

void SceneReader::exclude() {
  for (const MjcfNode* node : model_.document().section("contact")) {
    check_stop();
    if (node->name() == "pair") continue;
    if (node->name() != "exclude") {
      model_.document().unused().element(node->element);
      continue;
    }
    model_.document().unused().attributes(node->element, {"name", "class", "body1", "body2"});
    const XmlValues values(node->element);
    const auto &first = parts_of(values, "body1"), &second = parts_of(values, "body2");
    for (const PartRef& a : first)
      for (const PartRef& b : second) {
        if (a.kind == b.kind && a.index == b.index) continue;
        const auto both = std::minmax(part_numbers_.at(part_key(a)), part_numbers_.at(part_key(b)));
        if (!listed_.contains(both)) keep_apart(a, b);
      }
  }
}

/// Sets the collision bits of the parts, unless all parts collide with each other anyway. Pairs of
/// bodies with geoms listed by a <pair> collide regardless of their bits.
void SceneReader::set_bits() {
  std::vector<MjcfPart> parts;
  for (const ScenePart& part : parts_)
    parts.push_back({MjcfBits(part.geoms), part.fixed, part_owner(part.ref), part.name});
  const MjcfKeptApart apart = model_.contacts().kept_apart(parts, listed_);
  if (apart.by_bits + apart.fixed == 0) return;
  for (size_t i = 0; i < parts_.size(); ++i) {
    const MjcfBits& bits = parts[i].bits;
    if (!parts_[i].geoms.empty())
      world_.collision_bits.emplace_back(parts_[i].ref,
                                         CollisionBits{bits.type, bits.affinity, parts_[i].fixed});
  }
  for (const auto& [i, j] : apart.listed)
    world_.always_meet.push_back({parts_[i].ref, parts_[j].ref});
  if (apart.by_bits > 0)
    cache_.diagnostics().note(
        Place(model_.document().file()),
        "{} pair{} of bodies never collide{} because of contype and conaffinity", apart.by_bits,
        apart.by_bits == 1 ? "" : "s", apart.by_bits == 1 ? "s" : "");
}

/// Accepts a scene without bodies if its <worldbody> is empty, too.
void SceneReader::check_empty() {
  const Worldbody& worldbody = model_.worldbody();
  const auto& sections = model_.document().root().children;
  const bool is_given = std::ranges::any_of(
      sections, [](const MjcfNode& node) { return node.name() == "worldbody"; });
  if (is_given && worldbody.order.empty() && !worldbody.lacks_bodies) return;
  const auto& types = model_.geoms().unused_types();
  fail("{}: expected bodies or geoms in <worldbody>, got {}", model_.document().file(),
       types.empty() ? "none" : "only geoms that are not used, of type " + name_list(types));
}

WorldSpec SceneReader::read() {
  const Worldbody& worldbody = model_.worldbody();
  const ReadOptions& options = cache_.options();
  const size_t trees = model_.joint_trees().size();
  if (trees != 1 &&
      (!options.closing.empty() || !options.closing_by_number.empty() || options.approach))
    fail(
        "{}: {}: expected a file of one robot, got {}; world:add_robot with the option 'body' "
        "takes one of them",
        model_.document().file(),
        options.closing.empty() && options.closing_by_number.empty() ? "approach" : "close", trees);
  for (const auto& [is_body, number] : worldbody.order) {
    if (is_body)
      add_body(worldbody.bodies[number]);
    else
      add_geom(worldbody.geoms[number]);
  }
  if (world_.bodies.empty() && world_.robots.empty()) check_empty();
  if (trees == 0)
    for (const char* section : {"equality", "tendon", "actuator"})
      for (const MjcfNode* node : model_.document().section(section))
        model_.document().unused().element(node->element);
  dress_things();
  world_.frictions = materials_.list();
  for (PlacedRobot& placed : world_.robots) placed.robot.frictions = used_frictions(placed.robot);
  materials_.tell(cache_);
  read_mjcf_options(model_.document(), cache_, world_);
  world_.contact_threshold = written_threshold(model_.document());
  std::vector<const std::vector<MjcfGeom>*> geoms;
  for (const ScenePart& part : parts_) geoms.push_back(&part.geoms);
  listed_ = model_.contacts().listed(geoms);
  exclude();
  set_bits();
  model_.contacts().tell([&](const std::string& name) { return geom_names_.contains(name); });
  read_mjcf_keyframes(model_.document(), scene_, worldbody.lacks_bodies, cache_, world_);
  model_.tell();
  return std::move(world_);
}

}  // namespace

WorldSpec read_world_mjcf(const fs::path& path, FileCache& cache) {
  return SceneReader(path, cache).read();
}

}  // namespace clench
