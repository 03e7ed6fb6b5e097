// Steps per CPU second together with accuracy: Clench's dynamics compared with ODE and Bullet on
// scenes of primitives, in alternating blocks of one process; grips that are hard to hold; a hand
// on an arm that holds a glass.
//   bench_dynamics [--brief] [--csv FILE] [--check]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/dynamic_engine.h"
#include "bench/heap_race.h"
#include "bench/report.h"
#include "clench/dynamics/control/closing.h"
#include "clench/dynamics/stepper.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::bench;

namespace {

constexpr double h = 1e-3;

/// processor time of this thread [us]
double cpu() { return 1e6 * cpu_seconds(); }

double middle(std::vector<double> values) {
  if (values.empty()) return NAN;
  const auto m = values.begin() + static_cast<long>(values.size()) / 2;
  std::nth_element(values.begin(), m, values.end());
  return *m;
}

/// Results of an engine on a scene.
struct Outcome {
  std::string engine;
  std::unique_ptr<DynamicEngine> run;
  /// by part, at the start and in the middle of the measured steps
  std::vector<Pose> begin, middle;
  std::vector<Eigen::Vector3d> velocity;  ///< at the start of the measured steps
  std::vector<double> times;              ///< per step, by block [us]
};

struct Length {
  int settle, steps, block;
};

std::vector<Pose> poses_of(const Outcome& o, const DynamicScene& scene) {
  std::vector<Pose> out;
  for (size_t i = 0; i < scene.parts.size(); ++i) out.push_back(o.run->pose(static_cast<int>(i)));
  return out;
}

template <class Make>
std::vector<Outcome> race(const std::vector<EngineKind>& engines, Make&& make,
                          const Length& length) {
  std::vector<Outcome> out;
  for (const EngineKind& kind : engines) {
    const DynamicScene scene = make(kind.gap);
    out.push_back({kind.name, kind.make(scene, h), {}, {}, {}, {}});
    Outcome& o = out.back();
    o.run->step(length.settle);
    o.begin = poses_of(o, scene);
    for (size_t i = 0; i < scene.parts.size(); ++i)
      o.velocity.push_back(o.run->velocity(static_cast<int>(i)));
  }
  const DynamicScene scene = make(0);
  for (int done = 0; done < length.steps; done += length.block)
    for (Outcome& o : out) {
      if (done == length.steps / 2 / length.block * length.block) o.middle = poses_of(o, scene);
      const double start = cpu();
      o.run->step(length.block);
      o.times.push_back((cpu() - start) / length.block);
    }
  return out;
}

/// time of an engine divided by Clench's, block by block; NaN if the engine did not run
double ratio(const std::vector<Outcome>& all, const std::string& engine) {
  std::vector<double> ratios;
  for (const Outcome& o : all)
    if (o.engine == engine)
      for (size_t i = 0; i < o.times.size(); ++i) ratios.push_back(o.times[i] / all[0].times[i]);
  return middle(ratios);
}

/// Published figures of engines that are not run here, in steps of 1 ms per CPU second of a Zen 3
/// server: MuJoCo 3.3.8 with elliptic cones, and the original (GraspIt!) on a box on a slope. They
/// are listed for orientation only: another machine, similar scenes.
struct Elsewhere {
  const char *engine, *scene;
  double rate;
};
constexpr Elsewhere elsewhere[] = {{"MuJoCo (elsewhere)", "stack of ten", 18500},
                                   {"MuJoCo (elsewhere)", "hand holds", 9500},
                                   {"MuJoCo (elsewhere)", "slope slides", 300000},
                                   {"original (elsewhere)", "slope slides", 1400}};

/// A table that is printed row by row: rates, and the accuracy measures of a scene.
class Table {
 public:
  explicit Table(Report& report) : report_(report) {}

  void add_rates(const std::vector<Outcome>& all, const std::string& scene) {
    Times times;
    for (const Outcome& o : all) {
      times[o.engine] = o.times;
      fmt::print("{:20} {:24} {:>10.0f} steps a second\n", scene, o.engine, 1e6 / middle(o.times));
    }
    for (const Elsewhere& e : elsewhere)
      if (scene == e.scene) {
        times[e.engine] = {1e6 / e.rate};
        fmt::print("{:20} {:24} {:>10.0f} steps a second\n", scene, e.engine, e.rate);
      }
    report_.add("step [us]", scene, times);
  }
  void add(const std::string& what, const std::string& scene, const std::string& engine,
           double value) {
    fmt::print("{:20} {:24} {:>10.3g} {}\n", scene, engine, value, what);
    values_[what + scene][engine].push_back(value);
    names_.emplace(what + scene, std::pair(what, scene));
  }
  void close() {
    for (const auto& [key, times] : values_)
      report_.add(names_.at(key).first, names_.at(key).second, times);
  }

 private:
  Report& report_;
  std::map<std::string, Times> values_;
  std::map<std::string, std::pair<std::string, std::string>> names_;
};

// aims require values above 0
double seen(double value) { return std::max(value, 1e-18); }

void measure_stack(const std::vector<EngineKind>& peers, bool brief, Table& table,
                   std::vector<Aim>& aims) {
  const Length length = brief ? Length{20, 20, 10} : Length{500, 2000, 100};
  const auto all = race(peers, stack_of_ten, length);
  table.add_rates(all, "stack of ten");
  for (const Outcome& o : all) {
    double drift = 0, deep = -INFINITY, deep_before = -INFINITY;
    const DynamicScene scene = stack_of_ten(0);
    const std::vector<Pose> end = poses_of(o, scene);
    const auto overlap = [&](const std::vector<Pose>& at, int i) {
      const double below = i == 1 ? -0.02 : at[i - 1].position.z();
      return 0.04 - (at[i].position.z() - below);
    };
    for (int i = 1; i <= 10; ++i) {
      drift =
          std::max(drift, (end[i].position - o.middle[i].position).norm() / (length.steps / 2 * h));
      deep = std::max(deep, overlap(end, i));
      deep_before = std::max(deep_before, overlap(o.middle, i));
    }
    table.add("drift [m/s]", "stack of ten", o.engine, drift);
    table.add("penetration [m]", "stack of ten", o.engine, std::max(deep, 0.0));
    if (&o != &all[0]) continue;
    aims.push_back({"stack of ten, drift [m/s]", seen(drift), 1e-6, true});
    // a negative overlap is a gap
    aims.push_back({"stack of ten, penetration [m]", seen(deep), 1e-4, true});
    aims.push_back(
        {"stack of ten, growth of penetration [m/s]", seen(deep - deep_before), 1e-7, true});
  }
  aims.push_back({"stack of ten, ODE quick step / ours", ratio(all, "ODE quick step"), 2.5});
}

// Measured while the boxes fall and tumble: bodies at rest cost next to nothing.
void measure_bin(const std::vector<EngineKind>& peers, bool brief, Table& table) {
  const Length length = brief ? Length{0, 20, 10} : Length{0, 1200, 50};
  const auto all = race(peers, boxes_in_a_bin, length);
  table.add_rates(all, "boxes in a bin");
  const DynamicScene scene = boxes_in_a_bin(0);
  for (const Outcome& o : all) {
    double sum = 0;
    for (const double time : o.times) sum += time * length.block * 1e-6;
    table.add("time of all steps [s]", "boxes in a bin", o.engine, sum);
    const std::vector<Pose> end = poses_of(o, scene);
    const auto left = std::ranges::count_if(end, [](const Pose& X) {
      return X.position.cwiseAbs().head<2>().maxCoeff() > 0.2 || X.position.z() < -0.06;
    });
    table.add("boxes lost", "boxes in a bin", o.engine, static_cast<double>(left));
  }
}

void measure_heaps(const std::vector<EngineKind>& engines, bool brief, Table& table,
                   std::vector<Aim>& aims) {
  const std::vector<HeapFigures> all = race_heaps(engines, h, brief);
  double ours = NAN, ode = NAN;
  for (const HeapFigures& f : all) {
    const std::string scene = fmt::format("{}, {} bodies", f.scene, f.bodies);
    table.add("time of all steps [s]", scene, f.engine, f.seconds);
    table.add("largest penetration [m]", scene, f.engine, f.penetration);
    if (!f.scene.starts_with("bin")) table.add("sinks [m]", scene, f.engine, f.fallen);
    if (f.engine != "ours") {
      if (f.bodies == 100) ode = f.seconds;
      continue;
    }
    table.add("largest residual [m/s]", scene, f.engine, f.residual);
    if (f.bodies == 100) ours = f.seconds;
    if (f.scene.starts_with("bin")) continue;
    aims.push_back({f.scene + " sinks [m]", seen(f.fallen), 1e-4, true});
  }
  if (brief) return;
  for (const EngineKind& kind : engines)
    table.add("exponent of time over bodies", "bin of boxes", kind.name,
              growth_exponent(all, kind.name));
  table.add("ODE quick step / ours, time", "bin of boxes, 100 bodies", "ours", ode / ours);
}

void measure_hand(const std::vector<EngineKind>& peers, bool brief, Table& table,
                  std::vector<Aim>& aims) {
  const Length length = brief ? Length{20, 20, 10} : Length{500, 2000, 100};
  const auto all = race(peers, three_fingers, length);
  table.add_rates(all, "hand holds");
  for (const Outcome& o : all) {
    const double drift = (o.run->pose(0).position - o.begin[0].position).norm();
    table.add("drift in 2 s [m]", "hand holds", o.engine, drift);
    if (&o == &all[0]) aims.push_back({"hand holds, drift in 2 s [m]", seen(drift), 1e-6, true});
  }
  aims.push_back({"hand holds, ODE quick step / ours", ratio(all, "ODE quick step"), 1.5});
  aims.push_back({"hand holds, ODE world step / ours", ratio(all, "ODE world step"), 3});
  if (brief) return;
  const EngineKind ours = our_engine();
  const auto held = ours.make(three_fingers(ours.gap), h);
  held->step(500);
  const Pose before = held->pose(0);
  held->step(60000);
  const double drift = (held->pose(0).position - before.position).norm();
  table.add("drift in 60 s [m]", "hand holds", "ours", drift);
  aims.push_back({"hand holds, drift in 60 s [m]", seen(drift), 1e-6, true});
}

void measure_slope(const std::vector<EngineKind>& peers, bool brief, Table& table,
                   std::vector<Aim>& aims) {
  const Length length = brief ? Length{20, 20, 10} : Length{500, 2000, 100};
  const double angle = slope_angle * std::numbers::pi / 180, limit = std::tan(angle);
  const auto sliding = race(
      peers, [&](double gap) { return slope(slope_angle, 0.95 * limit, gap); }, length);
  table.add_rates(sliding, "slope slides");
  const double book = gravity * (std::sin(angle) - 0.95 * limit * std::cos(angle));
  for (const Outcome& o : sliding) {
    const double error =
        std::abs((o.run->velocity(1) - o.velocity[1]).norm() / (length.steps * h) - book);
    table.add("acceleration, off by [m/s2]", "slope slides", o.engine, error);
    if (&o == &sliding[0])
      aims.push_back({"slope slides, acceleration off by [m/s2]", seen(error), 1e-9, true});
  }
  const auto sticking = race(
      peers, [&](double gap) { return slope(slope_angle, 1.05 * limit, gap); }, length);
  table.add_rates(sticking, "slope sticks");
  for (const Outcome& o : sticking) {
    const double creep =
        (o.run->pose(1).position - o.begin[1].position).norm() / (length.steps * h);
    table.add("creep [m/s]", "slope sticks", o.engine, creep);
    if (&o == &sticking[0]) aims.push_back({"slope sticks, creep [m/s]", seen(creep), 1e-9, true});
  }
  for (const auto& [all, name] : {std::pair(&sliding, "slides"), std::pair(&sticking, "sticks")}) {
    aims.push_back(
        {fmt::format("slope {}, ODE quick step / ours", name), ratio(*all, "ODE quick step"), 0.7});
    aims.push_back({fmt::format("slope {}, ODE quick step on meshes / ours", name),
                    ratio(*all, "ODE quick step, meshes"), 3});
  }
  if (brief) return;
  // the same acceleration for any time step
  const EngineKind ours = our_engine();
  double worst = 0;
  for (const double step : {5e-4, 2e-3, 5e-3}) {
    const auto run = ours.make(slope(slope_angle, 0.95 * limit, ours.gap), step);
    const int steps = static_cast<int>(std::lround(0.5 / step));
    run->step(steps);
    const Eigen::Vector3d before = run->velocity(1);
    run->step(steps);
    worst = std::max(worst, std::abs((run->velocity(1) - before).norm() / (steps * step) - book));
  }
  table.add("acceleration, steps of 0.5 to 5 ms, off by [m/s2]", "slope slides", "ours", worst);
  aims.push_back({"slope slides, steps of 0.5 to 5 ms, off by [m/s2]", seen(worst), 1e-9, true});
}

/// mean velocity at which the watched part sinks after it has settled [m/s]
double sinking(const EngineKind& kind, const DynamicScene& scene, double step, double seconds) {
  const auto run = kind.make(scene, step);
  run->step(static_cast<int>(std::lround(0.5 / step)));
  const double before = run->pose(scene.watched).position.z();
  const int steps = static_cast<int>(std::lround(seconds / step));
  run->step(steps);
  return std::abs(before - run->pose(scene.watched).position.z()) / (steps * step);
}

void measure_grips(const std::vector<EngineKind>& engines, bool brief, Table& table,
                   std::vector<Aim>& aims, Report& report) {
  const std::vector<double> steps = brief ? std::vector{1e-3} : std::vector{5e-4, 1e-3, 2e-3, 5e-3};
  const double seconds = brief ? 0.1 : 2;
  for (const EngineKind& kind : engines) {
    const bool own = &kind == &engines[0];
    double capsule = 0, held = 0, unbalanced = 0, jitter = 0, fallen = INFINITY;
    for (const double step : steps) {
      if (!own && step != h) continue;
      for (const double force : {12.0, 60.0})
        capsule = std::max(capsule, sinking(kind, pinched_capsule(force, kind.gap), step, seconds));
      held = std::max(held, sinking(kind, critical_grip(1.01, kind.gap), step, seconds));
      fallen = std::min(fallen, sinking(kind, critical_grip(0.99, kind.gap), step, 0.2));
      if (!own) continue;
      const GripForces grip = our_grip(critical_grip(1.01, kind.gap), step, brief ? 0.1 : 0.5);
      unbalanced = std::max(unbalanced, std::abs(grip.tangential / (0.3 * gravity) - 1));
      jitter = std::max(jitter, grip.jitter);
    }
    table.add("sinks [um/s]", "pinched capsule", kind.name, 1e6 * capsule);
    table.add("creep at 1.01 of its weight [um/s]", "critical friction", kind.name, 1e6 * held);
    table.add("falls at 0.99 [um/s]", "critical friction", kind.name, 1e6 * fallen);
    if (!own) continue;
    table.add("friction against weight, off by", "critical friction", kind.name, unbalanced);
    table.add("jitter of a pad's force, relative", "critical friction", kind.name, jitter);
    aims.push_back({"pinched capsule sinks [um/s]", seen(1e6 * capsule), 1e-3, true});
    aims.push_back({"critical friction, creep at 1.01 [um/s]", seen(1e6 * held), 1e-3, true});
    aims.push_back(
        {"critical friction, friction against weight off by", seen(unbalanced), 1e-6, true});
    aims.push_back({"critical friction, jitter of a pad's force", seen(jitter), 1e-6, true});
    report.check(held < 1e-6, "critical friction: it is held at 1.01 of its weight");
    // after 0.5 s its mean velocity exceeds half of the theoretical value
    report.check(fallen > 0.5 * 0.01 * gravity * 0.5,
                 "critical friction: it falls at 0.99 of its weight");
  }
}

void measure_demo(bool brief, Table& table, Report& report, std::vector<Aim>& aims) {
  World world = build_world(read_world("worlds/puma_barrett_glass.wld", {.root = "."}));
  const auto hand = world.robots().back();
  const auto objects = world.bodies();
  const auto glass = *std::ranges::find_if(
      objects, [&](Id<Body> id) { return world.body(id).kind == BodyKind::object; });
  Stepper stepper(world);
  close_by_motors(world, hand, 1);
  stepper.run(brief ? 0.01 : 3);
  const Pose before = world.pose(glass);
  std::vector<double> times;
  for (int block = 0; block < (brief ? 1 : 20); ++block) {
    const double start = cpu();
    stepper.run(brief ? 0.01 : 0.1);
    times.push_back((cpu() - start) / (brief ? 10 : 100));
  }
  const double moved = (world.pose(glass).position - before.position).norm();
  fmt::print("{:20} {:24} {:>10.0f} steps a second\n", "arm, hand, glass", "ours",
             1e6 / middle(times));
  report.add("step [us]", "arm, hand, glass", {{"ours", times}});
  table.add("drift in 2 s [m]", "arm, hand, glass", "ours", moved);
  report.check(world.dynamics()->report.failures == 0, "arm, hand, glass: a step failed");
  size_t touching = 0;
  for (const Manifold& m : world.dynamics()->manifolds)
    if (const Id<Body> other = m.a == glass ? m.b : m.a;
        (m.a == glass || m.b == glass) && world.body(other).robot == hand)
      touching += m.points.size();
  report.check(brief || touching >= 3, "arm, hand, glass: the hand does not hold the glass");
  if (!brief) aims.push_back({"arm, hand, glass, drift in 2 s [m]", seen(moved), 1e-6, true});
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = read_options(argc, argv, "bench_dynamics");
  if (!options) return 2;
  const auto [brief, check, csv] = *options;
  Report report;
  Table table(report);
  std::vector<Aim> aims;
  std::vector<EngineKind> engines = {our_engine(), ode_engine(OdeMethod::quick_step, false),
                                     ode_engine(OdeMethod::world_step, false)};
#ifdef CLENCH_BENCH_BULLET
  engines.push_back(bullet_engine());
#endif
  std::vector<EngineKind> on_meshes = engines;
  on_meshes.push_back(ode_engine(OdeMethod::quick_step, true));
  on_meshes.push_back(ode_engine(OdeMethod::world_step, true));
  measure_stack(engines, brief, table, aims);
  measure_bin(engines, brief, table);
  measure_heaps({our_engine(), ode_engine(OdeMethod::quick_step, false)}, brief, table, aims);
  measure_hand(engines, brief, table, aims);
  measure_slope(on_meshes, brief, table, aims);
  measure_grips(engines, brief, table, aims, report);
  measure_demo(brief, table, report, aims);
  table.close();
  fmt::print("\n");
  const bool good = report.judge(aims);
  const bool written = csv.empty() || report.write_csv(csv);
  return written && (good || !check) ? 0 : 1;
}
