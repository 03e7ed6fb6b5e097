#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "app/verbs.h"
#include "script/state.h"

namespace clench {

namespace fs = std::filesystem;

static std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

static bool write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  return static_cast<bool>(out.flush());
}

int write_docs(const std::string& folder, bool check) {
  State state;
  // name, text, name, text, ...
  const auto pages = state.call("host.doc", "pages", {});
  if (!pages.ok) {
    std::fprintf(stderr, "clench doc: %s\n", pages.error.c_str());
    return 1;
  }
  std::error_code error;
  if (!check) fs::create_directories(folder, error);
  int different = 0;
  for (size_t i = 0; i + 1 < pages.values.size(); i += 2) {
    const fs::path path = fs::path(folder) / pages.values[i];
    if (read_text(path) == pages.values[i + 1]) continue;
    ++different;
    if (check) {
      std::fprintf(stderr, "clench doc: %s is not what the bindings say; run clench doc\n",
                   path.c_str());
    } else if (!write_text(path, pages.values[i + 1])) {
      std::fprintf(stderr, "clench doc: %s cannot be written\n", path.c_str());
      return 1;
    }
  }
  if (!check)
    std::printf("%zu pages in %s, %d of them new\n", pages.values.size() / 2, folder.c_str(),
                different);
  return check && different ? 1 : 0;
}

}  // namespace clench
