#include "clench/script/bind/world/world_files.h"

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/mjcf_write/written_keys.h"
#include "clench/io/text/confine.h"
#include "clench/io/write/write_mjcf.h"
#include "clench/io/write/write_world.h"
#include "clench/model/build.h"
#include "clench/model/compare_worlds.h"
#include "clench/model/describe_world.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/chunks.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

namespace fs = std::filesystem;

static bool is_script(const fs::path& path) {
  return lower_case(path.extension().string()) == ".lua";
}

namespace {

// its address is the registry key of the table of running scripts
const char running_key = 0;

/// Marks a script as running during its lifetime.
class Running {
 public:
  Running(lua_State* L, const fs::path& path)
      : L_(L), name_(fs::weakly_canonical(path).generic_string()) {
    push_kept_table(L_, &running_key);
    lua_getfield(L_, -1, name_.c_str());
    const bool runs = !lua_isnil(L_, -1);
    lua_pop(L_, 2);
    if (runs) fail("{}: it loads itself", path.filename().string());
    mark(true);
  }
  ~Running() { mark(false); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  void mark(bool runs) const {
    push_kept_table(L_, &running_key);
    runs ? push(L_, true) : push_nil(L_);
    lua_setfield(L_, -2, name_.c_str());
    lua_pop(L_, 1);
  }

  lua_State* L_;
  std::string name_;
};

}  // namespace

// Pushes the world that a script returns. The script receives a table with the root and its own
// folder.
static WorldPtr run_script(lua_State* L, const fs::path& path, const fs::path& root) {
  const std::string file = path.filename().string();
  if (!lua_checkstack(L, 12)) fail(ErrorKind::limit, "too many values on the stack");
  const Running running(L, path);
  const std::string folder = fs::absolute(path).parent_path().lexically_normal().generic_string();
  const ScopedSetting modules(L, Setting::modules, folder);
  if (load_text_file(L, path.string().c_str()) != LUA_OK) fail("{}", string_at(L, -1));
  lua_createtable(L, 0, 1);
  if (!root.empty()) set_field(L, "root", root.generic_string());
  push(L, folder);
  call_script(L, 2, 1, file);
  const auto* handle = to<WorldHandle>(L, -1);
  if (!handle) fail("{}: expected a script that returns a world, got {}", file, described(L, -1));
  return handle->world;
}

WorldPtr push_world_of(lua_State* L, const fs::path& path, const ReadOptions& reading) {
  const Watching watching(L);
  if (is_script(path)) {
    if (!reading.confine.empty())
      fail(
          "{}: a world in Lua is a program, which may read any file; expected another format, as "
          "reading is confined",
          path.filename().string());
    WorldPtr world = run_script(L, path, reading.root);
    if (world->source().empty()) world->set_source(path.generic_string());
    return world;
  }
  const auto world =
      std::make_shared<World>(build_world(read_world(path, reading), reading.diagnostics));
  push_world(L, world);
  add_owned_bodies(L, -1, world->bodies());
  return world;
}

int load_world(lua_State* L) {
  const std::string path = check_string(L, 1, "path");
  Table options(L, 2);
  ReadOptions reading = read_options(L, options);
  read_robot_options(L, options, reading);
  const std::string keyframe = options.string("keyframe", "");
  options.done();
  const WorldPtr world = push_world_of(L, find_file(path, {}, reading), reading);
  if (!keyframe.empty()) world->set_keyframe(keyframe);
  return 1;
}

namespace {

/// Suppresses messages during its lifetime.
class Silence {
 public:
  explicit Silence(lua_State* L) : L_(L), before_(log_level(L)) {
    set_log_level(L, LogLevel::quiet);
  }
  ~Silence() { set_log_level(L_, before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  lua_State* L_;
  LogLevel before_;
};

}  // namespace

static World read_again(lua_State* L, const fs::path& path, const SavingOptions& saving) {
  if (!is_script(path))
    return build_world(read_world(path, {.root = saving.root, .confine = saving.confine}));
  const Silence silence(L);
  // the script itself was written by us
  const ScopedSetting models(L, Setting::confine, saving.confine.string());
  const int top = lua_gettop(L);
  World world = *run_script(L, path, saving.root);
  lua_settop(L, top);
  return world;
}

// reports contents that the written file cannot represent
static void warn_of_losses(lua_State* L, const World& world, const World& again,
                           const std::string& file) {
  const auto lost = differences(world, again);
  if (!lost.empty()) log_warning(L, fmt::format("{} does not hold {}", file, name_list(lost)));
}

bool is_mjcf_target(const World& world, const fs::path& path, const std::string& format) {
  const std::string ending = lower_case(path.extension().string());
  static const std::vector<std::string> formats = {"mjcf", "graspit", "lua"};
  if (!format.empty() && std::ranges::find(formats, format) == formats.end())
    fail("unknown format {}{}", in_quotes(format), instead_of(format, formats));
  const bool is_lua = ending == ".lua", is_wld = ending == ".wld", is_xml = ending == ".xml";
  const bool is_mjcf = ending == ".mjcf";
  const bool fits = format == "mjcf"      ? is_xml || is_mjcf
                    : format == "graspit" ? is_xml || is_wld
                    : format == "lua"     ? is_lua
                                          : true;
  if (!fits && (is_lua || is_wld || is_xml || is_mjcf))
    fail("{}: the format {} is not written to {}", path.filename().string(), in_quotes(format),
         in_quotes(ending));
  const auto is_carried = [&](Id<Robot> id) { return world.robot(id).mounting.has_value(); };
  if (is_xml && format.empty()) return std::ranges::none_of(world.robots(), is_carried);
  return is_mjcf || (is_xml && format == "mjcf");
}

// gains and limits that scripts give to motors of DOFs
static void apply_motor_settings(const RobotDynamics& settings, RobotSpec& robot) {
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    DofSpec& dof = robot.dofs[d];
    if (d < settings.gains.size() && settings.gains[d]) {
      dof.kp = settings.gains[d]->kp;
      dof.kd = settings.gains[d]->kd;
      dof.damping_ratio = 0;
    }
    if (settings.max_effort && dof.max_effort <= 0) dof.max_effort = *settings.max_effort;
  }
}

WorldSpec scene_spec(const World& world) {
  WorldSpec out = describe_world(world);
  for (size_t r = 0; r < out.robots.size(); ++r)
    apply_motor_settings(world.dynamic_settings().robot(world.robots()[r]), out.robots[r].robot);
  return out;
}

// settings of dynamics that scenes cannot represent
static void warn_of_settings(lua_State* L, const World& world) {
  const DynamicSettings& set = world.dynamic_settings();
  const DynamicSettings plain;
  std::vector<std::string> lost;
  if (set.engine != plain.engine) lost.emplace_back("engine");
  if (set.cone != plain.cone) lost.emplace_back("friction cone");
  if (!set.surface_velocities.empty()) lost.emplace_back("belts");
  if (!set.welds.empty()) lost.emplace_back("welds");
  for (const auto& [id, robot] : set.robots) {
    if (!world.alive(id) || !world.robot(id).passive || world.robot(id).passive->actuators.empty())
      continue;
    if (!robot.gains.empty() || robot.max_effort)
      lost.push_back(fmt::format("gains and max_effort of '{}', which has separate actuators",
                                 world.robot(id).name));
  }
  if (!lost.empty())
    log_warning(L, fmt::format("{}: these settings of dynamics are not saved: {}", subject(L),
                               name_list(lost)));
}

SceneRequest scene_of(const World& world, const WorldSpec& spec, const fs::path& path) {
  SceneRequest out{.world = spec, .friction = {}};
  const MaterialTable& table = world.materials();
  out.friction = [&table](const std::string& a, const std::string& b) {
    const Friction both = table.friction(table.index(a), table.index(b));
    return std::array{both.statics, both.kinetic};
  };
  // readers name a single robot after the model
  out.name = spec.robots.size() == 1 ? spec.robots[0].robot.name : path.stem().string();
  out.time_step = world.dynamic_settings().step;
  for (size_t r = 0; r < world.robots().size(); ++r)
    if (!world.dynamic_settings().robot(world.robots()[r]).gravity_compensation)
      out.unsupported.push_back(static_cast<int>(r));
  return out;
}

void save_scene(lua_State* L, const World& world, const fs::path& path, const SavingOptions& saving,
                SceneRequest& request) {
  WriteOptions writing{.root = saving.root, .confine = saving.confine};
  writing.diagnostics = log_losses(L);
  // a scene that could not be loaded is not written
  writing.check = [&](const fs::path& written) {
    if (!world.bodies().empty() && lies_within(written, saving.confine))
      build_world(read_world(written, {.confine = saving.confine}));
  };
  if (world.time() > 0)
    log_warning(L, fmt::format("{}: the time and velocities of a world that has run are not saved",
                               subject(L)));
  warn_of_settings(L, world);
  write_mjcf(request, path, writing);
}

static void save_as_scene(lua_State* L, const World& world, const fs::path& path,
                          const SavingOptions& saving) {
  const WorldSpec spec = scene_spec(world);
  SceneRequest request = scene_of(world, spec, path);
  request.keys.push_back(present_key(spec, "start"));
  for (const KeyframeSpec& keyframe : spec.keyframes) {
    WrittenKey key = key_of(spec, keyframe);
    // the key of the present state replaces an older one
    if (key.name != "start") request.keys.push_back(std::move(key));
  }
  save_scene(L, world, path, saving, request);
}

void save_world(lua_State* L, const World& world, const fs::path& path,
                const SavingOptions& saving) {
  if (is_mjcf_target(world, path, saving.format)) return save_as_scene(L, world, path, saving);
  if (saving.format.empty() && lower_case(path.extension().string()) == ".xml")
    log_warning(L,
                fmt::format("{}: a robot carries another one, so this is an XML world of GraspIt!; "
                            "format = \"mjcf\" writes a scene of MuJoCo",
                            path.filename().string()));
  WriteOptions writing{.root = saving.root, .confine = saving.confine};
  writing.diagnostics = log_losses(L);
  const std::string file = path.filename().string();
  writing.check = [&](const fs::path& written) {
    if (is_script(written) || lies_within(written, saving.confine))
      warn_of_losses(L, world, read_again(L, written, saving), file);
    else
      log_warning(L, fmt::format("{} lies outside of {}, to which reading is confined: contents "
                                 "that it cannot represent are not reported",
                                 file, saving.confine.generic_string()));
  };
  DynamicSettings kept;
  kept.step = world.dynamic_settings().step;
  const bool script = is_script(path);
  for (const auto id : world.robots())
    if (script && world.dynamic_settings().robot(id).floating) kept.robots[id].floating = true;
  if (world.dynamic_settings() != kept)
    log_warning(L, fmt::format("{}: settings of dynamics other than the time step{} are not saved: "
                               "engine, friction cone, gains, max_effort, {}breakaway, gravity "
                               "compensation, belts, welds",
                               subject(L), script ? " and floating bases" : "",
                               script ? "" : "floating bases, "));
  if (world.time() > 0)
    log_warning(
        L,
        fmt::format(
            "{}: the time, velocities and targets of motors of a world that has run are not saved",
            subject(L)));
  write_world(describe_world(world), path, writing);
}

int save_world(lua_State* L) {
  const WorldPtr world = self<WorldHandle>(L).world;
  const fs::path path = check_output(L, 2);
  Table options(L, 3);
  const SavingOptions saving{.root = options.string("root", ""),
                             .confine = read_confine(L, options),
                             .format = options.string("format", "")};
  options.done();
  check_target(path, saving.confine);
  save_world(L, *world, path, saving);
  return 0;
}

}  // namespace clench
