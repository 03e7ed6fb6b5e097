#include "clench/motion/relax_springs.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/motion/springs.h"

namespace clench {

// springs are at rest when no joint has farther to go: a micrometre at the tip of a finger [rad or
// m]
static constexpr double at_rest = 1e-5;
// contacts that a finger slides along change on the way; so many changes are followed before the
// tendon is pulled on
static constexpr int max_turns = 20;

namespace {

// how much of a way all joints can go before one of them is at its limit
double within_limits(const Drive& drive, const JointSpeeds& way) {
  double part = 1;
  for (int j = 0; j < static_cast<int>(way.size()); ++j) {
    const Joint& joint = drive.robot().joints[j];
    const double q = drive.world.joints(drive.id)[j];
    const double room = way[j] > 0 ? joint.max - q : joint.min - q;
    if (!joint.endless && way[j] != 0 && std::abs(way[j]) > std::abs(room))
      part = std::min(part, std::max(0.0, room / way[j]));
  }
  return part;
}

// the joints of compliant DOFs go the way that their springs draw them
Advance follow_springs(Drive& drive, const JointSpeeds& way, int& queries) {
  std::vector<double> start;
  for (int j = 0; j < static_cast<int>(way.size()); ++j)
    start.push_back(drive.world.joints(drive.id)[j]);
  const auto place = [&](double s) {
    for (size_t j = 0; j < way.size(); ++j)
      if (way[j] != 0) drive.joint_positions[j] = start[j] + s * way[j];
    drive.place();
  };
  return follow_path(drive, way, within_limits(drive, way), place, queries);
}

double longest(const JointSpeeds& way) {
  double most = 0;
  for (const double x : way) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

Springs relax_springs(Drive& drive, const DriveOptions& options, DriveResult& result) {
  for (int turn = 0; turn < max_turns; ++turn) {
    drive.world.context().progress().check();
    check_stop();
    const auto touching =
        contacts(drive.world, drive.world.bodies(), drive.moving, &drive.world.context());
    const JointSpeeds way = SpringBalance(drive.world, drive.id, touching, turn > 0).displacement();
    if (longest(way) <= at_rest) return Springs::at_rest;
    const Advance end = follow_springs(drive, way, result.queries);
    re_engage(drive);
    if (!end.stopped_by) continue;
    ++result.events;
    if (!options.stop_at_contact || end.stopped_by->touching) continue;
    result.stopped_by = {{end.stopped_by->a, end.stopped_by->b}};
    return Springs::stopped;
  }
  return Springs::moving;
}

}  // namespace clench
