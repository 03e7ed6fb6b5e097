#include "clench/math/cones.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clench {

using Eigen::VectorXd;

static constexpr double no_bound = std::numeric_limits<double>::infinity();

// visits index, first row and size of each cone
template <class Visit>
static void each_cone(const ConeSizes& cones, Visit visit) {
  int start = 0;
  for (int c = 0; c < static_cast<int>(cones.size()); ++c) {
    visit(c, start, cones[c]);
    start += cones[c];
  }
}

// t^2 - |u|^2, without cancellation of squares
static double determinant(const VectorXd& v, int start, int size) {
  const double norm = v.segment(start + 1, size - 1).norm();
  return (v[start] - norm) * (v[start] + norm);
}

VectorXd cone_unit(const ConeSizes& cones) {
  int rows = 0;
  for (const int size : cones) rows += size;
  VectorXd unit = VectorXd::Zero(rows);
  each_cone(cones, [&](int, int start, int) { unit[start] = 1; });
  return unit;
}

double cone_margin(const ConeSizes& cones, const VectorXd& v) {
  double least = no_bound;
  each_cone(cones, [&](int, int start, int size) {
    least = std::min(least, v[start] - v.segment(start + 1, size - 1).norm());
  });
  return least;
}

// the first a > 0 at which the determinant of v + a dv is 0
static double step_of_cone(const VectorXd& v, const VectorXd& dv, int start, int size) {
  // never below the apex, even if rounding hides that the path runs through it
  double least = dv[start] < 0 ? -v[start] / dv[start] : no_bound;
  if (size == 1) return least;
  const auto u = v.segment(start + 1, size - 1), du = dv.segment(start + 1, size - 1);
  const double a = determinant(dv, start, size);
  const double b = v[start] * dv[start] - u.dot(du);
  const double c = determinant(v, start, size);
  const double under_root = b * b - a * c;
  if ((a >= 0 && b >= 0) || under_root < 0) return least;
  // roots of a x^2 + 2 b x + c without cancellation
  const double t = -b + (b > 0 ? -1 : 1) * std::sqrt(under_root);
  if (t != 0 && c / t > 0) least = std::min(least, c / t);
  if (a != 0 && t / a > 0) least = std::min(least, t / a);
  return least;
}

double longest_step(const ConeSizes& cones, const VectorXd& v, const VectorXd& dv) {
  double least = no_bound;
  each_cone(cones, [&](int, int start, int size) {
    least = std::min(least, step_of_cone(v, dv, start, size));
  });
  return least;
}

VectorXd cone_product(const ConeSizes& cones, const VectorXd& a, const VectorXd& b) {
  VectorXd out(a.size());
  each_cone(cones, [&](int, int start, int size) {
    out[start] = a.segment(start, size).dot(b.segment(start, size));
    out.segment(start + 1, size - 1) =
        a[start] * b.segment(start + 1, size - 1) + b[start] * a.segment(start + 1, size - 1);
  });
  return out;
}

VectorXd cone_divide(const ConeSizes& cones, const VectorXd& a, const VectorXd& product) {
  VectorXd out(a.size());
  each_cone(cones, [&](int, int start, int size) {
    const auto tail = a.segment(start + 1, size - 1);
    const auto rest = product.segment(start + 1, size - 1);
    out[start] = (a[start] * product[start] - tail.dot(rest)) / determinant(a, start, size);
    out.segment(start + 1, size - 1) = (rest - out[start] * tail) / a[start];
  });
  return out;
}

NesterovTodd::NesterovTodd(const ConeSizes& cones)
    : cones_(cones), w_(cone_unit(cones)), lambda_(w_), eta_(cones.size(), 1) {}

NesterovTodd::NesterovTodd(const ConeSizes& cones, const VectorXd& s, const VectorXd& z)
    : cones_(cones), w_(s.size()), eta_(cones.size()) {
  each_cone(cones_, [&](int c, int start, int size) {
    const double of_s = std::sqrt(determinant(s, start, size));
    const double of_z = std::sqrt(determinant(z, start, size));
    eta_[c] = std::sqrt(of_s / of_z);
    const VectorXd unit_s = s.segment(start, size) / of_s, unit_z = z.segment(start, size) / of_z;
    const double gamma = std::sqrt((1 + unit_s.dot(unit_z)) / 2);
    w_.segment(start + 1, size - 1) = (unit_s.tail(size - 1) - unit_z.tail(size - 1)) / (2 * gamma);
    w_[start] = std::sqrt(1 + w_.segment(start + 1, size - 1).squaredNorm());
  });
  lambda_ = apply(z);
}

void NesterovTodd::apply(int cone, int start, int power, const double* in, double* out) const {
  const int tail = cones_[cone] - 1;
  const double eta = power > 0 ? eta_[cone] : 1 / eta_[cone];
  const Eigen::Map<const VectorXd> u(in + 1, tail);
  const auto w = w_.segment(start + 1, tail);
  const double along = power * w.dot(u), first = in[0];
  out[0] = eta * (w_[start] * first + along);
  Eigen::Map<VectorXd>(out + 1, tail) = eta * (u + power * (first + along / (1 + w_[start])) * w);
}

VectorXd NesterovTodd::apply(const VectorXd& v) const {
  VectorXd out(v.size());
  each_cone(cones_, [&](int c, int start, int) {
    apply(c, start, 1, v.data() + start, out.data() + start);
  });
  return out;
}

VectorXd NesterovTodd::apply_inverse(const VectorXd& v) const {
  VectorXd out(v.size());
  each_cone(cones_, [&](int c, int start, int) {
    apply(c, start, -1, v.data() + start, out.data() + start);
  });
  return out;
}

void NesterovTodd::apply_inverse(int cone, int start, const double* in, double* out) const {
  apply(cone, start, -1, in, out);
}

}  // namespace clench
