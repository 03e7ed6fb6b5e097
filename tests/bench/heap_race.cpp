#include "bench/heap_race.h"

#include <algorithm>
#include <cmath>

#include "bench/heap_scenes.h"
#include "bench/report.h"
#include "clench/geometry/query/penetration.h"

namespace clench::bench {

namespace {

// Largest penetration depth of two parts [m], from their triangles: the same measure for all
// engines.
double max_depth(const DynamicEngine& engine, const DynamicScene& scene) {
  const int count = static_cast<int>(scene.parts.size());
  std::vector<std::shared_ptr<const Shape>> shapes;
  for (const Part& part : scene.parts) shapes.push_back(Shape::make(mesh_of(part), "part"));
  double depth = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      if (scene.parts[i].mass == 0 && scene.parts[j].mass == 0) continue;
      const Pose X_WA = engine.pose(i), X_AB = X_WA.inverse() * engine.pose(j);
      const Shape &a = *shapes[i], &b = *shapes[j];
      if ((X_AB * b.center() - a.center()).norm() > a.radius() + b.radius()) continue;
      depth = std::max(depth, penetration(a, b, X_AB).depth);
    }
  return depth;
}

HeapFigures run_heap(const EngineKind& kind, const DynamicScene& scene, int bodies, int steps,
                     double h) {
  constexpr int checks = 5;
  HeapFigures out{.scene = scene.name, .engine = kind.name, .bodies = bodies, .residual = NAN};
  const auto engine = kind.make(scene, h);
  for (int check = 0; check < checks; ++check) {
    const double start = cpu_seconds();
    engine->step(steps / checks);
    out.seconds += cpu_seconds() - start;
    out.penetration = std::max(out.penetration, max_depth(*engine, scene));
  }
  out.fallen =
      scene.parts[scene.watched].X_W.position.z() - engine->pose(scene.watched).position.z();
  if (kind.name == "ours") out.residual = world_of(*engine).dynamics()->report.max_residual;
  return out;
}

}  // namespace

std::vector<HeapFigures> race_heaps(const std::vector<EngineKind>& engines, double h, bool brief) {
  std::vector<HeapFigures> out;
  for (const int count : brief ? std::vector{20} : std::vector{20, 50, 100})
    for (const EngineKind& kind : engines)
      out.push_back(run_heap(kind, bin_of_boxes(count), count, brief ? 20 : 2000, h));
  if (const DynamicScene scans = bin_of_scans(30); !brief && !scans.parts.empty())
    for (const EngineKind& kind : engines) out.push_back(run_heap(kind, scans, 30, 500, h));
  const int steps = brief ? 10 : 1000;
  for (const EngineKind& kind : engines) {
    const DynamicScene house = card_house(brief ? 2 : 6, kind.gap);
    out.push_back(run_heap(kind, house, static_cast<int>(house.parts.size()) - 1, steps, h));
    const DynamicScene tower = plank_tower(brief ? 3 : 15, kind.gap);
    out.push_back(run_heap(kind, tower, static_cast<int>(tower.parts.size()) - 1, steps, h));
  }
  return out;
}

double growth_exponent(const std::vector<HeapFigures>& figures, const std::string& engine) {
  const HeapFigures *first = nullptr, *last = nullptr;
  for (const HeapFigures& f : figures)
    if (f.engine == engine && f.scene == "bin of boxes") (first ? last : first) = &f;
  if (!last) return NAN;
  return std::log(last->seconds / first->seconds) /
         std::log(static_cast<double>(last->bodies) / first->bodies);
}

}  // namespace clench::bench
