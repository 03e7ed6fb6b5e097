#include "clench/planning/energy/closing_energy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "clench/base/error.h"
#include "clench/grasp/force/equilibrium.h"
#include "clench/grasp/force/resistance.h"
#include "clench/motion/drive.h"
#include "clench/motion/move.h"

namespace clench {

using Eigen::Vector3d;

namespace {

// restores all that an energy moves, also after an exception
class PutBack {
 public:
  explicit PutBack(World& world) : world_(world), snapshot_(world.snapshot()) {}
  ~PutBack() { world_.restore(*snapshot_); }
  PutBack(const PutBack&) = delete;
  PutBack& operator=(const PutBack&) = delete;

 private:
  World& world_;
  std::shared_ptr<const Snapshot> snapshot_;
};

bool base_touches(World& world, Id<Robot> hand) {
  const std::array base{world.robot(hand).base};
  return !contacts(world, world.bodies(), base, &world.context()).empty();
}

bool hand_collides(World& world, Id<Robot> hand) {
  const auto parts = world.bodies_of(hand);
  return !colliding_pairs(world, parts, world.bodies(), &world.context()).empty();
}

// Backs off along the approach direction until nothing collides, then moves to the first touch.
bool find_first_contact(World& world, Id<Robot> hand, double reach) {
  constexpr int most = 20;
  const Vector3d back = -turned(
      (world.pose(world.robot(hand).base) * world.robot(hand).X_BA).rotation, Vector3d::UnitZ());
  for (int i = 0; hand_collides(world, hand); ++i) {
    if (i == most) return false;
    const Pose X = world.pose(world.robot(hand).base);
    world.set_pose(hand, {X.rotation, X.position + reach / 2 * back});
  }
  return approach(world, hand, reach).touched;
}

}  // namespace

// --- ClosingEnergy ---

ClosingEnergy::ClosingEnergy(const HandAndObject& who, const Options& options)
    : who_(who), options_(options) {
  const auto refuse = [](const char* name, double got) {
    fail("energy: {} must be >= 0, got {}", name, got);
  };
  const auto bad = [](double x) { return !(std::isfinite(x) && x >= 0); };
  if (bad(options.volume_weight)) refuse("volume_weight", options.volume_weight);
  if (bad(options.epsilon_weight)) refuse("epsilon_weight", options.epsilon_weight);
  if (bad(options.task_weight)) refuse("task_weight", options.task_weight);
  if (bad(options.approach)) refuse("approach", options.approach);
  for (const Vector6d& task : options.tasks)
    if (!task.allFinite()) fail("energy: expected finite wrenches of a task");
}

double ClosingEnergy::worth(const World& world) const {
  const Grasp grasp = find_grasp(world, who_.hand, who_.object, options_.grasp);
  if (grasp.contacts.empty()) return 0;
  const WrenchSpacePtr& space = space_of(grasp);
  double out = 0;
  if (options_.epsilon_weight > 0) out += options_.epsilon_weight * space->epsilon();
  if (options_.volume_weight > 0) out += options_.volume_weight * space->volume();
  if (options_.task_weight > 0 && !options_.tasks.empty()) {
    const Eigen::Quaterniond& R = world.pose(who_.object).rotation;
    double least = infinite;
    for (const Vector6d& task : options_.tasks) {
      Vector6d wrench_W;
      wrench_W << turned(R, task.head<3>()), turned(R, task.tail<3>());
      least = std::min(least, resistance(world, grasp, wrench_W));
    }
    if (std::isfinite(least)) out += options_.task_weight * least;
  }
  return out;
}

double ClosingEnergy::bounded_value(World& world, double) {
  const PutBack back(world);
  if (options_.approach > 0) {
    const Pose X_WB = world.pose(world.robot(who_.hand).base);
    approach(world, who_.hand, options_.approach);
    if (options_.palm && !base_touches(world, who_.hand)) world.set_pose(who_.hand, X_WB);
  }
  autograsp(world, who_.hand);
  const double out = worth(world);
  return out == 0 ? options_.nothing : -out;
}

// --- GuidedClosingEnergy ---

GuidedClosingEnergy::GuidedClosingEnergy(const World& world, const HandAndObject& who,
                                         const Options& options)
    : contact_(world, who, {.contacts = options.contacts, .facing = options.facing}),
      options_(options) {}

double GuidedClosingEnergy::bounded_value(World& world, double) {
  ContactSites& sites = contact_.sites();
  sites.attend(world);
  double sum = 0;
  int near = 0;
  for (int i = 0; i < sites.size(); ++i) {
    const auto site = contact_.measure(world, i);
    sum += contact_.of(site);
    near += site.at.distance < options_.near && site.cosine > options_.min_facing;
  }
  const double out = sum / sites.size();
  if (near < 2) return out;
  const PutBack back(world);
  autograsp(world, sites.who().hand);
  const Grasp grasp = find_grasp(world, sites.who().hand, sites.who().object);
  if (static_cast<int>(grasp.contacts.size()) < options_.min_contacts) return out;
  return out - options_.volume_weight * space_of(grasp)->volume();
}

// --- CompliantEnergy ---

double CompliantEnergy::bounded_value(World& world, double) {
  const PutBack back(world);
  if (!find_first_contact(world, who_.hand, options_.approach)) return 1;
  autograsp(world, who_.hand);
  const Grasp grasp = find_grasp(world, who_.hand, who_.object);
  if (grasp.contacts.size() < 2) return 1;
  if (space_of(grasp)->epsilon() < options_.min_epsilon) return 1;
  const Equilibrium balance = equilibrium(world, grasp, {});
  if (balance.status == EquilibriumStatus::moving) return 1;
  return -200 + balance.result.unbalanced.head<3>().norm();
}

}  // namespace clench
