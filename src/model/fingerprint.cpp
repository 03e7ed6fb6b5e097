#include "clench/model/fingerprint.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <tuple>

#include "clench/base/hash.h"
#include "clench/math/pose.h"

namespace clench {

// 0 and -0 count as equal
static void add_number(Hasher& h, double x) { h.add(x + 0.0); }

template <class Numbers>
static void add_numbers(Hasher& h, const Numbers& numbers) {
  for (const double x : numbers) add_number(h, x);
}

// a quaternion and its negative are one rotation, so its matrix is hashed
static void add_pose(Hasher& h, const Pose& pose) {
  add_numbers(h, pose.position);
  add_numbers(h, pose.rotation.toRotationMatrix().reshaped());
}

uint64_t fingerprint(const Shape& shape) {
  const Mesh& mesh = shape.mesh();
  const auto less = [&](int a, int b) {
    const Eigen::Vector3d &p = mesh.vertices[a], &q = mesh.vertices[b];
    return std::tuple(p.x(), p.y(), p.z()) < std::tuple(q.x(), q.y(), q.z());
  };
  uint64_t sum = 0;  // independent of the order
  for (const Triangle& t : mesh.triangles) {
    int first = 0;
    for (const int k : {1, 2})
      if (less(t[k], t[first])) first = k;
    Hasher h;
    for (int k = 0; k < 3; ++k) add_numbers(h, mesh.vertices[t[(first + k) % 3]]);
    sum += h.value();
  }
  for (const RoundPiece& piece : shape.rounds().pieces) {
    Hasher h;
    h.add(static_cast<uint64_t>(piece.solid.kind));
    add_numbers(h, piece.solid.radii);
    add_number(h, piece.solid.half);
    add_pose(h, piece.X_SR);
    sum += Hasher::mix(h.value());
  }
  Hasher h;
  h.add(sum);
  h.add(static_cast<uint64_t>(shape.rounds().in));
  return h.value();
}

uint64_t ShapeFingerprints::of(const ShapePtr& shape) {
  if (!shape) return 0;
  const auto found = known_.find(shape.get());
  // another shape may lie where one was
  if (found != known_.end() && !found->second.shape.expired()) return found->second.value;
  if (known_.size() >= tidy_size_) {
    std::erase_if(known_, [](const auto& one) { return one.second.shape.expired(); });
    tidy_size_ = 2 * known_.size() + 100;
  }
  const uint64_t value = fingerprint(*shape);
  known_[shape.get()] = {shape, value};
  return value;
}

uint64_t fingerprint(const World& world, Id<Body> id) {
  const Body& body = world.body(id);
  Hasher h;
  h.add(body.shape ? fingerprint(*body.shape) : 0);
  h.add(world.materials().name(body.material));
  add_number(h, body.mass);
  add_numbers(h, body.com);
  add_numbers(h, body.inertia_per_mass.reshaped());
  for (const double x :
       {body.elastic_modulus.value_or(0), body.soft_layer, body.poisson_ratio, body.restitution,
        body.free_damping, body.free_friction, body.free_armature, body.gravity_compensation})
    add_number(h, x);
  return h.value();
}

static void add(Hasher& h, const JointSpec& joint) {
  h.add(static_cast<uint64_t>(joint.kind));
  add_pose(h, joint.X_PJ);
  add_numbers(h, joint.axis);
  h.add(static_cast<uint64_t>(joint.dof));
  h.add_flag(joint.endless);
  for (const double x : {joint.ratio, joint.min, joint.max, joint.viscous, joint.coulomb,
                         joint.armature, joint.spring, joint.rest, joint.offset})
    add_number(h, x);
  h.add_flag(joint.effort_range.has_value());
  if (joint.effort_range) add_numbers(h, *joint.effort_range);
}

static void add(Hasher& h, const DofSpec& dof) {
  h.add(static_cast<uint64_t>(dof.kind));
  h.add_flag(dof.driven);
  for (const double x : {dof.default_velocity, dof.max_effort, dof.max_velocity, dof.kp, dof.kd,
                         dof.damping_ratio, dof.breakaway_torque, dof.default_value})
    add_number(h, x);
}

static void add(Hasher& h, const DofDrive& drive) {
  const EffortRange range = drive.limits();
  for (const double x : {range.low, range.high, drive.max_effort}) add_number(h, x);
  for (const DriveTerm& term : drive.terms) {
    for (const auto& numbers : {term.gain, term.bias}) add_numbers(h, numbers);
    for (const auto& limits : {term.control, term.force}) add_numbers(h, limits);
  }
  for (const BoundedSum& sum : drive.sums) {
    add_number(h, sum.factor);
    add_numbers(h, sum.bounds);
  }
}

static void add(Hasher& h, const JointTendonSpec& tendon) {
  for (const auto& [dof, arm] : tendon.arms) {
    h.add(static_cast<uint64_t>(dof));
    add_number(h, arm);
  }
  h.add_flag(tendon.range.has_value());
  if (tendon.range) add_numbers(h, *tendon.range);
  add_numbers(h, tendon.slack);
  for (const double x : {tendon.stiffness, tendon.damping, tendon.friction}) add_number(h, x);
}

uint64_t fingerprint(const World& world, Id<Robot> id) {
  const Robot& robot = world.robot(id);
  Hasher h;
  h.add(fingerprint(world, robot.base));
  for (const Link& link : robot.links) {
    h.add(fingerprint(world, link.body));
    for (const int x : {link.parent, link.first_joint, link.end_joint})
      h.add(static_cast<uint64_t>(static_cast<int64_t>(x)));
    add_pose(h, link.X_JL);
  }
  for (const Joint& joint : robot.joints) add(h, joint);
  for (const DofSpec& dof : robot.dofs) add(h, dof);
  for (const DofDrive& drive : robot.drives) add(h, drive);
  for (const auto& limits : robot.limits) add_numbers(h, limits);
  for (const bool endless : robot.endless) h.add_flag(endless);
  for (const JointTendonSpec& tendon : robot.joint_tendons) add(h, tendon);
  add_pose(h, robot.X_BA);
  return h.value();
}

// frames that were written to a file and read again differ by rounding
static constexpr double frame_grid = 1e-9;  // [m], of positions, and of parts of axes and rotations

template <class Numbers>
static void add_rounded(Hasher& h, const Numbers& numbers) {
  for (const double x : numbers) add_number(h, std::round(x / frame_grid));
}

static void add_rounded(Hasher& h, const Pose& pose) {
  add_rounded(h, pose.position);
  add_rounded(h, pose.rotation.toRotationMatrix().reshaped());
}

uint64_t mechanism_fingerprint(const World& world, Id<Robot> id, ShapeFingerprints& shapes) {
  const Robot& robot = world.robot(id);
  Hasher h;
  const auto add_shape = [&](Id<Body> body) { h.add(shapes.of(world.body(body).shape)); };
  add_shape(robot.base);
  for (const Link& link : robot.links) {
    add_shape(link.body);
    for (const int x : {link.parent, link.first_joint, link.end_joint})
      h.add(static_cast<uint64_t>(static_cast<int64_t>(x)));
    add_rounded(h, link.X_JL);
  }
  for (const Joint& joint : robot.joints) {
    h.add(static_cast<uint64_t>(joint.kind));
    add_rounded(h, joint.X_PJ);
    add_rounded(h, joint.axis);
    h.add(static_cast<uint64_t>(joint.dof));
    add_rounded(h, std::array{joint.ratio});
  }
  return h.value();
}

std::string fingerprint_text(uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace clench
