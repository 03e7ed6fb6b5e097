#include "clench/io/urdf/urdf_files.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <functional>
#include <optional>
#include <set>

#include "clench/base/hex_digit.h"
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

/// True if the folder has this name, ignoring case.
bool is_called(const fs::path& folder, const std::string& name) {
  return lower_case(folder.filename().string()) == lower_case(name);
}

/// The folder of that name in another, otherwise one whose name differs only in case.
std::optional<fs::path> find_folder(const fs::path& in, const std::string& name,
                                    const ReadOptions& options) {
  if (is_folder(in / name, options)) return in / name;
  std::set<fs::path> alike;  // sorted, so that the choice is the same on every file system
  std::error_code code;
  if (lies_within(in, options.confine))
    for (fs::directory_iterator it(in, code), end; !code && it != end; it.increment(code))
      if (is_called(it->path(), name) && is_folder(it->path(), options)) alike.insert(it->path());
  if (alike.empty()) return {};
  return *alike.begin();
}

/// The name without leading slashes.
std::string without_slashes(const std::string& name) {
  const size_t first = name.find_first_not_of('/');
  return first == std::string::npos ? "" : name.substr(first);
}

/// The folder of a package given by the options; empty if there is none.
fs::path given_package(const std::string& package, const ReadOptions& options) {
  if (const auto found = options.packages.find(package); found != options.packages.end())
    return found->second;
  for (const auto& [name, folder] : options.packages)
    if (!name.empty() && lower_case(name) == lower_case(package)) return folder;
  // the name "" stands for every package: its folder, or a folder that contains all of them
  const auto all = options.packages.find("");
  if (all == options.packages.end()) return {};
  return find_folder(all->second, package, options).value_or(all->second);
}

/// The referrer's folder and all folders above it.
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

/// given  the name after the package and a slash, possibly with more slashes
fs::path find_in_package(const std::string& package, const std::string& given,
                         const fs::path& referrer, const ReadOptions& options) {
  const std::string rest = without_slashes(given);
  if (const fs::path folder = given_package(package, options); !folder.empty())
    return find_file(rest, folder / "x", options.beside_only());
  auto folders = folders_above(referrer);
  if (!options.folder.empty()) folders.insert(folders.begin(), options.folder);
  using Look = std::function<fs::path(const fs::path&)>;
  // exact names first, so that a name in other case elsewhere is never preferred
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
      if (const fs::path found = look(folder / rest);
          !found.empty() && folder != folder.root_path()) {
        options.diagnostics.note(Place(referrer.filename().string()),
                                 "package {} is taken to be {}", in_quotes(package),
                                 folder.generic_string());
        return found;
      }
  // if the nearest candidate is outside of `confine`, so are all others
  if (!lies_within(folders.front() / package / rest, options.confine))
    fail_outside(excerpt(given), options);
  if (is_folder(folders.front() / package, options) || is_called(folders.front(), package))
    fail("no such file in package {}: {}", in_quotes(package), excerpt(given));
  fail("no package {} with {} beside or above the file; the option 'package' names its folder",
       in_quotes(package), in_quotes(given));
}

/// Length of the scheme with which a name begins: letters, then ':' and a slash; 0 if there is
/// none. A single letter is a drive.
size_t scheme_length(const std::string& name) {
  const size_t colon = name.find(':');
  if (colon == std::string::npos || colon < 2 || name.substr(colon + 1, 1) != "/") return 0;
  const bool letters = std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(colon),
                                   [](unsigned char c) { return std::isalpha(c); });
  return letters ? colon : 0;
}

/// The name with escapes such as "%20" decoded; empty if it has none.
std::string unescaped(const std::string& name) {
  std::string out;
  bool any = false;
  for (size_t i = 0; i < name.size(); ++i) {
    const int high = name[i] == '%' && i + 2 < name.size() ? hex_digit(name[i + 1]) : -1;
    const int low = high < 0 ? -1 : hex_digit(name[i + 2]);
    const int code = 16 * high + low;
    if (low < 0 || code == 0) {
      out += name[i];
      continue;
    }
    out += static_cast<char>(code);
    i += 2, any = true;
  }
  return any ? out : "";
}

/// `given` is trimmed. Backslashes count as slashes, unless a file name contains them.
fs::path find_by_scheme(const std::string& given, const fs::path& referrer,
                        const ReadOptions& options) {
  const std::string name = with_slashes(given);
  const size_t colon = scheme_length(name);
  if (colon == 0) return find_file(given, referrer, options);
  const std::string scheme = lower_case(name.substr(0, colon)), rest = name.substr(colon + 1);
  if (scheme == "file") {
    // the path of file:///tmp/a.stl and file://localhost/tmp/a.stl is /tmp/a.stl
    std::string path = rest.starts_with("//") ? rest.substr(2) : rest;
    if (lower_case(path).starts_with("localhost/")) path = path.substr(std::strlen("localhost"));
    return find_file(path, referrer, options);
  }
  if (scheme != "package" && scheme != "model")
    fail("expected a file name, package:// or file://, got {}", in_quotes(name));
  const std::string in_package = without_slashes(rest);
  const size_t slash = in_package.find('/');
  const std::string file = slash == std::string::npos ? "" : in_package.substr(slash + 1);
  if (without_slashes(file).empty())
    fail("expected {}://PACKAGE/FILE, got {}", scheme, in_quotes(name));
  return find_in_package(in_package.substr(0, slash), file, referrer, options);
}

}  // namespace

fs::path find_robot_file(const std::string& given, const fs::path& referrer,
                         const ReadOptions& options) {
  const std::string name(trim(given));
  if (name.size() > 4096) fail("no such file: {}", in_quotes(name));
  const std::string plain = unescaped(name);
  if (plain.empty()) return find_by_scheme(name, referrer, options);
  try {
    return find_by_scheme(name, referrer, options);
  } catch (const Error&) {
    try {
      return find_by_scheme(plain, referrer, options);
    } catch (const Error&) {
    }
    throw;
  }
}

}  // namespace clench
