#include "clench/planning/energy/contact_energy.h"

#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/contact/cone.h"
#include "clench/grasp/wrench/wrench_space.h"

namespace clench {

using Eigen::Vector3d;

// --- ContactEnergy ---

ContactEnergy::ContactEnergy(const World& world, const HandAndObject& who, const Options& options)
    : sites_(world, who, options.contacts), options_(options) {
  if (!(std::isfinite(options.normal_weight) && options.normal_weight >= 0))
    fail("energy: normal_weight must be >= 0, got {}", options.normal_weight);
}

// outward normal of a triangle
static Vector3d face_normal(const Mesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3d n =
      (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  return n.stableNormalized();
}

ContactEnergy::SiteTerm ContactEnergy::measure(World& world, int i) {
  SiteTerm out{sites_.measure(world, i)};
  out.cosine = out.at.facing();
  if (options_.facing == Facing::away) out.cosine = -out.cosine;
  if (options_.facing == Facing::surface && out.at.triangle >= 0) {
    const Mesh& mesh = world.body(sites_.who().object).shape->mesh();
    out.cosine = -out.at.n.dot(face_normal(mesh, out.at.triangle));
  }
  return out;
}

double ContactEnergy::of(const SiteTerm& term) const {
  return energy_length * term.at.distance + options_.normal_weight * (1 - term.cosine);
}

double ContactEnergy::bounded_value(World& world, double bound) {
  sites_.attend(world);
  const int count = sites_.size();
  // rounding must not exclude a value at the bound
  const double enough = bound * count + 1e-9 * count;
  // no term is less than its distance
  min_rest_.assign(count + 1, 0);
  if (bound < infinite)
    for (int i = count - 1; i >= 0; --i)
      min_rest_[i] = min_rest_[i + 1] + energy_length * sites_.min_distance(world, i);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    if (const double min_sum = (sum + min_rest_[i]) * (1 - 1e-12); min_sum > enough)
      return min_sum / count;
    sum += of(measure(world, i));
  }
  return sum / count;
}

// --- PotentialQuality ---

PotentialQuality::PotentialQuality(const World& world, const HandAndObject& who,
                                   const Options& options)
    : sites_(world, who, options.contacts), options_(options) {
  if (!(std::isfinite(options.reach) && options.reach > 0))
    fail("energy: reach must be > 0 [m], got {}", options.reach);
  if (options.min_count < 1) fail("energy: min_count must be >= 1, got {}", options.min_count);
}

double PotentialQuality::lower_bound() const {
  // the support of no wrench space exceeds, in all directions, the force of two coincident contacts
  double mu = 0;
  for (int i = 0; i < sites_.size(); ++i) mu = std::max(mu, sites_.site(i).mu);
  return -2 * std::sqrt(1 + mu * mu);
}

double PotentialQuality::bounded_value(World& world, double) {
  sites_.attend(world);
  const Body& object = world.body(sites_.who().object);
  std::vector<UnitWrenches> pushing;
  int counted = 0;
  for (int i = 0; i < sites_.size(); ++i) {
    const SiteDistance at = sites_.measure(world, i);
    if (at.facing() < options_.min_facing || at.distance > options_.reach) continue;
    const double share = std::cos(std::numbers::pi * at.distance / options_.reach) + 1;
    counted += share > options_.min_share;
    UnitWrenches wrenches =
        unit_wrenches({.p_O = at.p, .n_O = at.n.normalized(), .mu = sites_.site(i).mu},
                      {.edges = 8, .rho = object.max_radius(), .p_OM = object.com});
    wrenches.edges *= share;
    pushing.push_back(std::move(wrenches));
  }
  if (counted < options_.min_count) return 1;
  WrenchSpaceOptions space;
  if (!options_.torques) space.coordinates = {0, 1, 2};
  const WrenchSpace forces(std::move(pushing), space);
  return forces.is_force_closure() ? -forces.epsilon() : 1;
}

// --- GuidedEnergy ---

double GuidedEnergy::bounded_value(World& world, double bound) {
  const double first = first_->value(world);
  return first <= 0 ? first : second_->value(world, bound);
}

}  // namespace clench
