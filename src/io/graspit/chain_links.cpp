#include "clench/io/graspit/chain_links.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/spec/valid.h"

namespace clench {

int joints_of_kind(std::string_view word) {
  const std::vector<std::string> names = {"Revolute", "Prismatic", "Universal", "Ball", "Fixed"};
  constexpr int joints[] = {1, 1, 2, 3, 0};
  for (size_t i = 0; i < names.size(); ++i)
    if (lower_case(names[i]) == lower_case(word)) return joints[i];
  fail("expected Revolute, Prismatic, Universal, Ball or Fixed, got {}{}", in_quotes(word),
       did_you_mean(word, names));
}

// Rz(theta) Tz(d) Tx(a) Rx(alpha)
static Pose pose_of(const DenavitHartenberg& n) {
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(n.theta, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(n.alpha, Eigen::Vector3d::UnitX()));
  return {about_z * about_x, {n.a * std::cos(n.theta), n.a * std::sin(n.theta), n.d}};
}

void ChainLinks::add_joint(const JointSpec& joint, const DenavitHartenberg& numbers) {
  const std::string subject = fmt::format("joint {}", joints());
  check_each(angle_rule, {{"theta", numbers.theta}, {"alpha", numbers.alpha}}, subject);
  check_each(coordinate_rule, {{"d", numbers.d}, {"a", numbers.a}}, subject);
  joints_.push_back(joint);
  after_.push_back(pose_of(numbers));
}

void ChainLinks::add_link(const BodySpec& body, int last_joint, RobotSpec& robot) {
  LinkSpec link{.body = body, .parent = parent_};
  for (; used_ <= last_joint; ++used_) {
    link.joints.push_back(joints_[used_]);
    link.joints.back().X_PJ = at_;
    at_ = after_[used_];
  }
  link.X_JL = at_;
  at_ = {};
  parent_ = static_cast<int>(robot.links.size());
  robot.links.push_back(std::move(link));
}

}  // namespace clench
