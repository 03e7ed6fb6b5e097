#include "clench/planning/energy/energy.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"

namespace clench {

EnergySum::EnergySum(std::vector<Term> terms) : terms_(std::move(terms)) {
  for (const Term& term : terms_)
    if (!(std::isfinite(term.weight) && term.weight >= 0))
      fail("energy: a weight must be >= 0, got {}", term.weight);
}

double EnergySum::bounded_value(World& world, double bound) {
  // lower bounds of the remaining terms
  double rest = 0;
  for (const Term& term : terms_)
    if (term.weight > 0) rest += term.weight * term.energy->lower_bound();
  double sum = 0;
  for (const Term& term : terms_) {
    if (term.weight == 0) continue;
    const double least = term.energy->lower_bound();
    const bool known = std::isfinite(rest);
    if (known) rest -= term.weight * least;
    // rounding must not exclude a value at the bound
    const double room = known ? (bound - sum - rest) / term.weight : infinite;
    const double slack = 1e-12 * (std::abs(room) + 1);
    sum += term.weight * term.energy->value(world, room + slack);
    if (known && sum + rest > bound) return sum + rest;
  }
  return sum;
}

double EnergySum::lower_bound() const {
  double sum = 0;
  for (const Term& term : terms_)
    if (term.weight > 0) sum += term.weight * term.energy->lower_bound();
  return sum;
}

EnergyPtr EnergySum::clone() const {
  std::vector<Term> terms;
  for (const Term& term : terms_) terms.push_back({term.weight, term.energy->clone()});
  return std::make_unique<EnergySum>(std::move(terms));
}

bool EnergySum::any_thread() const {
  return std::ranges::all_of(terms_, [](const Term& term) { return term.energy->any_thread(); });
}

EnergyWithin::EnergyWithin(EnergyPtr energy, double low, double high)
    : energy_(std::move(energy)), low_(low), high_(high) {
  if (!(low <= high)) fail("energy: expected low <= high, got {} and {}", low, high);
}

double EnergyWithin::bounded_value(World& world, double bound) {
  if (low_ > bound) return low_;
  // a value above the bound may still be limited by high
  return std::clamp(energy_->value(world, high_ <= bound ? high_ : bound), low_, high_);
}

EnergyPtr EnergyWithin::clone() const {
  return std::make_unique<EnergyWithin>(energy_->clone(), low_, high_);
}

double EnergyFunction::bounded_value(World&, double) {
  const double value = function_();
  if (std::isnan(value)) fail("energy: expected a number, got nan");
  return value;
}

}  // namespace clench
