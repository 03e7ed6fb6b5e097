#include "script/bind_catalog.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "script/check.h"
#include "script/guard.h"
#include "script/home.h"
#include "script/push.h"

namespace clench {

namespace fs = std::filesystem;

// what a shelf holds: files with these endings
struct Shelf {
  const char* name;
  const char* folder;
  std::vector<std::string> endings;
};

static const std::vector<Shelf>& shelves() {
  static const std::vector<Shelf> all = {
      {"hands", "models/hands", {".cfg", ".urdf"}},
      {"arms", "models/arms", {".cfg", ".urdf"}},
      {"objects", "models/objects", {".iv", ".wrl", ".obj", ".stl", ".ply", ".off"}},
      {"obstacles", "models/obstacles", {".iv", ".wrl", ".obj", ".stl", ".ply", ".off"}},
      {"worlds", "worlds", {".wld"}},
  };
  return all;
}

// below the current folder as seen from there, else absolute
static std::string plain_path(const fs::path& path) {
  std::error_code error;
  const fs::path near = fs::proximate(path, error);
  return !error && !near.empty() && *near.begin() != ".." ? near.generic_string()
                                                          : path.generic_string();
}

static std::vector<std::string> files_on(const fs::path& home, const Shelf& shelf) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::recursive_directory_iterator it(home / shelf.folder, error), end; !error && it != end;
       it.increment(error)) {
    // planners' stand-ins for objects are no models of their own
    if (it->path().filename() == "primitives") it.disable_recursion_pending();
    const std::string ending = it->path().extension().string();
    if (std::find(shelf.endings.begin(), shelf.endings.end(), ending) == shelf.endings.end())
      continue;
    found.push_back(plain_path(it->path()));
  }
  std::sort(found.begin(), found.end());
  return found;
}

static int catalog(lua_State* L) {
  check_count(L, 0);
  const fs::path home = home_folder();
  if (home.empty())
    fail("{}: no folder with models and worlds found near the program; set CLENCH_MODELS to it",
         subject(L));
  push_list(L, 0, static_cast<int>(shelves().size()));
  for (const Shelf& shelf : shelves()) {
    push_list_of(L, files_on(home, shelf), [L](const std::string& path) { push(L, path); });
    lua_setfield(L, -2, shelf.name);
  }
  return 1;
}

static const Entry functions[] = {
    {"catalog", guarded<catalog>, R"(
Paths of the models and worlds that come with Clench, sorted.
@return {hands: string[], arms: string[], objects: string[], obstacles: string[], worlds: string[]}
> type(clench.catalog().hands)  --> table)"},
};

const Library catalog_library{.name = "clench", .doc = "", .functions = functions};

}  // namespace clench
