#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

namespace fs = std::filesystem;

static std::vector<fs::path> test_files(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return {path};
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator it(path, error), end; !error && it != end;
       it.increment(error))
    if (it->path().filename().string().ends_with("_test.lua")) files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

struct Count {
  int passed = 0, failed = 0, skipped = 0;
  bool interrupted = false;
};

static Count run_test_file(const fs::path& file, const std::string& confine, bool quiet) {
  State state;
  if (quiet) state.set_quiet();
  if (!confine.empty()) state.set_confine(confine);
  state.set_script(file.string());
  const Interruptible running(state, 2);
  const auto result = state.call("test", "run_file", {file.string()});
  std::fflush(stdout);
  if (result.ok && result.values.size() == 3)
    return {std::atoi(result.values[0].c_str()), std::atoi(result.values[1].c_str()),
            std::atoi(result.values[2].c_str()), running.pressed()};
  fmt::print("  FAILED   {}\n", printable(result.error, "\n\t"));
  return {0, 1, 0, running.pressed()};
}

int run_tests(const std::string& path, const std::string& confine, bool quiet) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    std::fprintf(stderr, "clench test: no such file or folder: '%s'\n", printable(path).c_str());
    return 1;
  }
  const auto files = test_files(path);
  if (files.empty()) {
    std::fprintf(stderr, "clench test: no *_test.lua in '%s'\n", printable(path).c_str());
    return 1;
  }
  catch_interrupts();
  Count all;
  for (const auto& file : files) {
    if (!quiet) std::printf("%s\n", printable(file.string()).c_str());
    const Count one = run_test_file(file, confine, quiet);
    all.passed += one.passed, all.failed += one.failed, all.skipped += one.skipped;
    all.interrupted = one.interrupted;
    if (all.interrupted) break;
  }
  std::printf("%d passed, %d failed, %d skipped%s\n", all.passed, all.failed, all.skipped,
              all.interrupted ? "; interrupted" : "");
  if (all.interrupted) return 130;
  return all.failed ? 1 : 0;
}

}  // namespace clench
