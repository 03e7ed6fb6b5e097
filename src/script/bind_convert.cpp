#include "script/bind_convert.h"

#include "io/convert.h"
#include "script/bind_log.h"
#include "script/guard.h"
#include "script/push.h"
#include "script/read_spec.h"
#include "script/table.h"
#include "script/world_files.h"

namespace clench {

// a world is built on the way, which tells what the new file does not hold: arguments of load, then of save
static void convert_world(lua_State* L, const std::string& to, const std::string& root) {
  lua_pushcfunction(L, guarded<load_world>);
  lua_pushvalue(L, 1);
  lua_pushvalue(L, 3);
  protected_call(L, 2, 1);
  lua_pushcfunction(L, guarded<save_world>);
  lua_insert(L, -2);
  push(L, to);
  lua_createtable(L, 0, 1);
  if (!root.empty()) set_field(L, "root", std::string_view(root));
  protected_call(L, 3, 0);
}

static int convert(lua_State* L) {
  check_count(L, 3);
  const std::string from = check_string(L, 1, "from"), to = check_string(L, 2, "to");
  Table options(L, 3);
  const ReadOptions reading = read_options(L, options);
  options.done();
  lua_settop(L, 3);
  const auto found = find_file(from, {}, reading);
  const FileKind kind = file_kind(found);
  if (kind == FileKind::world)
    convert_world(L, to, reading.root.generic_string());
  else
    convert_file(kind, found, to, reading, {.root = reading.root, .warn = reading.warn});
  return push(L, kind_name(kind));
}

static const Entry functions[] = {
    {"convert", guarded<convert>, R"(
Writes what a file holds as another format, by the ending of `to`: bodies as .xml .iv .obj .off .ply .stl, robots as .cfg
.xml .urdf, worlds as .wld .xml .lua, eigengrasps as .egr .xml, virtual contacts as .vgr .xml. What the format cannot hold is
told in warnings; where it cannot hold the matter itself, that is an error, and nothing is written.
@param from string
@param to string
@param options? {root?: string, unit?: "mm"|"cm"|"m"|"inch"|"foot", mesh_scale?: number}  of reading
@return "body"|"robot"|"world"|"eigengrasps"|"virtual contacts"
> path = os.tmpname()
> clench.convert("models/objects/flask.iv", path .. ".ply")  --> body
> world:add_object(path .. ".ply").mesh:is_watertight()  --> true
> os.remove(path)
> os.remove(path .. ".ply")
> clench.convert("models/objects/flask.iv", "flask.egr")  --> error: wanted a body to .xml, .iv, .obj, .off, .ply or .stl, got '.egr')"},
};

const Library convert_library{.name = "clench", .doc = "", .functions = functions};

}  // namespace clench
