#include <cstdio>
#include <filesystem>
#include <system_error>

#include "clench/app/verbs.h"
#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/script/host/state.h"

namespace clench {

namespace fs = std::filesystem;

/// Does the file already contain that text?
static bool holds(const fs::path& path, const std::string& text) {
  std::error_code error;
  return fs::is_regular_file(path, error) && read_bytes(path) == text;
}

int write_docs(const std::string& given, bool check) {
  const std::string folder = given.empty() ? "docs/api" : given;
  std::error_code error;
  if (given.empty() && !fs::is_directory(folder, error)) {
    std::fprintf(stderr, "clench doc: expected a folder to write to, as there is no %s here\n",
                 folder.c_str());
    return 1;
  }
  State state;
  // name, text, name, text, ...
  const auto pages = state.call("host.doc", "pages", {});
  if (!pages.ok) {
    std::fprintf(stderr, "clench doc: %s\n", pages.error.c_str());
    return 1;
  }
  if (!check) fs::create_directories(folder, error);
  int different = 0;
  for (size_t i = 0; i + 1 < pages.values.size(); i += 2) {
    const fs::path path = fs::path(folder) / pages.values[i];
    try {
      if (holds(path, pages.values[i + 1])) continue;
      ++different;
      if (check)
        std::fprintf(stderr, "clench doc: %s is out of date; run clench doc\n", path.c_str());
      else
        write_file(path, pages.values[i + 1]);
    } catch (const Error& fault) {
      std::fprintf(stderr, "clench doc: %s\n", fault.what());
      return 1;
    }
  }
  if (!check)
    std::printf("%zu pages in %s, %d of them new\n", pages.values.size() / 2, folder.c_str(),
                different);
  return check && different ? 1 : 0;
}

}  // namespace clench
