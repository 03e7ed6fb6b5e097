#include "model_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clench::test {

namespace {

template <class Item>
const Item* find_named(const std::vector<Item>& items, const std::string& name) {
  const auto found = std::ranges::find(items, name, &Item::name);
  return found == items.end() ? nullptr : &*found;
}

std::string text(const Eigen::MatrixXd& m) {
  std::string out;
  for (const double x : m.reshaped()) out += fmt::format("{}{:.9g}", out.empty() ? "" : " ", x);
  return '(' + out + ')';
}

class Comparison {
 public:
  explicit Comparison(double tolerance) : tolerance_(tolerance) {}

  void check(const std::string& subject, const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs,
             double scale) {
    if ((ours - theirs).cwiseAbs().maxCoeff() <= tolerance_ * scale) return;
    sentences.push_back(fmt::format("{}: expected {}, got {}", subject, text(theirs), text(ours)));
  }
  void check(const std::string& subject, double ours, double theirs, double floor = 1e-12) {
    if (std::abs(ours - theirs) <= tolerance_ * std::abs(theirs) + floor) return;
    sentences.push_back(fmt::format("{}: expected {:.9g}, got {:.9g}", subject, theirs, ours));
  }
  void fail(const std::string& sentence) { sentences.push_back(sentence); }

  std::vector<std::string> sentences;

 private:
  double tolerance_;
};

constexpr double massless = 1e-9;  // [kg]

void compare_bodies(const BodyFacts& ours, const BodyFacts& theirs, double size, Comparison& out) {
  const std::string subject = fmt::format("body '{}'", theirs.name);
  out.check(subject + ": position", ours.X_WB.position, theirs.X_WB.position, size);
  out.check(subject + ": rotation", ours.X_WB.matrix(), theirs.X_WB.matrix(), 1);
  if (!ours.weighed || !theirs.weighed) return;
  out.check(subject + ": mass", ours.mass, theirs.mass, massless);
  if (theirs.mass < massless) return;
  out.check(subject + ": center of mass", ours.com_W, theirs.com_W, size);
  out.check(subject + ": inertia", ours.inertia_W, theirs.inertia_W, theirs.inertia_W.trace());
}

void compare_joints(const JointFacts& ours, const JointFacts& theirs, double size,
                    Comparison& out) {
  const std::string subject = fmt::format("joint '{}'", theirs.name);
  if (ours.body != theirs.body)
    out.fail(fmt::format("{}: expected on body '{}', got '{}'", subject, theirs.body, ours.body));
  if (ours.kind != theirs.kind) return out.fail(subject + ": another kind");
  if (theirs.kind == JointFacts::Kind::free) return;
  if (theirs.kind != JointFacts::Kind::ball)
    out.check(subject + ": axis", ours.axis_W, theirs.axis_W, 1);
  if (theirs.kind != JointFacts::Kind::slide)
    out.check(subject + ": anchor", ours.anchor_W, theirs.anchor_W, size);
  out.check(subject + ": damping", ours.damping, theirs.damping);
  out.check(subject + ": frictionloss", ours.friction, theirs.friction);
  out.check(subject + ": armature", ours.armature, theirs.armature);
  out.check(subject + ": stiffness", ours.stiffness, theirs.stiffness);
  if (theirs.kind == JointFacts::Kind::ball) return;
  if (theirs.stiffness != 0) out.check(subject + ": springref", ours.rest, theirs.rest, 1e-9);
  if (!ours.range_compared || !theirs.range_compared) return;
  if (ours.range.has_value() != theirs.range.has_value())
    return out.fail(fmt::format("{}: expected {}", subject, theirs.range ? "limits" : "no limits"));
  for (int i = 0; theirs.range && i < 2; ++i)
    out.check(subject + (i ? ": upper limit" : ": lower limit"), (*ours.range)[i],
              (*theirs.range)[i], 1e-9);
}

}  // namespace

const BodyFacts* ModelFacts::body(const std::string& name) const {
  return find_named(bodies, name);
}
const JointFacts* ModelFacts::joint(const std::string& name) const {
  return find_named(joints, name);
}

BodyFacts merge(const std::vector<BodyFacts>& parts) {
  BodyFacts out = parts.front();
  out.mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const BodyFacts& part : parts) out.weighed = out.weighed && part.weighed;
  for (const BodyFacts& part : parts) out.mass += part.mass, moment += part.mass * part.com_W;
  out.inertia_W.setZero();
  if (out.mass > 0) out.com_W = moment / out.mass;
  for (const BodyFacts& part : parts) {
    const Eigen::Vector3d off = part.com_W - out.com_W;
    out.inertia_W += part.inertia_W + part.mass * (off.squaredNorm() * Eigen::Matrix3d::Identity() -
                                                   off * off.transpose());
  }
  return out;
}

std::vector<std::string> differences(const ModelFacts& ours, const ModelFacts& theirs,
                                     double tolerance) {
  Comparison out(tolerance);
  double size = 0.1;
  for (const BodyFacts& body : theirs.bodies) size = std::max(size, body.X_WB.position.norm());
  std::vector<std::string> seen;
  for (const BodyFacts& body : ours.bodies) {
    std::vector<BodyFacts> parts;
    for (const std::string& name : body.merged.value_or(std::vector{body.name})) {
      seen.push_back(name);
      if (const BodyFacts* part = theirs.body(name))
        parts.push_back(*part);
      else
        out.fail(fmt::format("body '{}': expected none of the name", name));
    }
    if (parts.empty()) continue;
    compare_bodies(body, parts.size() == 1 ? parts.front() : merge(parts), size, out);
    const auto& parent = parts.front().parent;
    if (body.parent && parent && *body.parent != *parent)
      out.fail(
          fmt::format("body '{}': expected on '{}', got '{}'", body.name, *parent, *body.parent));
  }
  for (const BodyFacts& body : theirs.bodies)
    if (std::ranges::find(seen, body.name) == seen.end())
      out.fail(fmt::format("body '{}' is missing", body.name));
  for (const JointFacts& joint : theirs.joints) {
    if (const JointFacts* own = ours.joint(joint.name))
      compare_joints(*own, joint, size, out);
    else if (joint.kind != JointFacts::Kind::free)  // they become objects or floating robots
      out.fail(fmt::format("joint '{}' is missing", joint.name));
  }
  return out.sentences;
}

}  // namespace clench::test
