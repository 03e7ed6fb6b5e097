#include "clench/io/tree/closing_choice.h"

#include <algorithm>
#include <cmath>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/graspit/world_parts.h"

namespace clench {

// closing speeds if the file gives none
static constexpr double turning = 1;     // [rad/s]
static constexpr double sliding = 0.05;  // [m/s]
static constexpr double outer = 0.5;     // factor for joints distal to another closing joint

void set_closing(RobotSpec& robot, int dof, double sense) {
  double& velocity = robot.dofs[dof].default_velocity;
  const double pace = velocity != 0            ? std::abs(velocity)
                      : dof_slides(robot, dof) ? sliding
                                               : turning;
  velocity = sense > 0 ? pace : sense < 0 ? -pace : 0;
}

void slow_distal_joints(RobotSpec& robot) {
  constexpr int none = -1, several = -2;
  // DOFs that close on the path to a link, including its own joints: none, one, or several; parents
  // precede their children
  std::vector<int> before(robot.links.size(), none);
  // true if the DOF has a joint that is not distal to another DOF
  std::vector<bool> first(robot.dofs.size());
  for (size_t l = 0; l < robot.links.size(); ++l) {
    const LinkSpec& link = robot.links[l];
    int& way = before[l];
    if (link.parent >= 0) way = before[link.parent];
    for (const JointSpec& joint : link.joints) {
      if (robot.dofs[joint.dof].default_velocity == 0) continue;
      if (way == none || way == joint.dof) first[joint.dof] = true;
      way = way == none || way == joint.dof ? joint.dof : several;
    }
  }
  for (size_t d = 0; d < robot.dofs.size(); ++d)
    if (!first[d]) robot.dofs[d].default_velocity *= outer;
}

void choose_closing(RobotSpec& robot, const std::string& file, const ReadOptions& options) {
  std::vector<std::string> names;
  for (const DofSpec& dof : robot.dofs) names.push_back(dof.name);
  const auto choose = [&](const std::string& key, double sense, bool by_name) {
    auto found = key.empty() || !by_name ? names.end() : std::find(names.begin(), names.end(), key);
    const auto number = parse_integer(key);
    if (found == names.end() && number && *number >= 1 && *number <= static_cast<int>(names.size()))
      found = names.begin() + (*number - 1);
    if (found == names.end())
      fail("{}: close: expected the name of a DOF or a number from 1 to {}, got {}{}", file,
           names.size(), in_quotes(key), did_you_mean(key, names));
    if (sense != 1 && sense != -1 && sense != 0)
      fail("{}: close: {}: expected 1, -1 or 0, got {}", file, key, sense);
    set_closing(robot, static_cast<int>(found - names.begin()), sense);
  };
  for (const auto& [key, sense] : options.closing) choose(key, sense, true);
  for (const auto& [number, sense] : options.closing_by_number)
    choose(std::to_string(number), sense, false);
  if (options.approach) robot.X_BA = options.approach;
}

}  // namespace clench
