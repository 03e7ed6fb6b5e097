// Verdicts of clench.study.shake beside those of the same test in Bullet, grasp by grasp.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <thread>

#include "bench/verdicts/bullet_grip.h"

using namespace clench::bench;

namespace {

struct Tally {
  int count = 0, agree = 0, ours = 0, theirs = 0, verified = 0, verified_survived = 0;
  void add(const StoredGrasp& grasp, const BulletVerdict& verdict) {
    ++count;
    agree += grasp.survived == verdict.survived;
    ours += grasp.survived, theirs += verdict.survived;
    verified += grasp.verified, verified_survived += grasp.verified && verdict.survived;
  }
  void print(const std::string& name) const {
    std::printf("%-28s %5d %9d %9d %9.1f %% %9d %9d\n", name.c_str(), count, ours, theirs, count ? 100.0 * agree / count : 0.0, verified, verified_survived);
    std::fflush(stdout);
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  std::string csv;
  BulletGripOptions options;
  bool each = false;
  size_t limit = 1000000;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return ++i < argc ? std::string(argv[i]) : std::string("0"); };
    if (word == "--each") each = true;
    else if (word == "--csv") csv = value();
    else if (word == "--step") options.step = std::stod(value());
    else if (word == "--kp") options.kp = std::stod(value());
    else if (word == "--kd") options.kd = std::stod(value());
    else if (word == "--iterations") options.iterations = std::stoi(value());
    else if (word == "--limit") limit = std::stoul(value());
    else files.push_back(word);
  }
  if (files.empty()) {
    std::cerr << "usage: bench_verdicts [--each] [--csv FILE] [--limit COUNT] [--step S] [--kp N] [--kd N] [--iterations N] FILE...\n";
    return 2;
  }
  std::printf("%-28s %5s %9s %9s %11s %9s %9s\n", "", "count", "survived", "in Bullet", "agreement", "verified", "in Bullet");
  Tally all;
  for (const std::string& file : files) {
    const GripScene scene = read_grip_scene(file);
    const size_t count = std::min(limit, scene.grasps.size());
    std::vector<BulletVerdict> verdicts(count);
    std::vector<std::thread> threads;
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    for (unsigned t = 0; t < cores; ++t)
      threads.emplace_back([&, t] {
        for (size_t g = t; g < count; g += cores) verdicts[g] = shake_in_bullet(scene, scene.grasps[g], options);
      });
    for (std::thread& thread : threads) thread.join();
    Tally tally;
    for (size_t g = 0; g < count; ++g) {
      const StoredGrasp& grasp = scene.grasps[g];
      tally.add(grasp, verdicts[g]), all.add(grasp, verdicts[g]);
      if (each)
        std::printf("  %2zu ours %d Bullet %d settled %d  epsilon %.3f load %.2f  deepest %.2f mm, gripping moved it %.1f mm, %.1f degrees\n", g, grasp.held, verdicts[g].held,
                    verdicts[g].settled, grasp.epsilon, grasp.load, 1e3 * verdicts[g].depth, 1e3 * verdicts[g].moved, verdicts[g].turned * 57.29578);
    }
    tally.print(scene.hand_name + ", " + scene.object_name);
  }
  all.print("all");
  if (!csv.empty()) {
    std::ofstream out(csv);
    out << "grasps,survived,survived in Bullet,agreement,verified,verified that survived in Bullet\n"
        << all.count << ',' << all.ours << ',' << all.theirs << ',' << double(all.agree) / std::max(1, all.count) << ',' << all.verified << ',' << all.verified_survived << '\n';
  }
  return 0;
}
