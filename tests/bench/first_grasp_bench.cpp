// From the file of a world to an evaluated grasp, step by step. Uses the DLR hand and flask of the
// original if ../shared is present, and otherwise the shipped models.
// The original took, on the machine of ../shared/reference: 96 ms to load, 23 ms to close, 26 ms
// for the wrench space.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "clench/grasp/wrench/grasp.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/motion/drive.h"

using namespace clench;

namespace {

struct Scene {
  std::filesystem::path file, root;
};

Scene original() {
  const char* given = std::getenv("CLENCH_SHARED");
  const std::filesystem::path root =
      std::filesystem::path(given ? given : "../shared") / "data/graspit";
  return {root / "worlds/dlr_flask.wld", root};
}

Scene ours() { return {"worlds/dlr_flask.wld", "."}; }

World load(const Scene& scene) {
  ReadOptions options;
  options.root = scene.root;
  return build_world(read_world(scene.file, options));
}

void load_world(benchmark::State& state, const Scene& scene) {
  for (auto _ : state) benchmark::DoNotOptimize(load(scene));
}

void close_hand(benchmark::State& state, const Scene& scene) {
  World world = load(scene);
  const auto open = world.snapshot();
  int queries = 0;
  for (auto _ : state) {
    state.PauseTiming();
    world.restore(*open);
    state.ResumeTiming();
    queries = autograsp(world, world.robots()[0]).queries;
  }
  state.counters["queries"] = queries;
}

void measure(benchmark::State& state, const Scene& scene) {
  World world = load(scene);
  const auto hand = world.robots()[0];
  autograsp(world, hand);
  const Grasp grasp = find_grasp(world, hand, world.bodies()[0]);
  for (auto _ : state) benchmark::DoNotOptimize(wrench_space(grasp));
  state.counters["contacts"] = static_cast<double>(grasp.contacts.size());
  state.counters["epsilon"] = wrench_space(grasp).epsilon();
}

// the patches of all contacts of a rubber object, computed once per site
void fit_patches(benchmark::State& state, const Scene& scene) {
  World world = load(scene);
  const auto hand = world.robots()[0];
  autograsp(world, hand);
  world.set_elastic_modulus(world.bodies()[0], 1.5e6);
  std::vector<SoftSitePtr> sites;
  for (const Contact& contact : find_grasp(world, hand, world.bodies()[0]).contacts)
    if (std::find(sites.begin(), sites.end(), contact.site) == sites.end())
      sites.push_back(contact.site);
  for (auto _ : state)
    for (const SoftSitePtr& site : sites) benchmark::DoNotOptimize(soft_patch(*site));
  state.counters["patches"] = static_cast<double>(sites.size());
  state.counters["each"] = benchmark::Counter(
      static_cast<double>(sites.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  const auto add = [](const std::string& name, const Scene& scene) {
    const auto unit = benchmark::kMillisecond;
    benchmark::RegisterBenchmark((name + "/load").c_str(), load_world, scene)->Unit(unit);
    benchmark::RegisterBenchmark((name + "/autograsp").c_str(), close_hand, scene)->Unit(unit);
    benchmark::RegisterBenchmark((name + "/wrench_space").c_str(), measure, scene)->Unit(unit);
    benchmark::RegisterBenchmark((name + "/patches").c_str(), fit_patches, scene)->Unit(unit);
  };
  add("ours", ours());
  if (std::filesystem::exists(original().file)) add("original", original());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
