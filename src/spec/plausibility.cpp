#include "clench/spec/plausibility.h"

#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/spec/chains.h"

namespace clench {

static constexpr double min_size = 1e-3, max_size = 3;        // [m]
static constexpr double limit_rounding = 1e-6;                // of limits [rad or m]
static constexpr double max_mass = 1000;                      // [kg]
static constexpr double max_turn = 4 * 2 * std::numbers::pi;  // [rad]

static double length_of(const BodySpec& body) { return body.shape->bounds().size().maxCoeff(); }

static bool has_no_area(const Mesh& mesh) {
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i)
    if (!without_area(mesh, i)) return false;
  return true;
}

/// Region that may contain its mass: its surface, or the visible one, enlarged to twice the size.
static bool within_reach(const BodySpec& body, const Eigen::Vector3d& p) {
  for (const ShapePtr& shape : {body.shape, body.appearance.visual}) {
    if (!shape) continue;
    const auto box = shape->bounds();
    const double size = box.size().maxCoeff();
    if (((p - box.low).array() >= -size).all() && ((box.high - p).array() >= -size).all())
      return true;
  }
  return false;
}

/// Does a file give a center of mass far from the surface?
static bool com_is_elsewhere(const BodySpec& body) {
  return body.com && body.shape && !within_reach(body, *body.com);
}

/// Does it give an inertia that mass within twice its radius cannot have?
static bool inertia_is_larger(const BodySpec& body) {
  if (!body.inertia_per_mass || !body.shape) return false;
  double r = largest_radius(body.shape->mesh(), com_of(body));
  if (const ShapePtr& visual = body.appearance.visual)
    r = std::max(r, largest_radius(visual->mesh(), com_of(body)));
  return body.inertia_per_mass->diagonal().maxCoeff() > 4 * r * r;
}

std::string doubt_mass(double mass, const Shape* shape) {
  // osmium has 22,600, air 1.2; motors elsewhere, and surfaces thinner than the body, explain
  // smaller deviations
  constexpr double heaviest = 250'000, lightest = 1;
  if (!shape || !shape->has_volume()) return {};
  const double density = mass / shape->solid().volume;
  if (density <= heaviest && density >= lightest) return {};
  return fmt::format("its mass of {:.4g} kg makes {:.3g} kg/m^3: is its unit right?", mass,
                     density);
}

std::string doubt_modulus(double modulus) {
  constexpr double softest = 1e4;  // rubber has about 1e6
  return modulus >= softest
             ? ""
             : fmt::format("{} Pa is softer than any rubber; is it meant in MPa?", modulus);
}

std::string doubt_gravity(const Eigen::Vector3d& gravity) {
  const double size = gravity.norm();
  return size > 100
             ? fmt::format("gravity is {:.4g} m/s^2, and the earth's is 9.81: is its unit right?",
                           size)
             : "";
}

// for a file that gives a mass
static std::string doubt_given_mass(const BodySpec& body) {
  // the smallest mass is used for 0
  return (body.mass_from != Origin::assumed || body.assumptions_told) && body.mass > mass_rule.min
             ? doubt_mass(body.mass, body.shape.get())
             : "";
}

void check_plausible_object(const BodySpec& body, const Place& place,
                            const Diagnostics& diagnostics) {
  if (!body.shape) return;
  const double length = length_of(body);
  if (has_no_area(body.shape->mesh()))
    diagnostics.suspected(place, "none of its triangles has an area");
  else if (length < min_size || length > max_size)
    diagnostics.suspected(place, "it is {:.4g} m large: is its unit right?", length);
  else if (const std::string doubt = doubt_given_mass(body); !doubt.empty())
    diagnostics.suspected(place, "{}", doubt);
  if (com_is_elsewhere(body))
    diagnostics.suspected(place, "its center of mass is far from its surface: is its unit right?");
  if (inertia_is_larger(body))
    diagnostics.suspected(place,
                          "its inertia is that of a much larger body: is it divided by the mass?");
}

std::string some_names(const std::vector<std::string>& names) {
  constexpr size_t most = 6;
  std::string out;
  for (size_t i = 0; i < names.size() && i < most; ++i)
    out += fmt::format("{}'{}'", i ? ", " : "", excerpt(names[i]));
  if (names.size() > most) out += fmt::format(" and {} more", names.size() - most);
  return out;
}

void check_plausible(const RobotSpec& robot, const Place& file, const Diagnostics& diagnostics) {
  std::vector<std::string> small, large, heavy, dense, turning, off, broad, outside;
  const auto look = [&](const BodySpec& body) {
    if (body.shape && length_of(body) < min_size) small.push_back(body.name);
    if (body.shape && length_of(body) > max_size) large.push_back(body.name);
    if (body.mass > max_mass)
      heavy.push_back(body.name);
    else if (!doubt_given_mass(body).empty())
      dense.push_back(body.name);
    if (com_is_elsewhere(body)) off.push_back(body.name);
    if (inertia_is_larger(body)) broad.push_back(body.name);
  };
  look(robot.base);
  for (const LinkSpec& link : robot.links) look(link.body);
  for (const auto& [chain, number, joint] : joints_of(robot))
    if (joint->kind == JointKind::revolute && !joint->endless &&
        std::max(std::abs(joint->min), std::abs(joint->max)) > max_turn)
      turning.push_back(joint->name.empty() ? fmt::format("{} of chain {}", number, chain)
                                            : joint->name);
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    const DofSpec& dof = robot.dofs[d];
    const auto [low, high] = dof_range(robot, static_cast<int>(d));
    if (dof.default_value != 0 && !dof_is_endless(robot, static_cast<int>(d)) &&
        (dof.default_value < low - limit_rounding || dof.default_value > high + limit_rounding))
      outside.push_back(dof.name.empty() ? fmt::format("{}", d) : dof.name);
  }
  const auto tell_of = [&](const std::vector<std::string>& names, const char* what,
                           const char* question) {
    if (!names.empty())
      diagnostics.suspected(file, "{}: {}: {}", what, some_names(names), question);
  };
  tell_of(small, "parts smaller than a millimeter", "is the unit of their geometry right?");
  tell_of(large, "parts larger than 3 m",
          "is the unit of their geometry right, or a scale of 0.001 missing?");
  tell_of(heavy, "parts heavier than a tonne", "is the unit of their mass or geometry right?");
  tell_of(dense, "parts ten times denser than any metal, or lighter than air",
          "is the unit of their mass right?");
  tell_of(off, "parts whose center of mass is far from their surface", "is its unit right?");
  tell_of(broad, "parts with the inertia of a much larger body",
          "is its unit right, and its mass?");
  tell_of(outside, "DOFs whose default value lies outside their limits, to which it is moved",
          "are limits or value exchanged?");
  tell_of(turning, "joints that turn more than four times", "is the unit of their limits right?");
}

}  // namespace clench
