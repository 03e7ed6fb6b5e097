#include "grasp/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "math/cone_builder.h"

namespace clench {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

constexpr double no_end = std::numeric_limits<double>::infinity();

MatrixXd number(double x) { return MatrixXd::Constant(1, 1, x); }
VectorXd numbers(double x) { return VectorXd::Constant(1, x); }

// f of the contacts, u of the joints, and what else the program asks for, with the rows that a proof is read from
struct ForceProgram {
  GraspMap map;
  Vector6d load_O = Vector6d::Zero();
  JointBalance joints;
  ConeBuilder builder;
  int f = 0, u = 0, extra = 0;
  ConeRange balance;
  std::vector<ConeRange> cones, caps;  // one a contact; caps empty without
  VectorXd low, high;                  // of the efforts, as they are bounded here
  std::vector<ConeRange> lows, highs;  // one an effort; count 0: no bound
  ConeProgram program;
  ConeSolution solution;

  int normal(int contact) const { return f + map.starts[contact]; }
};

Vector6d turned(const Vector6d& wrench, const Eigen::Matrix3d& R) {
  Vector6d out;
  out << R * wrench.head<3>(), R * wrench.tail<3>();
  return out;
}

// t at least |u|: mu f_n less `back` of an unknown, against the tangential forces and the torsion over its radius
void add_friction(ForceProgram& p, const Grasp& grasp, int i, int less, double back) {
  const PointContact& contact = grasp.points[i];
  const int count = p.map.starts[i + 1] - p.map.starts[i];
  if (count == 1) {
    std::vector<ConeBlock> blocks = {{p.normal(i), number(1)}};
    if (less >= 0) blocks.push_back({less, number(-1)});
    p.cones.push_back(p.builder.cone(blocks));
    return;
  }
  MatrixXd own = MatrixXd::Identity(count, count);
  own(0, 0) = contact.mu;
  if (count == 4) own(3, 3) = 1 / contact.torsion_radius;
  std::vector<ConeBlock> blocks = {{p.normal(i), own}};
  if (less >= 0) blocks.push_back({less, -back * MatrixXd::Identity(count, 1)});
  p.cones.push_back(p.builder.cone(blocks));
}

void add_cones(ForceProgram& p, const Grasp& grasp, const ForceOptions& options, bool objective) {
  const bool interior = objective && options.objective == ForceObjective::interior;
  const bool sum = objective && options.objective == ForceObjective::interior_sum;
  const int contacts = p.map.contacts();
  // how far inside: one number for all, or one a contact
  int depth = -1;
  if (interior && contacts > 0) depth = p.builder.unknowns(1);
  if (sum && contacts > 0) depth = p.builder.unknowns(contacts);
  for (int i = 0; i < contacts; ++i) {
    const double mu = grasp.points[i].mu;
    const int own = depth < 0 ? -1 : depth + (sum ? i : 0);
    add_friction(p, grasp, i, own, std::sqrt(1 + mu * mu));
    if (own < 0) continue;
    if (sum || i == 0) {
      p.builder.cost(own, -1);
      p.builder.at_most({{own, number(-1)}}, numbers(0));
    }
  }
  if (options.max_force)
    for (int i = 0; i < contacts; ++i) {
      std::vector<ConeBlock> blocks = {{p.normal(i), number(1)}};
      if (interior) blocks.push_back({depth, number(1)});
      p.caps.push_back(p.builder.at_most(blocks, numbers(options.max_force.of(i))));
    }
}

// all normal forces together
std::vector<ConeBlock> sum_of_normals(const ForceProgram& p) {
  MatrixXd row = MatrixXd::Zero(1, p.map.forces());
  for (int i = 0; i < p.map.contacts(); ++i) row(0, p.map.starts[i]) = 1;
  return {{p.f, row}};
}

void add_totals(ForceProgram& p, const ForceOptions& options) {
  if (options.max_total_force)
    p.builder.at_most(sum_of_normals(p), numbers(*options.max_total_force));
  if (options.total_force) p.builder.equal(sum_of_normals(p), numbers(*options.total_force));
}

void add_objective(ForceProgram& p, const Grasp& grasp, ForceObjective objective) {
  const int contacts = p.map.contacts();
  if (objective == ForceObjective::least)
    for (int i = 0; i < contacts; ++i) p.builder.cost(p.normal(i), 1);
  if (objective == ForceObjective::squares)
    for (int i = 0; i < contacts; ++i)
      for (int k = p.map.starts[i]; k < p.map.starts[i + 1]; ++k) {
        const bool torsion = k == p.map.starts[i] + 3;
        const double length = torsion ? grasp.points[i].torsion_radius : 1;
        p.builder.square(p.f + k, 2 / (length * length));
      }
  if (objective == ForceObjective::peak && contacts > 0) {
    const int most = p.builder.unknowns(1);
    p.builder.cost(most, 1);
    for (int i = 0; i < contacts; ++i)
      p.builder.at_most({{p.normal(i), number(1)}, {most, number(-1)}}, numbers(0));
  }
}

// which way an effort closes the hand; 0: neither
double closing_sense(const World& world, const Grasp& grasp, int dof) {
  const double pace = world.robot(grasp.hand).dofs[dof].default_velocity;
  return pace > 0 ? 1 : pace < 0 ? -1 : 0;
}

// what bounds each effort
void bound_efforts(ForceProgram& p, const World& world, const Grasp& grasp,
                   const JointDemand& demand) {
  p.low = p.joints.low, p.high = p.joints.high;
  const auto& dofs = world.robot(grasp.hand).dofs;
  for (int k = 0; k < static_cast<int>(p.joints.refs.size()); ++k) {
    const EffortRef& ref = p.joints.refs[k];
    if (ref.clutch) {
      // a clutch that nothing bounds gives what it must
      if (demand.springs_only && std::isfinite(p.high[k])) p.low[k] = p.high[k];
      continue;
    }
    if (demand.unlimited) p.high[k] = no_end, p.low[k] = -no_end;
    if (ref.robot != grasp.hand) continue;
    if (demand.limits) p.high[k] = (*demand.limits)[ref.dof], p.low[k] = -p.high[k];
    const double sense = closing_sense(world, grasp, ref.dof);
    if (demand.closing_only && sense > 0) p.low[k] = 0;
    if (demand.closing_only && sense < 0) p.high[k] = 0;
    // a tendon pulls and cannot push
    if (demand.springs_only && dofs[ref.dof].kind == DofKind::compliant)
      p.low[k] = p.high[k] =
          sense < 0 ? std::min(0.0, p.joints.tendons[k]) : std::max(0.0, p.joints.tendons[k]);
    if (demand.efforts) p.low[k] = p.high[k] = (*demand.efforts)[ref.dof];
  }
}

// each joint is in balance, or nearly
void balance_joints(ForceProgram& p, const JointDemand& demand) {
  std::vector<int> tight, loose;
  for (int i = 0; i < p.joints.slack.size(); ++i)
    (demand.nearly_at_rest && p.joints.slack[i] > 0 ? loose : tight).push_back(i);
  const auto blocks = [&](const std::vector<int>& rows, double sign) {
    return std::vector<ConeBlock>{{p.f, sign * p.joints.forces(rows, Eigen::all)},
                                  {p.u, -sign * p.joints.efforts(rows, Eigen::all)}};
  };
  if (!tight.empty()) p.builder.equal(blocks(tight, 1), p.joints.springs(tight));
  if (loose.empty()) return;
  for (const double sign : {1.0, -1.0})
    p.builder.at_most(blocks(loose, sign), sign * p.joints.springs(loose) + p.joints.slack(loose));
}

void add_joints(ForceProgram& p, const World& world, const Grasp& grasp,
                const JointDemand& demand) {
  const int efforts = static_cast<int>(p.joints.refs.size());
  p.u = p.builder.unknowns(efforts);
  bound_efforts(p, world, grasp, demand);
  balance_joints(p, demand);
  p.lows.resize(efforts), p.highs.resize(efforts);
  for (int k = 0; k < efforts; ++k) {
    if (p.low[k] == p.high[k]) {
      p.builder.equal({{p.u + k, number(1)}}, numbers(p.high[k]));
      continue;
    }
    if (std::isfinite(p.high[k]))
      p.highs[k] = p.builder.at_most({{p.u + k, number(1)}}, numbers(p.high[k]));
    if (std::isfinite(p.low[k]))
      p.lows[k] = p.builder.at_most({{p.u + k, number(-1)}}, numbers(-p.low[k]));
  }
  if (demand.total_torque) {
    MatrixXd row = MatrixXd::Zero(1, efforts);
    for (int k = 0; k < efforts; ++k)
      if (p.joints.refs[k].robot == grasp.hand && !p.joints.refs[k].clutch)
        row(0, k) = closing_sense(world, grasp, p.joints.refs[k].dof);
    p.builder.equal({{p.u, row}}, numbers(*demand.total_torque));
  }
}

enum class Question { forces, nearest, largest };

ForceProgram make_program(const World& world, const Grasp& grasp, const ForceOptions& options,
                          Question question) {
  ForceProgram p;
  p.map = grasp_map(grasp.points, grasp.com);
  const Eigen::Matrix3d R_OW = world.body(grasp.object).X_WB.matrix().transpose();
  p.load_O = turned(options.load, R_OW);
  p.f = p.builder.unknowns(p.map.forces());
  const bool chosen = question == Question::forces;
  if (question == Question::forces) {
    p.balance = p.builder.equal({{p.f, p.map.matrix}}, -p.load_O);
  } else if (question == Question::nearest) {
    // what is left, torque over rho
    Vector6d unit = Vector6d::Ones();
    unit.tail<3>() *= grasp.rho;
    p.extra = p.builder.unknowns(6);
    p.balance =
        p.builder.equal({{p.f, p.map.matrix}, {p.extra, -MatrixXd(unit.asDiagonal())}}, -p.load_O);
    for (int k = 0; k < 6; ++k) p.builder.square(p.extra + k, 1);
  } else {
    p.extra = p.builder.unknowns(1);
    p.balance = p.builder.equal({{p.f, p.map.matrix}, {p.extra, p.load_O}}, Vector6d::Zero());
    p.builder.cost(p.extra, -1);
    p.builder.at_most({{p.extra, number(-1)}}, numbers(0));
  }
  add_cones(p, grasp, options, chosen);
  add_totals(p, options);
  if (chosen) add_objective(p, grasp, options.objective);
  p.joints = joint_balance(world, grasp, options.joints && options.joints->arms,
                           options.joints && options.joints->link_weights);
  if (options.joints) add_joints(p, world, grasp, *options.joints);
  p.program = p.builder.program();
  p.solution = solve(p.program);
  return p;
}

// --- reading it back ---

ContactForce read_force(const ForceProgram& p, const World& world, const Grasp& grasp, int i) {
  const PointContact& contact = grasp.points[i];
  const int count = p.map.starts[i + 1] - p.map.starts[i];
  const VectorXd f = p.solution.x.segment(p.normal(i), count);
  const Eigen::Matrix3d R_WO = world.body(grasp.object).X_WB.matrix();
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

// what the motors give; where nobody asked, what comes nearest to balancing each DOF's joints
VectorXd read_efforts(const ForceProgram& p, const World& world, const Grasp& grasp, bool asked) {
  const int dofs = static_cast<int>(world.robot(grasp.hand).dofs.size());
  VectorXd out = VectorXd::Zero(dofs);
  if (asked) return p.solution.x.segment(p.u, dofs);
  const VectorXd rows =
      p.joints.forces * p.solution.x.segment(p.f, p.map.forces()) - p.joints.springs;
  for (int k = 0; k < dofs; ++k) {
    const VectorXd column = p.joints.efforts.col(k);
    if (!column.isZero(0)) out[k] = column.dot(rows) / column.squaredNorm();
  }
  return out;
}

void read_forces(const ForceProgram& p, const World& world, const Grasp& grasp,
                 const ForceOptions& options, Question question, ForceResult& out) {
  for (int i = 0; i < p.map.contacts(); ++i) out.forces.push_back(read_force(p, world, grasp, i));
  Vector6d sum = p.map.matrix * p.solution.x.segment(p.f, p.map.forces());
  if (question == Question::largest) out.load_factor = std::max(0.0, p.solution.x[p.extra]);
  sum += (question == Question::largest ? out.load_factor : 1) * p.load_O;
  out.unbalanced = turned(sum, world.body(grasp.object).X_WB.matrix());
  sum.tail<3>() /= grasp.rho;
  out.residual = sum.norm();
  out.efforts = read_efforts(p, world, grasp, options.joints.has_value());
  const bool grows = options.objective == ForceObjective::interior ||
                     options.objective == ForceObjective::interior_sum;
  if (question == Question::forces) out.objective = (grows ? -1 : 1) * p.solution.objective;
}

int largest_of(const std::vector<double>& values) {
  const auto at = std::max_element(values.begin(), values.end());
  return at == values.end() ? -1 : static_cast<int>(at - values.begin());
}

void name_weakest(ForceCertificate& c) {
  c.contact = largest_of(c.cap_shares);
  const int dof = largest_of(c.effort_shares);
  const double of_cap = c.contact < 0 ? 0 : c.cap_shares[c.contact];
  const double of_dof = dof < 0 ? 0 : c.effort_shares[dof];
  // shares that are rounding are none: then friction alone is at its end
  const double least = 1e-9 * std::max(std::abs(c.power), std::abs(c.capacity));
  if (of_dof > of_cap && of_dof > least) c.dof = dof;
  if (of_cap <= least) {
    std::vector<double> moves;
    for (size_t i = 0; i < c.opens.size(); ++i)
      moves.push_back(std::hypot(c.opens[i], c.slides[i]));
    c.contact = largest_of(moves);
  }
}

// factor  of the largest load, where that was asked for
ForceCertificate read_certificate(const ForceProgram& p, const World& world, const Grasp& grasp,
                                  std::optional<double> factor) {
  const ConeSolution& s = p.solution;
  const Vector6d y = s.y.segment<6>(p.balance.start);
  Vector6d measured = y;
  measured.tail<3>() *= grasp.rho;
  // no motion of the object is in a proof that its forces contradict each other whatever the load
  const double size = measured.norm() > 1e-12 * s.y.norm() ? 1 / measured.norm() : 1;
  ForceCertificate out;
  out.twist = turned(y * size, world.body(grasp.object).X_WB.matrix());
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
    out.opens.push_back((z.size() == 1 ? 1 : contact.mu) * z[0]);
    out.slides.push_back(z.size() == 1 ? 0 : z.segment(1, 2).norm());
    const double cap = p.caps.empty() ? 0 : s.z[p.caps[i].start] * p.program.h[p.caps[i].start];
    out.cap_shares.push_back(size * cap);
  }
  const int dofs = static_cast<int>(world.robot(grasp.hand).dofs.size());
  for (int k = 0; k < dofs && !p.highs.empty(); ++k) {
    double share = 0;
    if (p.highs[k].count > 0) share += s.z[p.highs[k].start] * p.high[k];
    if (p.lows[k].count > 0) share -= s.z[p.lows[k].start] * p.low[k];
    out.effort_shares.push_back(size * share);
  }
  out.effort_shares.resize(dofs);
  name_weakest(out);
  return out;
}

// of a load, torque over rho: a power of two, so that no digit changes
double size_of(const Vector6d& load, const Grasp& grasp) {
  return std::exp2(std::round(
      std::log2(std::hypot(load.head<3>().stableNorm(), load.tail<3>().stableNorm() / grasp.rho))));
}

// What stands in the way of the largest part of the load that is held is the tightest of all proofs. Where no part is,
// since motors or springs press too much, the solver's own.
ForceCertificate best_certificate(const ForceProgram& p, const World& world, const Grasp& grasp,
                                  const ForceOptions& options) {
  if (!options.load.isZero(0)) {
    ForceOptions unit = options;
    const double size = size_of(options.load, grasp);
    unit.load /= size;
    const ForceProgram part = make_program(world, grasp, unit, Question::largest);
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

// --- what may be asked ---

void check_options(const World& world, const Grasp& grasp, const ForceOptions& options) {
  const auto refuse = [](const std::string& why) { fail("contact forces: {}", why); };
  if (!options.load.allFinite()) refuse("load holds a number that is not finite");
  const auto positive = [&](const char* name, const std::optional<double>& x, const char* unit) {
    if (x && !(std::isfinite(*x) && *x > 0))
      refuse(fmt::format("{} must be > 0 [{}], got {}", name, unit, *x));
  };
  const auto& caps = options.max_force.values;
  if (caps.size() > 1 && caps.size() != grasp.points.size())
    refuse(fmt::format("max_force: wanted one number or {}, one a contact, got {}",
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
      refuse(fmt::format("{}: wanted {}, one a DOF, got {}", name, dofs, x->size()));
    for (const double effort : *x)
      if (!std::isfinite(effort) || effort < least)
        refuse(fmt::format("{}: wanted {} [N m or N], got {}", name,
                           least == 0 ? "numbers >= 0" : "finite numbers", effort));
  };
  per_dof("torque limits", options.joints->limits, 0);
  per_dof("torques", options.joints->efforts, -no_end);
}

ForceResult answer(const World& world, const Grasp& grasp, const ForceOptions& options,
                   Question question) {
  const ForceProgram p = make_program(world, grasp, options, question);
  ForceResult out;
  out.status = status_of(p.solution.status);
  const bool forces = out.status == ForceStatus::optimal || out.status == ForceStatus::inaccurate;
  if (forces) read_forces(p, world, grasp, options, question, out);
  const bool limit = question == Question::largest && out.status == ForceStatus::optimal;
  if (limit) out.certificate = read_certificate(p, world, grasp, out.load_factor);
  if (question == Question::forces && out.status == ForceStatus::infeasible)
    out.certificate = best_certificate(p, world, grasp, options);
  return out;
}

}  // namespace

ForceResult contact_forces(const World& world, const Grasp& grasp, const ForceOptions& options) {
  check_unmoved(world, grasp);
  check_options(world, grasp, options);
  return answer(world, grasp, options, options.nearest ? Question::nearest : Question::forces);
}

ForceResult largest_load(const World& world, const Grasp& grasp, const ForceOptions& options) {
  check_unmoved(world, grasp);
  check_options(world, grasp, options);
  if (options.load.isZero(0)) fail("largest load: the direction must not be 0");
  // the length of a direction counts for nothing
  ForceOptions unit = options;
  const double size = size_of(options.load, grasp);
  unit.load /= size;
  ForceResult out = answer(world, grasp, unit, Question::largest);
  out.load_factor /= size;
  return out;
}

}  // namespace clench
