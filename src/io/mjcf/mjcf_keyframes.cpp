#include "clench/io/mjcf/mjcf_keyframes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

namespace {

constexpr int max_key_numbers = 100'000;  // of one row
// limit over all keyframes, including poses of bodies
constexpr size_t max_keyframe_numbers = 4'000'000;
// deviation of followers that counts as settled in a simulation [rad or m]
constexpr double settled = 0.01;

Eigen::Quaterniond turn_at(const XmlValues& values, const char* attribute, const double* wxyz) {
  const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(q.norm() > 1e-9)) values.fail(attribute, "expected a quaternion, got zeros");
  return q.normalized();
}

/// Consecutive rotations about x, y and z: R = Rx(a) Ry(b) Rz(c). If b is a right angle, a and c
/// are about the same axis, and a is set to 0.
Eigen::Vector3d three_turns(const Eigen::Quaterniond& q) {
  constexpr double aligned = 1e-12;  // cosine of b
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const double a = std::hypot(R(1, 2), R(2, 2)) < aligned ? 0 : std::atan2(-R(1, 2), R(2, 2));
  // Rx(a)^T R = Ry(b) Rz(c), whose second row is (sin c, cos c, 0)
  const double cos_a = std::cos(a), sin_a = std::sin(a);
  return {a, std::atan2(R(0, 2), cos_a * R(2, 2) - sin_a * R(1, 2)),
          std::atan2(cos_a * R(1, 0) + sin_a * R(2, 0), cos_a * R(1, 1) + sin_a * R(2, 1))};
}

/// Values of the DOFs of a robot whose joints are at q.
std::vector<double> dofs_of(const SceneBody& body, const RobotSpec& robot,
                            const std::vector<double>& q, const XmlValues& values,
                            const FileCache& cache) {
  std::vector<double> dofs;
  for (size_t j = 0; j < body.joints.size(); ++j) {
    const TreeJoint& joint = body.joints[j];
    if (joint.leader < 0) {
      const int dof = static_cast<int>(dofs.size());
      const auto [low, high] = dof_range(robot, dof);
      dofs.push_back(dof_is_endless(robot, dof) ? q[j] : std::clamp(q[j], low, high));
      if (std::abs(dofs.back() - q[j]) > 1e-6)
        cache.diagnostics().repaired(values.subject("qpos"),
                                     "joint '{}' is at {}, outside [{}, {}]; moved to the limit",
                                     excerpt(joint.name), q[j], low, high);
    } else if (std::abs(joint.ratio * q[joint.leader] + joint.offset - q[j]) > settled) {
      cache.diagnostics().warn(
          values.subject("qpos"),
          "joint '{}' follows '{}', and is at {} rather than at {}; it follows",
          excerpt(joint.name), excerpt(body.joints[joint.leader].name), q[j],
          joint.ratio * q[joint.leader] + joint.offset);
    }
  }
  return dofs;
}

KeyframeSpec read_key(const XmlValues& values, const std::vector<const SceneBody*>& moving,
                      const std::string& name, const FileCache& cache, const WorldSpec& world) {
  KeyframeSpec out;
  out.name = name;
  const bool given = values.has("qpos"), moves = values.has("mpos"), turns = values.has("mquat");
  const auto qpos = given ? values.numbers("qpos", 1, max_key_numbers) : std::vector<double>();
  const int mocaps = static_cast<int>(std::ranges::count_if(moving, &SceneBody::mocap));
  const auto mpos = moves ? values.numbers("mpos", 3 * mocaps, 3 * mocaps) : std::vector<double>();
  const auto mquat =
      turns ? values.numbers("mquat", 4 * mocaps, 4 * mocaps) : std::vector<double>();
  size_t at = 0, mocap = 0;
  for (const SceneBody* moved : moving) {
    check_stop();
    const SceneBody& body = *moved;
    Pose X_WB = body.X_WB;
    if (body.mocap && moves) X_WB.position = Eigen::Vector3d::Map(&mpos[3 * mocap]);
    if (body.mocap && turns) X_WB.rotation = turn_at(values, "mquat", &mquat[4 * mocap]);
    mocap += body.mocap;
    // the pose of a free body comes first
    if (body.free && given)
      X_WB = {turn_at(values, "qpos", &qpos[at + 3]), Eigen::Vector3d::Map(&qpos[at])};
    if (body.free) at += 7;
    for (const auto& part : body.bodies)
      if (body.free || body.mocap) out.bodies.push_back({part.body, X_WB * part.X_SB});
    if (body.robot < 0) continue;
    std::vector<double> q;
    for (const TreeJoint& joint : body.joints) q.push_back(joint.motor.default_value);
    for (const auto& slots : body.slots)
      for (const QposSlot& slot : slots) {
        if (slot.kind == QposSlot::Kind::joint) {
          if (given) q[slot.joint] = qpos[at];
        } else if (slot.kind == QposSlot::Kind::ball && given) {
          const Eigen::Vector3d turn = three_turns(turn_at(values, "qpos", &qpos[at]));
          std::copy(turn.begin(), turn.end(), q.begin() + slot.joint);
        }
        if (slot.kind != QposSlot::Kind::free) at += slot.size();
      }
    const bool on_world = !body.free && !body.mocap;
    const PlacedRobot& placed = world.robots[body.robot];
    out.robots.push_back(
        {body.robot, on_world ? placed.X_WB : X_WB, dofs_of(body, placed.robot, q, values, cache)});
  }
  return out;
}

/// Count of numbers in a row.
int qpos_size(const std::vector<const SceneBody*>& moving) {
  int count = 0;
  for (const SceneBody* body : moving) {
    count += body->free ? 7 : 0;
    for (const auto& slots : body->slots)
      for (const QposSlot& slot : slots)
        count += slot.kind == QposSlot::Kind::free ? 0 : slot.size();
  }
  return count;
}

/// Count of the numbers that a keyframe stores, including those that the file omits.
size_t kept_numbers(const std::vector<const SceneBody*>& moving) {
  size_t count = 0;
  for (const SceneBody* body : moving) {
    if (body->free || body->mocap) count += 7 * body->bodies.size();
    if (body->robot >= 0) count += 7 + body->joints.size();
  }
  return count;
}

}  // namespace

void read_mjcf_keyframes(MjcfDocument& document, const std::vector<SceneBody>& bodies, bool lossy,
                         const FileCache& cache, WorldSpec& world) {
  std::vector<const SceneBody*> moving;
  for (const SceneBody& body : bodies)
    if (body.free || body.mocap || body.robot >= 0) moving.push_back(&body);
  const int expected = qpos_size(moving);
  const size_t kept = kept_numbers(moving);
  std::set<std::string> names;
  int number = 0;
  for (const MjcfNode* node : document.section("keyframe")) {
    if (node->name() != "key") {
      document.unused().element(node->element);
      continue;
    }
    ++number;
    check_stop();
    document.unused().attributes(node->element, {"name", "class", "qpos", "mpos", "mquat"});
    const XmlValues values(node->element);
    std::string name = values.text("name", fmt::format("{}", number));
    if (const auto wrong = name_fault(name); !wrong.empty()) {
      name = repaired_name(name);
      cache.diagnostics().repaired(values.subject("name"), "{}; it becomes '{}'", wrong,
                                   excerpt(name));
    }
    const int got = values.has("qpos")
                        ? static_cast<int>(values.numbers("qpos", 1, max_key_numbers).size())
                        : expected;
    if (got != expected && lossy) {
      cache.diagnostics().warn(
          values.subject("qpos"),
          "keyframe '{}' has {} numbers, and the bodies that are read take {}; it is not used",
          excerpt(name), got, expected);
      continue;
    }
    if (got != expected) values.fail("qpos", "expected {} numbers, got {}", expected, got);
    if (!names.insert(name).second) {
      document.repairs().add("key", node->element.place().of("key"),
                             "there is another one of the name '{}'; the first one counts",
                             excerpt(name));
      continue;
    }
    if (kept * names.size() > max_keyframe_numbers)
      node->element.fail("key: expected at most {} numbers in all keyframes, of {} each",
                         max_keyframe_numbers, kept);
    world.keyframes.push_back(read_key(values, moving, name, cache, world));
  }
}

}  // namespace clench
