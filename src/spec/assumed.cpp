#include "clench/spec/assumed.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/spec/plausibility.h"

namespace clench {

void tell_assumed(std::span<const BodySpec* const> bodies, const Place& place,
                  const Diagnostics& diagnostics, std::span<const BodySpec* const> obstacles) {
  std::vector<std::string> neither, weightless, of_nothing, balls, uniform;
  const auto look = [&](const BodySpec* body) {
    if (!body->shape || body->assumptions_told) return;
    const bool mass_assumed = body->mass_from == Origin::assumed,
               material_assumed = body->material_from == Origin::assumed;
    if (mass_assumed && material_assumed)
      neither.push_back(body->name);
    else if (mass_assumed)
      weightless.push_back(body->name);
    else if (material_assumed)
      of_nothing.push_back(body->name);
  };
  for (const BodySpec* body : bodies) {
    look(body);
    if (!body->shape) continue;
    if (inertia_is_of_ball(*body))
      balls.push_back(body->name);
    else if (!body->inertia_per_mass && !body->inertia_told)
      uniform.push_back(body->name);
  }
  std::ranges::for_each(obstacles, look);
  const BodySpec assumed;
  // which of several
  const auto those = [&](const std::vector<std::string>& names) {
    return bodies.size() + obstacles.size() > 1 ? ": " + some_names(names) : "";
  };
  const auto note = [&](const std::vector<std::string>& names, const std::string& what) {
    if (!names.empty()) diagnostics.note(place, "{}{}", what, those(names));
  };
  note(neither, fmt::format("no mass and no material is given; {} kg of {} is assumed",
                            assumed.mass, assumed.material));
  note(weightless, fmt::format("no mass is given; {} kg is assumed", assumed.mass));
  note(of_nothing, fmt::format("no material is given; {} is assumed", assumed.material));
  note(uniform, "no inertia is given; that of a uniform solid is assumed");
  if (!balls.empty())
    diagnostics.suspected(place,
                          "no inertia is given, and the surface bounds no solid; that of a ball "
                          "around it is assumed{}",
                          those(balls));
}

}  // namespace clench
