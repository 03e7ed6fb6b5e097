// Annealing steps per second compared with the step built from FCL and Embree, alternating on the
// same random numbers in one process; energies per second, two threads compared with one, and
// memory over a long run.
//   bench_planning [--brief] [--csv FILE] [--check]
#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "bench/peer_step.h"
#include "bench/report.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/planning/energy/contact_energy.h"
#include "clench/planning/search/run_together.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::bench;

namespace {

/// A hand, an object, and the original's annealing steps per CPU second, or NaN.
struct Scene {
  std::string name, root, hand, object;
  double original = NAN;
};

// figures of the original: one thread, contact energy at preset contacts, axis-angle space; CPU
// seconds of its planner for 40,000 steps, but wall time for Barrett and flask
std::vector<Scene> scenes() {
  std::vector<Scene> out = {
      {"human hand + flask (ours)", ".", "models/hands/human/human20.cfg",
       "models/objects/flask.iv"},
      {"Barrett + flask (ours)", ".", "models/hands/barrett/barrett.cfg",
       "models/objects/flask.iv"},
      {"Barrett + mug (ours)", ".", "models/hands/barrett/barrett.cfg", "models/objects/mug.iv"}};
  const auto shared = test::shared();
  if (shared.empty()) {
    fmt::print(
        "no third-party data at ../shared or CLENCH_SHARED: measured are our own models alone\n");
    return out;
  }
  const std::string root = (shared / "data/graspit-xml").string();
  const auto at = [&](const char* file) { return root + "/models/" + file; };
  out.push_back({"human hand + flask", root, at("robots/HumanHand/HumanHand20DOF.xml"),
                 at("objects/flask.xml"), 1457});
  out.push_back(
      {"Barrett + flask", root, at("robots/Barrett/Barrett.xml"), at("objects/flask.xml"), 2280});
  out.push_back(
      {"Barrett + mug", root, at("robots/Barrett/Barrett.xml"), at("objects/mug.xml"), 1939});
  return out;
}

double resident_megabytes() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return double(resident) * 4096 / 1e6;
}

/// A chain with a separate world.
struct Chain {
  std::unique_ptr<World> world;
  HandAndObject who;
  std::unique_ptr<SearchSpace> space;
  std::unique_ptr<Annealing> search;
};

World built(const Scene& scene, HandAndObject& who) {
  World world;
  ReadOptions options{.root = scene.root};
  who.hand = add_robot(world, read_robot(scene.hand, options), {});
  who.object = world.add_body(read_body(scene.object, options), BodyKind::object, {});
  return world;
}

Chain chain_of(const World& world, const HandAndObject& who, uint64_t seed) {
  Chain out{std::make_unique<World>(world), who, nullptr, nullptr};
  const Robot& robot = world.robot(who.hand);
  const HandState start{world.pose(who.object).inverse() * world.pose(robot.base),
                        world.dofs(who.hand)};
  out.space = std::make_unique<SearchSpace>(robot, start);
  out.search = std::make_unique<Annealing>(
      *out.world, who, *out.space,
      std::make_unique<ContactEnergy>(*out.world, who, ContactEnergy::Options{}),
      AnnealingOptions{.seed = seed});
  return out;
}

struct Figures {
  double ours = NAN, plain = NAN, tuned = NAN, evaluations = NAN;  ///< per second
};

Figures measure(const Scene& scene, const BenchOptions& options, Report& report) {
  HandAndObject who;
  const World world = built(scene, who);
  constexpr int seed = 5;
  Chain own = chain_of(world, who, seed);
  Figures out;
  struct Peer {
    const char* name;
    PeerKind kind;
    Chain chain;
    std::unique_ptr<PeerStep> step;
    double time = 0;
  };
  std::vector<Peer> peers;
  for (const auto& [name, kind] :
       {std::pair{"FCL + Embree", PeerKind::plain}, {"FCL + Embree (tuned)", PeerKind::tuned}}) {
    Peer peer{name, kind, chain_of(world, who, seed), nullptr};
    peer.step = peer_step(*peer.chain.world, who, *peer.chain.space, seed, kind);
    if (peer.step) peers.push_back(std::move(peer));
  }
  // alternating blocks of the same steps, so that all visit the same states
  const int blocks = options.brief ? 2 : 20, steps = options.brief ? 20 : 500;
  double own_time = 0, energy_time = 0;
  int evaluated = 0;
  Chain beside = chain_of(world, who, seed);
  ContactEnergy energy(*beside.world, who, {});
  for (int b = 0; b < blocks; ++b) {
    double start = cpu_seconds();
    own.search->run(steps);
    own_time += cpu_seconds() - start;
    for (Peer& peer : peers) {
      start = cpu_seconds();
      peer.step->run(steps);
      peer.time += cpu_seconds() - start;
      const bool same = (own.search->values() - peer.step->values()).cwiseAbs().maxCoeff() < 1e-9 &&
                        std::abs(own.search->energy() - peer.step->energy()) <
                            1e-6 * std::abs(peer.step->energy());
      report.check(same, fmt::format("{}: where the chain stands after {} steps of {}", scene.name,
                                     (b + 1) * steps, peer.name));
    }
    // energies of states near the chain's; each state is set and evaluated again
    const HandState at = own.space->state(own.search->values());
    const Pose X_WO = beside.world->pose(who.object);
    start = cpu_seconds();
    for (int i = 0; i < steps; ++i, ++evaluated) {
      Pose X = X_WO * at.X_RH;
      X.position.x() += 1e-4 * i;
      beside.world->set_posture(who.hand, X, at.dofs);
      energy.value(*beside.world);
    }
    energy_time += cpu_seconds() - start;
  }
  out.ours = blocks * steps / own_time;
  out.evaluations = evaluated / energy_time;
  Times times;
  times["ours"].push_back(1e6 / out.ours);
  for (const Peer& peer : peers) {
    (peer.kind == PeerKind::plain ? out.plain : out.tuned) = blocks * steps / peer.time;
    times[peer.name].push_back(1e6 * peer.time / (blocks * steps));
  }
  if (!std::isnan(scene.original)) times["original"].push_back(1e6 / scene.original);
  report.add("annealing step", scene.name, times);
  report.add("energy evaluation", scene.name, {{"ours", {1e6 / out.evaluations}}});
  return out;
}

double thread_scaling(const Scene& scene, int steps) {
  HandAndObject who;
  const World world = built(scene, who);
  const auto seconds = [&](int threads) {
    std::vector<Chain> chains;
    std::vector<Share> shares;
    for (int i = 0; i < 4; ++i) chains.push_back(chain_of(world, who, uint64_t(i)));
    for (Chain& chain : chains) shares.push_back({chain.search.get(), steps});
    const double start = now();
    run_together(shares, threads);
    return (now() - start) * 1e-6;
  };
  seconds(1);
  const double one = seconds(1);
  return one / seconds(2);
}

/// memory at the end of a long run divided by that after its first quarter
double memory_growth(const Scene& scene, int steps) {
  HandAndObject who;
  const World world = built(scene, who);
  Chain chain = chain_of(world, who, 3);
  chain.search->run(steps / 4);
  const double before = resident_megabytes();
  chain.search->run(steps - steps / 4);
  return resident_megabytes() / before;
}

}  // namespace

int main(int argc, char** argv) {
  const auto read = read_options(argc, argv, "bench_planning");
  if (!read) return 2;
  const BenchOptions& options = *read;
  Report report;
  const auto all = scenes();
  std::vector<Aim> aims;
  fmt::print("{:26} {:>8} {:>13} {:>6} {:>8} {:>6} {:>9} {:>6} {:>11}\n",
             "steps a second, one thread", "ours", "FCL + Embree", "ratio", "tuned", "ratio",
             "original", "ratio", "energies/s");
  double min_peer = infinite, min_original = infinite;
  bool original = false;
  for (const Scene& scene : all) {
    const Figures f = measure(scene, options, report);
    fmt::print("{:26} {:8.0f} {:13.0f} {:6.1f} {:8.0f} {:6.1f} {:9.0f} {:6.1f} {:11.0f}\n",
               scene.name, f.ours, f.plain, f.ours / f.plain, f.tuned, f.ours / f.tuned,
               scene.original, f.ours / scene.original, f.evaluations);
    // the minimum is NaN if any figure is missing
    const double ratio = f.ours / f.plain;
    min_peer = std::isnan(ratio) ? NAN : std::min(min_peer, ratio);
    if (!std::isnan(scene.original)) {
      min_original = std::min(min_original, f.ours / scene.original);
      original = true;
    }
  }
  aims.push_back({"least of FCL + Embree / ours (aim 20)", min_peer, 8});
  // the original's figures are for its own models
  if (original)
    aims.push_back({"least of ours / the original's (aim 25)", min_original, 15});
  else
    fmt::print("the original's steps a second are of its own models, which are not here\n");
  const double growth = memory_growth(all[2], options.brief ? 400 : 40'000);
  aims.push_back({"memory at the end / after a quarter of a long run", growth, 1.02, true});
  if (!options.brief && std::thread::hardware_concurrency() > 1)
    fmt::print("two threads / one, four chains: {:.2f} (aim 1.8 on an idle machine)\n",
               thread_scaling(all[0], 10'000));
  report.sort();
  const bool good = report.judge(aims);
  const bool written = options.csv.empty() || report.write_csv(options.csv);
  return written && (good || !options.check) ? 0 : 1;
}
