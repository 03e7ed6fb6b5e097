#include "clench/grasp/wrench/wrench_space.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/grasp/wrench/expanding_polytope.h"
#include "clench/grasp/wrench/nearest_point.h"
#include "clench/grasp/wrench/sum_volume.h"
#include "clench/grasp/wrench/wrench_hull.h"
#include "clench/math/decompositions.h"

namespace clench {

namespace {

// Directions in which the support is below this fraction of the largest wrench are not spanned: far
// above the rounding of hundreds of wrenches (1e-15), far below any lever or friction that could
// hold something.
constexpr double rank_tolerance = 1e-10;

// A set of size one whose support is at least this in every direction spans all of them.
constexpr double surely_spanned = 1e-6;

// A facet nearer to the origin than this fraction of the largest wrench contains it: planes are
// accurate to about 1e-14 of the wrenches' extent.
constexpr double on_boundary = 1e-12;

// Tolerance of epsilon, for size one: for polytopes the limit of doubles, for round cones a
// compromise with time, about twenty points per digit.
constexpr double flat_tolerance = 1e-12, round_tolerance = 1e-9;

// A bracket wider than this is not accepted for a polytope: only the larger shifts of points cause
// one.
constexpr double poor = 3e-10;

// Beyond this number of wrenches the last digits take too long; whether the origin is inside is
// decided without them.
constexpr size_t many_wrenches = 10'000;

// Tolerance within which a contact counts as attaining the support.
constexpr double carries = 1e-9;

constexpr int max_facets = 1'000'000;

// Cells of a sum take about 15 to 30 us each: a second or two at most.
constexpr int max_cells = 60'000;

// If a curved set has many points nearest to the origin, brackets close slowly: this many facets
// take a third of a second and 160 MB, and the result is what they certify.
constexpr int max_round_facets = 500'000;

// the one of the two unit vectors along a line whose largest component is positive
Eigen::VectorXd upright(const Eigen::VectorXd& direction) {
  int largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? Eigen::VectorXd(-direction) : direction;
}

void check_finite(const Eigen::Ref<const Wrenches>& wrenches, size_t contact) {
  if (wrenches.allFinite()) return;
  for (Eigen::Index k = 0; k < wrenches.cols(); ++k)
    for (const double x : wrenches.col(k))
      if (!std::isfinite(x))
        fail("wrench space: contact {}, wrench {}: numbers must be finite, got {}", contact + 1,
             k + 1, x);
}

void check_coordinates(const std::vector<int>& coordinates) {
  if (coordinates.size() < 2 || coordinates.size() > 6)
    fail("wrench space: expected 2 to 6 coordinates, got {}", coordinates.size());
  for (size_t i = 0; i < coordinates.size(); ++i) {
    if (coordinates[i] < 0 || coordinates[i] > 5)
      fail("wrench space: coordinates must be 0 to 5, got {}", coordinates[i]);
    if (std::count(coordinates.begin(), coordinates.end(), coordinates[i]) > 1)
      fail("wrench space: coordinate {} is given twice", coordinates[i]);
  }
}

std::vector<UnitWrenches> edges_only(std::vector<Wrenches> contacts) {
  std::vector<UnitWrenches> out;
  for (Wrenches& edges : contacts) out.push_back({std::move(edges), {}});
  return out;
}

// Are all directions certainly spanned? By Gram-Schmidt, the longest column first.
bool surely_full_rank(Eigen::MatrixXd m) {
  double first = 0;
  for (int k = 0; k < m.rows(); ++k) {
    Eigen::Index longest = 0;
    const double length = std::sqrt(m.colwise().squaredNorm().maxCoeff(&longest));
    if (k == 0) first = length;
    if (!(length > surely_spanned * first)) return false;
    const Eigen::VectorXd q = m.col(longest) / length;
    m -= q * (q.transpose() * m).eval();
  }
  return true;
}

}  // namespace

WrenchSpace::WrenchSpace(std::vector<UnitWrenches> contacts, WrenchSpaceOptions options)
    : contacts_(std::move(contacts)), options_(std::move(options)) {
  check_coordinates(options_.coordinates);
  for (size_t i = 0; i < contacts_.size(); ++i) {
    check_finite(contacts_[i].edges, i);
    if (contacts_[i].round) {
      check_finite(contacts_[i].round->axis, i);
      check_finite(contacts_[i].round->spread, i);
    }
  }
}

WrenchSpace::WrenchSpace(std::vector<Wrenches> contacts, WrenchSpaceOptions options)
    : WrenchSpace(edges_only(std::move(contacts)), std::move(options)) {}

bool WrenchSpace::is_round() const {
  return std::any_of(contacts_.begin(), contacts_.end(),
                     [](const UnitWrenches& c) { return c.round.has_value(); });
}

Vector6d WrenchSpace::in_all_coordinates(const Eigen::VectorXd& x) const {
  Vector6d out = Vector6d::Zero();
  for (int i = 0; i < dimension(); ++i) out[options_.coordinates[i]] = x[i];
  return out;
}

const WrenchSpace::Prepared& WrenchSpace::prepared() const {
  if (prepared_) return *prepared_;
  int exponent = wrenches().exponent();
  double zero = on_boundary * wrenches().max_norm(exponent);
  // sums of many contacts have size one, too
  if (options_.norm == WrenchNorm::linf && contacts_.size() > 1) {
    const int more = std::ilogb(static_cast<double>(contacts_.size()));
    exponent += more;
    zero = std::ldexp(zero, -more);
  }
  prepared_.emplace(Prepared{exponent, zero, wrenches().support(options_.norm, exponent)});
  return *prepared_;
}

WrenchSupport WrenchSpace::support_in_l1() const {
  return wrenches().support(WrenchNorm::l1, prepared().exponent);
}

// vectors with the same span as all wrenches, scaled
Eigen::MatrixXd WrenchSpace::spanning() const { return wrenches().columns(prepared().exponent); }

int WrenchSpace::rank() const {
  if (rank_) return *rank_;
  if (bracket_ && bracket_->lower > surely_spanned) return rank_.emplace(dimension());
  const Eigen::MatrixXd all = spanning();
  if (all.size() == 0 || all.isZero(0)) return rank_.emplace(0);
  if (surely_full_rank(all)) return rank_.emplace(dimension());
  const Eigen::VectorXd values = singular_value_decomposition(all).values;
  return rank_.emplace(static_cast<int>((values.array() > rank_tolerance * values[0]).count()));
}

WrenchSpace::Bracket WrenchSpace::bracket_of(const WrenchSupport& reach, double tolerance,
                                             double at_least, const Progress& progress) const {
  const Ball ball =
      largest_ball(reach, {.tolerance = std::max(tolerance, flat_tolerance),
                           .zero = prepared().zero,
                           .at_least = at_least,
                           .max_facets = is_round() ? max_round_facets : BallOptions().max_facets,
                           .progress = progress});
  Bracket out{ball.lower, ball.upper, tolerance,
              Eigen::Map<const Eigen::VectorXd>(ball.direction, dimension()),
              ball.end == BallEnd::outside || ball.end == BallEnd::flat};
  if (out.outside) out.lower = out.upper = 0;
  return out;
}

const WrenchSpace::Bracket& WrenchSpace::final_bracket(const Progress& progress) const {
  // the same bits whatever was computed before
  if (final_) return *final_;
  if (bracket_ && bracket_->outside) return *bracket_;
  const double round = std::min(round_tolerance, std::ldexp(round_tolerance, -prepared().exponent));
  const Bracket found =
      bracket_of(prepared().reach, is_round() ? round : flat_tolerance, 0, progress);
  progress.check();
  final_ = found;
  const double width = final_->upper - final_->lower;
  if (width > poor && !is_round() && options_.norm == WrenchNorm::l1) {
    // rounding broke every surface that was tried: the complete hull, by qhull
    const Hull all = hull();
    if (all.full()) {
      int facet = 0;
      const double offset = std::ldexp(all.offsets.minCoeff(&facet), -prepared().exponent);
      final_->lower = final_->upper = std::max(0.0, offset);
      final_->direction = all.normals.col(facet);
      final_->outside = offset <= prepared().zero;
    }
  }
  if (!bracket_ || bracket_->upper - bracket_->lower > final_->upper - final_->lower)
    bracket_ = final_;
  return *final_;
}

bool WrenchSpace::is_force_closure(const Progress& progress) const {
  if (closure_) return *closure_;
  if (contacts_.empty()) return closure_.emplace(false);
  // normal forces of at most one each resist the same directions as normal forces that sum to at
  // most one
  const bool l1 = options_.norm == WrenchNorm::l1;
  const double inside = 2 * prepared().zero;
  size_t wrenches = 0;
  for (const UnitWrenches& contact : contacts_) wrenches += contact.edges.cols();
  const double tolerance = wrenches > many_wrenches ? flat_tolerance : 0.5;
  Bracket b = bracket_ && l1 ? *bracket_
                             : bracket_of(l1 ? prepared().reach : support_in_l1(), tolerance,
                                          inside, progress);
  progress.check();
  if (b.outside) {
    if (l1) bracket_ = b, bracket_->tolerance = 0;
    return closure_.emplace(false);
  }
  if (b.lower < inside)
    b = l1 ? final_bracket(progress) : bracket_of(support_in_l1(), flat_tolerance, 0, progress);
  progress.check();
  if (b.outside || b.upper <= prepared().zero) return closure_.emplace(false);
  return closure_.emplace(b.lower > surely_spanned || rank() == dimension());
}

double WrenchSpace::epsilon(const Progress& progress) const {
  if (contacts_.empty()) return 0;
  if (options_.norm == WrenchNorm::linf && !is_force_closure(progress)) return 0;
  const Bracket& b = final_bracket(progress);
  if (!is_force_closure(progress)) return 0;
  const bool converged = b.upper - b.lower <= std::max(b.tolerance, 1e-9);
  return std::ldexp(std::max(0.0, converged ? b.upper : b.lower), prepared().exponent);
}

EpsilonBounds WrenchSpace::epsilon_bounds(const EpsilonOptions& options,
                                          const Progress& progress) const {
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    fail("wrench space: tolerance must be >= 0, got {}", options.tolerance);
  if (options.at_least && !std::isfinite(*options.at_least))
    fail("wrench space: at_least must be finite, got {}", *options.at_least);
  if (!is_force_closure(progress)) return {0, 0, true};
  const int exponent = prepared().exponent;
  const double tolerance = std::max(std::ldexp(options.tolerance, -exponent), flat_tolerance);
  const double at_least = options.at_least ? std::ldexp(*options.at_least, -exponent) : 0;
  const auto decides = [&](const Bracket& b) {
    return b.upper - b.lower <= tolerance ||
           (options.at_least && (b.lower >= at_least || b.upper < at_least));
  };
  if (!bracket_ || !decides(*bracket_)) {
    Bracket found = bracket_of(prepared().reach, tolerance, std::max(0.0, at_least), progress);
    // later steps need the distance reached
    found.tolerance = std::max(found.upper - found.lower, flat_tolerance);
    if (bracket_) {
      found.lower = std::max(found.lower, bracket_->lower);
      if (bracket_->upper < found.upper)
        found.upper = bracket_->upper, found.direction = bracket_->direction;
    }
    bracket_ = found;
  }
  return {std::ldexp(std::max(0.0, bracket_->lower), exponent),
          std::ldexp(bracket_->upper, exponent), bracket_->upper - bracket_->lower <= tolerance};
}

// without force closure: a wrench whose largest resisted multiple is zero or negative
Weakest WrenchSpace::unresisted(const Progress& progress) const {
  Weakest out;
  out.direction = Vector6d::Unit(options_.coordinates[0]);
  if (rank() == 0) return out;
  if (rank() < dimension()) {
    const Svd svd = singular_value_decomposition(spanning());
    out.direction = in_all_coordinates(upright(svd.u.col(dimension() - 1)));
    return out;
  }
  const int exponent = prepared().exponent;
  const WrenchSupport l1 = support_in_l1();
  const NearestPoint nearest = nearest_point(l1, Eigen::VectorXd::Zero(dimension()));
  Eigen::VectorXd direction, far(dimension());
  if (nearest.distance > 10 * prepared().zero)
    direction = nearest.point / nearest.distance;
  else
    direction = -bracket_of(l1, flat_tolerance, 0, progress).direction;
  progress.check();
  const Eigen::VectorXd answer = -direction;
  const double reach = l1.support(answer.data(), far.data());
  out.direction = in_all_coordinates(direction);
  // in L-infinity no contact has to push at all
  if (options_.norm == WrenchNorm::l1 && std::abs(reach) > prepared().zero)
    out.resistance = std::ldexp(reach, exponent);
  return out;
}

const Weakest& WrenchSpace::weakest(const Progress& progress) const {
  if (weakest_) return *weakest_;
  if (!is_force_closure(progress)) return weakest_.emplace(unresisted(progress));
  Weakest out;
  out.resistance = epsilon(progress);
  const Eigen::VectorXd answer = final_bracket(progress).direction;
  out.direction = in_all_coordinates(-answer);
  std::vector<double> pushes;
  for (size_t i = 0; i < contacts_.size(); ++i)
    pushes.push_back(prepared().reach.support_of(static_cast<int>(i), answer.data()));
  const double most = *std::max_element(pushes.begin(), pushes.end());
  const double enough = options_.norm == WrenchNorm::l1 ? most - carries : carries;
  for (size_t i = 0; i < pushes.size(); ++i)
    if (pushes[i] >= enough) out.contacts.push_back(static_cast<int>(i));
  return weakest_.emplace(out);
}

Hull WrenchSpace::hull() const {
  if (options_.norm != WrenchNorm::l1) fail("wrench space: no hull of points in L-infinity");
  if (is_round()) fail("wrench space: no hull of points with round cones, give edges");
  Hull out;
  out.dimension = dimension();
  const Eigen::MatrixXd all = spanning();
  if (all.size() == 0 || all.isZero(0)) return out;
  out.rank = affine_rank(all, rank_tolerance);
  if (out.rank < dimension()) return out;
  const int exponent = prepared().exponent;
  out = wrench_hull(all);
  for (double& x : out.offsets) x = std::ldexp(x, exponent);
  out.volume = std::ldexp(out.volume, dimension() * exponent);
  out.area = std::ldexp(out.area, (dimension() - 1) * exponent);
  return out;
}

double WrenchSpace::volume(const Progress& progress) const {
  if (volume_) return *volume_;
  if (is_round()) {
    const VolumeBounds bounds = volume_bounds(32, progress);
    return volume_.emplace((bounds.lower + bounds.upper) / 2);
  }
  if (rank() < dimension()) return volume_.emplace(0);
  const double scaled =
      options_.norm == WrenchNorm::l1 ? hull_volume(progress) : sum_of_hulls_volume(progress);
  return volume_.emplace(std::ldexp(scaled, dimension() * prepared().exponent));
}

// of the space in L1, scaled
double WrenchSpace::hull_volume(const Progress& progress) const {
  if (affine_rank(spanning(), rank_tolerance) < dimension()) return 0;
  const Facets facets =
      all_facets(prepared().reach, {.max_facets = max_facets, .progress = progress});
  if (facets.end == FacetsEnd::too_many)
    fail(ErrorKind::limit,
         "wrench space: volume: the hull of {} contact{} has more than {} facets; give fewer "
         "edges",
         contacts_.size(), contacts_.size() == 1 ? "" : "s", max_facets);
  if (facets.end == FacetsEnd::complete) return facets.volume;
  if (facets.end == FacetsEnd::flat) return 0;
  return std::ldexp(hull().volume, -dimension() * prepared().exponent);
}

// of the space in L-infinity, scaled
double WrenchSpace::sum_of_hulls_volume(const Progress& progress) const {
  const Eigen::MatrixXd all = spanning();
  std::vector<Eigen::MatrixXd> hulls;
  Eigen::Index column = 0;
  for (const UnitWrenches& contact : contacts_) {
    const Eigen::Index count = contact.edges.cols();
    auto& points = hulls.emplace_back(Eigen::MatrixXd::Zero(dimension(), count + 1));
    points.rightCols(count) = all.middleCols(column, count);
    column += count;
  }
  const SumVolume sum = sum_volume(hulls, max_cells, progress);
  if (sum.end == SumVolume::too_many)
    fail(
        ErrorKind::limit,
        "wrench space: volume: in L-infinity the space of {} contacts has more than {} cells; give "
        "fewer edges",
        contacts_.size(), max_cells);
  if (sum.end == SumVolume::failed)
    fail(ErrorKind::internal, "wrench space: volume: rounding broke the cells in L-infinity");
  return sum.volume;
}

VolumeBounds WrenchSpace::volume_bounds(int edges, const Progress& progress) const {
  if (edges < 4 || edges > max_edges)
    fail("wrench space: edges must be 4 to {}, got {}", max_edges, edges);
  if (!is_round()) return {volume(progress), volume(progress)};
  if (volume_bounds_ && volume_bounds_->first == edges) return volume_bounds_->second;
  const auto replaced = [&](bool around) {
    std::vector<UnitWrenches> contacts = contacts_;
    for (UnitWrenches& contact : contacts)
      if (contact.round) contact = {pyramid_of(*contact.round, edges, around), {}};
    return WrenchSpace(std::move(contacts), options_).volume(progress);
  };
  return volume_bounds_.emplace(edges, VolumeBounds{replaced(false), replaced(true)}).second;
}

}  // namespace clench
