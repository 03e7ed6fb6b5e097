#include "clench/io/text/find_model.h"

#include <algorithm>

#include "clench/base/text.h"
#include "clench/io/text/file_kind.h"

namespace clench {

namespace fs = std::filesystem;

// robots: only endings of GraspIt!, because a URDF or MJCF file need not describe the same robot
static std::vector<std::string> endings_of(ModelKind kind) {
  return kind == ModelKind::body ? body_endings() : std::vector<std::string>{".xml", ".cfg"};
}

// the name itself, otherwise with another ending; empty if there is none
static fs::path try_endings(const std::string& name, const fs::path& referrer, ModelKind kind,
                            const ReadOptions& options) {
  std::vector<std::string> names = {name};
  for (const auto& ending : endings_of(kind))
    names.push_back(fs::path(name).replace_extension(ending).generic_string());
  for (const auto& expected : names)
    if (const auto found = find_if_any(expected, referrer, options)) return *found;
  return {};
}

// "graspit" for "GraspIt-4.0"
static std::string first_word(const fs::path& folder) {
  const std::string name = lower_case(folder.filename().string());
  return name.substr(0, name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"));
}

// searches the folders next to `root` whose names begin with the same word, in alphabetical order
static fs::path try_generations(const std::string& name, const fs::path& root, ModelKind kind,
                                const ReadOptions& options) {
  const fs::path home = (fs::absolute(root).lexically_normal() / "").parent_path();
  const fs::path above = home.parent_path();
  const std::string library = first_word(home);
  if (library.empty()) return {};
  std::vector<fs::path> folders;
  std::error_code code;
  for (fs::directory_iterator it(above, code), end; !code && it != end; it.increment(code)) {
    std::error_code none;
    if (first_word(it->path()) == library && it->path() != home &&
        fs::is_directory(it->path() / *fs::path(name).begin(), none))
      folders.push_back(it->path());
  }
  std::sort(folders.begin(), folders.end());
  for (const auto& folder : folders)
    // find_file also searches the folder above
    if (const fs::path found = try_endings(name, folder / "x", kind, options.beside_only());
        !found.empty() && *found.lexically_relative(folder).begin() != "..")
      return found;
  return {};
}

fs::path find_converted(const std::string& name, const fs::path& referrer, ModelKind kind,
                        const Place& place, const ReadOptions& options) {
  try {
    return find_file(name, referrer, options);
  } catch (const Error& missing) {
    const fs::path sibling = try_endings(name, referrer, kind, options);
    if (sibling.empty()) throw missing;
    options.diagnostics.note(place, "there is no {}; {} is used instead", name,
                             sibling.filename().string());
    return sibling;
  }
}

fs::path find_model(const std::string& name, const fs::path& referrer, ModelKind kind,
                    const Place& place, const ReadOptions& options) {
  try {
    return find_converted(name, referrer, kind, place, options);
  } catch (const Error& missing) {
    // only names relative to a root mean the same below another root
    const fs::path relative = name;
    const bool rooted = relative.is_relative() && relative.has_parent_path() &&
                        name.find("..") == std::string::npos && !referrer.empty();
    const fs::path root = options.root.empty() ? referrer.parent_path() / ".." : options.root;
    const fs::path found = rooted ? try_generations(name, root, kind, options) : fs::path();
    if (found.empty()) throw missing;
    options.diagnostics.repaired(place, "{} is not below the root; {} is used instead", name,
                                 found.generic_string());
    return found;
  }
}

}  // namespace clench
