#include "clench/io/urdf/urdf_files.h"

#include <functional>
#include <optional>
#include <set>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/text/any_case.h"
#include "clench/io/text/confine.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

bool is_folder(const fs::path& path, const ReadOptions& options) {
  std::error_code code;
  return lies_within(path, options.confine) && fs::is_directory(path, code);
}

/// Is that the name of the folder, upper and lower case alike?
bool is_called(const fs::path& folder, const std::string& name) {
  return lower_case(folder.filename().string()) == lower_case(name);
}

/// The folder of that name in another, else one whose name differs only in case.
std::optional<fs::path> find_folder(const fs::path& in, const std::string& name,
                                    const ReadOptions& options) {
  if (is_folder(in / name, options)) return in / name;
  std::set<fs::path> alike;  // the first by name, on every file system
  std::error_code code;
  if (lies_within(in, options.confine))
    for (fs::directory_iterator it(in, code), end; !code && it != end; it.increment(code))
      if (is_called(it->path(), name) && is_folder(it->path(), options)) alike.insert(it->path());
  if (alike.empty()) return {};
  return *alike.begin();
}

/// The folder of a package as the options name it; empty when they do not.
fs::path given_package(const std::string& package, const ReadOptions& options) {
  if (const auto found = options.packages.find(package); found != options.packages.end())
    return found->second;
  // the name "" stands for every package: its folder, or the one that holds all of them
  const auto all = options.packages.find("");
  if (all == options.packages.end()) return {};
  return find_folder(all->second, package, options).value_or(all->second);
}

/// The referrer's folder and those above it, as far as it has any.
std::vector<fs::path> folders_above(const fs::path& referrer) {
  std::error_code code;
  std::vector<fs::path> out;
  fs::path at = fs::absolute(referrer, code).lexically_normal().parent_path();
  for (int i = 0; i < 32 && !at.empty(); ++i) {
    out.push_back(at);
    if (at == at.root_path()) break;
    at = at.parent_path();
  }
  return out;
}

fs::path find_in_package(const std::string& package, const std::string& rest,
                         const fs::path& referrer, const ReadOptions& options) {
  if (const fs::path folder = given_package(package, options); !folder.empty())
    return find_file(rest, folder / "x", options.beside_only());
  auto folders = folders_above(referrer);
  if (!options.folder.empty()) folders.insert(folders.begin(), options.folder);
  using Look = std::function<fs::path(const fs::path&)>;
  // exact names first, so that another case elsewhere never takes their place
  const Look looks[] = {
      [&](const fs::path& file) { return is_readable(file, options) ? file : fs::path(); },
      [&](const fs::path& file) { return find_in_any_case(file, options); }};
  for (const Look& look : looks)
    for (const fs::path& folder : folders) {
      if (is_called(folder, package))
        if (const fs::path found = look(folder / rest); !found.empty()) return found;
      if (const fs::path found = look(folder / package / rest); !found.empty()) return found;
    }
  for (const Look& look : looks)
    for (const fs::path& folder : folders)
      if (const fs::path found = look(folder / rest); !found.empty()) {
        if (options.note)
          options.note(fmt::format("{}: package {} is taken to be {}", referrer.filename().string(),
                                   in_quotes(package), folder.generic_string()));
        return found;
      }
  // nobody lies inside whose nearest place does not
  if (!lies_within(folders.front() / package / rest, options.confine))
    fail_outside(excerpt(rest), options);
  if (is_folder(folders.front() / package, options) || is_called(folders.front(), package))
    fail("no such file in package {}: {}", in_quotes(package), excerpt(rest));
  fail("no package {} with {} beside or above the file; the option 'package' names its folder",
       in_quotes(package), in_quotes(rest));
}

}  // namespace

fs::path find_robot_file(const std::string& given, const fs::path& referrer,
                         const ReadOptions& options) {
  const std::string name = with_slashes(given);
  const size_t colon = name.find("://");
  if (colon == std::string::npos) return find_file(name, referrer, options);
  const std::string scheme = lower_case(name.substr(0, colon)), rest = name.substr(colon + 3);
  if (name.size() > 4096) fail("no such file: {}", in_quotes(name));
  if (scheme == "file") return find_file(rest, referrer, options);
  if (scheme != "package" && scheme != "model")
    fail("expected a file name, package:// or file://, got {}", in_quotes(name));
  const size_t slash = rest.find('/');
  if (slash == std::string::npos || slash == 0 || slash + 1 == rest.size())
    fail("expected {}://PACKAGE/FILE, got {}", scheme, in_quotes(name));
  return find_in_package(rest.substr(0, slash), rest.substr(slash + 1), referrer, options);
}

}  // namespace clench
