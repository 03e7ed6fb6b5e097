#include "clench/spec/plausibility.h"

#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/spec/chains.h"

namespace clench {

static constexpr double min_size = 1e-3, max_size = 3;        // [m]
static constexpr double max_mass = 1000;                      // [kg]
static constexpr double max_turn = 4 * 2 * std::numbers::pi;  // [rad]

static void suspect(const Listeners& listeners, const std::string& sentence) {
  tell(listeners.suspect, listeners.warn, sentence);
}

static double length_of(const BodySpec& body) { return body.shape->bounds().size().maxCoeff(); }

static bool has_no_area(const Mesh& mesh) {
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i)
    if (!without_area(mesh, i)) return false;
  return true;
}

void check_plausible_object(const BodySpec& body, const std::string& place,
                            const Listeners& listeners) {
  if (!body.shape) return;
  const double length = length_of(body);
  if (has_no_area(body.shape->mesh()))
    suspect(listeners, place + ": none of its triangles has an area");
  else if (length < min_size || length > max_size)
    suspect(listeners, fmt::format("{}: it is {:.4g} m large: is its unit right?", place, length));
}

std::string some_names(const std::vector<std::string>& names) {
  constexpr size_t most = 6;
  std::string out;
  for (size_t i = 0; i < names.size() && i < most; ++i)
    out += fmt::format("{}'{}'", i ? ", " : "", excerpt(names[i]));
  if (names.size() > most) out += fmt::format(" and {} more", names.size() - most);
  return out;
}

void check_plausible(const RobotSpec& robot, const std::string& file, const Listeners& listeners) {
  std::vector<std::string> small, large, heavy, turning;
  const auto look = [&](const BodySpec& body) {
    if (body.shape && length_of(body) < min_size) small.push_back(body.name);
    if (body.shape && length_of(body) > max_size) large.push_back(body.name);
    if (body.mass > max_mass) heavy.push_back(body.name);
  };
  look(robot.base);
  for (const LinkSpec& link : robot.links) look(link.body);
  for (const auto& [chain, number, joint] : joints_of(robot))
    if (joint->kind == JointKind::revolute &&
        std::max(std::abs(joint->min), std::abs(joint->max)) > max_turn)
      turning.push_back(joint->name.empty() ? fmt::format("{} of chain {}", number, chain)
                                            : joint->name);
  const auto tell_of = [&](const std::vector<std::string>& names, const char* what,
                           const char* question) {
    if (!names.empty())
      suspect(listeners, fmt::format("{}: {}: {}: {}", file, what, some_names(names), question));
  };
  tell_of(small, "parts smaller than a millimetre", "is the unit of their geometry right?");
  tell_of(large, "parts larger than 3 m",
          "is the unit of their geometry right, or a scale of 0.001 missing?");
  tell_of(heavy, "parts heavier than a tonne", "is the unit of their mass or geometry right?");
  tell_of(turning, "joints that turn more than four times", "is the unit of their limits right?");
}

}  // namespace clench
