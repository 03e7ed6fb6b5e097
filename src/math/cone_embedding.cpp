#include "clench/math/cone_embedding.h"

#include <cmath>
#include <limits>

#include "clench/base/watched.h"

namespace clench {
namespace {

using Eigen::VectorXd;

constexpr double accepted = 1e-9;   // residuals of an optimum promised in the header
constexpr double expected = 1e-11;  // target of the iterations while they make progress
constexpr double certain = 1e-9;    // residuals of a proof of infeasibility or unboundedness
constexpr double proved = 1e-14;    // target of the iterations while they make progress
constexpr int max_iterations = 100;
constexpr double step_back = 0.99;  // fraction of the way to the boundary

// residuals of a point
struct Residuals {
  VectorXd x, z;
  double tau = 0;
};

VectorXd cones_of(const ConeRows& rows, const VectorXd& v) { return v.tail(rows.in_cones()); }

Residuals residuals(const ConeRows& rows, const ConePoint& p) {
  const VectorXd Px = rows.P * p.x;
  Residuals r;
  r.x = Px + rows.At * p.z + p.tau * rows.q;
  r.z = rows.A * p.x - p.tau * rows.b;
  r.z.tail(rows.in_cones()) += p.s;
  r.tau = rows.q.dot(p.x) + rows.b.dot(p.z) + p.x.dot(Px) / p.tau + p.kappa;
  return r;
}

VectorXd stacked(const VectorXd& a, const VectorXd& b) {
  VectorXd out(a.size() + b.size());
  out << a, b;
  return out;
}

// moves v into the interior, if it is not there
void shift_inside(const ConeSizes& cones, VectorXd& v) {
  const double margin = cone_margin(cones, v);
  if (margin < 1e-3) v += (1 - std::min(margin, 0.0)) * cone_unit(cones);
}

// least squares for s and for z, moved into the interior
ConePoint first_point(const ConeRows& rows, ConeKkt& kkt) {
  ConePoint p;
  const int n = rows.unknowns();
  const VectorXd primal = kkt.solve(stacked(VectorXd::Zero(n), rows.b));
  const VectorXd dual = kkt.solve(stacked(-rows.q, VectorXd::Zero(rows.count())));
  p.x = primal.head(n);
  p.s = -cones_of(rows, primal);
  p.z = dual.tail(rows.count());
  shift_inside(rows.cones, p.s);
  VectorXd z = cones_of(rows, p.z);
  shift_inside(rows.cones, z);
  p.z.tail(rows.in_cones()) = z;
  return p;
}

// The step that removes the fraction `part` of the residuals and brings the products of s and z,
// and of tau and kappa, to given values.
struct Newton {
  const ConeRows& rows;
  const ConeKkt& kkt;
  const NesterovTodd& scaling;
  const ConePoint& at;
  const Residuals& missing;
  VectorXd per_tau = {};  // change of x and of the scaled z per unit of tau

  void prepare() {
    VectorXd right = stacked(-rows.q, rows.b);
    right.tail(rows.in_cones()) = scaling.apply_inverse(cones_of(rows, rows.b));
    per_tau = kkt.solve(right);
  }

  // products: lambda o (W dz + W^-1 ds) = -products; tau dkappa + kappa dtau = -product
  ConePoint step(double part, const VectorXd& products, double product) const {
    const int n = rows.unknowns(), m = rows.in_cones();
    const VectorXd asked = cone_divide(rows.cones, scaling.lambda(), products);
    VectorXd right = stacked(-part * missing.x, -part * missing.z);
    right.tail(m) = scaling.apply_inverse(right.tail(m)) + asked;
    const VectorXd fixed = kkt.solve(right);

    // b.z with the equations' z unscaled and the cones' z scaled
    VectorXd b = rows.b;
    b.tail(m) = scaling.apply_inverse(b.tail(m));
    const VectorXd xi = at.x / at.tau, off = per_tau.head(n) - xi;
    const double curvature =
        off.dot(rows.P * off) + per_tau.tail(m).squaredNorm() + at.kappa / at.tau;
    const VectorXd slope = 2 * (rows.P * xi) + rows.q;
    ConePoint d;
    d.tau = (part * missing.tau - product / at.tau + slope.dot(fixed.head(n)) +
             b.dot(fixed.tail(rows.count()))) /
            curvature;
    const VectorXd both = fixed + d.tau * per_tau;
    d.x = both.head(n);
    d.z = both.tail(rows.count());
    d.z.tail(m) = scaling.apply_inverse(d.z.tail(m));
    // from the rows, not from z: rounding errors remain in the products, which the next step
    // corrects
    d.s = (d.tau * rows.b - part * missing.z - rows.A * d.x).tail(m);
    d.kappa = -(product + at.kappa * d.tau) / at.tau;
    return d;
  }
};

double step_length(const ConeRows& rows, const ConePoint& p, const ConePoint& d) {
  double most = std::min(longest_step(rows.cones, p.s, d.s),
                         longest_step(rows.cones, cones_of(rows, p.z), cones_of(rows, d.z)));
  if (d.tau < 0) most = std::min(most, -p.tau / d.tau);
  if (d.kappa < 0) most = std::min(most, -p.kappa / d.kappa);
  return most;
}

void move(ConePoint& p, const ConePoint& d, double step) {
  p.x += step * d.x;
  p.z += step * d.z;
  p.s += step * d.s;
  p.tau += step * d.tau;
  p.kappa += step * d.kappa;
  // only the ratio of the embedding's unknowns matters
  const double size = 1 / std::max(p.tau, p.kappa);
  p.x *= size, p.z *= size, p.s *= size, p.tau *= size, p.kappa *= size;
}

bool is_finite(const ConePoint& p) {
  return p.x.allFinite() && p.z.allFinite() && p.s.allFinite() && std::isfinite(p.tau) &&
         std::isfinite(p.kappa);
}

ConeQuality judge(const ConeRows& rows, const ConePoint& p) {
  const double none = std::numeric_limits<double>::infinity();
  const VectorXd Px = rows.P * p.x, Ax = rows.A * p.x, Az = rows.At * p.z;
  VectorXd back = Ax;
  back.tail(rows.in_cones()) += p.s;
  const double qx = rows.q.dot(p.x), bz = rows.b.dot(p.z), xPx = p.x.dot(Px);
  ConeQuality q;
  const double tau = p.tau;
  // rounding is relative to the largest terms; but if they grow without limit, there is no solution
  const auto against = [](double terms) { return std::clamp(terms, 1.0, 1e3); };
  q.primal = max_norm(back / tau - rows.b) / against(std::max(max_norm(Ax), max_norm(p.s)) / tau);
  q.dual = max_norm((Px + Az) / tau + rows.q) / against(std::max(max_norm(Px), max_norm(Az)) / tau);
  const double above = (xPx / tau / 2 + qx) / tau, below = -(xPx / tau / 2 + bz) / tau;
  const double steepest = std::max(max_norm(rows.q), max_norm(Px) / tau);
  q.gap = std::abs(above - below) /
          std::max({gap_floor, std::abs(above), std::abs(below), steepest * max_norm(p.x) / tau});
  q.infeasible = bz < 0 ? max_norm(Az) / -bz : none;
  q.unbounded = qx < 0 ? std::max(max_norm(Px), max_norm(back)) / -qx : none;
  return q;
}

// one iteration; false: no step possible
bool advance_point(const ConeRows& rows, ConeKkt& kkt, ConePoint& p) {
  const NesterovTodd scaling(rows.cones, p.s, cones_of(rows, p.z));
  if (!scaling.lambda().allFinite() || !kkt.factor(scaling)) return false;
  const Residuals missing = residuals(rows, p);
  const double degree = static_cast<double>(rows.cones.size()) + 1;
  const double mu = (p.s.dot(cones_of(rows, p.z)) + p.tau * p.kappa) / degree;

  // predictor: the step length directly towards the solution
  Newton newton{rows, kkt, scaling, p, missing};
  newton.prepare();
  const VectorXd& lambda = scaling.lambda();
  const VectorXd square = cone_product(rows.cones, lambda, lambda);
  const ConePoint straight = newton.step(1, square, p.tau * p.kappa);
  const double reach = std::min(1.0, step_length(rows, p, straight));

  // then towards the central path by as much as that fell short, with the second-order correction
  const double centering = std::pow(1 - reach, 3);
  const VectorXd second = cone_product(rows.cones, scaling.apply_inverse(straight.s),
                                       scaling.apply(cones_of(rows, straight.z)));
  const VectorXd products = square + second - centering * mu * cone_unit(rows.cones);
  const double product = p.tau * p.kappa + straight.tau * straight.kappa - centering * mu;
  const ConePoint d = newton.step(1 - centering, products, product);
  const double step = std::min(1.0, step_back * step_length(rows, p, d));
  ConePoint next = p;
  move(next, d, step);
  if (!is_finite(next) || !(step > 1e-10)) return false;
  p = next;
  return true;
}

}  // namespace

EmbeddingEnd solve_embedding(const ConeRows& rows) {
  ConeKkt kkt(rows);
  EmbeddingEnd best, proof;
  best.quality = {1e300, 1e300, 1e300, 1e300, 1e300};
  best.point = {.x = VectorXd::Zero(rows.unknowns()),
                .z = VectorXd::Zero(rows.count()),
                .s = VectorXd::Zero(rows.in_cones())};
  proof.quality = best.quality;
  const NesterovTodd none(rows.cones);
  if (!kkt.factor(none)) return best;
  ConePoint p = first_point(rows, kkt);
  if (!is_finite(p)) return best;
  int without_progress = 0;
  for (int i = 0;; ++i) {
    check_stop();
    const ConeQuality q = judge(rows, p);
    ++without_progress;
    if (q.worst() < best.quality.worst()) {
      best = {best.status, p, q, i};
      without_progress = 0;
    }
    if (best.quality.worst() > accepted && q.proof() < proof.quality.proof()) {
      const bool none_meets = q.infeasible <= q.unbounded;
      proof = {none_meets ? ConeStatus::infeasible : ConeStatus::unbounded, p, q, i};
      without_progress = 0;
    }
    const bool enough = best.quality.worst() <= accepted || proof.quality.proof() <= certain;
    if (best.quality.worst() <= expected || proof.quality.proof() <= proved) break;
    if ((enough && without_progress > 1) || i == max_iterations) break;
    if (!advance_point(rows, kkt, p)) break;
  }
  if (best.quality.worst() <= accepted) best.status = ConeStatus::optimal;
  return best.status != ConeStatus::optimal && proof.quality.proof() <= certain ? proof : best;
}

}  // namespace clench
