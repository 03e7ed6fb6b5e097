#include "clench/io/urdf/urdf_files.h"

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/text/confine.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

bool is_folder(const fs::path& path, const ReadOptions& options) {
  std::error_code code;
  return lies_within(path, options.confine) && fs::is_directory(path, code);
}

/// The folder of a package as the options name it; empty when they do not.
fs::path given_package(const std::string& package, const ReadOptions& options) {
  if (const auto found = options.packages.find(package); found != options.packages.end())
    return found->second;
  // the name "" stands for every package: its folder, or the one that holds all of them
  const auto all = options.packages.find("");
  if (all == options.packages.end()) return {};
  const fs::path within = all->second / package;
  return is_folder(within, options) ? within : all->second;
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
  for (const fs::path& folder : folders) {
    if (folder.filename() == package && is_readable(folder / rest, options)) return folder / rest;
    if (is_readable(folder / package / rest, options)) return folder / package / rest;
  }
  for (const fs::path& folder : folders)
    if (is_readable(folder / rest, options)) {
      if (options.note)
        options.note(fmt::format("{}: package {} is taken to be {}", referrer.filename().string(),
                                 in_quotes(package), folder.generic_string()));
      return folder / rest;
    }
  // nobody lies inside whose nearest place does not
  if (!lies_within(folders.front() / package / rest, options.confine))
    fail_outside(excerpt(rest), options);
  if (is_folder(folders.front() / package, options) || folders.front().filename() == package)
    fail("no such file in package {}: {}", in_quotes(package), excerpt(rest));
  fail("no package {} with {} beside or above the file; the option 'package' names its folder",
       in_quotes(package), in_quotes(rest));
}

}  // namespace

fs::path find_robot_file(const std::string& name, const fs::path& referrer,
                         const ReadOptions& options) {
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
