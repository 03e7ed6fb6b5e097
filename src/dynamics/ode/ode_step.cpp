#include "clench/dynamics/ode/ode_step.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "clench/base/error.h"
#include "clench/dynamics/ode/ode_library.h"
#include "clench/dynamics/ode/ode_scene.h"
#include "clench/math/decompositions.h"

namespace clench {

namespace {

/// A joint coupled by a ratio to the joint that represents their DOF.
struct Coupling {
  int tree, joint, lead;
  double share;  // speed of the joint per that of the lead
};

std::vector<Coupling> couplings_of(const System& system, const OdeScene& scene) {
  std::vector<Coupling> out;
  for (size_t t = 0; t < system.trees.size(); ++t) {
    const auto& joints = system.trees[t].joints;
    for (size_t j = 0; j < joints.size(); ++j) {
      const int lead = scene.trees()[t].lead[joints[j].coordinate];
      if (lead >= 0 && lead != static_cast<int>(j))
        out.push_back(
            {static_cast<int>(t), static_cast<int>(j), lead, joints[j].ratio / joints[lead].ratio});
    }
  }
  return out;
}

// Torques that keep couplings, by Newton's method: ODE's velocities are piecewise linear functions
// of them.
class Coupler {
 public:
  Coupler(OdeScene& scene, std::vector<Coupling> couplings, OdeSolution& out)
      : scene_(scene), couplings_(std::move(couplings)), out_(out) {
    given_.setZero(size());
  }

  void run() {
    Eigen::VectorXd torques = Eigen::VectorXd::Zero(size());
    Eigen::VectorXd g = faults(torques);
    double fault = size() == 0 ? 0 : g.cwiseAbs().maxCoeff();
    for (int round = 0; round < 30 && fault > within; ++round) {
      const Eigen::VectorXd way = least_squares(slopes(torques, g), -g);
      double step = 1;
      Eigen::VectorXd next_g;
      // shorter if a contact opens or begins to slide within the step
      for (int cut = 0; cut < 8; ++cut, step /= 2) {
        next_g = faults(torques + step * way);
        if (next_g.cwiseAbs().maxCoeff() < fault) break;
      }
      const double next = next_g.cwiseAbs().maxCoeff();
      if (!(next < fault)) break;
      torques += step * way;
      g = next_g;
      fault = next;
    }
    faults(torques);  // the accepted step
    out_.residual = std::max(out_.residual, fault);
    out_.solved = out_.solved && fault <= 1e-6;
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(couplings_.size()); }

  Eigen::VectorXd faults(const Eigen::VectorXd& torques) {
    Eigen::VectorXd g(size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      const Coupling& c = couplings_[i];
      scene_.push(c.tree, c.joint, torques[i] - given_[i]);
      scene_.push(c.tree, c.lead, -c.share * (torques[i] - given_[i]));
    }
    given_ = torques;
    scene_.step();
    ++out_.solves;
    for (Eigen::Index i = 0; i < size(); ++i) {
      const Coupling& c = couplings_[i];
      g[i] =
          scene_.joint_velocity(c.tree, c.joint) - c.share * scene_.joint_velocity(c.tree, c.lead);
    }
    if (!g.allFinite()) fail("dynamics: ODE returns velocities that are not numbers");
    return g;
  }

  Eigen::MatrixXd slopes(const Eigen::VectorXd& torques, const Eigen::VectorXd& g) {
    Eigen::MatrixXd J(size(), size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      // torque that moves the joint by about this much
      constexpr double moved = 1e-5;
      double d = 1e-6;
      Eigen::VectorXd change;
      for (int tries = 0; tries < 3; ++tries) {
        Eigen::VectorXd there = torques;
        there[i] += d;
        change = faults(there) - g;
        const double size = std::abs(change[i]);
        if ((size > moved / 100 && size < moved * 100) || size == 0) break;
        d *= moved / size;
      }
      J.col(i) = change / d;
    }
    return J;
  }

  static constexpr double within = 1e-10;
  OdeScene& scene_;
  std::vector<Coupling> couplings_;
  OdeSolution& out_;
  Eigen::VectorXd given_;
};

}  // namespace

// Dantzig's method fails for redundant contacts unless they are compliant; if it fails
// nevertheless, ODE iterates.
static constexpr double softness[] = {1e-7, 1e-6, 1e-5, 1e-4};
static constexpr double max_fault = 1e-5;  // tolerance of contacts after iterations [m/s]

OdeSolution step_ode(const World& world, const OdeProblem& problem, double h) {
  OdeSolution out;
  std::optional<OdeScene> made;
  bool iterates = false;
  for (size_t round = 0; round <= std::size(softness); ++round) {
    out = {};
    out.softened = round > 0;
    iterates = round == std::size(softness);
    made.emplace(world, problem, h, softness[iterates ? 0 : round]);
    if (iterates) made->iterate();
    for (const CoordinateRow& row : problem.rows) made->add_row(row);
    for (const OdeContact& contact : problem.contacts) made->add_contact(contact);
    take_ode_warnings();
    Coupler(*made, couplings_of(problem.system, *made), out).run();
    const bool whole = take_ode_warnings() == 0;
    out.solved = out.solved && whole;
    if (whole) break;
  }
  const OdeScene& scene = *made;

  out.v = problem.v;
  for (size_t t = 0; t < problem.system.trees.size(); ++t) {
    const Articulation& tree = problem.system.trees[t];
    if (tree.floating) {
      const Twist twist = scene.root_twist(static_cast<int>(t));
      out.v.segment<3>(tree.first) = twist.linear;
      out.v.segment<3>(tree.first + 3) = twist.angular;
    }
    for (int c = tree.root_size(); c < tree.size(); ++c)
      if (const int lead = scene.trees()[t].lead[c]; lead >= 0)
        out.v[tree.first + c] =
            scene.joint_velocity(static_cast<int>(t), lead) / tree.joints[lead].ratio;
  }
  if (!out.v.allFinite()) fail("dynamics: ODE returns velocities that are not numbers");
  for (size_t i = 0; i < problem.rows.size(); ++i)
    out.row_impulses.push_back(scene.row_impulse(static_cast<int>(i)));
  for (size_t i = 0; i < problem.contacts.size(); ++i) {
    scene.read_contact(problem.contacts[i], static_cast<int>(i), out);
    out.residual = std::max(out.residual, problem.contacts[i].target - out.velocities[i][0]);
  }
  if (iterates) out.solved = out.solved && out.residual <= max_fault;
  return out;
}

}  // namespace clench
