// Our MJCF reader compared with MuJoCo: all files of ours and of third parties that MuJoCo reads.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "clench_reader.h"
#include "mujoco_reader.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

bool is_mjcf(const fs::path& path) {
  if (path.extension() != ".xml" && path.extension() != ".mjcf") return false;
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str().find("<mujoco") != std::string::npos;
}

/// If two versions of MuJoCo disagree, the newer one is right: MuJoCo 2.2.2 puts a primitive that
/// is fitted to bounds at the origin of its body.
bool is_outdated(const fs::path& path) {
  return path.string().find("fitted_primitive") != std::string::npos;
}

/// Compares all MJCF files below a folder.   returns  their number
int compare_files(const fs::path& folder, double tolerance) {
  int count = 0;
  if (!fs::is_directory(folder)) return 0;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_mjcf(entry.path()) && !is_outdated(entry.path()))
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  for (const fs::path& path : paths) {
    const ModelFacts theirs = read_by_mujoco(path);
    if (!theirs.error.empty() || theirs.bodies.empty()) continue;
    std::vector<std::string> warnings;
    const ModelFacts ours = read_by_clench(path, theirs, warnings);
    INFO(path.string());
    CHECK(ours.error == "");
    if (!ours.error.empty()) continue;
    for (const std::string& sentence : differences(ours, theirs, tolerance)) FAIL_CHECK(sentence);
    ++count;
  }
  return count;
}

constexpr double tolerance = 1e-6;

}  // namespace

TEST_CASE("our MJCF files have the same meaning as in MuJoCo") {
  CHECK(compare_files("tests/data/mjcf", tolerance) >= 2);
  compare_files("models", tolerance);
}

TEST_CASE("third-party MJCF files have the same meaning as in MuJoCo") {
  REQUIRE_SHARED();
  CHECK(compare_files(shared() / "data", tolerance) +
            compare_files(shared() / "cases", tolerance) >=
        1);
}
