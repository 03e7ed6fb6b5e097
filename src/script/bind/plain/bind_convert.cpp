#include "clench/base/text.h"
#include "clench/io/convert.h"
#include "clench/io/text/confine.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/bind/world/world_files.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

static std::vector<std::string> dof_names_option(Table& options) {
  std::vector<std::string> out;
  if (options.has("dof_order"))
    options.each("dof_order", "a list of names", [&](int i, const What& what) {
      out.push_back(read_string(options.state(), i, what));
    });
  return out;
}

static int convert(lua_State* L) {
  const std::string from = check_string(L, 1, "from"), to = check_output(L, 2, "to");
  Table options(L, 3);
  ReadOptions reading = read_options(L, options);
  check_target(to, reading.confine);
  const auto found = find_file(from, {}, reading);
  std::error_code code;
  if (std::filesystem::equivalent(found, to, code))
    fail("{}: expected another file to write, got the same", to);
  const FileKind kind = file_kind(found);
  if (kind == FileKind::robot) read_robot_options(L, options, reading);
  GraspConversion grasps;
  std::string format;
  if (is_grasp_list(kind)) {
    grasps.format = options.string("format", "");
    grasps.dof_names = dof_names_option(options);
  } else if (kind == FileKind::world || kind == FileKind::robot) {
    format = options.string("format", "");
  }
  options.done();
  const std::string ending = ending_of(to);
  const bool as_world = kind == FileKind::robot && (ending == ".lua" || ending == ".wld" ||
                                                    ending == ".xml" || ending == ".mjcf");
  if (kind == FileKind::robot && !as_world && ending != ".urdf")
    fail("{}: expected a robot to .urdf, or its world to .xml, .mjcf, .lua or .wld, got {}", to,
         in_quotes(ending));
  if (kind == FileKind::world ||
      as_world)  // intermediate world, which reports contents that the new file cannot represent
    save_world(L, *push_world_of(L, found, reading), to,
               {.root = reading.root, .confine = reading.confine, .format = format});
  else
    convert_file(
        kind, found, to, reading,
        {.root = reading.root, .confine = reading.confine, .diagnostics = reading.diagnostics},
        grasps);
  return push(L, kind_name(as_world ? FileKind::world : kind));
}

static const Entry convert_functions[] = {
    {"convert", guarded<convert>, R"(
Converts a file to another format, by the ending of `to`: bodies as .xml .iv .obj .off .ply .stl, robots as
.urdf, robots and worlds as scenes of MuJoCo, .xml .mjcf, or as .wld .lua, eigengrasps as .egr .xml, virtual contacts as .vgr .xml,
lists of grasps as .jsonl .csv .npz .yaml, or in the given `format`. Warnings name everything that the format cannot represent.
@param from string  file to read
@param to string  file to write; its ending selects the format
@param options? table  how the file is read and written
@like clench.load  root, confine, strict, unit, mesh_scale, folder, body, package, eigengrasps, virtual_contacts, close, approach
@option format? string  of worlds as world:save takes it; of grasps that of the file to read, as clench.grasps takes it
@option dof_order? string[]  of grasps: names of DOFs that the file does not name
@return "body"|"robot"|"world"|"eigengrasps"|"virtual contacts"|"grasps"|"planned grasps" # what was read
@effect files
> path = os.tmpname()
> clench.convert("models/objects/flask.iv", path .. ".ply")  --> body
> world:add_object(path .. ".ply").mesh:is_watertight()  --> true
> os.remove(path)
> os.remove(path .. ".ply")
> clench.convert("models/objects/flask.iv", "flask.egr")  --> error: expected a body to .xml, .iv, .obj, .off, .ply or .stl, got '.egr')"},
};

const Library convert_library{.name = "clench", .doc = "", .functions = convert_functions};

}  // namespace clench
