#include "clench/script/lua/home.h"

#include <link.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace clench {

namespace fs = std::filesystem;

// the file of the program or shared library that contains the code at an address
struct Search {
  uintptr_t address;
  std::string file;
};

static int visit(dl_phdr_info* info, size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const uintptr_t start = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
    if (info->dlpi_phdr[i].p_type != PT_LOAD || search.address < start ||
        search.address - start >= info->dlpi_phdr[i].p_memsz)
      continue;
    // the executable itself has no name here
    search.file = info->dlpi_name && *info->dlpi_name ? info->dlpi_name : "/proc/self/exe";
    return 1;
  }
  return 0;
}

// also correct for a program whose file was replaced while it runs, as a build does
static fs::path real_path(const std::string& file) {
  constexpr std::string_view mark = " (deleted)";
  std::error_code error;
  const fs::path path = fs::canonical(file, error);
  if (!error) return path;
  std::string link = fs::read_symlink(file, error).string();
  if (!link.ends_with(mark)) return {};
  link.resize(link.size() - mark.size());
  return link;
}

static bool is_home(const fs::path& folder) {
  std::error_code none;
  return fs::is_directory(folder / "models", none) && fs::is_directory(folder / "worlds", none);
}

fs::path home_folder() {
  if (const char* given = std::getenv("CLENCH_MODELS"); given && *given) return given;
  Search search{reinterpret_cast<uintptr_t>(&home_folder), ""};
  dl_iterate_phdr(visit, &search);
  const fs::path file = real_path(search.file);
  if (file.empty()) return {};
  for (const char* way : {"../share/clench", "../../../share/clench", "../.."}) {
    const fs::path folder = (file.parent_path() / way).lexically_normal();
    if (is_home(folder)) return folder;
  }
  return {};
}

}  // namespace clench
