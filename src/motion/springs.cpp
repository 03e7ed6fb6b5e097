#include "clench/motion/springs.h"

#include <cmath>
#include <optional>

#include "clench/contact/cone.h"
#include "clench/contact/friction_edges.h"
#include "clench/math/nonnegative_least_squares.h"

namespace clench {

using Eigen::Vector3d;
using Eigen::VectorXd;

// a joint this near its limit is at it [rad or m]
static constexpr double at_limit = 1e-9;
// smaller displacements are rounding [rad or m]
static constexpr double nowhere = 1e-12;
// as a fraction of the contact threshold: closing stops at this gap in any case
static constexpr double min_gap = 0.2;

namespace {

// has every joint of the DOF a spring?
bool all_sprung(const Robot& robot, int dof) {
  for (const Joint& joint : robot.joints)
    if (joint.dof == dof && !(joint.spring > 0)) return false;
  return true;
}

// forces on the contact's body at the edges of its friction cone
std::vector<Vector3d> edges_of(const Contact& contact, bool sliding) {
  const double mu = sliding ? contact.friction.kinetic : contact.friction.statics;
  if (mu == 0) return {contact.n_W};
  const Eigen::Matrix3d frame = contact_frame(contact.n_W);
  std::vector<Vector3d> edges;
  static const FrictionEdges pyramid = friction_edges();
  for (const auto& edge : pyramid.colwise())
    edges.push_back(contact.n_W + mu * (frame * edge.head<3>()));
  return edges;
}

// The y nearest to `to` with sides^T y >= least, one side per column; empty if there is none.
// source  Lawson & Hanson (1974), Solving least squares problems, ch. 23: least distance
//         programming
std::optional<VectorXd> nearest_allowed(const Eigen::MatrixXd& sides, const VectorXd& least,
                                        const VectorXd& to) {
  const int n = static_cast<int>(to.size());
  // scaling to lengths of about 1 preserves precision
  const double size = to.norm() > 0 ? to.norm() : 1;
  Eigen::MatrixXd both(n + 1, sides.cols());
  both.topRows(n) = sides;
  both.row(n) = ((least - sides.transpose() * to) / size).transpose();
  const VectorXd unit = VectorXd::Unit(n + 1, n);
  const VectorXd rest = both * nonnegative_least_squares(both, unit) - unit;
  if (rest[n] > -1e-12) return {};
  return to - size * rest.head(n) / rest[n];
}

}  // namespace

SpringBalance::SpringBalance(const World& world, Id<Robot> id, const CarriedBodies& bodies,
                             std::span<const Contact> touching, bool sliding) {
  const Robot& robot = world.robot(id);
  none_.assign(robot.joints.size(), 0);
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
    const Joint& joint = robot.joints[j];
    if (robot.dofs[joint.dof].kind != DofKind::compliant) continue;
    joints_.push_back({j, joint.dof, joint.ratio, all_sprung(robot, joint.dof) ? joint.spring : 1,
                       joint.ratio * world.dofs(id)[joint.dof] - world.joints(id)[j]});
  }
  add_reactions(world, id, bodies, touching, sliding);
}

void SpringBalance::add_reactions(const World& world, Id<Robot> id, const CarriedBodies& bodies,
                                  std::span<const Contact> touching, bool sliding) {
  const Robot& robot = world.robot(id);
  const int count = static_cast<int>(joints_.size());
  std::vector<VectorXd> columns;
  std::vector<double> opens;
  const auto add = [&](const VectorXd& torques, double open) {
    columns.push_back(torques);
    opens.push_back(open);
  };
  const auto frames = world.frames(id);
  for (const Contact& contact : touching) {
    Eigen::Matrix3Xd velocities(3, count);
    for (int i = 0; i < count; ++i)
      velocities.col(i) = contact_velocity(robot, bodies, frames, joints_[i].number, contact);
    if (velocities.isZero(0)) continue;
    const double open = std::max(0.0, min_gap * world.contact_threshold() - contact.gap);
    for (const Vector3d& edge : edges_of(contact, sliding))
      add(velocities.transpose() * edge, open);
  }
  for (int i = 0; i < count; ++i) {
    const Joint& joint = robot.joints[joints_[i].number];
    const double q = world.joints(id)[joints_[i].number];
    if (joint.endless) continue;
    if (q <= joint.min + at_limit) add(VectorXd::Unit(count, i), 0);
    if (q >= joint.max - at_limit) add(-VectorXd::Unit(count, i), 0);
  }
  reactions_.resize(count, static_cast<int>(columns.size()));
  opens_.resize(static_cast<int>(columns.size()));
  for (int k = 0; k < reactions_.cols(); ++k) {
    opens_[k] = opens[k];
    for (int i = 0; i < count; ++i)
      reactions_(i, k) = columns[k][i] / std::sqrt(joints_[i].stiffness);
  }
}

JointSpeeds SpringBalance::displacement() const {
  VectorXd drawn(static_cast<int>(joints_.size()));
  for (int i = 0; i < drawn.size(); ++i)
    drawn[i] = std::sqrt(joints_[i].stiffness) * joints_[i].deflection;
  auto way = nearest_allowed(reactions_, opens_, drawn);
  // opposite contacts that cannot all open
  if (!way) way = nearest_allowed(reactions_, VectorXd::Zero(opens_.size()), drawn);
  JointSpeeds out = none_;
  for (int i = 0; way && i < drawn.size(); ++i) {
    const double far = (*way)[i] / std::sqrt(joints_[i].stiffness);
    if (std::abs(far) > nowhere) out[joints_[i].number] = far;
  }
  return out;
}

bool SpringBalance::balanced_by_contacts(int dof, double sense) const {
  constexpr double rounding = 1e-9;  // relative to the torque
  VectorXd torques = VectorXd::Zero(static_cast<int>(joints_.size()));
  for (int i = 0; i < torques.size(); ++i)
    if (joints_[i].dof == dof)
      torques[i] = sense * std::sqrt(joints_[i].stiffness) * joints_[i].ratio;
  const VectorXd left = torques + reactions_ * nonnegative_least_squares(-reactions_, torques);
  return left.norm() <= rounding * torques.norm();
}

}  // namespace clench
