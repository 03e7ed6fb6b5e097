// Clench's wrench spaces compared with qhull: the same sets in one process, alternating, with all
// answers compared; and very many sets that are hard for hull algorithms, none of which may fail.
// Prints medians and ratios, and writes them as CSV.
//   bench_quality [--brief] [--csv FILE] [--check]
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/peer_qhull.h"
#include "bench/report.h"
#include "clench/base/error.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/grasp/wrench/grasp.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/motion/drive.h"
#include "grasp/wrench_sets.h"

using namespace clench;
using namespace clench::bench;
using namespace clench::test;

namespace {

using Set = std::vector<Wrenches>;

// tolerance of the comparison, for answers of size one
constexpr double agreement = 1e-9;

struct Named {
  std::string name;
  std::vector<Set> sets;
};

std::vector<PointContact> random_contacts(Random& random, int count) {
  std::vector<PointContact> out(count);
  for (PointContact& c : out) c = random_contact(random, 0.8);
  return out;
}

// random grasps, either all with or all without force closure
Named random_sets(int contacts, int count, bool closed) {
  Named out{fmt::format("{} contacts", contacts), {}};
  Random random(1, contacts);
  while (static_cast<int>(out.sets.size()) < count) {
    // no force closure: all contact points on one side, in half a ball of directions
    auto all = random_contacts(random, contacts);
    if (!closed)
      for (PointContact& c : all)
        if (c.n_O.z() < 0.3) c.n_O.z() = std::abs(c.n_O.z()) + 0.8, c.n_O.normalize();
    Set set = wrenches_of(all, 8);
    if (WrenchSpace(set).is_force_closure() == closed) out.sets.push_back(std::move(set));
  }
  return out;
}

std::vector<Named> symmetric_sets() {
  std::vector<Named> out;
  for (const int count : {4, 6, 8})
    out.push_back({fmt::format("solid of {}", count),
                   {wrenches_of(ball_contacts(solid_directions(count), 0.8), 8)}});
  for (const int count : {3, 5, 8, 16})
    out.push_back({fmt::format("ring of {}", count),
                   {wrenches_of(ball_contacts(ring_directions(count), 0.8), 8)}});
  for (const int faces : {2, 4, 6})
    out.push_back(
        {fmt::format("box {} faces", faces), {wrenches_of(box_contacts(faces, 0.5, 0.8), 8)}});
  return out;
}

// of hands that have closed on hard or soft objects
std::vector<Named> real_sets(bool brief) {
  std::vector<Named> out;
  ReadOptions options;
  options.root = ".";
  for (const char* name : {"dlr_flask", "barrett_mug", "human_flask", "tendon_cylinder"})
    for (const bool soft : {false, true}) {
      if (brief && (out.size() == 2)) continue;
      World world = build_world(read_world(std::string("worlds/") + name + ".wld", options));
      const auto hand = world.robots()[0];
      autograsp(world, hand);
      const auto object = world.bodies()[0];
      if (soft) world.set_elastic_modulus(object, 1e5);
      const Grasp grasp = find_grasp(world, hand, object);
      Set set;
      for (const PointContact& point : grasp.points)
        set.push_back(cone_wrenches(point, {.rho = grasp.rho, .p_OM = grasp.com}));
      out.push_back({fmt::format("{} {}{}", name, set.size(), soft ? " soft" : ""), {set}});
    }

  const char* given = std::getenv("CLENCH_SHARED");
  const std::filesystem::path reference =
      std::filesystem::path(given ? given : "../shared") / "reference";
  for (const char* name : {"dlr_flask", "barrett_flask_bestSA", "plannerMug"}) {
    std::ifstream file(reference / (std::string("autograsp_") + name + ".json"));
    if (!file) continue;
    const auto measured = nlohmann::json::parse(file);
    Set set;
    for (const auto& contact : measured["grasp_contact_list"]) {
      const auto& list = contact["wrenches_fx_fy_fz_tx_ty_tz"];
      Wrenches w(6, static_cast<int>(list.size()));
      for (int k = 0; k < w.cols(); ++k)
        for (int row = 0; row < 6; ++row) w(row, k) = list[k][row].get<double>();
      set.push_back(w);
    }
    if (WrenchSpace(set).is_force_closure())
      out.push_back({std::string("measured ") + name, {set}});
  }
  return out;
}

double size_of(const Wrenches& all) { return all.colwise().norm().maxCoeff(); }

// Option sets of qhull: the fastest one whose answers were all correct is used, query by query and
// pair by pair. Answers with joggled input (QJ) have errors of about 1e-10. If Qt, which gives
// exact hulls of triangles, accepts the set, it must agree with Clench; otherwise another option
// set is used
struct Way {
  const char *name, *options;
  bool competes;
};
constexpr Way ways[] = {{"qhull Qx", "qhull Pp Qx", true},
                        {"qhull Qt", "qhull Pp Qt", true},
                        {"qhull QJ", "qhull Pp QJ", true},
                        {"original's", "qhull Pp n Qx QJ C-0.0001", false}};
constexpr const char* reference = "qhull Qt";

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

// Counts the option sets of qhull that were used, by query.
class Fastest {
 public:
  /// wrong  option sets with a wrong answer or none
  void choose(const std::string& query, Times& times, const std::set<std::string>& wrong) {
    const Way* best = nullptr;
    for (const Way& way : ways)
      if (way.competes && !wrong.contains(way.name) &&
          (!best || mean_of(times[way.name]) < mean_of(times[best->name])))
        best = &way;
    if (!best) return;
    times["qhull"] = times[best->name];
    ++counts_[query][best->name];
  }
  void print() const {
    for (const auto& [query, names] : counts_)
      for (const auto& [name, count] : names)
        fmt::print("{}: {} is the fastest that is right, {} times\n", query, name, count);
  }

 private:
  std::map<std::string, std::map<std::string, int>> counts_;
};

void measure_epsilon(const std::string& query, const Named& named, int rounds, Report& report,
                     Fastest& fastest) {
  Times times;
  std::set<std::string> wrong;
  for (int round = 0; round < rounds; ++round)
    for (const Set& set : named.sets) {
      const Wrenches all = side_by_side(set);
      double epsilon = 0;
      bool confirmed = false;
      for (int again = 0; again < 3; ++again)
        epsilon = timed(times["ours"], [&] { return WrenchSpace(set).epsilon(); });
      for (const Way& way : ways) {
        const auto answer = timed(times[way.name], [&] { return ask_qhull(all, way.options); });
        const double theirs = answer ? std::max(0.0, answer->min_offset) : -1;
        const bool agrees = std::abs(theirs - epsilon) <= agreement * size_of(all);
        if (!agrees) wrong.insert(way.name);
        confirmed |= agrees;
        if (std::string(way.name) == reference && answer)
          report.check(
              agrees, fmt::format("{}, {}: qhull {}, ours {}", query, named.name, theirs, epsilon));
        else if (way.competes)
          report.count(way.name, agrees);
      }
      report.check(confirmed, fmt::format("{}, {}: ours {}", query, named.name, epsilon));
    }
  fastest.choose(query, times, wrong);
  report.add(query, named.name, times);
}

void measure_volume(const Named& named, int rounds, Report& report, Fastest& fastest) {
  const std::string query = "epsilon and volume";
  Times times;
  std::set<std::string> wrong;
  for (int round = 0; round < rounds; ++round)
    for (const Set& set : named.sets) {
      const Wrenches all = side_by_side(set);
      double epsilon = 0;
      const double volume = timed(times["ours"], [&] {
        const WrenchSpace space(set);
        epsilon = space.epsilon();
        return epsilon > 0 ? space.volume() : 0;
      });
      for (const Way& way : ways) {
        if (!way.competes) continue;
        const auto answer = timed(times[way.name],
                                  [&] { return ask_qhull(all, std::string(way.options) + " FA"); });
        const bool agrees = answer && std::abs(answer->volume - volume) <= agreement * volume &&
                            std::abs(answer->min_offset - epsilon) <= agreement * size_of(all);
        if (!agrees) wrong.insert(way.name);
        if (std::string(way.name) == reference)
          report.check(agrees, fmt::format("volume, {}: qhull {}, ours {}", named.name,
                                           answer ? answer->volume : 0, volume));
        else
          report.count(std::string(way.name) + " of volumes", agrees);
      }
    }
  fastest.choose(query, times, wrong);
  report.add(query, named.name, times);
}

void measure_ours(const std::string& query, const Named& named, WrenchNorm norm, Report& report) {
  Times times;
  for (const Set& set : named.sets)
    for (int again = 0; again < 3; ++again)
      timed(times["ours"], [&] { return WrenchSpace(set, {.norm = norm}).epsilon(); });
  report.add(query, named.name, times);
}

void measure_round(int contacts, int count, WrenchNorm norm, Report& report) {
  Times times;
  Random random(2, contacts);
  for (int i = 0; i < count; ++i) {
    std::vector<UnitWrenches> cones;
    for (const PointContact& c : random_contacts(random, contacts))
      cones.push_back(unit_wrenches(c, {.edges = round_edges}));
    timed(times["ours"], [&] { return WrenchSpace(cones, {.norm = norm}).epsilon(); });
  }
  report.add(
      norm == WrenchNorm::l1 ? "epsilon of round cones" : "epsilon of round cones, L-infinity",
      fmt::format("{} contacts", contacts), times);
}

// returns  number of failed sets
int measure_robustness(int count, Report& report) {
  int failures = 0;
  Times times, times_linf;
  for (int i = 0; i < count; ++i) {
    const int kind = i % wrench_set_kinds;
    const uint64_t number = static_cast<uint64_t>(i / wrench_set_kinds);
    const Set set = wrench_set(kind, number);
    const auto fails = [&](const std::string& why) {
      ++failures;
      fmt::print("FAILS: {} {}: {}\n", wrench_set_kind(kind), number, why);
    };
    try {
      const WrenchSpace space(set);
      const double size = size_of(side_by_side(set));
      const double epsilon = timed(times["ours"], [&] { return space.epsilon(); });
      const EpsilonBounds bounds = space.epsilon_bounds({.tolerance = agreement * size});
      if (!bounds.converged) fails("no bracket");
      if (space.is_force_closure() != (epsilon > 0)) fails("closure and epsilon differ");
      if (epsilon < bounds.lower - agreement * size || epsilon > bounds.upper + agreement * size)
        fails("epsilon outside of its bracket");
      // the larger sets of L-infinity take milliseconds
      if (i / wrench_set_kinds % 10 == 0 && set.size() <= 6) {
        const WrenchSpace sums(set, {.norm = WrenchNorm::linf});
        const double more = timed(times_linf["ours"], [&] { return sums.epsilon(); });
        if (!sums.epsilon_bounds({.tolerance = agreement * size * 8}).converged)
          fails("no bracket in L-infinity");
        if (more < epsilon - agreement * size) fails("L-infinity below L1");
      }
      // compared rarely: this hull takes as long as qhull
      if (i / wrench_set_kinds % 100 == 0) {
        const Hull hull = space.hull();
        const double exact = hull.full() ? std::max(0.0, hull.offsets.minCoeff()) : 0;
        report.check(
            std::abs(exact - epsilon) <= agreement * size,
            fmt::format("{} {}: qhull {}, ours {}", wrench_set_kind(kind), number, exact, epsilon));
      }
    } catch (const Error& error) {
      fails(error.what());
    }
  }
  report.add("epsilon of hard sets", fmt::format("{} sets", count), times);
  report.add("epsilon of hard sets, L-infinity", "every tenth", times_linf);
  return failures;
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = read_options(argc, argv, "bench_quality");
  if (!options) return 2;
  const auto [brief, check, csv] = *options;
  Report report;
  Fastest fastest;
  const int sets = brief ? 1 : 12;
  for (const int contacts : brief ? std::vector{3, 5} : std::vector{3, 5, 8, 16, 32}) {
    const Named closed = random_sets(contacts, sets, true);
    measure_epsilon("epsilon", closed, 1, report, fastest);
    measure_volume(closed, 1, report, fastest);
    measure_epsilon("not force closure", random_sets(contacts, sets, false), 1, report, fastest);
    measure_ours("epsilon, L-infinity", closed, WrenchNorm::linf, report);
    for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf})
      measure_round(contacts, sets, norm, report);
  }
  for (const Named& named : symmetric_sets())
    if (!brief || named.name == "solid of 4")
      measure_epsilon("epsilon, symmetric", named, brief ? 1 : 3, report, fastest);
  for (const Named& named : real_sets(brief))
    measure_epsilon("epsilon, real", named, brief ? 1 : 5, report, fastest);
  const int failures = measure_robustness(brief ? 160 : 100'000, report);

  report.sort();
  report.print({"ours", "qhull", "original's", "qhull Qx", "qhull Qt", "qhull QJ"});
  fastest.print();
  std::vector<Aim> aims = {
      {"epsilon, qhull / ours", report.ratio("epsilon", "qhull"), 100},
      // nearly all of their wrenches have facets near the ball, so that most of the hull is built
      {"epsilon of symmetric sets, qhull / ours", report.ratio("epsilon, symmetric", "qhull"), 35},
      {"epsilon of real sets, qhull / ours", report.ratio("epsilon, real", "qhull"), 100},
      {"not force closure, qhull / ours", report.ratio("not force closure", "qhull"), 200},
      {"epsilon and volume, qhull / ours", report.ratio("epsilon and volume", "qhull"), 2.5},
      {"failures", double(failures), 0, true}};
  if (!brief)
    aims.push_back({"epsilon, L-infinity, 8 contacts [us]",
                    report.median("epsilon, L-infinity", "8 contacts"), 5000, true});
  const bool good = report.judge(aims);
  const bool written = csv.empty() || report.write_csv(csv);
  return written && (good || !check) ? 0 : 1;
}
