// Geometry queries of Clench compared with other libraries: the same poses in one process,
// alternating query by query, with all answers compared. Prints medians and ratios, and writes them
// as CSV.
//   bench_geometry [--poses N] [--csv FILE] [--check]
#include <fmt/format.h>

#include <cstdlib>

#include "bench/pair_bench.h"
#include "bench/peers.h"
#include "bench/point_bench.h"
#include "bench/world_bench.h"

using namespace clench;
using namespace clench::bench;

namespace {

struct Options {
  int poses = 100;
  std::string csv;
  bool check = false;
};

std::vector<Aim> aims(const Report& r) {
  return {
      {"collide near, FCL / ours", r.ratio("collide near", "FCL"), 12},
      {"collide touching, FCL / ours", r.ratio("collide touching", "FCL"), 12},
      {"collide penetrating, FCL / ours", r.ratio("collide penetrating", "FCL"), 7},
      {"distance near, FCL / ours", r.ratio("distance near", "FCL"), 10},
      {"distance touching, FCL / ours", r.ratio("distance touching", "FCL"), 12},
      {"distance near, cold / seeded", r.ratio("distance near", "ours", "seeded distance near"), 2},
      // no other library has this query; a limit relative to Clench's own collision query (1.6)
      // would penalize a faster collision query
      {"pairs within 0.1 mm touching, FCL's collide / ours",
       r.ratio("collide touching", "FCL", "pairs within 0.1 mm touching"), 7},
      {"closest point, Embree / ours", r.ratio("closest point", "Embree"), 2.5},
      {"closest point, Embree / ours seeded",
       r.ratio("closest point", "Embree", "seeded closest point"), 3.5},
      {"build, us a triangle", r.mean("build, us a triangle"), 3, true},
      {"memory, bytes a triangle", r.mean("memory, bytes a triangle"), 300, true},
  };
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--check")
      options.check = true;
    else if (word == "--poses" && i + 1 < argc)
      options.poses = std::atoi(argv[++i]);
    else if (word == "--csv" && i + 1 < argc)
      options.csv = argv[++i];
    else
      return fmt::print(stderr, "usage: bench_geometry [--poses N] [--csv FILE] [--check]\n"), 2;
  }
  Report report;
  for (const MeshPair& pair : mesh_pairs()) {
    fmt::print("{}: {} and {} triangles\n", pair.name, pair.a->mesh().triangles.size(),
               pair.b->mesh().triangles.size());
    measure_pair(pair, options.poses, report);
    measure_points(pair.name, *pair.a, 5 * options.poses, report);
    measure_building(pair.name, *pair.a, report);
  }
  // a run with few poses only checks that everything works
  const bool brief = options.poses < 50;
  measure_worlds(brief ? 100 : 10000, report);
  measure_large_mesh(brief ? 10000 : 1000000, report);
  report.sort();

  std::vector<std::string> libraries = {"ours", "all pairs", "lattice"};
  for (const Peer& peer : peers()) libraries.push_back(peer.name);
  report.print(libraries);
  const bool good = report.judge(aims(report));
  const bool written = options.csv.empty() || report.write_csv(options.csv);
  return written && (good || !options.check) ? 0 : 1;
}
