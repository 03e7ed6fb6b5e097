#include "clench/motion/move.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/advance.h"
#include "clench/motion/blocked_joints.h"

namespace clench {

void refuse_collision(World& world, std::span<const Id<Body>> moving, const std::string& subject) {
  const auto pairs = colliding_pairs(world, moving, world.bodies(), &world.context());
  if (!pairs.empty())
    fail("{}: the motion starts in collision: {}", subject, describe(world, pairs));
}

namespace {

// motion of one rigid set of bodies from one pose to another
struct Way {
  Pose from, to;
  std::vector<Id<Body>> moving;
  std::function<void(const Pose&)> place;
};

// upper bound on the distance of the body's points from the origin that the motion turns about
double reach_from(const World& world, Id<Body> id, const Eigen::Vector3d& origin) {
  const Shape& shape = *world.body(id).shape;
  return (world.pose(id) * shape.center() - origin).norm() + shape.radius();
}

std::vector<PairBound> watch_pairs(const World& world, const Way& way, double length,
                                   double angle) {
  const std::set<Id<Body>> mine(way.moving.begin(), way.moving.end());
  std::vector<PairBound> watches;
  for (const auto a : way.moving)
    for (const auto b : world.bodies())
      if (!mine.contains(b) && world.may_collide(a, b))
        watches.push_back(
            {.a = a, .b = b, .speed = length + angle * reach_from(world, a, way.from.position)});
  return watches;
}

// contacts that the initial motion would push into
std::vector<BodyPair> blocked_pairs(World& world, const Way& way, const Eigen::Vector3d& linear,
                                    const Eigen::Vector3d& angular,
                                    const std::vector<PairBound>& watches) {
  std::vector<BodyPair> blocked;
  for (const PairBound& watch : watches) {
    const std::array a{watch.a}, b{watch.b};
    const auto touching = contacts(world, b, a, &world.context());
    const bool pushed = std::any_of(touching.begin(), touching.end(), [&](const Contact& contact) {
      const Eigen::Vector3d velocity = linear + angular.cross(contact.p_W - way.from.position);
      return velocity.dot(contact.n_W) < -grazing * velocity.norm();
    });
    if (pushed) blocked.emplace_back(watch.a, watch.b);
  }
  return blocked;
}

MoveResult move(World& world, const Way& way) {
  const Pose turn = way.to * way.from.inverse();
  const double angle = turn.angle();
  const Eigen::Vector3d linear = way.to.position - way.from.position;
  Eigen::Vector3d axis = turn.rotation.vec();
  if (turn.rotation.w() < 0) axis = -axis;
  const Eigen::Vector3d angular =
      axis.norm() > 0 ? Eigen::Vector3d(angle * axis.normalized()) : Eigen::Vector3d::Zero();

  MoveResult result;
  auto watches = watch_pairs(world, way, linear.norm(), angle);
  std::erase_if(watches, [](const PairBound& watch) { return watch.speed == 0; });
  result.stopped_by = blocked_pairs(world, way, linear, angular, watches);
  result.touched = !result.stopped_by.empty();
  if (result.touched) return result;

  const auto place = [&](double s) {
    way.place(s >= 1 ? way.to : interpolate(way.from, way.to, s));
  };
  const Advance end = advance(world, watches, 1, place, result.queries);
  result.fraction = end.s;
  result.iteration_limit = end.iteration_limit;
  result.touched = end.stopped_by && !end.iteration_limit;
  if (result.touched) result.stopped_by.emplace_back(end.stopped_by->a, end.stopped_by->b);
  return result;
}

// a robot's own bodies, and those of all that it carries
std::vector<Id<Body>> carried_bodies(const World& world, Id<Robot> robot) {
  auto out = world.bodies_of(robot);
  for (const auto other : world.robots()) {
    const auto& mounting = world.robot(other).mounting;
    if (!mounting || mounting->parent != robot) continue;
    const auto more = carried_bodies(world, other);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

// X_WB raised against gravity, for a body that overlaps its support by no more than the contact
// threshold, until there is a gap of at least a quarter of the threshold. Does not move the body.
// returns  empty if the body does not collide at X_WB, or still collides one threshold higher
std::optional<Pose> raised_from_support(World& world, Id<Body> body, const Pose& X_WB) {
  const std::array one{body};
  const Pose start = world.pose(body);
  const auto is_free = [&](const Pose& X) {
    world.set_pose(body, X);
    return !collides(world, one, &world.context());
  };
  const double weight = world.gravity().norm();
  const Eigen::Vector3d up =
      weight > 0 ? Eigen::Vector3d(-world.gravity() / weight) : Eigen::Vector3d::UnitZ();
  std::optional<Pose> raised;
  if (!is_free(X_WB))
    for (int quarter = 1; quarter <= 4 && !raised; ++quarter) {
      const Eigen::Vector3d step = 0.25 * world.contact_threshold() * up;
      const Pose free{X_WB.rotation, X_WB.position + quarter * step};
      const Pose higher{X_WB.rotation, X_WB.position + (quarter + 1) * step};
      if (is_free(free) && is_free(higher)) raised = higher;
    }
  world.set_pose(body, start);
  return raised;
}

}  // namespace

MoveResult move_body(World& world, Id<Body> body, const Pose& X_WB) {
  const Pose from = world.pose(body);
  world.set_pose(body, X_WB);  // rejects a part of a robot and a pose that is not finite
  world.set_pose(body, from);
  Way way{from, X_WB, {body}, [&](const Pose& X) { world.set_pose(body, X); }};
  // a body that rests on a support moves as if there were a gap below it, at both ends
  if (const auto raised = raised_from_support(world, body, from)) {
    way.from = *raised;
    way.to = raised_from_support(world, body, X_WB).value_or(X_WB);
    way.place(way.from);
  }
  refuse_collision(world, way.moving, fmt::format("moving '{}'", excerpt(world.body(body).name)));
  return move(world, way);
}

MoveResult move_robot(World& world, Id<Robot> robot, const Pose& X_WB) {
  const Pose from = world.pose(world.robot(robot).base);
  world.set_pose(robot, X_WB);  // rejects a carried robot and a pose that is not finite
  world.set_pose(robot, from);
  Way way{from, X_WB, carried_bodies(world, robot),
          [&](const Pose& X) { world.set_pose(robot, X); }};
  // the robot's own overlaps are ignored: only the rest of the world matters
  std::vector<Id<Body>> others;
  for (const auto b : world.bodies())
    if (std::find(way.moving.begin(), way.moving.end(), b) == way.moving.end()) others.push_back(b);
  const auto pairs = colliding_pairs(world, way.moving, others, &world.context());
  if (!pairs.empty())
    fail("moving '{}': the motion starts in collision: {}", excerpt(world.robot(robot).name),
         describe(world, pairs));
  return move(world, way);
}

MoveResult approach(World& world, Id<Robot> robot, double reach) {
  const Robot& hand = world.robot(robot);
  if (!(reach >= 0) || !std::isfinite(reach))
    fail("approach of '{}': the reach must be >= 0 [m], got {}", excerpt(hand.name), reach);
  const Pose X_WB = world.pose(hand.base);
  const Eigen::Vector3d direction = X_WB.rotation * (hand.X_BA.rotation * Eigen::Vector3d::UnitZ());
  return move_robot(world, robot, Pose{X_WB.rotation, X_WB.position + reach * direction});
}

}  // namespace clench
