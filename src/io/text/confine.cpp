#include "clench/io/text/confine.h"

#include <algorithm>
#include <vector>

#include "clench/base/error.h"

namespace clench {

namespace fs = std::filesystem;

static bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// The target of a path with all links followed, even if it does not exist; empty if links form a
/// cycle.
/// visit(link)  called with the path of each link on the way
template <class Visit>
static fs::path resolved(const fs::path& path, Visit visit) {
  constexpr int link_limit = 40;  // limit of the operating system
  std::error_code code;
  std::vector<fs::path> rest;  // in reverse order
  const auto add = [&](const fs::path& parts) {
    rest.insert(rest.end(), parts.begin(), parts.end());
    std::reverse(rest.end() - std::distance(parts.begin(), parts.end()), rest.end());
  };
  add(fs::absolute(path, code));
  fs::path out;
  for (int links = 0; !rest.empty();) {
    const fs::path part = rest.back();
    rest.pop_back();
    if (part.empty() || part == ".") continue;
    if (part == "..") {
      out = out.parent_path();
      continue;
    }
    const fs::path next = out / part;  // "/" restarts at the root
    const fs::path target = fs::read_symlink(next, code);
    if (code) {
      out = next;
    } else if (++links > link_limit) {
      return {};
    } else {
      visit(next);
      add(target);
    }
  }
  return out;
}

static fs::path resolved(const fs::path& path) {
  return resolved(path, [](const fs::path&) {});
}

bool lies_within(const fs::path& path, const fs::path& folder) {
  if (folder.empty()) return true;
  const fs::path at = resolved(path), home = resolved(folder);
  // if the folder cannot be resolved, no path counts as inside it
  return !home.empty() && is_below(at, home);
}

bool leads_out(const fs::path& path, const fs::path& folder) {
  if (folder.empty()) return false;
  const fs::path home = resolved(folder);
  bool through = false;
  const fs::path at =
      resolved(path, [&](const fs::path& link) { through = through || is_below(link, home); });
  return through && !is_below(at, home);
}

void check_target(const fs::path& file, const fs::path& confine) {
  if (leads_out(file, confine))
    fail(ErrorKind::file,
         "{}: a link leads out of {}, to which reading is confined; nothing is written",
         file.generic_string(), confine.generic_string());
}

}  // namespace clench
