#include "clench/base/file.h"
#include "clench/io/grasp_files.h"
#include "clench/script/bind/grasp/dof_order.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/json.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

static int list_grasps(lua_State* L) {
  GraspList list;
  std::optional<GraspFormat> format_read;
  if (given(L, 1)) {
    const std::string path = check_string(L, 1, "path");
    Table options(L, 2);
    const ReadOptions reading = read_options(L, options);
    const std::string format = options.string("format", "");
    const NamedOrder order = read_dof_order(options);
    const auto* hand = options.object<RobotHandle>("hand");
    options.done();
    const std::string place = subject(L);
    bool has_names = false;
    const Watching watching(L);
    const auto add = [&](GraspSpec&& spec) {
      has_names = has_names || !spec.dof_names.empty();
      if (order.is_given() && spec.dof_names.empty() && !spec.dofs.empty())
        name_dofs(spec, order, hand ? &**hand : nullptr, place);
      Grasp grasp;
      static_cast<GraspSpec&>(grasp) = std::move(spec);
      list.grasps.push_back({nullptr, std::move(grasp)});
    };
    format_read = read_grasp_file(
        path, {.add = add, .expect = [&](size_t n) { list.grasps.reserve(n); }}, format, reading);
    if (order.is_given() && has_names)
      reading.diagnostics.warn(Place(std::filesystem::path(path).filename().string()),
                               "it names its DOFs, so dof_order is not used");
  }
  push_object(L, std::move(list));
  if (!format_read) return 1;
  push(L, grasp_format_name(*format_read));
  return 2;
}

static int grasps_add(lua_State* L) {
  auto& list = self<GraspList>(L);
  list.grasps.push_back(check_object<GraspHandle>(L, 2, "grasp"));
  return push(L, static_cast<int>(list.grasps.size()));
}

static int grasps_save(lua_State* L) {
  const auto& list = self<GraspList>(L);
  const std::string path = check_output(L, 2);
  std::vector<GraspSpec> specs;
  for (const GraspHandle& handle : list.grasps) specs.push_back(handle.grasp);
  Table options(L, 3);
  const std::string format = options.string("format", "");
  WriteOptions writing{.diagnostics = log_losses(L)};
  if (options.has("notes")) {
    options.push("notes");
    writing.notes = lua_istable(L, -1) ? write_json(L, lua_gettop(L)) : "";
    if (!writing.notes.starts_with('{'))
      fail("{}: notes: expected a table of names and plain data, got {}", options.subject(),
           described(L, -1));
    lua_pop(L, 1);
  }
  writing.compress = options.boolean("compress", false);
  options.done();
  write_grasp_file(specs, path, format, writing);
  return 0;
}

static int grasps_check_save(lua_State* L) {
  self<GraspList>(L);
  const std::string path = check_output(L, 2);
  Table options(L, 3);
  const std::string format = options.string("format", "");
  options.done();
  const GraspFormat known = grasp_format_to_write(path, format);
  check_writable(path);
  return push(L, grasp_format_name(known));
}

static int grasps_item(lua_State* L) {
  const auto& list = self<GraspList>(L);
  const bool is_index = lua_isinteger(L, 2);
  const lua_Integer i = is_index ? lua_tointeger(L, 2) : 0;
  if (i < 1 || i > std::ssize(list.grasps)) return push_nil(L);
  return push(L, list.grasps[static_cast<size_t>(i) - 1]);
}

static const std::vector<GraspHandle>& items_of(const GraspList& list) { return list.grasps; }

static const Entry grasps_functions[] = {
    {"grasps", guarded<list_grasps>, R"(
A list of grasps: empty, or read from a file in any format that `save` writes; the ending or `format` selects it, and
for `.json` and `.txt` files the contents do. Its grasps belong to no world: they have the file's contacts, posture
and measures, and `apply` puts them into a world.
@param path? string  file of grasps to read; without it the list is empty
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@option format? "jsonl"|"csv"|"npz"|"isaac_grasp"|"graspgen"|"multigripper"|"graspit"  instead of that of the file name; graspit: results of its planner
@option dof_order? string|string[]  names of DOFs that the file does not name: a list, "isaac" (breadth first) or "hand" (in the order of the DOFs of `hand`)
@option hand? robot  hand to which dof_order refers
@return grasps list, string? format  of the file
@effect files
> list = clench.grasps()
> list:add(grasp)
> path = os.tmpname()
> list:save(path)
> again = clench.grasps(path)
> os.remove(path)
> #again, again[1].hand_name == hand.name, again[1]:wrench_space():epsilon() == grasp:quality "epsilon"  --> 1, true, true
> again[1].hand  --> error: grasp:apply(world) gives one that does
> clench.grasps "no.jsonl"  --> error: no such file: no.jsonl
> clench.grasps("no.jsonl", {format = "cvs"})  --> error: no such file: no.jsonl)"},
};

static const Entry grasps_methods[] = {
    {"add", guarded<grasps_add>, R"(
Appends a copy of a grasp, including its measures.
@param grasp grasp  grasp to append
@return integer count
@effect edits
> clench.grasps():add(grasp)  --> 1)"},
    {"save", guarded<grasps_save>, R"(
Writes the list. JSON lines (`.jsonl`, or no ending) store everything: a head with the version, then a grasp on each line, with bit-exact numbers.
`.csv`, `.npz` and `.yaml` (NVIDIA's isaac_grasp) are selected by their endings, too, `.json` of GraspGen and MultiGripperGrasp by
`format`; a warning names everything that a format cannot represent. The same list gives the same bytes.
@param path string  file to write; its ending selects the format
@param options? table  how it is written
@option format? string  as clench.grasps takes it
@option notes? table  plain data about the list as such, for the head of JSON lines
@option compress? boolean = false  true: compressed arrays in an .npz
@effect files
> list = clench.grasps()
> list:save("grasps.json")  --> error: .json may be several formats
> list:save("grasps.csv", {compress = true})  --> error: only .npz is compressed, got csv
> list:save("grasps.jsonl", {notes = {}})  --> error: notes: expected a table of names and plain data
> list:save "grasps.txt"  --> error: expected a name that ends in .jsonl, .csv, .npz, .yaml or .json, or a format
> list:save("grasps.txt", {format = "cvs"})  --> error: unknown format 'cvs', expected one of jsonl, csv
> list:save "no_such_folder/grasps.jsonl"  --> error: no such folder)"},
    {"check_save", guarded<grasps_check_save>, R"(
Checks that `save` can write there, for instance before a long search: the format is known, the folder exists, and file and
folder are writable. Changes no file.
@param path string  file that is to be written; its ending selects the format
@param options? table  how it would be written
@option format? string  as clench.grasps takes it
@return string format
@effect files
> clench.grasps():check_save "build/grasps.csv"  --> csv
> clench.grasps():check_save "grasps.json"  --> error: .json may be several formats
> clench.grasps():check_save "no_such_folder/grasps.jsonl"  --> error: no such folder)"},
};

static const Entry grasps_operators[] = {
    {"__index", guarded<grasps_item>, ""},
    {"__len", method<[](const GraspList& x) { return static_cast<int>(x.grasps.size()); }>, ""},
    {"__json", method<items_of>, ""},
    {"__tostring",
     method<[](const GraspList& x) { return fmt::format("{} grasps", x.grasps.size()); }>, ""},
};

const Library grasps_library{.name = "clench", .doc = "", .functions = grasps_functions};

const Class grasps_class{
    .name = "grasps",
    .variable = "list",
    .doc = "A list of grasps, made by `clench.grasps`: `list[1]`, `#list`, `ipairs(list)`.",
    .methods = grasps_methods,
    .operators = grasps_operators};

}  // namespace clench
