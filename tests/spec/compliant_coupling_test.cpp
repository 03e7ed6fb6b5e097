#include "clench/spec/compliant_coupling.h"
#include "support/chains.h"

#include <doctest/doctest.h>

#include <Eigen/Core>

#include "clench/spec/chains.h"

using namespace clench;

namespace {

struct Finger {
  std::vector<double> pulls, springs;
  double alpha = 0;  // of the first joint
};

// joints about parallel axes, all of one compliant DOF
RobotSpec hand_of(const std::vector<Finger>& fingers, DofKind kind = DofKind::compliant) {
  RobotSpec robot;
  robot.dofs.push_back({.kind = kind});
  for (const Finger& finger : fingers) {
    for (size_t i = 0; i < finger.pulls.size(); ++i) {
      JointSpec joint;
      joint.ratio = finger.pulls[i];
      joint.spring = finger.springs[i];
      joint.min = -1, joint.max = 1;
      LinkSpec link{.parent = i == 0 ? -1 : static_cast<int>(robot.links.size()) - 1};
      link.joints = {joint};
      if (i == 0) link.X_JL = Pose::turn(finger.alpha, Eigen::Vector3d::UnitX());
      robot.links.push_back(link);
    }
  }
  return robot;
}

std::vector<double> ratios(const RobotSpec& robot, int chain = 0) {
  std::vector<double> out;
  for (const NumberedJoint& joint : joints_of(robot))
    if (joint.chain == chain) out.push_back(joint.joint->ratio);
  return out;
}

// Balance of each link i: the tendon's torque, minus its own spring, plus the next link's spring,
// is zero.
Eigen::VectorXd turns_by_links(const std::vector<double>& pulls,
                               const std::vector<double>& springs) {
  const int n = static_cast<int>(pulls.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    a(i, i) = springs[i];
    if (i + 1 < n) a(i, i + 1) = -springs[i + 1];
  }
  return a.triangularView<Eigen::Upper>().solve(Eigen::Map<const Eigen::VectorXd>(pulls.data(), n));
}

}  // namespace

TEST_CASE("the original's compliant hand moves with the ratios of its file") {
  // comments of its file: proximal joints 1600 N mm/rad, distal ones 1000, tendon 1 to 0.6, free
  // motion 1 to 0.6; so it has (k1 / k2) t1 t2 / (t1 + t2) = 0.6
  RobotSpec robot = hand_of({Finger{{1, 0.6}, {1.6, 1.0}}});
  couple_by_springs(robot);
  CHECK(ratios(robot)[0] == 1);
  CHECK(ratios(robot)[1] == doctest::Approx(0.6).epsilon(1e-14));
}

TEST_CASE("joints move according to the balance of each link") {
  const std::vector<double> pulls = {1, 0.7, 0.4}, springs = {2, 0.5, 0.3};
  RobotSpec robot = hand_of({Finger{pulls, springs}, Finger{{0.5, 1}, {1, 4}}});
  couple_by_springs(robot);
  const Eigen::VectorXd first = turns_by_links(pulls, springs),
                        second = turns_by_links({0.5, 1}, {1, 4});
  const double scale = pulls[0] / first[0];
  for (int j = 0; j < 3; ++j) CHECK(ratios(robot)[j] == doctest::Approx(scale * first[j]));
  for (int j = 0; j < 2; ++j) CHECK(ratios(robot, 1)[j] == doctest::Approx(scale * second[j]));
}

TEST_CASE("a stiffer joint closes less") {
  RobotSpec soft = hand_of({Finger{{1, 1}, {1, 1}}}), stiff = hand_of({Finger{{1, 1}, {1, 3}}});
  couple_by_springs(soft), couple_by_springs(stiff);
  CHECK(ratios(soft)[1] == doctest::Approx(0.5));
  CHECK(ratios(stiff)[1] == doctest::Approx(0.5 / 3));
}

TEST_CASE("opposite and perpendicular axes are coupled") {
  RobotSpec turned = hand_of({{{1, -0.6}, {1.6, 1.0}, std::acos(-1.0)}});
  couple_by_springs(turned);
  CHECK(ratios(turned)[1] == doctest::Approx(-0.6));
  RobotSpec across = hand_of({{{1, 1}, {2, 1}, std::acos(-1.0) / 2}});
  couple_by_springs(across);
  CHECK(ratios(across)[1] == doctest::Approx(2));
}

TEST_CASE("ratios are kept if springs do not determine them") {
  const std::vector<double> as_written = {1, 0.6};
  RobotSpec rigid = hand_of({Finger{as_written, {1, 1}}}, DofKind::rigid);
  RobotSpec slack = hand_of({Finger{as_written, {1, 0}}});
  RobotSpec mixed = hand_of({Finger{as_written, {1, 1}}});
  mixed.links[1].joints[0].kind = JointKind::prismatic;
  RobotSpec against = hand_of({Finger{{1, -2}, {1, 1}}});  // the second would drive the first back
  for (RobotSpec* robot : {&rigid, &slack, &mixed}) {
    couple_by_springs(*robot);
    CHECK(ratios(*robot) == as_written);
  }
  couple_by_springs(against);
  CHECK(ratios(against) == std::vector<double>{1, -2});
}
