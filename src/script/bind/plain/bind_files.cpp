#include <algorithm>

#include "clench/base/convert.h"
#include "clench/base/file.h"
#include "clench/base/folder.h"
#include "clench/base/text.h"
#include "clench/contact/friction_edges.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/graspit/inventor_primitives.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/text/confine.h"
#include "clench/io/text/csv.h"
#include "clench/io/text/find_file.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/lua_budget.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

namespace fs = std::filesystem;

// applies a reader to the file named by argument 1, with the options of argument 2
template <class Value>
static Value read_with(lua_State* L, Value (*read)(const fs::path&, const ReadOptions&)) {
  const std::string path = check_string(L, 1, "path");
  Table options(L, 2);
  const ReadOptions reading = read_options(L, options);
  options.done();
  return read(find_file(path, {}, reading), reading);
}

static int save_text(lua_State* L) {
  const std::string path = check_output(L, 1);
  if (lua_type(L, 2) != LUA_TSTRING) fail_expected({L, {}, "text"}, "a text", 2);
  write_file(path, string_at(L, 2));
  return 0;
}

static int append_text(lua_State* L) {
  const std::string path = check_output(L, 1);
  if (lua_type(L, 2) != LUA_TSTRING) fail_expected({L, {}, "text"}, "a text", 2);
  append_file(path, string_at(L, 2));
  return 0;
}

static int check_writable_file(lua_State* L) {
  check_writable(check_output(L, 1));
  return 0;
}

static std::string bytes_of(const fs::path& path, const ReadOptions&) { return read_bytes(path); }

static int read_whole(lua_State* L) { return push(L, std::string_view(read_with(L, bytes_of))); }

// like the path of a file: "models/..." and "worlds/..." are also those that come with Clench
static fs::path find_folder(const std::string& name, const ReadOptions& reading) {
  const fs::path folder = name.empty() ? "." : fs::path(name);
  std::error_code ignored;
  const bool may_be_installed = *folder.begin() == "models" || *folder.begin() == "worlds";
  const bool is_installed =
      may_be_installed && !reading.home.empty() && !fs::exists(folder, ignored);
  const fs::path found = is_installed ? reading.home / folder : folder;
  if (!lies_within(found, reading.confine)) fail_outside(name, reading);
  return found;
}

static int list(lua_State* L) {
  const std::string name = check_string(L, 1, "folder");
  const FolderContents contents = list_folder(find_folder(name, read_places(L, 2)));
  return push_record(L, {{"folders", contents.folders}, {"files", contents.files}});
}

static int exists(lua_State* L) {
  const std::string name = check_string(L, 1, "path");
  const ReadOptions reading = read_places(L, 2);
  if (!lies_within(name, reading.confine)) fail_outside(name, reading);
  std::error_code ignored;
  return push(L, fs::exists(name, ignored));
}

static int make_new_folder(lua_State* L) {
  make_folder(check_output(L, 1));
  return 0;
}

// --- comma-separated values, for clench.csv ---

static char check_separator(lua_State* L, int i) {
  const std::string separator = given(L, i) ? check_string(L, i, "separator") : ",";
  if (separator != "," && separator != ";" && separator != "\t")
    fail("{}: separator must be ',', ';' or a tab, got {}", subject(L), in_quotes(separator));
  return separator[0];
}

static int csv_records(lua_State* L) {
  const std::string file = check_string(L, 1, "name");
  if (lua_type(L, 2) != LUA_TSTRING) fail_expected({L, {}, "text"}, "a text", 2);
  const std::string_view text = string_at(L, 2);
  CsvReader reader(file, text, check_separator(L, 3));
  CsvRecord record;
  LuaBudget budget(L, file, text.size());
  push_list(L);
  const int none_quoted = lua_gettop(L);
  push_list(L);
  for (lua_Integer i = 1; reader.next(record); ++i) {
    push_list_of(L, record.cells, [L, &budget](const CsvCell& cell) {
      budget.check();
      push(L, cell.text);
    });
    set_field(L, "line", record.line);
    // most records have no quotes, and share a table
    if (std::ranges::none_of(record.cells, &CsvCell::quoted)) {
      lua_pushvalue(L, none_quoted);
    } else {
      push_list(L);
      for (size_t c = 0; c < record.cells.size(); ++c)
        if (record.cells[c].quoted) push(L, true), lua_rawseti(L, -2, static_cast<int>(c) + 1);
    }
    lua_setfield(L, -2, "quoted");
    lua_rawseti(L, -2, i);
  }
  return 1;
}

static int csv_text(lua_State* L) {
  if (lua_type(L, 1) != LUA_TSTRING) fail_expected({L, {}, "text"}, "a text", 1);
  return push(L, std::string_view(csv_cell(string_at(L, 1), check_separator(L, 2))));
}

static int eigengrasps(lua_State* L) {
  return push_object(
      L, EigengraspsHandle{{}, std::make_shared<EigengraspSet>(read_with(L, read_eigengrasps))});
}

// --- contacts ---

static int virtual_contacts(lua_State* L) {
  const VirtualContactSet set = read_with(L, read_virtual_contacts);
  push_list_of(L, set.contacts,
               [L, place = set.places.begin()](const VirtualContactSpec& c) mutable {
                 push_record(L, {{"chain", place->chain + 1},
                                 {"link", place->link + 1},
                                 {"frame", c.X_LC},
                                 {"mu", c.mu},
                                 {"edges", c.edges.transpose()}});
                 ++place;
               });
  set_field(L, "robot", set.robot);
  return 1;
}

static int push(lua_State* L, const ObjectContact& c) {
  return push_record(L, {{"frame", c.X_OC},
                         {"placed", c.placed},
                         {"normal", c.n_O},
                         {"mu", c.mu},
                         {"edges", c.edges.transpose()}});
}

static int object_contacts(lua_State* L) { return push(L, read_with(L, read_object_contacts)); }

// visits the tables of the list in argument 2
template <class Visit>
static void each_table(lua_State* L, Visit visit) {
  each_item(L, 2, {L, {}, "list"}, "a list of tables", [&](int i, const What& what) {
    Table item(L, i, what.text());
    visit(item);
    item.done();
  });
}

static Eigen::Vector3d read_direction(Table& item, const char* key) {
  const Eigen::Vector3d v = item.vec3(key);
  if (!(v.norm() > 1e-9) || !std::isfinite(v.norm()))
    fail("{}: {}: expected a direction", item.subject(), key);
  return v.normalized();
}

static int save_object_contacts(lua_State* L) {
  const std::string path = check_output(L, 1);
  std::vector<ObjectContact> list;
  each_table(L, [&](Table& item) {
    ObjectContact contact{.X_OC = item.pose("frame"),
                          .placed = item.boolean("placed", true),
                          .n_O = read_direction(item, "normal"),
                          .mu = item.number("mu", 1),
                          .edges = friction_edges()};
    if (item.has("edges")) contact.edges = item.wrenches("edges");
    list.push_back(std::move(contact));
  });
  write_object_contacts(list, path);
  return 0;
}

// --- primitives and grasps ---

static int push(lua_State* L, const Primitive& p) {
  static constexpr const char* kinds[] = {"box", "sphere", "cylinder", "cone"};
  push_record(L, {{"kind", kinds[static_cast<int>(p.kind)]}, {"pose", p.X_OP}});
  if (p.kind == PrimitiveKind::box)
    set_field(L, "size", p.size);
  else
    set_field(L, "radius", p.radius);
  if (p.kind == PrimitiveKind::cylinder || p.kind == PrimitiveKind::cone)
    set_field(L, "height", p.height);
  return 1;
}

static int primitives(lua_State* L) { return push(L, read_with(L, read_primitives)); }

static int push(lua_State* L, const Pregrasp& p) {
  return push_record(
      L,
      {{"point", p.point}, {"direction", p.direction}, {"thumb", p.thumb}, {"spread", p.spread}});
}

static int pregrasps(lua_State* L) { return push(L, read_with(L, read_pregrasps)); }

static int save_pregrasps(lua_State* L) {
  const std::string path = check_output(L, 1);
  std::vector<Pregrasp> list;
  each_table(L, [&](Table& item) {
    list.push_back({.point = item.vec3("point"),
                    .direction = read_direction(item, "direction"),
                    .thumb = read_direction(item, "thumb"),
                    .spread = item.number("spread", 0)});
  });
  write_pregrasps(list, path);
  return 0;
}

// --- gloves ---

static int glove_calibration(lua_State* L) { return push(L, read_with(L, read_glove_calibration)); }

static int push(lua_State* L, GlovePose pose) {
  for (int& dof : pose.dof_of_sensor) dof = std::max(dof + 1, 0);
  push_record(L, {{"distance", pose.distance}, {"pose", pose.pose}});
  if (!pose.sensors.empty()) set_field(L, "sensors", pose.sensors);
  if (!pose.dof_of_sensor.empty()) set_field(L, "dof_of_sensor", pose.dof_of_sensor);
  if (!pose.joints.empty()) set_field(L, "joints", pose.joints);
  return 1;
}

static int glove_poses(lua_State* L) { return push(L, read_with(L, read_glove_poses)); }

static const Entry files_functions[] = {
    {"eigengrasps", guarded<eigengrasps>, R"(
Eigengrasps from .egr or .xml. Give them to a hand: hand.eigengrasps = set.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return eigengrasps
@effect files
> clench.files.eigengrasps "no.egr"  --> error: no such file: no.egr)"},
    {"virtual_contacts", guarded<virtual_contacts>, R"(
Virtual contacts from .vgr or .xml. Give them to a hand: hand.virtual_contacts = list. `chain` and `link` count from 1;
chain 0 is the base. `frame` is in the link frame, +z out of the link; `robot` of the list is the hand for which they were made.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return {chain: integer, link: index, frame: pose, mu: number, edges: number[][]}[]
@effect files
> path = os.tmpname() .. ".vgr"
> hand:save_virtual_contacts(path)
> list = clench.files.virtual_contacts(path)
> os.remove(path)
> #list == #hand.virtual_contacts, list.robot == hand.name  --> true, true)"},
    {"object_contacts", guarded<object_contacts>, R"(
Contacts on an object, as GraspIt! stores them. `placed` is false, and the frame at the origin, if the file omits
the points.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return {frame: pose, placed: boolean, normal: vec3, mu: number, edges: number[][]}[]
@effect files
> clench.files.object_contacts "no.txt"  --> error: no such file)"},
    {"save_object_contacts", guarded<save_object_contacts>, R"(
Writes contacts on an object; without `edges`, those of a point contact.
@param path string  file to write
@param list table[]  contacts in the object's frame
@option frame pose  z along the normal
@option placed? boolean = true  false: the frame is unknown
@option normal vec3  into the object
@option mu? number [0 to 1e6] = 1  coefficient of friction
@option edges? number[][]  friction edges, by default those of a point
@effect files
> path = os.tmpname()
> clench.files.save_object_contacts(path, {{frame = {xyz = {0, 0, 0.1}}, normal = {0, 0, -1}, mu = 0.5}})
> list = clench.files.object_contacts(path)
> os.remove(path)
> list[1].mu, #list[1].edges, list[1].placed  --> 0.5, 8, true)"},
    {"primitives", guarded<primitives>, R"(
Boxes, spheres, cylinders and cones of an Inventor or VRML file, in its frame. For an object's file, those of
primitives/<its name>.iv next to it are read instead, if that file exists. y is the axis of cylinder and cone.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return {kind: "box"|"sphere"|"cylinder"|"cone", pose: pose, size?: vec3, radius?: number, height?: number}[]  [m]
@effect files
> path = os.tmpname() .. ".iv"
> file = io.open(path, "w")
> file:write "#Inventor V2.1 ascii\nCube { width 20 height 30 depth 40 }"
> file:close()
> list = clench.files.primitives(path)
> os.remove(path)
> list[1].kind, list[1].size  --> box, (0.02, 0.03, 0.04))"},
    {"pregrasps", guarded<pregrasps>, R"(
Pre-grasps of a planner's list, in the object's frame.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return {point: vec3, direction: vec3, thumb: vec3, spread: number}[]  [m, rad]
@effect files
> path = os.tmpname()
> clench.files.save_pregrasps(path, {{point = {0, 0, 0.1}, direction = {0, 0, -1}, thumb = {1, 0, 0}, spread = 1}})
> list = clench.files.pregrasps(path)
> os.remove(path)
> list[1].direction, list[1].spread  --> (0, 0, -1), 1.0)"},
    {"save_text", guarded<save_text>, R"(
Writes a text to a file, completely or not at all: on failure an existing file is unchanged.
@param path string  file to write
@param text string  contents of the file
@effect files
> clench.files.save_text("build/note.txt", "held")
> clench.files.save_text("no/such/folder/a.txt", "")  --> error: no such folder: no/such/folder)"},
    {"append_text", guarded<append_text>, R"(
Appends a text as a separate line, and the end of that line, in one system call: a process that is killed leaves all of it
or nothing, and a full disk leaves no part of it. Creates the file if necessary.
@param path string  file to append to
@param text string  text to append
@effect files
> path = os.tmpname()
> clench.files.append_text(path, "one")
> clench.files.append_text(path, "two")
> text = clench.files.read_text(path)
> os.remove(path)
> text == "one\ntwo\n"  --> true
> clench.files.append_text("no/such/folder/a.txt", "")  --> error: no such folder: no/such/folder)"},
    {"check_writable", guarded<check_writable_file>, R"(
Checks that a file can be written there, for instance before long work: its folder exists, both are writable, and it is no
folder, pipe or device. Changes no file.
@param path string  file that is to be written
@effect files
> clench.files.check_writable "build/note.txt"
> clench.files.check_writable "build"  --> error: build: expected a file to write, got a folder
> clench.files.check_writable "/dev/null"  --> error: /dev/null: expected a file to write, got a special file)"},
    {"read_text", guarded<read_whole>, R"(
The bytes of a file, of at most 1 GB. Folders, pipes, devices and sockets are rejected.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return string
@effect files
> clench.files.save_text("build/note.txt", "held")
> clench.files.read_text "build/note.txt"  --> held
> clench.files.read_text "/dev/zero"  --> error: expected a file, got a special file: /dev/zero)"},
    {"list", guarded<list>, R"(
Names in a folder, sorted; hidden ones too. `files` are all that are not folders.
@param folder string  folder to list; "" is the current one
@param options? table  how the folder is read
@like clench.load  confine
@return {folders: string[], files: string[]}
@effect files
> clench.files.list("models").folders[1]  --> arms
> #clench.files.list("models/hands/barrett").folders  --> 1
> clench.files.list "README.md"  --> error: README.md: expected a folder, got a file
> clench.files.list "no/such"  --> error: no such folder: no/such)"},
    {"exists", guarded<exists>, R"(
Is there a file, folder or device at that path? False for a link without a target. Relative paths start at the current folder only.
@param path string  of a file or folder
@param options? table  how the path is read
@like clench.load  confine
@return boolean
@effect files
> clench.files.exists "README.md", clench.files.exists "no/such"  --> true, false)"},
    {"make_folder", guarded<make_new_folder>, R"(
Creates a folder and those above it, unless they exist.
@param path string  folder to create
@effect files
> clench.files.make_folder "build/notes/today"
> clench.files.exists "build/notes/today"  --> true
> clench.files.make_folder "README.md/x"  --> error: README.md/x: the folder cannot be created: Not a directory)"},
    {"csv_records", guarded<csv_records>, R"(
Cells of a text of comma-separated values, line by line, as texts; clench.csv reads files, with the types of their values.
@param name string  for errors
@param text string  contents of a CSV file
@param separator? string  "," by default, ";" or a tab
@return table[] records  lists of cells, each with its `line`, and `quoted`: of which cells stood in quotes
@effect reads
> records = clench.files.csv_records("a.csv", 'a,"7"\n1,2')
> #records, records[1][2], records[1].quoted[2], records[2].line  --> 2, 7, true, 2
> clench.files.csv_records("a.csv", '"a')  --> error: a.csv:1: a quote that is not closed)"},
    {"csv_text", guarded<csv_text>, R"(
A text as a cell of comma-separated values: quoted if it would otherwise be read differently, or as a number, true or false.
@param text string  text of the cell
@param separator? string  "," by default, ";" or a tab
@return string
@effect reads
> clench.files.csv_text "mug", clench.files.csv_text "7", clench.files.csv_text "a,b"  --> mug, "7", "a,b")"},
    {"save_pregrasps", guarded<save_pregrasps>, R"(
Writes pre-grasps as a planner's list.
@param path string  file to write
@param list table[]  pregrasps in the frame of the object
@option point vec3 [m]  approach point
@option direction vec3  approach direction
@option thumb vec3  direction of the thumb
@option spread? number [rad] = 0  spread of the fingers
@effect files
> clench.files.save_pregrasps("x.txt", {{point = {0, 0, 0}}})  --> error: list[1]: direction)"},
    {"glove_calibration", guarded<glove_calibration>, R"(
Calibration of a data glove, from raw numbers to DOF values: DOF = intercept + slopes * raw.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return {slopes: number[][], intercepts: number[]}  [rad per count, rad]
@effect files
> clench.files.glove_calibration "no.txt"  --> error: no such file)"},
    {"glove_poses", guarded<glove_poses>, R"(
Postures from which a glove was calibrated: raw `sensors`, the `dof_of_sensor` (0: not used), `joints` [rad], the
`distance` of fingertips that were meant to touch [m], and the hand's `pose`.
@param path string  file to read
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return {distance?: number, sensors?: integer[], dof_of_sensor?: integer[], joints?: number[], pose: pose}[]
@effect files
> clench.files.glove_poses "no.txt"  --> error: no such file)"},
};

const Library files_library{
    .name = "clench.files",
    .doc = "The small files around hands and planners, read as tables and written from them.",
    .functions = files_functions};

}  // namespace clench
