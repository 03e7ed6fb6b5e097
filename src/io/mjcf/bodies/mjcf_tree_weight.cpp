#include "clench/io/mjcf/bodies/mjcf_tree_weight.h"

namespace clench {

std::vector<Pose> tree_poses(const TreeModel& tree) {
  std::vector<Pose> out;
  for (const TreeLink& link : tree.links)
    out.push_back(link.parent < 0 ? link.X_PL : out[link.parent] * link.X_PL);
  return out;
}

std::optional<BodySpec> weigh_tree(const MjcfTree& tree, const std::vector<Pose>& X) {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const auto known = [&](size_t i) {
    const BodySpec& body = tree.model.links[i].body;
    return tree.pieces[i].has_inertial && body.com && body.inertia_per_mass;
  };
  for (size_t i = 0; i < X.size(); ++i) {
    if (!known(i)) {
      if (!tree.geoms[i].empty()) return {};
      continue;
    }
    const BodySpec& body = tree.model.links[i].body;
    mass += body.mass;
    moment += body.mass * (X[i] * *body.com);
  }
  if (!mass_rule.allows(mass)) return {};
  const Eigen::Vector3d com = moment / mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < X.size(); ++i) {
    if (!known(i)) continue;
    const BodySpec& body = tree.model.links[i].body;
    const Eigen::Matrix3d R = X[i].matrix();
    const Eigen::Vector3d off = X[i] * *body.com - com;
    inertia +=
        body.mass * (R * *body.inertia_per_mass * R.transpose() +
                     off.squaredNorm() * Eigen::Matrix3d::Identity() - off * off.transpose());
  }
  BodySpec out;
  if (X.size() == 1) {
    out = tree.model.links[0].body;  // bit-exactly
  } else {
    out.mass = mass;
    out.com = com;
    out.inertia_per_mass = inertia / mass;
  }
  out.mass_from = Origin::file;
  return out;
}

double mean_gravity_compensation(const MjcfTree& tree) {
  double mass = 0, carried = 0;
  for (const TreeLink& link : tree.model.links) {
    mass += link.body.mass;
    carried += link.body.mass * link.body.gravity_compensation;
  }
  return tree.model.links.size() == 1 ? tree.model.links[0].body.gravity_compensation
                                      : carried / mass;
}

}  // namespace clench
