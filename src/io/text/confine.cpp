#include "clench/io/text/confine.h"

#include <algorithm>
#include <vector>

namespace clench {

namespace fs = std::filesystem;

/// Where a path leads, whether anything is there or not; empty when links lead in a circle.
static fs::path resolved(const fs::path& path) {
  constexpr int link_limit = 40;  // as many as the system follows
  std::error_code code;
  std::vector<fs::path> rest;  // the next part last
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
    const fs::path next = out / part;  // "/" leads back to the root
    const fs::path target = fs::read_symlink(next, code);
    if (code)
      out = next;
    else if (++links > link_limit)
      return {};
    else
      add(target);
  }
  return out;
}

bool lies_within(const fs::path& path, const fs::path& folder) {
  if (folder.empty()) return true;
  const fs::path at = resolved(path), home = resolved(folder);
  // of a folder that cannot be told nothing is known to lie in
  return !home.empty() &&
         std::mismatch(home.begin(), home.end(), at.begin(), at.end()).first == home.end();
}

}  // namespace clench
