#include "clench/grasp/measure/robustness.h"

#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/math/decompositions.h"
#include "clench/math/solve_cone_program.h"
#include "clench/spec/valid.h"

namespace clench {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

namespace {

// singular values below this fraction of the largest are rounding: contact frames and levers are
// accurate to 1e-14
constexpr double rank_part = 1e-10;

void check_robustness_problem(const RobustnessProblem& p) {
  const Index contacts = p.mu.size(), forces = p.starts.empty() ? -1 : p.starts.back();
  bool rising = static_cast<Index>(p.starts.size()) == contacts + 1 && p.starts[0] == 0;
  for (size_t i = 1; rising && i < p.starts.size(); ++i) rising = p.starts[i] > p.starts[i - 1];
  if (!rising)
    fail(
        "robustness of {} contacts: expected the starts of their forces and the end, rising from "
        "0, "
        "got {}",
        contacts, name_list(p.starts));
  if (p.G.rows() != 6 || p.G.cols() != forces || p.J.rows() != forces ||
      p.compliance.size() != forces)
    fail(
        "robustness: expected G of 6 x {}, J of {} rows and as many compliances, got {} x {}, {} "
        "and "
        "{}",
        forces, forces, p.G.rows(), p.G.cols(), p.J.rows(), p.compliance.size());
  if (!p.G.allFinite() || !p.J.allFinite() || !p.load.allFinite())
    fail("robustness: G, J and the load must be finite");
  for (const double mu : p.mu) check(friction_rule.called("mu"), mu, "robustness");
  for (const double c : p.compliance)
    if (!(c > 0) || !std::isfinite(c)) fail("robustness: compliance must be > 0, got {} [m/N]", c);
  if (!(p.max_force > 0) || !std::isfinite(p.max_force))
    fail("robustness: max_force must be > 0, got {} [N]", p.max_force);
}

// the rows of f in use
std::vector<Index> held_rows(const RobustnessProblem& p, const std::vector<ContactHold>& states) {
  std::vector<Index> rows;
  for (size_t i = 0; i < states.size(); ++i) {
    const int end = states[i] == ContactHold::sticks  ? p.starts[i + 1]
                    : states[i] == ContactHold::slips ? p.starts[i] + 1
                                                      : p.starts[i];
    for (int row = p.starts[i]; row < end; ++row) rows.push_back(row);
  }
  return rows;
}

// The same problem with torques scaled to the size of forces, and DOFs scaled to move their fingers
// equally.
struct EvenProblem : RobustnessProblem {
  Vector6d units = Vector6d::Ones();  // of wrenches, in units of the problem's

  explicit EvenProblem(const RobustnessProblem& given) : RobustnessProblem(given) {
    const double force = largest(G.topRows<3>()), torque = largest(G.bottomRows<3>());
    if (force > 0 && torque > 0) units.tail<3>().setConstant(power_of_two(torque / force));
    G.array().colwise() /= units.array();
    load.array() /= units.array();
    for (auto column : J.colwise())
      if (const double size = largest(column); size > 0) column /= power_of_two(size);
  }

 private:
  static double largest(const MatrixXd& m) { return m.size() > 0 ? m.cwiseAbs().maxCoeff() : 0; }
  static double power_of_two(double x) { return std::exp2(std::round(std::log2(x))); }
};

// springs in series: the load is distributed according to their stiffness
struct Springs {
  VectorXd root;       // of their stiffness
  MatrixXd wrenches;   // orthonormal: forces over root that balance wrenches
  MatrixXd right;      // the resulting right inverse of G; empty: G does not span all wrenches
  double stretch = 0;  // largest effect of a unit wrench on the forces
};

Springs springs_of(const MatrixXd& G, const VectorXd& stiffness, const Vector6d& units) {
  Springs out;
  if (G.cols() < 6) return out;
  out.root = stiffness.cwiseSqrt();
  const Svd svd = singular_value_decomposition(G * out.root.asDiagonal());
  if (!(svd.values[5] > rank_part * svd.values[0])) return out;
  out.wrenches = svd.v.leftCols(6);
  out.right = out.root.asDiagonal() * out.wrenches * svd.values.cwiseInverse().asDiagonal() *
              svd.u.transpose();
  out.stretch =
      singular_value_decomposition(out.right * units.cwiseInverse().asDiagonal()).values[0];
  return out;
}

// margin of the contact force nearest to its bounds, or farthest outside
double min_margin(const RobustnessProblem& p, const std::vector<ContactHold>& states,
                  const VectorXd& f) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < states.size(); ++i) {
    if (states[i] == ContactHold::detached) continue;
    const int start = p.starts[i], across = p.starts[i + 1] - start - 1;
    least = std::min({least, f[start], p.max_force - f[start]});
    if (states[i] != ContactHold::sticks || across == 0) continue;
    const double mu = p.mu[static_cast<Index>(i)];
    const double room = mu * f[start] - f.segment(start + 1, across).norm();
    least = std::min(least, room / std::sqrt(1 + mu * mu));
  }
  return least;
}

// The bounds of contact forces f = start + span x, with the margin d between each and its bounds;
// the unknowns are (d, x).
class MarginProgram {
 public:
  MarginProgram(const RobustnessProblem& problem, VectorXd start, MatrixXd span)
      : problem_(problem), start_(std::move(start)), span_(std::move(span)) {}

  /// contact i keeps the margin, or only satisfies its bounds
  void bound(size_t i, ContactHold state, bool with_margin) {
    const int normal = problem_.starts[i], across = problem_.starts[i + 1] - normal - 1;
    const double d = with_margin ? 1 : 0, mu = problem_.mu[static_cast<Index>(i)];
    add_half_line(span_.row(normal), start_[normal], -d);
    add_half_line(-span_.row(normal), problem_.max_force - start_[normal], -d);
    if (state != ContactHold::sticks || across == 0) return;
    // mu f_n - |f_t| is sqrt(1 + mu^2) times the distance from the cone
    Cone cone{MatrixXd::Zero(1 + across, span_.cols() + 1), VectorXd(1 + across)};
    cone.rows(0, 0) = -d * std::sqrt(1 + mu * mu);
    cone.rows.rightCols(span_.cols()) = span_.middleRows(normal, 1 + across);
    cone.rows.row(0).tail(span_.cols()) *= mu;
    cone.start = start_.segment(normal, 1 + across);
    cone.start[0] *= mu;
    cones_.push_back(std::move(cone));
  }

  /// the solution with the largest margin, among the unknowns of A (d, x) = b
  ConeSolution solve(const MatrixXd& A, const VectorXd& b) const {
    const auto lines = static_cast<Index>(lines_.size());
    Index rows = lines;
    for (const Cone& cone : cones_) rows += cone.rows.rows();
    ConeProgram program;
    program.c = -VectorXd::Unit(span_.cols() + 1, 0);
    program.A = A;
    program.b = b;
    program.G.resize(rows, span_.cols() + 1);
    program.h.resize(rows);
    program.nonnegative = static_cast<int>(lines);
    for (Index i = 0; i < lines; ++i) {
      program.G.row(i) = -lines_[i];
      program.h[i] = line_starts_[i];
    }
    Index row = lines;
    for (const Cone& cone : cones_) {
      program.G.middleRows(row, cone.rows.rows()) = -cone.rows;
      program.h.segment(row, cone.rows.rows()) = cone.start;
      program.cones.push_back(static_cast<int>(cone.rows.rows()));
      row += cone.rows.rows();
    }
    return clench::solve(program);
  }

 private:
  // (t, u) = start + rows (d, x), |u| <= t
  struct Cone {
    MatrixXd rows;
    VectorXd start;
  };
  void add_half_line(const Eigen::RowVectorXd& row, double start, double margin) {
    Eigen::RowVectorXd with_margin(row.size() + 1);
    with_margin << margin, row;
    lines_.push_back(with_margin);
    line_starts_.push_back(start);
  }

  const RobustnessProblem& problem_;
  VectorXd start_;
  MatrixXd span_;
  std::vector<Eigen::RowVectorXd> lines_;
  std::vector<double> line_starts_;
  std::vector<Cone> cones_;
};

// orthonormal columns with the same span as those of m
MatrixXd range_of(const MatrixXd& m, double zero) {
  if (m.cols() == 0) return m;
  const Svd svd = singular_value_decomposition(m);
  const Index rank = (svd.values.array() > zero).count();
  return svd.u.leftCols(rank);
}

Robustness robustness_of(const EvenProblem& p, const std::vector<ContactHold>& states) {
  Robustness out;
  out.states = states;
  const std::vector<Index> rows = held_rows(p, states);
  const MatrixXd G = p.G(Eigen::all, rows), J = p.J(rows, Eigen::all);
  const Springs springs = springs_of(G, p.compliance(rows).cwiseInverse(), p.units);
  if (springs.right.size() == 0) return out;

  // internal forces that the joints can exert
  const MatrixXd made = springs.root.asDiagonal() * J;
  const MatrixXd no_wrench = made - springs.wrenches * (springs.wrenches.transpose() * made);
  const MatrixXd internal = springs.root.asDiagonal() *
                            range_of(no_wrench, rank_part * (made.size() > 0 ? made.norm() : 0));

  VectorXd start = VectorXd::Zero(p.G.cols());
  start(rows) = -springs.right * p.load;
  MatrixXd span = MatrixXd::Zero(p.G.cols(), internal.cols());
  for (size_t k = 0; k < rows.size(); ++k) span.row(rows[k]) = internal.row(static_cast<Index>(k));
  MarginProgram program(p, start, span);
  for (size_t i = 0; i < states.size(); ++i)
    if (states[i] != ContactHold::detached) program.bound(i, states[i], true);
  const ConeSolution best = program.solve(MatrixXd(0, span.cols() + 1), VectorXd(0));
  if (best.status == ConeStatus::infeasible) return out;
  // an uncertain result gives no bound, and its forces keep the margin that they have
  if (best.status != ConeStatus::optimal) out.most = p.max_force / 2 / springs.stretch;
  const VectorXd forces = start + span * best.x.tail(span.cols());
  const double margin = min_margin(p, states, forces);
  // values far below the data are rounding
  if (!(margin > 1e-9 * best.units[0])) return out;
  out.margin = margin;
  out.radius = margin / springs.stretch;
  out.most = std::max(out.most, out.radius);
  out.forces = forces;
  return out;
}

constexpr ContactHold all_holds[] = {ContactHold::sticks, ContactHold::slips,
                                     ContactHold::detached};

// Depth first over the states of the contacts; undecided contacts are assumed to transmit all that
// they could.
class RobustnessSearch {
 public:
  RobustnessSearch(const EvenProblem& problem, int steps, const Progress& progress)
      : problem_(problem),
        progress_(progress),
        steps_(steps),
        states_(static_cast<size_t>(problem.mu.size()), ContactHold::sticks) {
    best_ = robustness_of(problem_, states_);
    climb();
    search(0);
    best_.most = std::max(best_.radius, left_);
  }
  const Robustness& best() const { return best_; }

 private:
  bool takes_step() {
    if (progress_.stop_asked()) steps_ = 0;
    return steps_-- > 0;
  }

  // local search: changes the state of one contact at a time, while that improves the result
  void climb() {
    std::vector<ContactHold> at = states_;
    for (bool gained = true; gained;) {
      gained = false;
      for (size_t i = 0; i < at.size(); ++i)
        for (const ContactHold state : all_holds) {
          if (state == at[i]) continue;
          if (!takes_step()) return;
          auto tried = at;
          tried[i] = state;
          const Robustness found = robustness_of(problem_, tried);
          if (!(found.radius > best_.radius)) continue;
          best_ = found;
          at = std::move(tried);
          gained = true;
        }
    }
  }

  void search(size_t decided) {
    if (decided == states_.size()) {
      const Robustness found = robustness_of(problem_, states_);
      if (found.most > found.radius) left_ = std::max(left_, found.most);
      if (found.radius > best_.radius) best_ = found;
      return;
    }
    for (const ContactHold state : all_holds) {
      states_[decided] = state;
      const double most = takes_step() ? bound(decided + 1) : bounds_[decided];
      // a bound is as accurate as the solver's result: 1e-9
      if (!(most > best_.radius * (1 + 1e-8))) continue;
      if (steps_ <= 0) {
        left_ = std::max(left_, most);
        continue;
      }
      bounds_.resize(decided + 2, most);
      bounds_[decided + 1] = most;
      search(decided + 1);
    }
    states_[decided] = ContactHold::sticks;
  }

  // No right inverse of G has a smaller norm than the least-norm one, whose norm decreases with
  // every row; and no margin is larger than with free forces that balance the load.
  double bound(size_t decided) const {
    const std::vector<Index> rows = held_rows(problem_, states_);
    const MatrixXd G = problem_.G(Eigen::all, rows);
    const Springs springs = springs_of(G, VectorXd::Ones(G.cols()), problem_.units);
    if (springs.right.size() == 0) return 0;
    const auto held = static_cast<Index>(rows.size());
    MatrixXd span = MatrixXd::Zero(problem_.G.cols(), held);
    for (Index k = 0; k < held; ++k) span(rows[k], k) = 1;
    MarginProgram program(problem_, VectorXd::Zero(problem_.G.cols()), span);
    bool margin = false;
    for (size_t i = 0; i < states_.size(); ++i) {
      if (states_[i] == ContactHold::detached) continue;
      program.bound(i, states_[i], i < decided);
      margin = margin || i < decided;
    }
    const double most = problem_.max_force / 2;
    MatrixXd balance = MatrixXd::Zero(6, held + 1);
    balance.rightCols(held) = problem_.G * span;
    if (!margin) return most / springs.stretch;
    const ConeSolution solution = program.solve(balance, -problem_.load);
    if (solution.status == ConeStatus::infeasible) return 0;
    // an uncertain result gives no bound
    if (solution.status != ConeStatus::optimal) return most / springs.stretch;
    return std::min(solution.x[0], most) / springs.stretch;
  }

  const EvenProblem& problem_;
  const Progress& progress_;
  int steps_;  // remaining
  std::vector<ContactHold> states_;
  // of the path to this node
  std::vector<double> bounds_ = {std::numeric_limits<double>::infinity()};
  double left_ = 0;  // the largest bound of the nodes that were not searched
  Robustness best_;
};

}  // namespace

Robustness contact_robustness(const RobustnessProblem& problem,
                              const std::vector<ContactHold>& states) {
  check_robustness_problem(problem);
  if (static_cast<Index>(states.size()) != problem.mu.size())
    fail("robustness: expected {} states, one per contact, got {}", problem.mu.size(),
         states.size());
  return robustness_of(EvenProblem(problem), states);
}

Robustness contact_robustness(const RobustnessProblem& problem) {
  return contact_robustness(
      problem,
      std::vector<ContactHold>(static_cast<size_t>(problem.mu.size()), ContactHold::sticks));
}

Robustness grasp_robustness(const RobustnessProblem& problem, int max_steps,
                            const Progress& progress) {
  check_robustness_problem(problem);
  const EvenProblem even(problem);
  return RobustnessSearch(even, max_steps, progress).best();
}

}  // namespace clench
