#include "clench/spec/eigengrasp_spec.h"

#include <algorithm>
#include <cmath>
#include "clench/base/error.h"
#include "clench/spec/valid.h"

namespace clench {

EigengraspSet identity_eigengrasps(int dofs) {
  EigengraspSet set;
  set.dofs = dofs;
  for (int i = 0; i < dofs; ++i)
    set.grasps.push_back({Eigen::VectorXd::Unit(dofs, i), 1, std::nullopt});
  return set;
}

// minimum relative length of a unit vector after projecting out the others
static constexpr double independent = 1e-9;

static void check_numbers(const Eigen::VectorXd& x, int dofs, const std::string& subject) {
  if (x.size() != dofs) fail("{}: expected {} numbers, got {}", subject, dofs, x.size());
  for (int i = 0; i < dofs; ++i)
    if (!number_rule.allows(x[i]))
      fail("{}: number {}: {}", subject, i + 1, fault(number_rule, x[i]));
}

static void check_limits(const std::array<double, 2>& limits, const std::string& subject) {
  const auto [low, high] = limits;
  for (const double x : limits) check(number_rule.called("limit"), x, subject);
  if (low > high) fail("{}: min {} exceeds max {}", subject, low, high);
}

void check_eigengrasps(const EigengraspSet& set, const std::string& subject,
                       const EigengraspPlaces& places) {
  if (set.grasps.empty()) fail("{}: expected at least one eigengrasp, got none", subject);
  // each against an orthonormal basis of those before it: at most `dofs` can be independent
  Eigen::MatrixXd basis(set.dofs, std::min<int>(set.dofs, static_cast<int>(set.grasps.size())));
  for (size_t i = 0; i < set.grasps.size(); ++i) {
    const EigengraspSpec& grasp = set.grasps[i];
    const std::string place = fmt::format(
        "{}: eigengrasp {}", i < places.grasps.size() ? places.grasps[i] : subject, i + 1);
    check_numbers(grasp.vector, set.dofs, place);
    check(number_rule.called("eigenvalue"), grasp.eigenvalue, place);
    if (grasp.limits) check_limits(*grasp.limits, place);
    const double length = grasp.vector.stableNorm();
    if (!(length >= positive_rule.min))
      fail("{}: expected a vector other than zero, got one of length {}", place, length);
    Eigen::VectorXd rest = grasp.vector / length;
    const auto before = basis.leftCols(static_cast<int>(i));
    for (int pass = 0; pass < 2; ++pass) rest -= before * (before.transpose() * rest);
    if (static_cast<int>(i) >= set.dofs || rest.norm() < independent)
      fail("{}: it is a sum of those before it", place);
    basis.col(static_cast<int>(i)) = rest.normalized();
  }
  const auto at = [&](const std::string& place) { return place.empty() ? subject : place; };
  if (set.origin) check_numbers(*set.origin, set.dofs, at(places.origin) + ": origin");
  if (!set.norm) return;
  check_numbers(*set.norm, set.dofs, at(places.norm) + ": norm");
  for (int i = 0; i < set.dofs; ++i)
    if (!(std::abs((*set.norm)[i]) >= positive_rule.min))
      fail("{}: norm: number {}: expected a scale other than 0, got {}", at(places.norm), i + 1,
           (*set.norm)[i]);
}

}  // namespace clench
