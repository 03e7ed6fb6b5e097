#include "clench/grasp/force/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/grasp/force/force_program.h"

namespace clench {
namespace {

using Eigen::VectorXd;

constexpr double no_end = std::numeric_limits<double>::infinity();

// size of a load, torque over rho: a power of two, so that scaling is exact
double size_of(const Vector6d& load, const Grasp& grasp) {
  return std::exp2(std::round(
      std::log2(std::hypot(load.head<3>().stableNorm(), load.tail<3>().stableNorm() / grasp.rho))));
}

ContactForce read_force(const ForceProgram& p, const World& world, const Grasp& grasp, int i) {
  const PointContact& contact = grasp.points[i];
  const int count = p.map.starts[i + 1] - p.map.starts[i];
  const VectorXd f = p.solution.x.segment(p.normal(i), count);
  const Eigen::Matrix3d R_WO = world.pose(grasp.object).matrix();
  ContactForce out;
  out.normal = f[0];
  Eigen::Vector3d f_C(0, 0, f[0]);
  if (count >= 3) f_C.head<2>() = f.segment<2>(1);
  out.force_W = R_WO * (contact_frame(contact.n_O) * f_C);
  const Eigen::Matrix3d frame_W = contact_frame(R_WO * contact.n_O);
  out.tangential = {frame_W.col(0).dot(out.force_W), frame_W.col(1).dot(out.force_W)};
  double across = f_C.head<2>().norm();
  if (count == 4) {
    out.torsion = f[3];
    across = std::hypot(across, f[3] / contact.torsion_radius);
  }
  out.margin = (contact.mu * f[0] - across) / std::sqrt(1 + contact.mu * contact.mu);
  if (count == 1) out.margin = f[0];
  return out;
}

// efforts of the motors; if joints are not constrained, those that come nearest to balancing each
// DOF's joints
VectorXd read_efforts(const ForceProgram& p, const World& world, const Grasp& grasp, bool asked) {
  const int dofs = static_cast<int>(world.robot(grasp.hand).dofs.size());
  VectorXd out = VectorXd::Zero(dofs);
  if (asked) return p.solution.x.segment(p.u, dofs) + p.at_rest.head(dofs);
  const VectorXd rows =
      p.joints.forces * p.solution.x.segment(p.f, p.map.forces()) - p.joints.springs;
  for (int k = 0; k < dofs; ++k) {
    const VectorXd column = p.joints.efforts.col(k);
    if (!column.isZero(0)) out[k] = column.dot(rows) / column.squaredNorm();
  }
  return out;
}

// unknowns below this fraction of their unit are solver noise
constexpr double noise = 1e-9;

// for objectives that are maximized
double read_extra(const ForceProgram& p) {
  const double x = p.solution.x[p.extra];
  return x > noise * p.solution.units[p.extra] ? x : 0;
}

// for `interior` the maximized distance, otherwise the residual after rounding
void read_margin(const ForceProgram& p, bool interior, ForceResult& out) {
  if (out.forces.empty()) return;
  double most = 0;
  out.margin = no_end;
  for (const ContactForce& f : out.forces) {
    most = std::max(most, f.normal);
    out.margin = std::min(out.margin, f.margin);
  }
  if (interior) out.objective = read_extra(p);
  if (interior) out.margin = std::min(out.margin, out.objective);
  if (out.margin <= noise * most) out.margin = 0;
}

// Is the residual small relative to a load? Forces are compared with torques by the moment that
// they have at the longest arm.
bool balances(double arm, const Vector6d& load, const Vector6d& left) {
  const auto force = [&](const Vector6d& w) { return w.head<3>().stableNorm(); };
  const auto torque = [&](const Vector6d& w) { return w.tail<3>().stableNorm(); };
  // rounding error of the residual of forces a hundred million times the load
  const double part = 1e-7;
  return force(left) * arm <= part * (force(load) * arm + torque(load)) &&
         torque(left) <= part * (force(load) * arm + torque(load));
}

void read_forces(const ForceProgram& p, const World& world, const Grasp& grasp,
                 const ForceOptions& options, ForceQuestion question, ForceResult& out) {
  for (int i = 0; i < p.map.contacts(); ++i) out.forces.push_back(read_force(p, world, grasp, i));
  Vector6d held = p.load_O;
  if (question == ForceQuestion::largest) {
    out.load_factor = read_extra(p);
    held *= out.load_factor;
  }
  Vector6d sum = p.map.matrix * p.solution.x.segment(p.f, p.map.forces()) + held;
  const bool asked = !held.isZero(0) && question != ForceQuestion::nearest;
  if (asked && !balances(p.arm, held, sum)) out.status = ForceStatus::inaccurate;
  out.unbalanced = turned_wrench(sum, world.pose(grasp.object).matrix());
  sum.tail<3>() /= grasp.rho;
  out.residual = sum.stableNorm();
  if (!std::isfinite(out.residual)) out.status = ForceStatus::inaccurate;
  out.efforts = read_efforts(p, world, grasp, options.joints.has_value());
  const bool grows = options.objective == ForceObjective::max_margin ||
                     options.objective == ForceObjective::max_margin_sum;
  if (question == ForceQuestion::forces) out.objective = (grows ? -1 : 1) * p.solution.objective;
  const bool interior = options.objective == ForceObjective::max_margin;
  read_margin(p, interior && question == ForceQuestion::forces, out);
}

int largest_of(const std::vector<double>& values) {
  const auto at = std::max_element(values.begin(), values.end());
  return at == values.end() ? -1 : static_cast<int>(at - values.begin());
}

void name_weakest(ForceCertificate& c) {
  c.contact = largest_of(c.force_limit_power);
  const int dof = largest_of(c.effort_limit_power);
  const double of_cap = c.contact < 0 ? 0 : c.force_limit_power[c.contact];
  const double of_dof = dof < 0 ? 0 : c.effort_limit_power[dof];
  // shares at the level of rounding are set to zero: then friction alone is the limit
  const double least = 1e-9 * std::max(std::abs(c.power), std::abs(c.capacity));
  if (of_dof > of_cap && of_dof > least) c.dof = dof;
  if (of_cap <= least) {
    std::vector<double> moves;
    for (size_t i = 0; i < c.separation_rates.size(); ++i)
      moves.push_back(std::hypot(c.separation_rates[i], c.sliding_rates[i]));
    c.contact = largest_of(moves);
  }
}

// factor  of the largest load, if that was requested
ForceCertificate read_certificate(const ForceProgram& p, const World& world, const Grasp& grasp,
                                  std::optional<double> factor) {
  const ConeSolution& s = p.solution;
  Vector6d y = s.y.segment<6>(p.balance.start);
  y.tail<3>() /= p.arm;
  Vector6d measured = y;
  measured.tail<3>() *= grasp.rho;
  // the proof that the forces contradict each other for any load involves no motion of the object
  const double size = measured.norm() > 1e-12 * s.y.norm() ? 1 / measured.norm() : 1;
  ForceCertificate out;
  out.twist = turned_wrench(y * size, world.pose(grasp.object).matrix());
  out.power = size * p.load_O.dot(y);
  const double value = size * (s.y.dot(p.program.b) + s.z.dot(p.program.h));
  if (factor)
    out.power *= *factor, out.capacity = value;
  else
    out.capacity = out.power + value;
  const int cones = p.builder.cones_start();
  for (int i = 0; i < p.map.contacts(); ++i) {
    const PointContact& contact = grasp.points[i];
    const VectorXd z = size * s.z.segment(cones + p.cones[i].start, p.cones[i].count);
    out.separation_rates.push_back((z.size() == 1 ? 1 : contact.mu) * z[0]);
    out.sliding_rates.push_back(z.size() == 1 ? 0 : z.segment(1, 2).norm());
    const double cap = p.caps.empty() ? 0 : s.z[p.caps[i].start] * p.program.h[p.caps[i].start];
    out.force_limit_power.push_back(size * cap);
  }
  const int dofs = static_cast<int>(world.robot(grasp.hand).dofs.size());
  for (int k = 0; k < dofs && !p.highs.empty(); ++k) {
    double share = 0;
    if (p.highs[k].count > 0) share += s.z[p.highs[k].start] * p.high[k];
    if (p.lows[k].count > 0) share -= s.z[p.lows[k].start] * p.low[k];
    out.effort_limit_power.push_back(size * share);
  }
  out.effort_limit_power.resize(dofs);
  name_weakest(out);
  return out;
}

// The tightest of all proofs is the one that limits the largest multiple of the load. If no
// multiple is balanced, since motors or springs press too much, the solver's own proof is used.
ForceCertificate best_certificate(const ForceProgram& p, const World& world, const Grasp& grasp,
                                  const ForceOptions& options) {
  if (!options.load.isZero(0)) {
    ForceOptions unit = options;
    const double size = size_of(options.load, grasp);
    unit.load /= size;
    const ForceProgram part = make_program(world, grasp, unit, ForceQuestion::largest);
    if (part.solution.status == ConeStatus::optimal && part.solution.x[part.extra] < size)
      return read_certificate(part, world, grasp, size);
  }
  return read_certificate(p, world, grasp, {});
}

ForceStatus status_of(ConeStatus status) {
  switch (status) {
    case ConeStatus::optimal:
      return ForceStatus::optimal;
    case ConeStatus::infeasible:
      return ForceStatus::infeasible;
    case ConeStatus::unbounded:
      return ForceStatus::unbounded;
    default:
      return ForceStatus::inaccurate;
  }
}

// --- checks of the options ---

void check_options(const World& world, const Grasp& grasp, const ForceOptions& options) {
  const auto refuse = [](const std::string& why) { fail("contact forces: {}", why); };
  if (!options.load.allFinite()) refuse("load holds a number that is not finite");
  const auto positive = [&](const char* name, const std::optional<double>& x, const char* unit) {
    if (x && !(std::isfinite(*x) && *x > 0))
      refuse(fmt::format("{} must be > 0 [{}], got {}", name, unit, *x));
  };
  const auto& caps = options.max_force.values;
  if (!options.max_force.fits(grasp.points.size()))
    refuse(fmt::format("max_force: expected one number or {}, one per contact, got {}",
                       grasp.points.size(), caps.size()));
  for (const double cap : caps) positive("max_force", cap, "N");
  positive("max_total_force", options.max_total_force, "N");
  positive("total_force", options.total_force, "N");
  if (!options.joints) return;
  positive("total_torque", options.joints->total_torque, "N m");
  const auto dofs = static_cast<int>(world.robot(grasp.hand).dofs.size());
  const auto per_dof = [&](const char* name, const std::optional<VectorXd>& x, double least) {
    if (!x) return;
    if (x->size() != dofs)
      refuse(fmt::format("{}: expected {}, one per DOF, got {}", name, dofs, x->size()));
    for (const double effort : *x)
      if (!std::isfinite(effort) || effort < least)
        refuse(fmt::format("{}: expected {} [N m or N], got {}", name,
                           least == 0 ? "numbers >= 0" : "finite numbers", effort));
  };
  per_dof("torque limits", options.joints->limits, 0);
  per_dof("torques", options.joints->efforts, -no_end);
}

ForceResult answer(const World& world, const Grasp& grasp, const ForceOptions& options,
                   ForceQuestion question) {
  const ForceProgram p = make_program(world, grasp, options, question);
  ForceResult out;
  out.status = status_of(p.solution.status);
  const bool forces = out.status == ForceStatus::optimal || out.status == ForceStatus::inaccurate;
  if (forces) read_forces(p, world, grasp, options, question, out);
  const bool limit = question == ForceQuestion::largest && out.status == ForceStatus::optimal;
  if (limit) out.certificate = read_certificate(p, world, grasp, out.load_factor);
  if (question == ForceQuestion::forces && out.status == ForceStatus::infeasible)
    out.certificate = best_certificate(p, world, grasp, options);
  return out;
}

}  // namespace

void check_force_options(const World& world, const Grasp& grasp, const ForceOptions& options) {
  check_unmoved(world, grasp);
  check_options(world, grasp, options);
}

ForceResult contact_forces(const World& world, const Grasp& grasp, const ForceOptions& options) {
  check_force_options(world, grasp, options);
  return answer(world, grasp, options,
                options.nearest ? ForceQuestion::nearest : ForceQuestion::forces);
}

ForceResult max_load(const World& world, const Grasp& grasp, const ForceOptions& options) {
  check_force_options(world, grasp, options);
  if (options.load.isZero(0)) fail("largest load: the direction must not be 0");
  // the length of a direction is ignored
  ForceOptions unit = options;
  const double size = size_of(options.load, grasp);
  unit.load /= size;
  ForceResult out = answer(world, grasp, unit, ForceQuestion::largest);
  out.load_factor /= size;
  return out;
}

}  // namespace clench
