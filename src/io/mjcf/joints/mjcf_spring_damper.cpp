#include "clench/io/mjcf/joints/mjcf_spring_damper.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace clench {

Eigen::MatrixXd reference_mass_matrix(const TreeModel& tree, bool floating) {
  const auto joints = static_cast<Eigen::Index>(tree.joints.size()), size = joints + 6 * floating;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index j = 0; j < joints; ++j) M(j, j) = tree.joints[j].armature;
  for (Eigen::Index k = joints; k < size; ++k) M(k, k) = tree.links[0].body.free_armature;
  std::vector<Pose> X;  // in the frame of the first link
  // per link: the joints that move it, with axis and a point on the axis
  std::vector<std::vector<int>> moved_by;
  std::vector<Eigen::Vector3d> axes(joints), points(joints);
  for (const TreeLink& link : tree.links) {
    X.push_back(link.parent < 0 ? Pose{} : X[link.parent] * link.X_PL);
    moved_by.push_back(link.parent < 0 ? std::vector<int>() : moved_by[link.parent]);
    for (const int j : link.joints) {
      axes[j] = X.back().rotation * tree.joints[j].axis;
      points[j] = X.back() * tree.joints[j].anchor;
      moved_by.back().push_back(j);
    }
    // derivatives of the position of the center of mass and of the rotation of the link by the
    // coordinates
    const double mass = link.body.mass;
    const Eigen::Vector3d com = X.back() * com_of(link.body);
    const Eigen::Matrix3d R = X.back().matrix(),
                          I = mass * (R * inertia_of(link.body) * R.transpose());
    std::vector<int> columns = moved_by.back();
    Eigen::Matrix3Xd v(3, columns.size() + 6 * floating), w = v;
    for (size_t c = 0; c < columns.size(); ++c) {
      const int j = columns[c];
      const bool turns = tree.joints[j].kind == JointKind::revolute;
      v.col(c) = turns ? Eigen::Vector3d(axes[j].cross(com - points[j])) : axes[j];
      w.col(c) = turns ? axes[j] : Eigen::Vector3d::Zero();
    }
    for (int k = 0; floating && k < 6; ++k) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(k % 3);
      v.rightCols<6>().col(k) = k < 3 ? unit : Eigen::Vector3d(unit.cross(com));
      w.rightCols<6>().col(k) = k < 3 ? Eigen::Vector3d::Zero() : unit;
      columns.push_back(static_cast<int>(joints) + k);
    }
    M(columns, columns) += mass * v.transpose() * v + w.transpose() * I * w;
  }
  return M;
}

/// True if both are hinges of the same ball.
static bool share_ball(const TreeJoint& a, const TreeJoint& b) {
  const auto stem = [](const TreeJoint& joint) {
    return joint.name.substr(0, joint.name.size() - std::min<size_t>(2, joint.name.size()));
  };
  const auto ends = [](const TreeJoint& joint) {
    return joint.name.ends_with("_x") || joint.name.ends_with("_y") || joint.name.ends_with("_z");
  };
  return a.place == b.place && ends(a) && ends(b) && stem(a) == stem(b);
}

void set_springs_and_dampers(TreeModel& tree, bool floating) {
  const auto given = [](const TreeJoint& joint) { return joint.spring_damper.has_value(); };
  if (std::ranges::none_of(tree.joints, given)) return;
  const Eigen::MatrixXd M = reference_mass_matrix(tree, floating);
  const Eigen::VectorXd inverse =
      M.ldlt().solve(Eigen::MatrixXd::Identity(M.rows(), M.cols())).diagonal();
  for (TreeJoint& joint : tree.joints) {
    if (!joint.spring_damper) continue;
    double sum = 0;
    int count = 0;
    for (size_t k = 0; k < tree.joints.size(); ++k)
      if (&tree.joints[k] == &joint || share_ball(tree.joints[k], joint))
        sum += inverse[static_cast<Eigen::Index>(k)], ++count;
    const auto [time, ratio] = *joint.spring_damper;
    const double inertia = count / std::max(1e-15, sum);
    joint.spring = inertia / std::max(1e-15, time * time * ratio * ratio);
    joint.viscous = 2 * inertia / std::max(1e-15, time);
  }
}

}  // namespace clench
