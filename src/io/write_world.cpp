#include "io/write_world.h"

#include "base/text.h"
#include "io/write_file.h"
#include "io/write_text_worlds.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

/// A file that is gone at the end.
class WorldDraft {
 public:
  WorldDraft(const fs::path& path, const std::string& text) : path_(path) {
    write_file(path, text);
  }
  ~WorldDraft() {
    std::error_code code;
    fs::remove(path_, code);
  }
  WorldDraft(const WorldDraft&) = delete;
  WorldDraft& operator=(const WorldDraft&) = delete;

 private:
  const fs::path& path_;
};

}  // namespace

void write_world(const WorldSpec& world, const fs::path& path, const WriteOptions& options) {
  const std::string ending = lower_case(path.extension().string());
  const std::string file = path.filename().string();
  if (ending != ".wld" && ending != ".xml" && ending != ".lua")
    fail("{}: wanted a world to .wld, .xml or .lua, got {}", file, in_quotes(ending));
  std::error_code code;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!fs::is_directory(folder, code))
    fail("{}: the file cannot be written: no such folder: {}", path.generic_string(),
         folder.generic_string());
  if (!options.root.empty() && !fs::is_directory(options.root, code))
    fail("{}: root: wanted a folder, got {}", file, in_quotes(options.root.string()));

  SavedFiles files(path, options);
  const std::string text = ending == ".wld"   ? wld_text(world, files)
                           : ending == ".xml" ? world_xml_text(world, files)
                                              : text_of_lua(world, files);
  if (options.check) {
    const fs::path seen = folder / fmt::format(".{}.saving{}", path.stem().string(), ending);
    const WorldDraft draft(seen, text);
    try {
      options.check(seen);
    } catch (const Error& error) {
      fail("{} cannot be saved: {}", file, error.what());
    }
  }
  write_file(path, text);
}

}  // namespace clench
