#include "clench/grasp/force/force_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "clench/grasp/force/shared_actuators.h"
#include "clench/math/decompositions.h"
#include "clench/math/solve_cone_program.h"

namespace clench {

using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

MatrixXd number(double x) { return MatrixXd::Constant(1, 1, x); }
VectorXd numbers(double x) { return VectorXd::Constant(1, x); }

// t at least |u|: mu f_n minus `back` times an unknown, against the tangential forces and the
// torsion over its radius
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
  const bool interior = objective && options.objective == ForceObjective::max_margin;
  const bool sum = objective && options.objective == ForceObjective::max_margin_sum;
  const int contacts = p.map.contacts();
  // distance from the boundary: one number for all, or one per contact
  int depth = -1;
  if (interior && contacts > 0) depth = p.extra = p.builder.unknowns(1);
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

// sum of all normal forces
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
  if (objective == ForceObjective::min_sum)
    for (int i = 0; i < contacts; ++i) p.builder.cost(p.normal(i), 1);
  if (objective == ForceObjective::min_norm)
    for (int i = 0; i < contacts; ++i)
      for (int k = p.map.starts[i]; k < p.map.starts[i + 1]; ++k) {
        const bool torsion = k == p.map.starts[i] + 3;
        const double length = torsion ? grasp.points[i].torsion_radius : 1;
        p.builder.square(p.f + k, 2 / (length * length));
      }
  if (objective == ForceObjective::min_max && contacts > 0) {
    const int most = p.builder.unknowns(1);
    p.builder.cost(most, 1);
    for (int i = 0; i < contacts; ++i)
      p.builder.at_most({{p.normal(i), number(1)}, {most, number(-1)}}, numbers(0));
  }
}

// direction in which an effort closes the hand; 0: neither
double closing_sense(const World& world, const Grasp& grasp, int dof) {
  const double pace = world.robot(grasp.hand).dofs[dof].default_velocity;
  return pace > 0 ? 1 : pace < 0 ? -1 : 0;
}

// bounds of each effort
void bound_efforts(ForceProgram& p, const World& world, const Grasp& grasp,
                   const JointDemand& demand) {
  p.low = p.joints.low, p.high = p.joints.high;
  const auto& dofs = world.robot(grasp.hand).dofs;
  for (int k = 0; k < static_cast<int>(p.joints.refs.size()); ++k) {
    const EffortRef& ref = p.joints.refs[k];
    if (ref.clutch) {
      // an unbounded clutch exerts any effort required
      if (demand.springs_only && std::isfinite(p.high[k])) p.low[k] = p.high[k];
      continue;
    }
    // a motor without a limit exerts any effort in the directions in which it can push
    if (demand.unlimited && p.low[k] < p.high[k]) {
      if (p.high[k] > 0) p.high[k] = no_bound;
      if (p.low[k] < 0) p.low[k] = -no_bound;
    }
    if (ref.robot != grasp.hand) continue;
    if (demand.limits) p.high[k] = (*demand.limits)[ref.dof], p.low[k] = -p.high[k];
    const double sense = closing_sense(world, grasp, ref.dof);
    if (demand.unilateral && sense > 0) p.low[k] = std::max(0.0, p.low[k]);
    if (demand.unilateral && sense < 0) p.high[k] = std::min(0.0, p.high[k]);
    // a tendon can pull but not push; without a motor it is slack
    if (demand.springs_only && dofs[ref.dof].kind == DofKind::compliant && p.low[k] < p.high[k])
      p.low[k] = p.high[k] =
          sense < 0 ? std::min(0.0, p.joints.tendons[k]) : std::max(0.0, p.joints.tendons[k]);
    if (demand.efforts) p.low[k] = p.high[k] = (*demand.efforts)[ref.dof];
  }
}

// Efforts that balance springs and weights without contacts, and the remainder that no effort
// balances: so that heavy links do not hide small forces.
VectorXd efforts_at_rest(const JointBalance& joints, VectorXd& left) {
  left = joints.springs;
  if (joints.efforts.size() == 0) return VectorXd::Zero(joints.efforts.cols());
  const VectorXd efforts = least_squares(joints.efforts, -joints.springs);
  const MatrixXd sizes = joints.efforts.cwiseAbs();
  left += joints.efforts * efforts;
  const VectorXd terms = joints.springs.cwiseAbs() + sizes * efforts.cwiseAbs();
  // a few rounding errors of the terms that cancelled
  for (int i = 0; i < left.size(); ++i)
    if (std::abs(left[i]) <= 1e-14 * terms[i]) left[i] = 0;
  return efforts;
}

// each joint is balanced, or nearly
void balance_joints(ForceProgram& p, const JointDemand& demand) {
  VectorXd springs;
  p.at_rest = efforts_at_rest(p.joints, springs);
  std::vector<int> tight, loose;
  for (int i = 0; i < p.joints.slack.size(); ++i)
    (demand.nearly_at_rest && p.joints.slack[i] > 0 ? loose : tight).push_back(i);
  const auto blocks = [&](const std::vector<int>& rows, double sign) {
    return std::vector<ConeBlock>{{p.f, sign * p.joints.forces(rows, Eigen::all)},
                                  {p.u, -sign * p.joints.efforts(rows, Eigen::all)}};
  };
  if (!tight.empty()) p.builder.equal(blocks(tight, 1), springs(tight));
  if (loose.empty()) return;
  for (const double sign : {1.0, -1.0})
    p.builder.at_most(blocks(loose, sign), sign * springs(loose) + p.joints.slack(loose));
}

// limits of the directions in which an effort acts, if motors exert any effort required
EffortRange without_limits(EffortRange range) {
  return {range.low < 0 ? -no_bound : range.low, range.high > 0 ? no_bound : range.high};
}

// An actuator of several DOFs exerts one force on all of them: within the bounds of each, their
// efforts are combinations of such forces and of those of their other actuators.
void share_actuators(ForceProgram& p, const World& world, Id<Robot> robot, bool unlimited) {
  const SharedActuators shared = shared_actuators(world, robot);
  if (shared.actuators.empty()) return;
  const int first = p.builder.unknowns(static_cast<int>(shared.actuators.size()));
  std::map<int, MatrixXd> rows;  // by DOF: effort per unit of each force
  for (const auto& [dof, own] : shared.others)
    rows[dof] = MatrixXd::Zero(1, static_cast<int>(shared.actuators.size()));
  for (int a = 0; a < static_cast<int>(shared.actuators.size()); ++a) {
    const SharedActuator& actuator = shared.actuators[a];
    const EffortRange force = unlimited ? without_limits(actuator.force) : actuator.force;
    if (std::isfinite(force.high)) p.builder.at_most({{first + a, number(1)}}, numbers(force.high));
    if (std::isfinite(force.low)) p.builder.at_most({{first + a, number(-1)}}, numbers(-force.low));
    for (const auto& [dof, reach] : actuator.reaches) rows[dof](0, a) += reach;
  }
  for (int k = 0; k < static_cast<int>(p.joints.refs.size()); ++k) {
    const EffortRef& ref = p.joints.refs[k];
    if (ref.clutch || ref.robot != robot || !rows.contains(ref.dof)) continue;
    const EffortRange given = shared.others.at(ref.dof);
    const EffortRange own = unlimited ? without_limits(given) : given;
    const MatrixXd& row = rows[ref.dof];
    if (std::isfinite(own.high))
      p.builder.at_most({{p.u + k, number(1)}, {first, -row}}, numbers(own.high - p.at_rest[k]));
    if (std::isfinite(own.low))
      p.builder.at_most({{p.u + k, number(-1)}, {first, row}}, numbers(p.at_rest[k] - own.low));
  }
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
      p.builder.equal({{p.u + k, number(1)}}, numbers(p.high[k] - p.at_rest[k]));
      continue;
    }
    if (std::isfinite(p.high[k]))
      p.highs[k] = p.builder.at_most({{p.u + k, number(1)}}, numbers(p.high[k] - p.at_rest[k]));
    if (std::isfinite(p.low[k]))
      p.lows[k] = p.builder.at_most({{p.u + k, number(-1)}}, numbers(p.at_rest[k] - p.low[k]));
  }
  // limits set by a script replace those of the actuators
  std::vector<Id<Robot>> robots;
  for (const EffortRef& ref : p.joints.refs)
    if (std::ranges::find(robots, ref.robot) == robots.end()) robots.push_back(ref.robot);
  for (const Id<Robot> robot : robots)
    if (robot != grasp.hand || !(demand.limits || demand.efforts))
      share_actuators(p, world, robot, demand.unlimited);
  if (demand.total_torque) {
    MatrixXd row = MatrixXd::Zero(1, efforts);
    for (int k = 0; k < efforts; ++k)
      if (p.joints.refs[k].robot == grasp.hand && !p.joints.refs[k].clutch)
        row(0, k) = closing_sense(world, grasp, p.joints.refs[k].dof);
    p.builder.equal({{p.u, row}}, numbers(*demand.total_torque - row.row(0).dot(p.at_rest)));
  }
}

// so that torques have the same weight as forces
double about_longest_arm(const Grasp& grasp) {
  double arm = 0;
  for (const PointContact& point : grasp.points)
    arm = std::max(arm, (point.p_O - grasp.com).stableNorm());
  return arm > 0 ? std::exp2(std::round(std::log2(arm))) : 1;
}

// Does a motor of the hand drive this?
bool is_driven(const ForceProgram& p, const Grasp& grasp, int k) {
  const EffortRef& ref = p.joints.refs[k];
  return !ref.clutch && ref.robot == grasp.hand && p.low[k] < p.high[k];
}

// limits of a motor, +-1 where it has none
EffortRange limits_of(const ForceProgram& p, int k) {
  return {std::isfinite(p.low[k]) ? std::min(0.0, p.low[k]) : -1,
          std::isfinite(p.high[k]) ? std::max(0.0, p.high[k]) : 1};
}

// `extra`, over `unit`, as the largest fraction of the efforts of the hand's motors
void minimize_fraction(LoadedProgram& out, const Grasp& grasp) {
  ForceProgram& p = out.program;
  p.extra = p.builder.unknowns(1);
  p.builder.cost(p.extra, 1);
  p.builder.at_most({{p.extra, number(-1)}}, numbers(0));
  const int efforts = static_cast<int>(p.joints.refs.size());
  double largest = 0;
  for (int k = 0; k < efforts; ++k)
    if (is_driven(p, grasp, k))
      largest = std::max({largest, limits_of(p, k).high, -limits_of(p, k).low});
  if (largest > 0) out.unit = largest;
  for (int k = 0; k < efforts; ++k) {
    if (!is_driven(p, grasp, k)) continue;
    const EffortRange range = limits_of(p, k);
    const int effort = out.efforts + k;
    p.builder.at_most({{effort, number(1)}, {p.extra, number(-range.high / out.unit)}},
                      numbers(-p.at_rest[k]));
    p.builder.at_most({{effort, number(-1)}, {p.extra, number(range.low / out.unit)}},
                      numbers(p.at_rest[k]));
  }
  p.program = p.builder.program();
  p.solution = solve(p.program);
}

ForceProgram begin_preload(const World& world, const Grasp& grasp, const JointDemand& joints) {
  ForceProgram p;
  p.map = grasp_map(grasp.points, grasp.com);
  p.arm = about_longest_arm(grasp);
  p.joints = joint_balance(world, grasp, joints.arms, joints.link_weights);
  return p;
}

// further forces and efforts, which balance a load
void add_loaded(ForceProgram& p, const World& world, const Grasp& grasp,
                const ForceOptions& options, const Vector6d& load_O) {
  Vector6d rows = Vector6d::Ones();
  rows.tail<3>() /= p.arm;
  p.f = p.builder.unknowns(p.map.forces());
  p.builder.equal({{p.f, rows.asDiagonal() * p.map.matrix}}, -rows.cwiseProduct(load_O));
  add_cones(p, grasp, options, false);
  add_joints(p, world, grasp, *options.joints);
}

}  // namespace

LoadedProgram make_constant_preload(const World& world, const Grasp& grasp,
                                    const ForceOptions& options,
                                    const std::vector<Vector6d>& loads_O) {
  LoadedProgram out{.program = begin_preload(world, grasp, *options.joints)};
  ForceProgram& p = out.program;
  for (const Vector6d& load_O : loads_O) {
    add_loaded(p, world, grasp, options, load_O);
    if (out.forces.empty()) out.efforts = p.u;
    out.forces.push_back(p.f);
    // motors exert the same efforts as at the first load
    for (int k = 0; k < static_cast<int>(p.joints.refs.size()) && p.u != out.efforts; ++k)
      if (is_driven(p, grasp, k))
        p.builder.equal({{out.efforts + k, number(1)}, {p.u + k, number(-1)}}, numbers(0));
  }
  minimize_fraction(out, grasp);
  return out;
}

LoadedProgram make_locked_preload(const World& world, const Grasp& grasp,
                                  const ForceOptions& options,
                                  const std::vector<VectorXd>& responses) {
  LoadedProgram out{.program = begin_preload(world, grasp, *options.joints)};
  ForceProgram& p = out.program;
  add_loaded(p, world, grasp, options, Vector6d::Zero());
  out.efforts = p.u;
  const int unloaded = p.f, count = p.map.forces();
  for (const VectorXd& response : responses) {
    p.f = p.builder.unknowns(count);
    p.builder.equal(
        {{p.f, MatrixXd::Identity(count, count)}, {unloaded, -MatrixXd::Identity(count, count)}},
        response);
    add_cones(p, grasp, options, false);
    out.forces.push_back(p.f);
  }
  minimize_fraction(out, grasp);
  return out;
}

ForceProgram make_program(const World& world, const Grasp& grasp, const ForceOptions& options,
                          ForceQuestion question) {
  ForceProgram p;
  p.map = grasp_map(grasp.points, grasp.com);
  const Eigen::Matrix3d R_OW = world.pose(grasp.object).matrix().transpose();
  p.load_O = turned_wrench(options.load, R_OW);
  p.f = p.builder.unknowns(p.map.forces());
  p.arm = about_longest_arm(grasp);
  Vector6d rows = Vector6d::Ones();
  rows.tail<3>() /= p.arm;
  const MatrixXd map = rows.asDiagonal() * p.map.matrix;
  const Vector6d load = rows.cwiseProduct(p.load_O);
  const bool chosen = question == ForceQuestion::forces;
  if (question == ForceQuestion::forces) {
    p.balance = p.builder.equal({{p.f, map}}, -load);
  } else if (question == ForceQuestion::nearest) {
    // the residual, torque over rho
    Vector6d unit = rows;
    unit.tail<3>() *= grasp.rho;
    p.extra = p.builder.unknowns(6);
    p.balance = p.builder.equal({{p.f, map}, {p.extra, -MatrixXd(unit.asDiagonal())}}, -load);
    for (int k = 0; k < 6; ++k) p.builder.square(p.extra + k, 1);
  } else {
    p.extra = p.builder.unknowns(1);
    p.balance = p.builder.equal({{p.f, map}, {p.extra, load}}, Vector6d::Zero());
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

}  // namespace clench
