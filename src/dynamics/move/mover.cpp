#include "clench/dynamics/move/mover.h"

#include <algorithm>
#include <cmath>

#include "clench/dynamics/tree/tree_dynamics.h"
#include "clench/math/decompositions.h"
#include "clench/model/dof.h"

namespace clench {

// rotated by a rotation vector, in world axes
static Eigen::Quaterniond turned_by(const Eigen::Quaterniond& q, const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  // half the sine divided by the angle; its series for small angles
  const double s = angle > 1e-4 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48;
  const Eigen::Quaterniond step(std::cos(angle / 2), s * turn.x(), s * turn.y(), s * turn.z());
  return (step * q).normalized();
}

static Pose moved_rigidly(const Pose& X_WB, const Eigen::Vector3d& com, const Twist& twist,
                          double s) {
  if (twist.is_zero()) return X_WB;
  const Eigen::Vector3d c = X_WB * com + s * twist.linear;
  const Eigen::Quaterniond turned =
      twist.angular.isZero(0) ? X_WB.rotation : turned_by(X_WB.rotation, s * twist.angular);
  return {turned, c - turned * com};
}

Mover::Mover(World& world, const System& system) : world_(world) {
  const DynamicState& state = world.edit_dynamics();
  for (const auto id : world.bodies()) {
    const Body& body = world.body(id);
    if (body.kind == BodyKind::obstacle && !state.twists[id.index].is_zero())
      parts_.push_back({id, world.pose(id), state.twists[id.index], body.com, {}});
  }
  for (const Articulation& tree : system.trees)
    if (tree.is_free_body() && tree.robots.empty()) parts_.push_back(free_part(world, tree));
  for (const auto& [body, to] : system.welds)
    welded_.push_back({body, to, world.pose(body), world.pose(to)});
  for (const Articulation& tree : system.trees)
    for (const auto id : tree.robots) {
      const Robot& robot = world.robot(id);
      const auto dofs = world.dofs(id), joints = world.joints(id);
      const auto from = [](const std::vector<double>& all, size_t first, size_t count) {
        return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(first),
                                   all.begin() + static_cast<std::ptrdiff_t>(first + count));
      };
      robots_.push_back({id,
                         world.pose(robot.base),
                         state.twists[robot.base.index],
                         {dofs.begin(), dofs.end()},
                         {joints.begin(), joints.end()},
                         from(state.dof_velocities, robot.first_dof, robot.dofs.size()),
                         from(state.joint_velocities, robot.first_joint, robot.joints.size())});
      if (!robot.mounting && robots_.back().rests()) robots_.pop_back();
    }
  find_floating(system);
  find_carriers(system);
  find_movers(system);
}

// Records which bodies are placed independently, and which are placed by their carriers.
void Mover::find_movers(const System& system) {
  part_of_.assign(system.places.size(), stands);
  for (const Articulation& tree : system.trees)
    for (const TreeBody& body : tree.bodies) part_of_[body.body.index] = by_others;
  for (const Welded& weld : welded_) part_of_[weld.body.index] = by_others;
  for (size_t i = 0; i < parts_.size(); ++i)
    part_of_[parts_[i].body.index] = parts_[i].carrier ? by_others : static_cast<int>(i);
}

void Mover::place_pair(double s, Id<Body> a, Id<Body> b) {
  const int first = part_of_[a.index], second = part_of_[b.index];
  if (first == by_others || second == by_others) return place(s);
  for (const int i : {first, second})
    if (i != stands) world_.drift(parts_[i].body, moved(parts_[i], s, parts_[i].after));
}

void Mover::find_floating(const System& system) {
  for (const Articulation& tree : system.trees) {
    if (!tree.floating || tree.robots.empty()) continue;
    Eigen::VectorXd v;
    gather_velocities(system, world_, *world_.dynamics(), v);
    TreeDynamics dynamics;
    dynamics.place(world_, tree);
    Floating out{&tree, v.segment(tree.first, tree.size()), {}};
    out.momentum = dynamics.momentum(out.v);
    out.momentum.tail<3>() += dynamics.about().cross(Eigen::Vector3d(out.momentum.head<3>()));
    floating_.push_back(std::move(out));
  }
}

// If the relative rotation exceeds this part of the carrier's rotation, the body rolls on it.
static constexpr double turns_along = 0.01;
// Slip below this speed counts as sticking, and slips that differ by less count as equal [m/s].
static constexpr double stick_speed = 1e-3, same_slip = 1e-6;

// Contacts by which bodies press on each other; finds for each body the one with which it moves
// along.
class Mover::Carriers {
 public:
  Carriers(const World& world, const System& system);
  /// Can any body move along with another?
  bool any() const { return turning_ >= 2 || jumps_; }
  /// Assigns a carrier to a part, if it has one.   returns  false if all bodies that it presses on
  /// are still undecided
  bool find(Part& part, const std::vector<Part>& waiting);

 private:
  struct Press {
    Id<Body> a, b;
    Eigen::Vector3d p_W;
    double force;
  };
  // has its velocity been set from outside since the last solution?
  bool changed(Id<Body> id) const { return state_.twists[id.index] != state_.solved[id.index]; }
  bool jumped(Id<Body> id) const;
  Id<Body> whole(Id<Body> id) const;
  Eigen::Vector3d velocity(Id<Body> id, const Eigen::Vector3d& p_W, bool before) const;
  // the press with the least slip, and that slip; null: none
  const Press* min_slip(const Part& part, const std::vector<Part>& waiting, bool before,
                        double& slip) const;

  const World& world_;
  const System& system_;
  const DynamicState& state_;
  std::vector<Press> presses_;
  std::vector<Id<Body>> along_;  // that move along with a body whose velocity was set
  long turning_ = 0;
  bool jumps_ = false;
};

Mover::Carriers::Carriers(const World& world, const System& system)
    : world_(world), system_(system), state_(*world.dynamics()) {
  jumps_ = state_.twists != state_.solved &&
           std::ranges::any_of(world.bodies(), [&](Id<Body> id) { return jumped(id); });
  // a carrier and a body that it carries
  turning_ = std::ranges::count_if(state_.twists,
                                   [](const Twist& twist) { return !twist.angular.isZero(0); });
  if (!any()) return;
  for (const Manifold& m : state_.manifolds) {
    const auto point = std::ranges::max_element(
        m.points, {}, [](const ManifoldPoint& p) { return p.force.squaredNorm(); });
    if (point == m.points.end() || point->force.isZero(0)) continue;
    presses_.push_back({whole(m.a), whole(m.b), world.pose(m.a) * point->p_a, point->force.norm()});
  }
}

bool Mover::Carriers::jumped(Id<Body> id) const {
  const int tree = system_.place(id).tree;
  return tree < 0 ? changed(id)
                  : !system_.trees[tree].floating && !system_.trees[tree].is_free_body() &&
                        changed(system_.trees[tree].root);
}

// the first of the bodies that are welded together
Id<Body> Mover::Carriers::whole(Id<Body> id) const {
  const int tree = system_.place(id).tree;
  return tree >= 0 && system_.trees[tree].is_free_body() && system_.trees[tree].robots.empty()
             ? system_.trees[tree].root
             : id;
}

// before: velocities as solved for
Eigen::Vector3d Mover::Carriers::velocity(Id<Body> id, const Eigen::Vector3d& p_W,
                                          bool before) const {
  const Twist& twist = (before ? state_.solved : state_.twists)[id.index];
  return twist.linear + twist.angular.cross(p_W - world_.pose(id) * world_.body(id).com);
}

const Mover::Carriers::Press* Mover::Carriers::min_slip(const Part& part,
                                                        const std::vector<Part>& waiting,
                                                        bool before, double& smallest) const {
  const auto waits = [&](Id<Body> id) {
    return std::ranges::any_of(waiting, [&](const Part& other) { return other.body == id; });
  };
  const Press* best = nullptr;
  for (const Press& press : presses_) {
    if (press.a != part.body && press.b != part.body) continue;
    if (waits(press.a == part.body ? press.b : press.a)) continue;
    const double slip =
        (velocity(press.a, press.p_W, before) - velocity(press.b, press.p_W, before)).norm();
    if (!best || slip < smallest - same_slip ||
        (slip <= smallest + same_slip && press.force > best->force))
      best = &press, smallest = slip;
  }
  return best;
}

bool Mover::Carriers::find(Part& part, const std::vector<Part>& waiting) {
  // before the change both had the velocities that were solved for
  const bool before = jumps_ && !changed(part.body);
  double slip = 0;
  const Press* const press = min_slip(part, waiting, before, slip);
  if (!press) return false;
  const Id<Body> to = press->a == part.body ? press->b : press->a;
  const bool comes =
      before && slip < stick_speed && (jumped(to) || std::ranges::find(along_, to) != along_.end());
  const Eigen::Vector3d turning = (before ? state_.solved : state_.twists)[to.index].angular,
                        apart = part.twist.angular - turning;
  if (!comes && !(apart.norm() < turns_along * turning.norm())) return true;
  part.carrier = to, part.X_WC = world_.pose(to);
  const Eigen::Matrix3d into = part.X_WC.rotation.conjugate().toRotationMatrix();
  part.relative = {into * (part.twist.linear - velocity(to, part.X_WB * part.com, before)),
                   into * apart};
  if (comes) along_.push_back(part.body);
  return true;
}

// Of all bodies that a free body presses on, prescribed ones first, the one with the least slip.
// None if the body does not rotate along with it, unless the other's velocity has just been set
// from outside: a body that sticks to it moves along, and gets its velocity in the solution.
void Mover::find_carriers(const System& system) {
  Carriers carriers(world_, system);
  if (!carriers.any()) return;
  std::vector<Part> sorted, waiting;
  for (Part& part : parts_) (part.inertia ? waiting : sorted).push_back(std::move(part));
  while (!waiting.empty()) {
    std::vector<Part> found, rest;
    for (Part& part : waiting) (carriers.find(part, waiting) ? found : rest).push_back(part);
    // bodies that touch no prescribed body come last
    if (found.empty()) found.swap(rest);
    sorted.insert(sorted.end(), found.begin(), found.end());
    waiting.swap(rest);
  }
  parts_.swap(sorted);
}

// Moves along with its carrier, which has been placed, and on a straight line in the carrier's
// frame.
Pose Mover::carried(const Part& part, double s) const {
  const Pose& X_WC = world_.pose(*part.carrier);
  const Pose X_CB = part.X_WC.inverse() * part.X_WB;
  return X_WC * moved_rigidly(X_CB, part.com, part.relative, s);
}

bool Mover::RobotStart::rests() const {
  const auto none = [](const std::vector<double>& all) {
    return std::ranges::all_of(all, [](double x) { return x == 0; });
  };
  return twist.is_zero() && none(dof_velocities) && none(joint_velocities);
}

Mover::Part Mover::free_part(const World& world, const Articulation& tree) {
  const Body& root = world.body(tree.root);
  const Twist twist = world.twist(tree.root);
  Part out{tree.root, world.pose(tree.root), twist, root.com, root.mass * root.inertia_per_mass};
  if (tree.bodies.size() == 1) return out;
  const Eigen::Vector3d c = center(world, tree);
  SpatialInertia all;
  for (const TreeBody& part : tree.bodies)
    all.add(SpatialInertia::of(world.body(part.body), world.pose(part.body), c));
  const Eigen::Matrix3d R = out.X_WB.matrix();
  out.twist.linear += twist.angular.cross(c - out.X_WB * root.com);
  out.com = out.X_WB.inverse() * c;
  out.inertia = R.transpose() * all.turning * R;
  return out;
}

// Euler's equations in body axes, by the fourth-order Runge-Kutta method; in world axes they are
// stiff for slender bodies. Then the known invariant is restored: the angular momentum in the
// world, by a rotation of the size of the error.
Pose Mover::moved(const Part& part, double s, Twist& after) const {
  after = part.twist;
  const Eigen::Vector3d& w = part.twist.angular;
  constexpr double no_turn = 1e-9, turn_of_a_step = 0.1;  // [rad]
  const double turn = w.norm() * s;
  if (!part.inertia || turn < no_turn) return moved_rigidly(part.X_WB, part.com, part.twist, s);
  const Eigen::Matrix3d &I = *part.inertia, inverse = I.inverse();
  struct Spin {
    Eigen::Vector3d momentum;  // in body axes
    Eigen::Vector4d rotation;
    Spin plus(double h, const Spin& rate) const {
      return {momentum + h * rate.momentum, rotation + h * rate.rotation};
    }
  };
  // dL/dt = L x w, dq/dt = 1/2 q w
  const auto rate = [&](const Spin& spin) {
    const Eigen::Vector3d v = inverse * spin.momentum;
    const Eigen::Quaterniond q(spin.rotation), half(0, 0.5 * v.x(), 0.5 * v.y(), 0.5 * v.z());
    return Spin{spin.momentum.cross(v), (q * half).coeffs()};
  };
  Spin spin{I * (part.X_WB.rotation.conjugate() * w), part.X_WB.rotation.coeffs()};
  const Eigen::Vector3d momentum = part.X_WB.rotation * spin.momentum;
  const double size = momentum.norm();
  constexpr int max_steps = 1000;
  const int steps = static_cast<int>(std::min<double>(max_steps, std::ceil(turn / turn_of_a_step)));
  const double h = s / steps;
  for (int i = 0; i < steps; ++i) {
    const Spin k1 = rate(spin), k2 = rate(spin.plus(h / 2, k1)), k3 = rate(spin.plus(h / 2, k2)),
               k4 = rate(spin.plus(h, k3));
    spin = spin.plus(h / 6, k1).plus(h / 3, k2).plus(h / 3, k3).plus(h / 6, k4);
    spin.rotation.normalize();
    spin.momentum *= size / spin.momentum.norm();
  }
  const Eigen::Quaterniond near(spin.rotation);
  const Eigen::Quaterniond turned =
      (shortest_rotation(near * spin.momentum, momentum) * near).normalized();
  after.angular = turned * (inverse * spin.momentum);
  const Eigen::Vector3d c = part.X_WB * part.com + s * part.twist.linear;
  return {turned, c - turned * part.com};
}

void Mover::place(double s) {
  if (s == placed_) return;
  placed_ = s;
  for (Part& part : parts_)
    if (!part.carrier) world_.drift(part.body, moved(part, s, part.after));
  for (RobotStart& start : robots_) {
    const Robot& robot = world_.robot(start.robot);
    std::vector<double> dofs = start.dofs, joints = start.joints;
    start.picked_up.clear();
    for (size_t i = 0; i < dofs.size(); ++i) {
      const double moved = dofs[i] + s * start.dof_velocities[i];
      const auto [low, high] = range_around(robot, static_cast<int>(i), moved);
      dofs[i] = std::clamp(moved, std::min(dofs[i], low), std::max(dofs[i], high));
    }
    for (size_t j = 0; j < joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      const double followed = joint.ratio * dofs[joint.dof];
      if (world_.follows_dof(start.robot, static_cast<int>(j))) {
        joints[j] = followed;
        continue;
      }
      joints[j] += s * start.joint_velocities[j];
      const DofSpec& dof = robot.dofs[joint.dof];
      if (dof.kind != DofKind::breakaway) continue;
      // on opening, the DOF picks up joints that it left behind when it reaches them
      const double closing = (dof.default_velocity < 0 ? -1.0 : 1.0) * (joint.ratio < 0 ? -1 : 1);
      constexpr double met = 1e-5;  // [rad or m]
      if (closing * start.dof_velocities[joint.dof] >= 0 || closing * (followed - joints[j]) > met)
        continue;
      joints[j] = followed;
      start.picked_up.push_back(static_cast<int>(j));
    }
    // a robot that is carried is where its carrier has placed it
    const Pose X_WB = robot.mounting
                          ? world_.pose(robot.base)
                          : moved_rigidly(start.X_WB, world_.body(robot.base).com, start.twist, s);
    world_.drift(start.robot, X_WB, dofs, joints);
  }
  place_welded();
  bool more = false;
  for (Part& part : parts_)
    if (part.carrier) {
      moved(part, s, part.after);
      world_.drift(part.body, carried(part, s));
      more = true;
    }
  if (more) place_welded();
}

void Mover::finish(double s) {
  place(s);
  for (const Part& part : parts_) {
    if (!part.inertia) continue;
    const Eigen::Vector3d arm =
        world_.pose(part.body).rotation * (world_.body(part.body).com - part.com);
    world_.edit_dynamics().twists[part.body.index] = {
        part.after.linear + part.after.angular.cross(arm), part.after.angular};
  }
  for (const Floating& start : floating_) {
    TreeDynamics dynamics;
    dynamics.place(world_, *start.tree);
    Vector6d momentum = start.momentum;
    momentum.tail<3>() -= dynamics.about().cross(Eigen::Vector3d(momentum.head<3>()));
    const Vector6d v = dynamics.root_velocity(momentum, start.v);
    const Eigen::Vector3d angular = v.tail<3>();
    world_.edit_dynamics().twists[start.tree->root.index] = {
        v.head<3>() + angular.cross(dynamics.com(0) - dynamics.about()), angular};
  }
  for (const RobotStart& start : robots_)
    for (const int joint : start.picked_up) world_.set_follows_dof(start.robot, joint, true);
}

void Mover::place_welded() {
  for (const Welded& weld : welded_) {
    const Pose& X_WT = world_.pose(weld.to);
    // a body at rest stays bit-exactly where it is
    world_.drift(weld.body,
                 X_WT == weld.X_WT ? weld.X_WB : X_WT * (weld.X_WT.inverse() * weld.X_WB));
  }
}

}  // namespace clench
