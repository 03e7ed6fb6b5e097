#include "clench/motion/relax_springs.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/motion/springs.h"

namespace clench {

// springs are at rest if no joint has farther to move: a micrometer at the tip of a finger [rad or
// m]
static constexpr double at_rest = 1e-5;
// contacts that a finger slides along change during the motion; this many changes are followed
// before the tendon is pulled on
static constexpr int max_turns = 20;

namespace {

// fraction of their travel that all joints can make before one of them is at its limit
double within_limits(const DrivenRobot& driven, const JointSpeeds& travel) {
  double part = 1;
  for (int j = 0; j < static_cast<int>(travel.size()); ++j) {
    const Joint& joint = driven.robot().joints[j];
    const double q = driven.world.joints(driven.id)[j];
    const double left = travel[j] > 0 ? joint.max - q : joint.min - q;
    if (!joint.endless && travel[j] != 0 && std::abs(travel[j]) > std::abs(left))
      part = std::min(part, std::max(0.0, left / travel[j]));
  }
  return part;
}

// moves the joints of compliant DOFs as far as their springs pull them, or until a pair touches
Advance follow_springs(const DrivenRobot& driven, DrivePosture& posture, PairBounds& pairs,
                       const JointSpeeds& travel, int& queries) {
  std::vector<double> start;
  for (int j = 0; j < static_cast<int>(travel.size()); ++j)
    start.push_back(driven.world.joints(driven.id)[j]);
  const auto place = [&](double s) {
    for (size_t j = 0; j < travel.size(); ++j)
      if (travel[j] != 0) posture.own[j] = start[j] + s * travel[j];
    driven.place(posture);
  };
  return follow_path(driven, pairs, travel, within_limits(driven, travel), place, queries);
}

double longest(const JointSpeeds& travel) {
  double most = 0;
  for (const double x : travel) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

RelaxedSprings relax_springs(const DrivenRobot& driven, const DrivePosture& start,
                             PairBounds& pairs, const DriveOptions& options) {
  RelaxedSprings out{start};
  const auto is_sprung = [](const DofSpec& dof) { return dof.kind == DofKind::compliant; };
  if (std::ranges::none_of(driven.robot().dofs, is_sprung)) return out;
  for (int turn = 0; turn < max_turns; ++turn) {
    driven.world.context().progress().check();
    check_stop();
    const auto touching = driven.touching();
    const JointSpeeds travel =
        SpringBalance(driven.world, driven.id, driven.bodies, touching, turn > 0).displacement();
    if (longest(travel) <= at_rest) return out;
    const Advance end = follow_springs(driven, out.posture, pairs, travel, out.queries);
    out.posture = re_engaged(driven, std::move(out.posture));
    if (!end.stopped_by) continue;
    ++out.events;
    if (!options.stop_at_contact || end.stopped_by->touching) continue;
    out.stopped_by = {{end.stopped_by->a, end.stopped_by->b}};
    out.springs = Springs::stopped;
    return out;
  }
  out.springs = Springs::moving;
  return out;
}

}  // namespace clench
