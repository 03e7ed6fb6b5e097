#include "clench/io/write/write_world.h"

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/write/write_text_worlds.h"

namespace clench {

namespace fs = std::filesystem;

void write_world(const WorldSpec& world, const fs::path& path, const WriteOptions& options) {
  const std::string ending = lower_case(path.extension().string());
  const std::string file = path.filename().string();
  if (ending != ".wld" && ending != ".xml" && ending != ".lua")
    fail("{}: expected the extension .xml, .mjcf, .wld or .lua, got {}", file, in_quotes(ending));
  check_folder_of(path);
  std::error_code code;
  if (!options.root.empty() && !fs::is_directory(options.root, code))
    fail("{}: root: expected a folder, got {}", file, in_quotes(options.root.string()));

  SavedFiles files(path, options);
  const std::string text = ending == ".wld"   ? wld_text(world, files)
                           : ending == ".xml" ? world_xml_text(world, files)
                                              : text_of_lua(world, files);
  if (options.check) {
    const Draft draft(path, text);
    try {
      options.check(draft.path());
    } catch (const Error& error) {
      std::string what = error.what();
      const std::string own = draft.path().filename().string();
      for (size_t at; (at = what.find(own)) != std::string::npos;)
        what.replace(at, own.size(), file);
      fail(error.kind(), "{} cannot be saved: {}", file, what);
    }
  }
  write_file(path, text);
  files.keep();
}

}  // namespace clench
