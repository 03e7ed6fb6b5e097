// Shakes and lifts verified grasps in MuJoCo.
//   bench_mujoco [--each] [--brief] [--limit COUNT] FILE...
//   FILE  as written by tests/bench/verdicts.lua and tables.lua
#include <cstdio>
#include <iostream>

#include "bench/verdicts/mujoco_grip.h"

using namespace clench::bench;

namespace {

struct Tally {
  int count = 0, held = 0, lifted = 0, lifts = 0;
  void print(const std::string& name) const {
    std::printf("%-32s %5d %9d", name.c_str(), count, held);
    if (lifts > 0) std::printf(" %9d", lifted);
    std::printf("\n");
    std::fflush(stdout);
  }
  void add(const Tally& other) {
    count += other.count, held += other.held, lifted += other.lifted, lifts += other.lifts;
  }
};

void print_lost(const GripVerdict& verdict) {
  constexpr const char* directions[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  for (size_t d = 0; verdict.settled && d < verdict.pushes.size(); ++d) {
    const PushVerdict& push = verdict.pushes[d];
    if (!push.held)
      std::printf(", lost along %s (%.1f mm, %.1f degrees)", directions[d], 1e3 * push.moved,
                  57.29578 * push.turned);
  }
}

Tally judge(const GripScene& scene, size_t limit, bool each, const GripOptions& options) {
  Tally out;
  for (size_t g = 0; g < std::min(limit, scene.grasps.size()); ++g) {
    const StoredGrasp& grasp = scene.grasps[g];
    const GripVerdict shaken = shake(*mujoco_grip(scene, grasp, options), scene, options);
    ++out.count, out.held += shaken.survived;
    if (each)
      std::printf(
          "  %2zu epsilon %.3f load %.2f: held in %d (gripping moved it %.1f mm, %.1f degrees)", g,
          grasp.epsilon, grasp.load, shaken.held, 1e3 * shaken.moved, 57.29578 * shaken.turned);
    if (scene.table) {
      const LiftVerdict lifted = lift_in_mujoco(scene, grasp, options);
      ++out.lifts, out.lifted += lifted.held;
      if (each)
        std::printf(", lift %s (%.1f mm, %.1f degrees)", lifted.held ? "held" : "lost",
                    1e3 * lifted.moved, 57.29578 * lifted.turned);
    }
    if (each) {
      print_lost(shaken);
      std::printf("\n");
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  bool each = false;
  size_t limit = 1000000;
  GripOptions options;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--each")
      each = true;
    else if (word == "--brief")
      options.settle = 0.2, options.seconds = 0.1;
    else if (word == "--limit" && i + 1 < argc)
      limit = std::stoul(argv[++i]);
    else
      files.push_back(word);
  }
  if (files.empty()) {
    std::cerr << "usage: bench_mujoco [--each] [--brief] [--limit COUNT] FILE...\n";
    return 2;
  }
  try {
    std::printf("%-32s %5s %9s %9s\n", "in MuJoCo", "of", "held", "lifted");
    Tally all;
    for (const std::string& file : files) {
      const GripScene scene = read_grip_scene(file);
      const Tally tally = judge(scene, limit, each, options);
      tally.print(scene.hand_name + ", " + scene.object_name);
      all.add(tally);
    }
    all.print("all");
    return 0;
  } catch (const std::exception& problem) {
    std::cerr << "bench_mujoco: " << problem.what() << '\n';
    return 1;
  }
}
