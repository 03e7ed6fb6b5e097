// Our MJCF reader compared with MuJoCo: random models.
#include <doctest/doctest.h>

#include "clench_reader.h"
#include "mujoco_reader.h"
#include "random_mjcf.h"
#include "support/folder.h"

using namespace clench;
using namespace clench::test;

TEST_CASE("random models have the same meaning as in MuJoCo") {
  constexpr int count = 30;  // 200 agree, too, and take about 8 s
  // MuJoCo stores the vertices of meshes in single precision
  constexpr double tolerance = 1e-5;
  const TemporaryFolder folder;
  int compared = 0;
  for (int seed = 0; seed < count; ++seed) {
    const auto path = folder.write("model.xml", random_mjcf(seed));
    const ModelFacts theirs = read_by_mujoco(path);
    if (!theirs.error.empty()) continue;  // such as two geoms without mass
    std::vector<std::string> warnings;
    const ModelFacts ours = read_by_clench(path, theirs, warnings);
    INFO("seed " << seed);
    CHECK(ours.error == "");
    if (!ours.error.empty()) continue;
    for (const std::string& sentence : differences(ours, theirs, tolerance)) FAIL_CHECK(sentence);
    ++compared;
  }
  CHECK(compared > count * 2 / 3);
}
