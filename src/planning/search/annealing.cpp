#include "clench/planning/search/annealing.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/model/find.h"

namespace clench {

namespace {

constexpr int max_draws = 100;      // draws for a variable, until it lies in its range
constexpr int max_stuck = 10'000;   // tries in a row without a legal neighbor
constexpr double coldest = 1e-100;  // a temperature of 0 has no neighbors

double temperature(double t0, double decay, double dimensions, double step) {
  return std::max(t0 * std::exp(-decay * std::pow(step, 1 / dimensions)), coldest);
}

// log(1 + 1 / T) of a temperature: size of changes
double reach(double temperature) { return std::log(1 + 1 / temperature); }

// maps a uniform x in [-1, 1] to a change that is longer at higher temperatures: T ((1 + 1 / T)^|x|
// - 1)
double spread(double x, double temperature, double reach) {
  return std::copysign(temperature * (std::exp(reach * std::abs(x)) - 1), x);
}

void check_schedule(const AnnealingSchedule& s) {
  const auto positive = [](const char* name, double x) {
    if (!(std::isfinite(x) && x > 0)) fail("annealing: {} must be > 0, got {}", name, x);
  };
  positive("neighbor_decay", s.neighbor_decay);
  positive("error_decay", s.error_decay);
  positive("neighbor_dimensions", s.neighbor_dimensions);
  positive("error_dimensions", s.error_dimensions);
  positive("neighbor_scale", s.neighbor_scale);
  positive("error_scale", s.error_scale);
  positive("t0", s.t0);
  if (s.first_step < 0) fail("annealing: first_step must be >= 0, got {}", s.first_step);
}

}  // namespace

double AnnealingSchedule::neighbor_temperature(double step) const {
  return temperature(t0, neighbor_decay, neighbor_dimensions, step);
}
double AnnealingSchedule::error_temperature(double step) const {
  return temperature(t0, error_decay, error_dimensions, step);
}

AnnealingSchedule annealing_schedule(const std::string& name) {
  static const std::vector<std::pair<std::string, AnnealingSchedule>> known = {
      {"default", {}},
      {"loop", {.first_step = 35000}},
      {"modified", {2.38, 2.38, 8, 8, 1e-3, 1e-1, 1e3, 0}},
      {"strict", {0.72, 0.22, 2, 2, 1, 1, 10, 0}},
      {"online", {0.24, 0.54, 2, 3, 1, 1e-2, 10, 100}}};
  std::vector<std::string> names;
  for (const auto& [known_name, schedule] : known) {
    if (known_name == name) return schedule;
    names.push_back(known_name);
  }
  fail("annealing: no schedule '{}'{}", excerpt(name), instead_of(name, names));
}

Annealing::Annealing(World& world, const HandAndObject& who, SearchSpace space, EnergyPtr energy,
                     const AnnealingOptions& options)
    : world_(world),
      who_(who),
      space_(std::move(space)),
      energy_(std::move(energy)),
      options_(options),
      random_(options.seed),
      best_(options.best),
      parts_(world.bodies_of(who.hand)),
      k_(options.schedule.first_step) {
  space_.check();
  check_schedule(options.schedule);
  if (options.max_tries < 1) fail("annealing: max_tries must be >= 1, got {}", options.max_tries);
  if (std::ranges::all_of(space_.variables(), &Variable::fixed))
    fail("annealing: every variable is fixed");
  go_to(space_.start());
  first_energy_ = energy_value_;
}

void Annealing::go_to(const Values& values) {
  values_ = values;
  const HandState state = space_.state(values);
  // if the hand collides, any legal neighbor is better
  energy_value_ = place(state) == Verdict::collides ? infinite : energy_->value(world_);
  if (std::isfinite(energy_value_)) best_.add(space_, {values, state, energy_value_, 0});
}

Annealing::Verdict Annealing::place(const HandState& state) {
  if (best_.is_avoided(space_, state)) return Verdict::avoided;
  world_.set_posture(who_.hand, world_.pose(who_.object) * state.X_RH, state.dofs);
  if (options_.collisions && collides(world_, parts_, &world_.context())) return Verdict::collides;
  return Verdict::legal;
}

// A value near this one. With a target, values between it and the target are more likely than
// others, in proportion to the confidence in the target.
double Annealing::jump(const Variable& v, double value, double temperature, double reach) {
  double x;
  if (v.target && v.confidence > 0) {
    const double change = std::clamp(*v.target - value, -v.jump, v.jump) / v.jump;
    const double mean = std::copysign(std::log(1 + std::abs(change) / temperature) / reach, change);
    const double deviation = std::sqrt(1 - v.confidence);
    do x = mean + deviation * random_.normal();
    while (std::abs(x) > 1);
  } else {
    x = 2 * random_.uniform() - 1;
  }
  double out = value + v.jump * spread(x, temperature, reach);
  if (v.circular) {
    const double range = v.max - v.min;
    if (out > v.max) out -= range;
    if (out < v.min) out += range;
  }
  return out;
}

std::optional<Values> Annealing::neighbor() {
  const double temperature = options_.schedule.neighbor_scale *
                             options_.schedule.neighbor_temperature(static_cast<double>(k_));
  const double farthest = reach(temperature);
  Values out = values_;
  for (int i = 0; i < out.size(); ++i) {
    const Variable& v = space_.variables()[i];
    if (v.fixed) continue;
    int draws = 0;
    do {
      if (++draws > max_draws) {
        ++counts_.outside;
        return {};
      }
      out[i] = jump(v, values_[i], temperature, farthest);
    } while (!(out[i] >= v.min && out[i] <= v.max));
  }
  return out;
}

bool Annealing::take_step() {
  std::optional<Values> next;
  HandState state;
  bool legal = false;
  for (int i = 0; i < options_.max_tries && !legal; ++i) {
    next = neighbor();
    if (!next) continue;
    state = space_.state(*next);
    const Verdict verdict = place(state);
    legal = verdict == Verdict::legal;
    counts_.in_collision += verdict == Verdict::collides;
    counts_.avoided += verdict == Verdict::avoided;
  }
  if (!legal) return ++counts_.stuck, false;

  // the largest acceptable increase is drawn first: the energy of worse states need not be computed
  // exactly
  const double warmth =
      options_.schedule.error_temperature(static_cast<double>(k_)) / options_.schedule.error_scale;
  const double bound = energy_value_ - warmth * std::log(1 - random_.uniform());
  const double energy = energy_->value(world_, bound);
  ++k_, ++counts_.steps;
  if (!(energy <= bound)) return true;
  ++counts_.accepted;
  counts_.improved += energy < energy_value_;
  values_ = *next;
  energy_value_ = energy;
  if (best_.may_keep(energy)) best_.add(space_, {*next, std::move(state), energy, counts_.steps});
  return true;
}

int Annealing::run(int count, const Progress& progress) {
  int taken = 0;
  for (int stuck = 0; taken < count && stuck < max_stuck;) {
    progress.check();
    check_stop();
    if (take_step())
      ++taken, stuck = 0;
    else
      ++stuck;
  }
  return taken;
}

}  // namespace clench
