#include "clench/grasp/force/shared_actuators.h"

#include <algorithm>
#include <cmath>

namespace clench {

// its force at the DOF, and the effort per unit of it: within the sum of a tendon's forces, if no
// other actuator acts there
static SharedActuator of_term(const DofDrive& drive, const DriveTerm& term, int dof,
                              const Eigen::VectorXd& q) {
  SharedActuator out{term.force_at_rest(q), {{dof, term.reach}}};
  if (term.sum < 0) return out;
  const BoundedSum& sum = drive.sums[static_cast<size_t>(term.sum)];
  out.reaches[0].second *= sum.factor;
  if (term.reach != 1) return out;
  out.force.low = std::clamp(out.force.low, sum.bounds[0], sum.bounds[1]);
  out.force.high = std::clamp(out.force.high, sum.bounds[0], sum.bounds[1]);
  return out;
}

SharedActuators shared_actuators(const World& world, Id<Robot> id) {
  const Robot& robot = world.robot(id);
  const Eigen::VectorXd q = world.dofs(id);
  std::map<int, SharedActuator> all;
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d)
    for (const DriveTerm& term : robot.drives[d].terms) {
      if (term.actuator < 0 || term.reach == 0) continue;
      const SharedActuator part = of_term(robot.drives[d], term, d, q);
      const auto [at, fresh] = all.try_emplace(term.actuator, part);
      if (fresh) continue;
      auto& reaches = at->second.reaches;
      // several joints of one DOF
      if (reaches.back().first == d)
        reaches.back().second += part.reaches[0].second;
      else
        reaches.push_back(part.reaches[0]);
    }
  SharedActuators out;
  for (const auto& [number, actuator] : all)
    if (actuator.reaches.size() > 1) out.actuators.push_back(actuator);
  for (const SharedActuator& actuator : out.actuators)
    for (const auto& [dof, reach] : actuator.reaches) {
      if (out.others.contains(dof)) continue;
      DofDrive rest = robot.drives[dof];
      std::erase_if(rest.terms, [&](const DriveTerm& term) {
        const auto found = all.find(term.actuator);
        return found != all.end() && found->second.reaches.size() > 1;
      });
      out.others[dof] = rest.terms.empty() ? EffortRange{} : rest.at_rest(q);
    }
  return out;
}

}  // namespace clench
