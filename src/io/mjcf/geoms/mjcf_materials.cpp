#include "clench/io/mjcf/geoms/mjcf_materials.h"

#include <algorithm>
#include <tuple>

#include "clench/spec/plausibility.h"

namespace clench {

// a world stores the friction of every pair of materials
static constexpr size_t max_frictions = 500;

std::string MjcfMaterials::of(const std::vector<MjcfGeom>& geoms, const std::string& body) {
  const MjcfGeom* first = nullptr;
  bool mixed = false;
  for (const MjcfGeom& geom : geoms) {
    if (!geom.collides()) continue;
    mixed = mixed || (first && geom.friction != first->friction);
    const auto rank = [](const MjcfGeom& g) {
      return std::tuple(g.friction.priority, !g.friction.frictionless, g.friction.mu);
    };
    if (!first || rank(geom) > rank(*first)) first = &geom;
  }
  if (mixed) mixed_.push_back(body);
  const OwnFriction friction = first ? first->friction : OwnFriction{};
  if (frictions_.size() == max_frictions && !frictions_.contains(friction))
    fail("{}: geom: expected at most {} different frictions of bodies, got more", file_,
         max_frictions);
  frictions_.insert(friction);
  return material_name(friction);
}

void MjcfMaterials::tell(const FileCache& cache) const {
  if (!mixed_.empty())
    cache.diagnostics().warn(Place(file_),
                             "bodies whose geoms differ in friction; the one of the highest "
                             "priority, then the largest, is used for all: {}",
                             some_names(mixed_));
}

bool is_friction_given(const std::vector<MjcfGeom>& geoms) {
  return std::ranges::any_of(
      geoms, [](const MjcfGeom& geom) { return geom.collides() && geom.friction_given; });
}

}  // namespace clench
