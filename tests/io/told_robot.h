// Reads a robot and stores all diagnostics about it.
#pragma once
#include <doctest/doctest.h>

#include "clench/io/read/read.h"
#include "support/chains.h"
#include "support/listening.h"

namespace clench::test {

struct ToldRobot {
  std::vector<std::string> warnings, notes;
  RobotSpec robot;

  explicit ToldRobot(const std::filesystem::path& file, ReadOptions options = {}) {
    options.diagnostics = Listening{.warn = [this](const std::string& s) { warnings.push_back(s); },
                                    .note = [this](const std::string& s) { notes.push_back(s); }};
    robot = read_robot(file, options);
  }
  bool warned(const std::string& part) const { return has(warnings, part); }
  bool noted(const std::string& part) const { return has(notes, part); }
  static bool has(const std::vector<std::string>& list, const std::string& part) {
    for (const auto& s : list)
      if (s.find(part) != std::string::npos) return true;
    return false;
  }

  // by the names in the file
  const LinkSpec& link(const std::string& name) const {
    for (const auto& l : robot.links)
      if (l.body.name == robot.name + "_" + name) return l;
    FAIL("no link " << name);
    return robot.links.at(0);
  }
  const BodySpec& body(const std::string& name) const {
    return robot.base.name == robot.name + "_" + name ? robot.base : link(name).body;
  }
  const JointSpec& joint(const std::string& name) const {
    for (const auto& l : robot.links)
      for (const auto& j : l.joints)
        if (j.name == name) return j;
    FAIL("no joint " << name);
    return robot.links.at(0).joints.at(0);
  }
  const DofSpec& dof(const std::string& name) const {
    for (const auto& d : robot.dofs)
      if (d.name == name) return d;
    FAIL("no DOF " << name);
    return robot.dofs.at(0);
  }
  std::vector<std::string> dofs() const {
    std::vector<std::string> out;
    for (const auto& d : robot.dofs) out.push_back(d.name);
    return out;
  }
};

/// Angle by which a joint is turned about its axis at q = 0, in (-pi, pi].
inline double constant_turn(const JointSpec& joint) {
  const Eigen::Quaterniond& R = joint.X_PJ.rotation;
  return std::remainder(2 * std::atan2(R.vec().dot(joint.axis), R.w()), 2 * 3.14159265358979323846);
}

}  // namespace clench::test
