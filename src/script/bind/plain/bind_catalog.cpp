#include <algorithm>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "clench/io/read/read.h"
#include "clench/io/text/confine.h"
#include "clench/io/text/file_kind.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/home.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/table.h"

namespace clench {

namespace fs = std::filesystem;

struct Shelf {
  const char* name;
  const char* folder;
  FileKind kind;  // of what lies on it
};

static constexpr Shelf shelves[] = {
    {"hands", "models/hands", FileKind::robot},
    {"arms", "models/arms", FileKind::robot},
    {"objects", "models/objects", FileKind::body},
    {"obstacles", "models/obstacles", FileKind::body},
    {"worlds", "worlds", FileKind::world},
};

// parts of robots, planners' substitutes for objects, and files saved with a world are not separate
// models
static bool holds_parts(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name == "iv" || name == "primitives" || name.ends_with("_files");
}

static bool belongs(const fs::path& path, FileKind kind, const fs::path& confine) {
  if (!lies_within(path, confine)) return false;
  // a surface next to its body's XML file belongs to that
  if (path.extension() != ".xml" && kind == FileKind::body &&
      fs::exists(fs::path(path).replace_extension(".xml")))
    return false;
  try {
    return file_kind(path) == kind;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::file) throw;
    return false;  // a note, a picture
  }
}

// relative if below the current folder, otherwise absolute
static std::string plain_path(const fs::path& path) {
  std::error_code error;
  const fs::path near = fs::proximate(path, error);
  return !error && !near.empty() && *near.begin() != ".." ? near.generic_string()
                                                          : path.generic_string();
}

static std::vector<std::string> files_on(const fs::path& home, const Shelf& shelf,
                                         const fs::path& confine) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::recursive_directory_iterator it(home / shelf.folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code none;
    if (it->is_directory(none)) {
      if (holds_parts(it->path())) it.disable_recursion_pending();
      continue;
    }
    if (!belongs(it->path(), shelf.kind, confine)) continue;
    found.push_back(plain_path(it->path()));
  }
  std::sort(found.begin(), found.end());
  return found;
}

static int catalog(lua_State* L) {
  const fs::path home = home_folder();
  if (home.empty())
    fail("{}: no folder with models and worlds found near the program; set CLENCH_MODELS to it",
         subject(L));
  const std::string confine = get_setting(L, Setting::confine);
  push_list(L, 0, static_cast<int>(std::size(shelves)));
  for (const Shelf& shelf : shelves) {
    set_field(L, shelf.name, files_on(home, shelf, confine));
  }
  return 1;
}

static int kind_of_file(lua_State* L) {
  const std::string path = check_string(L, 1, "path");
  return push(L, kind_name(file_kind(find_file(path, {}, read_places(L, 2)))));
}

static const Entry catalog_functions[] = {
    {"file_kind", guarded<kind_of_file>, R"(
Kind of a file's contents, by its ending, or in XML by its root element; if the ending leaves it open, by the layout of its
numbers.
@param path string  file to inspect
@param options? table  how the file is read
@like clench.load  confine
@return "body"|"robot"|"world"|"eigengrasps"|"virtual contacts"|"object contacts"|"pre-grasps"|"planned grasps"|"glove calibration"|"glove poses"
@effect files
> clench.file_kind "models/objects/flask.iv"  --> body
> clench.file_kind "worlds/dlr_flask.wld"  --> world
> clench.file_kind "README.md"  --> error: expected a model, a world, or a file that goes with one, got '.md')"},
    {"catalog", guarded<catalog>, R"(
Paths of the models and worlds that come with Clench, sorted.
@return {hands: string[], arms: string[], objects: string[], obstacles: string[], worlds: string[]}
@effect files
> type(clench.catalog().hands)  --> table)"},
};

const Library catalog_library{.name = "clench", .doc = "", .functions = catalog_functions};

}  // namespace clench
