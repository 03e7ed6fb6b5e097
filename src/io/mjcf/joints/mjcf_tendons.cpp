#include "clench/io/mjcf/joints/mjcf_tendons.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/io/mjcf/joints/mjcf_actuator.h"
#include "clench/io/mjcf/joints/mjcf_ties.h"

namespace clench {

Place MjcfTendon::subject() const {
  return values.element().place().of("tendon '{}'", excerpt(name));
}

double linear_part(const XmlValues& values, const char* name, const Place& subject,
                   MjcfDocument& document, const FileCache& cache) {
  if (!values.has(name)) return 0;
  const auto given = values.numbers(name, 1, 10);
  if (std::any_of(given.begin() + 1, given.end(), [](double x) { return x != 0; }))
    cache.diagnostics().warn(
        subject.of(name), "expected one number, got {}; only the first, the linear part, is used",
        given.size());
  return document.repairs().magnitude(given[0], values.subject(name));
}

MjcfTendon read_mjcf_tendon(MjcfDocument& document, const XmlElement& element) {
  MjcfTendon out;
  out.values = document.values(element, "", "tendon");
  out.name = out.values.text("name", "");
  out.spatial = element.name() != "fixed";
  if (out.spatial) return out;
  out.values.tell_unused(document.unused(),
                         {"name", "class", "limited", "range", "stiffness", "springlength",
                          "damping", "frictionloss", "actuatorfrclimited", "actuatorfrcrange"});
  out.force_range = limited_range(out.values, document, "actuatorfrcrange", "actuatorfrclimited");
  return out;
}

namespace {

/// Limits of the length, if any.
std::optional<std::array<double, 2>> length_range(const XmlValues& values, MjcfDocument& document) {
  const std::string limited = values.word("limited", {"auto", "true", "false"}, "auto");
  if (limited == "false" || !values.has("range")) return {};
  const auto range = values.range("range", document.repairs());
  if (limited == "auto" && range[0] == 0 && range[1] == 0) return {};
  return range;
}

/// Limits of a joint given by those of the length, coefficient * q + offset.
void narrow(const MjcfTendon& tendon, TreeJoint& joint, double coefficient, double offset,
            const std::array<double, 2>& length, const FileCache& cache) {
  const double a = (length[0] - offset) / coefficient, b = (length[1] - offset) / coefficient;
  const double low = joint.endless ? std::min(a, b) : std::max(joint.min, std::min(a, b)),
               high = joint.endless ? std::max(a, b) : std::min(joint.max, std::max(a, b));
  if (low > high) {
    cache.diagnostics().warn(
        tendon.subject(),
        "its range has no value in common with that of joint '{}'; it is not used",
        excerpt(joint.name));
    return;
  }
  if (!joint.endless && low == joint.min && high == joint.max) return;
  const char* unit = joint.kind == JointKind::revolute ? "rad" : "m";
  cache.diagnostics().note(
      tendon.subject(), "its range narrows that of joint '{}' from {} to [{:.6g}, {:.6g}] {}",
      excerpt(joint.name),
      joint.endless ? "no limits" : fmt::format("[{:.6g}, {:.6g}]", joint.min, joint.max), low,
      high, unit);
  joint.min = low, joint.max = high, joint.endless = false;
  joint.motor.default_value = std::clamp(joint.motor.default_value, low, high);
}

}  // namespace

void add_tendon_dynamics(const MjcfTendon& tendon, MjcfDocument& document, const FileCache& cache,
                         TreeModel& tree) {
  if (tendon.spatial || tendon.joints.empty()) return;
  const XmlValues& values = tendon.values;
  const Place subject = tendon.subject();
  auto range = length_range(values, document);
  JointTendonSpec out;
  out.name = tendon.name;
  out.stiffness = linear_part(values, "stiffness", subject, document, cache);
  out.damping = linear_part(values, "damping", subject, document, cache);
  out.friction = values.not_negative("frictionloss", 0, document.repairs());
  if (!range && out.stiffness == 0 && out.damping == 0 && out.friction == 0) return;
  if (!tendon.complete) {
    cache.diagnostics().warn(subject,
                             "limits, stiffness, damping and frictionloss are not used, because "
                             "some of its joints do not belong to the robot");
    return;
  }
  // length = sum of coefficients times DOFs + offset
  std::map<int, double> arms;
  double offset = 0, rest = 0;
  for (const auto& [number, coefficient] : tendon.joints) {
    const TiedJoint tied = by_leader(tree, number);
    if (tied.leader < 0) return;  // circular leaders are rejected elsewhere
    arms[tied.leader] += coefficient * tied.ratio;
    offset += coefficient * tied.offset;
    rest += coefficient * tree.joints[number].rest;
  }
  for (const auto& [leader, arm] : arms)
    if (std::abs(arm) > 1e-12) out.arms.emplace_back(leader, arm);
  if (out.arms.empty()) return;
  if (range && out.arms.size() == 1) {
    const auto [leader, arm] = out.arms.front();
    narrow(tendon, tree.joints[leader], arm, offset, *range, cache);
    range.reset();
    if (out.stiffness == 0 && out.damping == 0 && out.friction == 0) return;
  }
  if (range) out.range = std::array{(*range)[0] - offset, (*range)[1] - offset};
  // -1: the length at which the springs of its joints are slack
  std::array<double, 2> slack = {rest, rest};
  if (values.has("springlength")) {
    const auto given = values.numbers("springlength", 1, 2);
    if (given.size() > 1 && given[0] > given[1])
      values.fail("springlength", "{} exceeds {}", given[0], given[1]);
    if (given[0] != -1) slack = {given.front(), given.back()};
  }
  out.slack = {slack[0] - offset, slack[1] - offset};
  tree.tendons.push_back(std::move(out));
}

}  // namespace clench
