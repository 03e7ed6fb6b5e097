#include <algorithm>
#include <bit>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/write/write_text_worlds.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

std::string as_lua(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (static_cast<unsigned char>(c) < ' ' || c == 127)
      out += fmt::format("\\{:03}", static_cast<int>(c));
    else
      out += c;
  }
  return out + "\"";
}

/// A decimal that Lua reads back bit-exactly: "-0" would be read as an integer, which has no signed
/// zero.
template <class Number>
std::string number(Number x) {
  return x == 0 && std::signbit(x) ? "-0.0" : fmt::format("{}", x);
}

template <class Vector>
std::string list(const Vector& v) {
  std::string out;
  for (const auto x : v) out += (out.empty() ? "" : ", ") + number(x);
  return "{" + out + "}";
}

std::string pose(const Pose& X) {
  const Eigen::Quaterniond& q = X.rotation;
  return fmt::format("{{xyz = {}, quat = {}}}", list(X.position),
                     list(std::array{q.w(), q.x(), q.y(), q.z()}));
}

/// The number x with x / mass == value bit-exactly, if there is one; otherwise the nearest.
double times_mass(double value, double mass) {
  const double near = value * mass;
  for (const double x : {near, std::nextafter(near, -HUGE_VAL), std::nextafter(near, HUGE_VAL)})
    if (x / mass == value) return x;
  return near;
}

std::string inertia(const BodySpec& body) {
  std::string out;
  const Eigen::Matrix3d rows =
      inertia_of(body).unaryExpr([&](double x) { return times_mass(x, body.mass); });
  for (int i = 0; i < 3; ++i) out += (i ? ", " : "") + list(Eigen::Vector3d(rows.row(i)));
  return "{" + out + "}";
}

/// Bit-exact comparison, which includes the signs of zeros.
template <class Matrix>
bool same_bits(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::equal(a.data(), a.data() + a.size(), b.data(), [](double x, double y) {
           return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
         });
}

bool same_bits(const Pose& a, const Pose& b) {
  return same_bits(a.position, b.position) && same_bits(a.rotation.coeffs(), b.rotation.coeffs());
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Properties of a body that differ from those given by its file or its surface alone: keys and
/// values in Lua.
/// together  they are options of one call, which computes an inertia about the given center
Pairs changes(const BodySpec& now, const BodySpec& was, bool together) {
  Pairs out;
  if (now.material != was.material) out.emplace_back("material", as_lua(now.material));
  if (now.mass != was.mass) out.emplace_back("mass", number(now.mass));
  BodySpec then = was;
  if (!same_bits(com_of(now), com_of(was))) {
    out.emplace_back("com", list(com_of(now)));
    if (together) then.com = com_of(now);
  }
  if (!same_bits(inertia_of(now), inertia_of(then))) out.emplace_back("inertia", inertia(now));
  if (now.elastic_modulus != was.elastic_modulus)
    out.emplace_back("elastic_modulus", now.elastic_modulus ? number(*now.elastic_modulus) : "nil");
  if (now.soft_layer != was.soft_layer) out.emplace_back("soft_layer", number(now.soft_layer));
  if (now.poisson_ratio != was.poisson_ratio)
    out.emplace_back("poisson_ratio", number(now.poisson_ratio));
  if (now.restitution != was.restitution) out.emplace_back("restitution", number(now.restitution));
  const auto add = [&](const char* key, double x, double y) {
    if (x != y) out.emplace_back(key, number(x));
  };
  add("free_damping", now.free_damping, was.free_damping);
  add("free_friction", now.free_friction, was.free_friction);
  add("free_armature", now.free_armature, was.free_armature);
  add("gravity_compensation", now.gravity_compensation, was.gravity_compensation);
  const Appearance &look = now.appearance, &old = was.appearance;
  const bool plain =
      (look.triangle_colors.empty() && !old.triangle_colors.empty()) || (!look.skin && old.skin);
  if (look.color != old.color || plain) out.emplace_back("color", list(look.color));
  if (look.transparency != old.transparency)
    out.emplace_back("transparency", number(look.transparency));
  return out;
}

// Round solids, each with the triangles that represent it.
std::string rounds_table(const std::vector<RoundPiece>& pieces) {
  std::string out = "  round = {\n";
  for (const RoundPiece& piece : pieces)
    out += fmt::format(
        "    {{kind = \"{}\", radii = {}, half = {}, pose = {}, first = {}, count = {}}},\n",
        round_kinds[piece.solid.kind], list(piece.solid.radii), number(piece.solid.half),
        pose(piece.X_SR), piece.first + 1, piece.count);
  return out + "  },\n";
}

std::string mesh_table(const Shape& shape) {
  const Mesh& mesh = shape.mesh();
  std::string out = "{\n  vertices = {\n";
  for (const auto& v : mesh.vertices) out += "    " + list(v) + ",\n";
  out += "  },\n  triangles = {\n";
  for (const auto& t : mesh.triangles)
    out += fmt::format("    {{{}, {}, {}}},\n", t[0] + 1, t[1] + 1, t[2] + 1);
  out += "  },\n";
  if (shape.is_round(RoundIn::all)) out += rounds_table(shape.rounds().pieces);
  return out + "}";
}

class LuaWriter {
 public:
  LuaWriter(const WorldSpec& world, SavedFiles& files) : world_(world), files_(files) {}
  std::string write();

 private:
  void begin();
  void add_body(const PlacedBody& placed);
  void add_robot(int index);
  void add_connection(const Connection& c);
  void rename_parts(const RobotSpec& now, const RobotSpec& was, int index);
  void change_parts(const RobotSpec& now, const RobotSpec& was, int index);
  void set_dofs(const PlacedRobot& placed, int index);
  std::string sets_of(const RobotSpec& now, const RobotSpec& was);
  std::string choices_of(const RobotSpec& now, const RobotSpec& was);
  void switch_collision();
  void switch_pairs(const std::vector<std::array<std::string, 2>>& pairs, bool on);
  void add_camera();
  void add_keyframes();
  std::string file(const std::string& path);
  std::string root_option() const { return files_.root().empty() ? "" : ", root = root"; }
  void line(const std::string& text) { out_ += text + "\n"; }

  const WorldSpec& world_;
  SavedFiles& files_;
  std::string out_;
};

/// root .. "/models/objects/mug.iv", or the complete path
std::string LuaWriter::file(const std::string& path) {
  const std::string near = files_.below_root(path);
  return near.empty() ? as_lua(path) : "root .. " + as_lua("/" + near);
}

void LuaWriter::begin() {
  line(
      "-- A world saved by Clench, made again by clench.load(this file). Meters, radians, "
      "kilograms.");
  line("local clench = require \"clench\"");
  if (!files_.root().empty()) {
    // a root above the file is written relative to it, so that both can be moved together
    const fs::path up = files_.root().lexically_relative(files_.folder());
    const bool above =
        std::ranges::all_of(up, [](const fs::path& part) { return part == ".." || part == "."; });
    line("local options, here = ...");
    line("local root = (options or {}).root or " +
         (above ? "here .. " + as_lua("/" + up.generic_string())
                : as_lua(files_.root().generic_string())));
  }
  line("");
  line(world_.contact_threshold ? "local world = clench.world {contact_threshold = " +
                                      number(*world_.contact_threshold) + "}"
                                : "local world = clench.world()");
  if (world_.time_step) line("world.time_step = " + number(*world_.time_step));
  if (world_.gravity) line("world.gravity = " + list(*world_.gravity));
  for (const FrictionSpec& f : world_.friction)
    line(fmt::format("world:set_friction({}, {}, {{static = {}, kinetic = {}{}}})", as_lua(f.a),
                     as_lua(f.b), number(f.statics), number(f.kinetic),
                     f.restitution ? ", restitution = " + number(*f.restitution) : ""));
  if (!world_.robots.empty()) line("local robots = {}");
}

void LuaWriter::add_body(const PlacedBody& placed) {
  const BodySpec& body = placed.body;
  const BodySpec* read = files_.again(body);
  BodySpec bare;
  bare.shape = body.shape;
  std::string made;
  if (read)
    made = file(body.file);
  else if (body.shape)
    made = mesh_table(*body.shape);
  else
    made = file(files_.write_body(body).generic_string());
  if (!read && body.appearance.visual)
    files_.diagnostics().warn(
        fmt::format("the surface that pictures show of '{}' is not saved", excerpt(body.name)));
  if (!read && !body.appearance.triangle_colors.empty())
    files_.diagnostics().warn(
        fmt::format("the colors of the triangles of '{}' are not saved", excerpt(body.name)));
  if (!read && body.appearance.skin)
    files_.diagnostics().warn(
        fmt::format("the textures of '{}' are not saved", excerpt(body.name)));
  std::string options =
      fmt::format("name = {}, pose = {}{}", as_lua(body.name), pose(placed.X_WB), root_option());
  std::string after;
  for (const auto& [key, value] : changes(body, read ? *read : bare, true)) {
    if (value == "nil")
      after += fmt::format("world:body({}).{} = nil\n", as_lua(body.name), key);
    else
      options += fmt::format(", {} = {}", key, value);
  }
  out_ += fmt::format("world:{}({}, {{{}}})\n{}",
                      placed.role == Role::object ? "add_object" : "add_obstacle", made, options,
                      after);
}

// --- robots ---

/// Base and links, with the Lua expression for each.
static std::vector<std::pair<std::string, const BodySpec*>> parts(const RobotSpec& robot,
                                                                  int index) {
  std::vector<std::pair<std::string, const BodySpec*>> out;
  out.emplace_back(fmt::format("robots[{}].base", index + 1), &robot.base);
  int number = 0;
  for (const LinkSpec& link : robot.links)
    out.emplace_back(fmt::format("robots[{}].links[{}]", index + 1, ++number), &link.body);
  return out;
}

void LuaWriter::rename_parts(const RobotSpec& now, const RobotSpec& was, int index) {
  const auto mine = parts(now, index), theirs = parts(was, index);
  std::vector<size_t> renamed;
  for (size_t i = 0; i < mine.size(); ++i) {
    // a part's name begins with the robot's name if it does so in the file
    std::string usual = theirs[i].second->name;
    if (usual.starts_with(was.name)) usual = now.name + usual.substr(was.name.size());
    if (usual != mine[i].second->name) renamed.push_back(i);
  }
  // two passes, because names may have been exchanged
  if (renamed.size() > 1)
    for (const size_t i : renamed)
      line(fmt::format("{}.name = {}", mine[i].first,
                       as_lua(fmt::format("{} (part {})", now.name, i))));
  for (const size_t i : renamed)
    line(fmt::format("{}.name = {}", mine[i].first, as_lua(mine[i].second->name)));
}

void LuaWriter::change_parts(const RobotSpec& now, const RobotSpec& was, int index) {
  const auto mine = parts(now, index), theirs = parts(was, index);
  for (size_t i = 0; i < mine.size(); ++i)
    for (const auto& [key, value] : changes(*mine[i].second, *theirs[i].second, false))
      line(fmt::format("{}.{} = {}", mine[i].first, key, value));
}

void LuaWriter::set_dofs(const PlacedRobot& placed, int index) {
  if (placed.dofs.empty()) return;
  std::string own;
  const auto joints = joints_of(placed.robot);
  for (size_t j = 0; j < placed.joint_positions.size(); ++j)
    if (const JointPosition& q = placed.joint_positions[j])
      own += fmt::format("{}{{{}, {}, {}}}", own.empty() ? "" : ", ", joints[j].chain + 1,
                         joints[j].number + 1, number(*q));
  line(fmt::format("robots[{}]:set_dofs({}{})", index + 1, list(placed.dofs),
                   own.empty() ? "" : ", {joint_positions = {" + own + "}}"));
}

static bool same_vectors(const std::optional<Eigen::VectorXd>& a,
                         const std::optional<Eigen::VectorXd>& b) {
  return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
}

static bool same(const std::optional<EigengraspSet>& a, const std::optional<EigengraspSet>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return same_vectors(a->origin, b->origin) && same_vectors(a->norm, b->norm) &&
         std::ranges::equal(a->grasps, b->grasps, [](const auto& x, const auto& y) {
           return same_bits(x.vector, y.vector) && x.eigenvalue == y.eigenvalue &&
                  x.limits == y.limits;
         });
}

static bool same(const std::optional<std::vector<VirtualContactSpec>>& a,
                 const std::optional<std::vector<VirtualContactSpec>>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return std::ranges::equal(*a, *b, [](const auto& x, const auto& y) {
    return x.link == y.link && same_bits(x.X_LC, y.X_LC) && x.mu == y.mu &&
           same_bits(x.edges, y.edges);
  });
}

/// Sets that the user assigned to the hand are written to files, which options name.
std::string LuaWriter::sets_of(const RobotSpec& now, const RobotSpec& was) {
  std::string out;
  const auto add = [&](const std::string& kind, const std::string& text) {
    const fs::path path = files_.write_beside(now.name + "_" + kind, {{".xml", text}});
    out += ", " + kind + " = " + file(path.generic_string());
  };
  if (now.eigengrasps && !same(now.eigengrasps, was.eigengrasps))
    add("eigengrasps", eigengrasps_xml(*now.eigengrasps));
  if (now.virtual_contacts && !same(now.virtual_contacts, was.virtual_contacts))
    add("virtual_contacts",
        virtual_contacts_xml(contact_set(now.name, chains_of(now), *now.virtual_contacts)));
  return out;
}

/// Options with which the robot was read, and its changed closing directions and approach frame.
std::string LuaWriter::choices_of(const RobotSpec& now, const RobotSpec& was) {
  std::string out, list;
  if (!now.files.body.empty()) out += ", body = " + as_lua(now.files.body);
  if (!now.files.folder.empty()) out += ", folder = " + file(now.files.folder);
  for (const auto& [name, folder] : now.files.packages)
    list += fmt::format("[{}] = {}, ", as_lua(name), file(folder));
  if (!list.empty()) out += fmt::format(", package = {{{}}}", list);
  list.clear();
  for (size_t i = 0; i < now.dofs.size(); ++i) {
    const double v = now.dofs[i].default_velocity;
    if (v != was.dofs[i].default_velocity)
      list += fmt::format("[{}] = {}, ", i + 1, v > 0 ? 1 : v < 0 ? -1 : 0);
  }
  if (!list.empty()) out += fmt::format(", close = {{{}}}", list);
  const bool same_approach = same_bits(now.X_BA.value_or(Pose{}), was.X_BA.value_or(Pose{}));
  if (!same_approach && now.X_BA)
    out += fmt::format(", approach = {{frame = {}}}", pose(*now.X_BA));
  return out;
}

void LuaWriter::add_robot(int index) {
  const PlacedRobot& placed = world_.robots[index];
  const RobotSpec& robot = placed.robot;
  const RobotSpec& read = files_.again(robot);
  line(fmt::format("robots[{}] = world:add_robot({}, {{name = {}, pose = {}{}{}}})", index + 1,
                   file(robot.file), as_lua(robot.name), pose(placed.X_WB), root_option(),
                   choices_of(robot, read) + sets_of(robot, read)));
  if (placed.floating) line(fmt::format("robots[{}].floating = true", index + 1));
  if (!robot.eigengrasps && read.eigengrasps)
    line(fmt::format("robots[{}].eigengrasps = nil", index + 1));
  if (!robot.virtual_contacts && read.virtual_contacts)
    line(fmt::format("robots[{}].virtual_contacts = nil", index + 1));
  rename_parts(robot, read, index);
  change_parts(robot, read, index);
  set_dofs(placed, index);
}

void LuaWriter::add_connection(const Connection& c) {
  std::string adapter, after;
  if (c.mount) {
    const BodySpec* read = files_.again(*c.mount);
    const std::string path = read ? c.mount->file : files_.write_body(*c.mount).generic_string();
    adapter = ", adapter = " + file(path) + root_option();
    const std::string usual = world_.robots[c.child].robot.name + "_mount";
    if (c.mount->name != usual)
      after += fmt::format("world:body({}).name = {}\n", as_lua(usual), as_lua(c.mount->name));
    // a file that was just written holds all properties of the format
    if (read)
      for (const auto& [key, value] : changes(*c.mount, *read, false))
        after += fmt::format("world:body({}).{} = {}\n", as_lua(c.mount->name), key, value);
  }
  const RobotSpec& parent = world_.robots[c.parent].robot;
  const auto place = place_of(chains_of(parent), c.link);
  const bool last = chain_ending_at(parent, c.link).has_value();
  const std::string where = last ? fmt::format("chain = {}", place.chain + 1)
                                 : "link = " + as_lua(parent.links[c.link].body.name);
  line(fmt::format("robots[{}]:mount_on(robots[{}], {{{}, pose = {}{}}})", c.child + 1,
                   c.parent + 1, where, pose(c.X_LB), adapter));
  out_ += after;
}

// --- collisions and sensors ---

void LuaWriter::switch_pairs(const std::vector<std::array<std::string, 2>>& pairs, bool on) {
  if (pairs.empty()) return;
  line("for _, pair in ipairs {");
  for (const auto& [a, b] : pairs) line(fmt::format("  {{{}, {}}},", as_lua(a), as_lua(b)));
  line("} do");
  line(fmt::format("  world:set_collision({}, world:body(pair[1]), world:body(pair[2]))", on));
  line("end");
}

void LuaWriter::switch_collision() {
  if (!world_.collision) return;
  const CollisionSpec& spec = *world_.collision;
  line("");
  if (!world_.robots.empty()) {
    line("-- all that may not collide, neighbors too");
    line("for _, a in ipairs(robots) do");
    line("  for _, b in ipairs(robots) do world:set_collision(true, a, b) end");
    line("end");
  }
  switch_pairs(spec.pairs_off, false);
  if (!spec.bits.empty()) {
    line("for _, of in ipairs {");
    for (const auto& [name, bits] : spec.bits)
      line(fmt::format("  {{{}, {{type = {}, affinity = {}, fixed = {}}}}},", as_lua(name),
                       static_cast<int>(bits.type), static_cast<int>(bits.affinity), bits.stands));
    line("} do");
    line("  world:set_collision_bits(world:body(of[1]), of[2])");
    line("end");
  }
  switch_pairs(spec.pairs_on, true);
  for (const auto& name : spec.bodies_off)
    line(fmt::format("world:set_collision(false, world:body({}))", as_lua(name)));
  if (!spec.on) line("world:set_collision(false)");
}

void LuaWriter::add_camera() {
  if (!world_.camera) return;
  line(fmt::format("world.camera = {{pose = {}, focal_distance = {}}}", pose(world_.camera->X_WC),
                   number(world_.camera->focal_distance)));
}

void LuaWriter::add_keyframes() {
  for (const KeyframeSpec& keyframe : world_.keyframes) {
    line(fmt::format("world:add_keyframe({}, {{", as_lua(keyframe.name)));
    for (const auto& placed : keyframe.bodies)
      line(fmt::format("  {{body = world:body({}), pose = {}}},",
                       as_lua(world_.bodies[placed.body].body.name), pose(placed.X_WB)));
    for (const auto& placed : keyframe.robots)
      line(fmt::format("  {{robot = robots[{}], {}dofs = {}}},", placed.robot + 1,
                       placed.X_WB ? "pose = " + pose(*placed.X_WB) + ", " : "",
                       list(placed.dofs)));
    line("})");
  }
}

std::string LuaWriter::write() {
  begin();
  std::vector<bool> connected(world_.connections.size());
  for (const WorldEntry& entry : world_.order) {
    if (entry.kind == WorldEntry::Kind::body) {
      add_body(world_.bodies[entry.index]);
    } else if (entry.kind == WorldEntry::Kind::robot) {
      add_robot(entry.index);
    } else {
      add_connection(world_.connections[entry.index]);
      connected[entry.index] = true;
    }
  }
  for (size_t i = 0; i < connected.size(); ++i)
    if (!connected[i]) add_connection(world_.connections[i]);
  switch_collision();
  add_camera();
  add_keyframes();
  line("return world");
  return std::move(out_);
}

}  // namespace

std::string text_of_lua(const WorldSpec& world, SavedFiles& files) {
  return LuaWriter(world, files).write();
}

}  // namespace clench
