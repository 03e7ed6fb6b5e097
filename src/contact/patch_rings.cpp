#include "clench/contact/patch_rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clench/base/watched.h"

namespace clench {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr double nowhere = std::numeric_limits<double>::infinity();
static constexpr double whole_turn = 2 * std::numbers::pi;
static constexpr double full_facing = 0.7;  // cosine: surfaces that lean less have full weight
static constexpr double min_width = 1e-6;   // fraction of the radius: narrower rings are omitted
static constexpr double longest_piece = whole_turn / 8, shortest_piece = 0.02;

namespace {

// nodes and weights of Gauss-Legendre quadrature on [0, 1]
struct Nodes {
  std::vector<double> at, weight;
};

const Nodes& radial_nodes() {
  static const Nodes nodes = {
      {0.02544604382862076, 0.1292344072003028, 0.2970774243113014, 0.5, 0.7029225756886985,
       0.8707655927996972, 0.9745539561713792},
      {0.06474248308443485, 0.1398526957446383, 0.1909150252525595, 0.2089795918367347,
       0.1909150252525595, 0.1398526957446383, 0.06474248308443485}};
  return nodes;
}

// number of nodes on an arc: shorter arcs have fewer
const Nodes& arc_nodes(double length) {
  static const Nodes two = {{0.21132486540518712, 0.78867513459481288}, {0.5, 0.5}};
  static const Nodes three = {{0.11270166537925831, 0.5, 0.88729833462074169},
                              {5.0 / 18, 4.0 / 9, 5.0 / 18}};
  static const Nodes five = {
      {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155, 0.95308992296933200},
      {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
       0.11846344252809454}};
  return length < 0.03 ? two : length < 0.1 ? three : five;
}

// part of a circle over a triangle; from < to
struct RingArc {
  double from, to;  // [rad]
  int triangle;
};

// a body's surface seen from the plane
struct SeenSheet {
  PatchSheet& sheet;
  double mirror;  // of y: 1 or -1

  Vector2d seen(const Vector3d& p) const { return {p.x(), mirror * p.y()}; }
  Vector2d own(const Vector2d& place) const { return {place.x(), mirror * place.y()}; }
};

// a position on a triangle
struct PatchHit {
  int triangle = -1;  // -1: no triangle
  Vector3d weights = Vector3d::Zero();
};

Vector2d on_circle(double radius, double angle) {
  return radius * Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace

static double plane_cross(const Vector2d& u, const Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

// barycentric weights of a triangle's point over a position; below 0 for a vertical triangle
static Vector3d weights_over(const Corners& c, const Vector2d& place) {
  const Vector2d a = c[0].head<2>() - place, b = c[1].head<2>() - place, d = c[2].head<2>() - place;
  const Vector3d weights(plane_cross(b, d), plane_cross(d, a), plane_cross(a, b));
  const double area = weights.sum();
  return area == 0 ? Vector3d(-Vector3d::Ones()) : Vector3d(weights / area);
}

static bool holds(const SeenSheet& side, int triangle, const Vector2d& place) {
  return weights_over(side.sheet.corners(triangle), side.own(place)).minCoeff() >= 0;
}

namespace {

// ascending angles at which a triangle's sides cross a circle
struct Crossings {
  void add(double angle) {
    int k = count++;
    for (; k > 0 && angles[k - 1] > angle; --k) angles[k] = angles[k - 1];
    angles[k] = angle;
  }
  std::array<double, 6> angles;
  int count = 0;
};

}  // namespace

static Crossings crossings(const std::array<Vector2d, 3>& p, double radius) {
  Crossings out;
  for (int k = 0; k < 3; ++k) {
    const Vector2d e = p[(k + 1) % 3] - p[k];
    const double a = e.squaredNorm(), b = p[k].dot(e), c = p[k].squaredNorm() - radius * radius;
    const double root = b * b - a * c;
    if (!(a > 0 && root > 0)) continue;
    for (const double sign : {-1, 1}) {
      const double t = (-b + sign * std::sqrt(root)) / a;
      if (t < 0 || t > 1) continue;
      const Vector2d at = p[k] + t * e;
      out.add(std::atan2(at.y(), at.x()));
    }
  }
  return out;
}

static void add_arcs(const SeenSheet& side, int triangle, double radius,
                     std::vector<RingArc>& out) {
  const Corners& c = side.sheet.corners(triangle);
  const std::array<Vector2d, 3> p = {side.seen(c[0]), side.seen(c[1]), side.seen(c[2])};
  const Vector2d middle = (p[0] + p[1] + p[2]) / 3;
  double size = 0, farthest = 0;
  for (const Vector2d& q : p)
    size = std::max(size, (q - middle).norm()), farthest = std::max(farthest, q.norm());
  if (farthest < radius || middle.norm() - size > radius) return;
  const auto [at, count] = crossings(p, radius);
  if (count == 0 && holds(side, triangle, {radius, 0})) out.push_back({0, whole_turn, triangle});
  for (int i = 0; i < count; ++i) {
    const double from = at[i], to = i + 1 < count ? at[i + 1] : at[0] + whole_turn;
    if (to - from > 1e-12 && holds(side, triangle, on_circle(radius, 0.5 * (from + to))))
      out.push_back({from, to, triangle});
  }
}

// cut at one angle, so that all lie within a turn, in order
static std::vector<RingArc> unrolled(const std::vector<RingArc>& arcs, double start) {
  std::vector<RingArc> out;
  for (RingArc arc : arcs) {
    const double turns = std::floor((arc.from - start) / whole_turn) * whole_turn;
    arc.from -= turns, arc.to -= turns;
    const double end = start + whole_turn;
    if (arc.to > end) out.push_back({start, arc.to - whole_turn, arc.triangle}), arc.to = end;
    out.push_back(arc);
  }
  std::sort(out.begin(), out.end(),
            [](const RingArc& a, const RingArc& b) { return a.from < b.from; });
  return out;
}

namespace {

// the arcs at successive angles
class ArcSweep {
 public:
  ArcSweep(const SeenSheet& side, const std::vector<RingArc>& arcs, double start)
      : side_(side), arcs_(unrolled(arcs, start)) {}

  /// the triangle over a position: where the sheet overlaps itself, the one nearer to the tangent
  /// plane
  int triangle_at(double angle, const Vector2d& place) {
    for (; next_ < arcs_.size() && arcs_[next_].from <= angle; ++next_)
      open_.push_back(arcs_[next_]);
    std::erase_if(open_, [&](const RingArc& arc) { return arc.to < angle; });
    int best = -1;
    double least = side_.sheet.highest();
    for (const RingArc& arc : open_) {
      const Corners& c = side_.sheet.corners(arc.triangle);
      const Vector3d w = weights_over(c, side_.own(place));
      const double height = std::abs(w[0] * c[0].z() + w[1] * c[1].z() + w[2] * c[2].z());
      if (height <= least) least = height, best = arc.triangle;
    }
    return best;
  }

 private:
  SeenSheet side_;
  std::vector<RingArc> arcs_, open_;
  size_t next_ = 0;
};

}  // namespace

static Vector3d point_over(const SeenSheet& side, int triangle, const Vector2d& place) {
  if (triangle < 0) return {0, 0, nowhere};
  return side.sheet.round_point(triangle,
                                weights_over(side.sheet.corners(triangle), side.own(place)));
}

static void add_point(const SeenSheet& side, int triangle, const Vector3d& point, double area,
                      RingPoints& out) {
  if (triangle < 0) return;
  constexpr double range = full_facing - PatchSheet::min_facing;
  const double part = std::min(1.0, (side.sheet.facing(triangle) - PatchSheet::min_facing) / range);
  out.points.push_back(point);
  out.weights.push_back(area * part * part);
}

namespace {

// a piece of a circle over one triangle of each body
struct RingPiece {
  double radius, width;  // of the ring that it represents
  int in_a, in_b;
  // a piece is halved if the gap widens along it by more than twice this, and by more than a half
  double depth;
};

}  // namespace

// shorter pieces where the gap widens fast
static void add_piece(const SeenSheet& a, const SeenSheet& b, const RingPiece& piece, double from,
                      double length, PatchRings& out) {
  const Nodes& nodes = arc_nodes(length);
  std::array<Vector3d, 5> over_a, over_b;
  double least = nowhere, most = -nowhere;
  for (size_t k = 0; k < nodes.at.size(); ++k) {
    const Vector2d place = on_circle(piece.radius, from + length * nodes.at[k]);
    over_a[k] = point_over(a, piece.in_a, place), over_b[k] = point_over(b, piece.in_b, place);
    const double gap = over_a[k].z() + over_b[k].z();
    least = std::min(least, gap), most = std::max(most, gap);
  }
  if (most < nowhere && most - least > std::max(2 * piece.depth, least / 2) &&
      length > shortest_piece) {
    add_piece(a, b, piece, from, length / 2, out);
    add_piece(a, b, piece, from + length / 2, length / 2, out);
    return;
  }
  for (size_t k = 0; k < nodes.at.size(); ++k) {
    const double area = piece.width * piece.radius * length * nodes.weight[k];
    add_point(a, piece.in_a, over_a[k], area, out.surfaces[0]);
    add_point(b, piece.in_b, over_b[k], area, out.surfaces[1]);
    out.gap.push_back({on_circle(piece.radius, from + length * nodes.at[k]), area,
                       over_a[k].z() + over_b[k].z()});
  }
}

static void add_circle(const SeenSheet& a, const SeenSheet& b, RingPiece piece, PatchRings& out) {
  check_stop();
  std::vector<RingArc> arcs_a, arcs_b;
  for (const int t : a.sheet.triangles()) add_arcs(a, t, piece.radius, arcs_a);
  for (const int t : b.sheet.triangles()) add_arcs(b, t, piece.radius, arcs_b);
  std::vector<double> cuts;
  for (const auto* arcs : {&arcs_a, &arcs_b})
    for (const RingArc& arc : *arcs)
      for (const double angle : {arc.from, arc.to})
        cuts.push_back(angle - std::floor(angle / whole_turn) * whole_turn);
  if (cuts.empty()) cuts.push_back(0);
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(cuts[0] + whole_turn);
  ArcSweep over_a(a, arcs_a, cuts[0]), over_b(b, arcs_b, cuts[0]);
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double length = cuts[i + 1] - cuts[i];
    if (length < 1e-12) continue;
    const double middle = cuts[i] + 0.5 * length;
    const Vector2d there = on_circle(piece.radius, middle);
    piece.in_a = over_a.triangle_at(middle, there), piece.in_b = over_b.triangle_at(middle, there);
    const int pieces = static_cast<int>(std::ceil(length / longest_piece));
    for (int k = 0; k < pieces; ++k)
      add_piece(a, b, piece, cuts[i] + length / pieces * k, length / pieces, out);
  }
}

// Radii at which circles begin to leave a sheet and have left it completely; smoothed between, up
// to the radius.
static std::vector<double> radial_cuts(const PatchSheet& a, const PatchSheet& b, double radius) {
  std::vector<double> out = {radius};
  for (const PatchSheet* sheet : {&a, &b}) {
    double nearest = nowhere, farthest = 0;
    for (const auto& edge : sheet->rim()) {
      const Vector2d p = edge[0].head<2>(), along = edge[1].head<2>() - p;
      if (along.isZero(0)) continue;
      const double foot = std::clamp(-p.dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p + foot * along).norm());
      farthest = std::max({farthest, p.norm(), (p + along).norm()});
    }
    for (const double cut : {nearest, farthest})
      if (cut > min_width * radius && cut < (1 - min_width) * radius) out.push_back(cut);
  }
  std::sort(out.begin(), out.end());
  const auto same = [&](double x, double y) { return y - x < min_width * radius; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

PatchRings patch_rings(PatchSheet& a, PatchSheet& b, double radius, double depth) {
  PatchRings out;
  const Nodes& nodes = radial_nodes();
  const std::vector<double> cuts = radial_cuts(a, b, radius);
  double from = 0;
  for (const double to : cuts) {
    const double width = to - from;
    for (size_t i = 0; i < nodes.at.size(); ++i) {
      // from the middle outwards, quadratically spaced
      const double t = nodes.at[i], w = nodes.weight[i];
      const double r = from == 0 ? t * t * width : from + t * width;
      add_circle({a, -1}, {b, 1}, {r, (from == 0 ? 2 * t * w : w) * width, -1, -1, depth}, out);
    }
    from = to;
  }
  double least = nowhere;
  for (const GapPlace& g : out.gap) least = std::min(least, g.gap);
  for (GapPlace& g : out.gap)
    if (g.gap < nowhere) g.gap -= least;
  for (int i = 0; i < 2; ++i) {
    auto& weights = out.surfaces[i].weights;
    double sum = 0;
    for (const double w : weights) sum += w;
    if (!(sum > 0)) continue;
    for (double& w : weights) w *= static_cast<double>(weights.size()) / sum;
    out.shares[i] = sum / (std::numbers::pi * radius * radius);
  }
  return out;
}

Matrix2d meeting_moments(const std::vector<GapPlace>& gap, double depth) {
  Matrix2d sum = Matrix2d::Zero();
  double area = 0;
  for (const GapPlace& g : gap) {
    const double share =
        g.gap < nowhere ? g.area * std::exp(-4 * g.gap * g.gap / (depth * depth)) : 0;
    sum += share * g.place * g.place.transpose();
    area += share;
  }
  return area > 0 ? Matrix2d(sum / area) : Matrix2d(Matrix2d::Zero());
}

std::vector<GapPlace> round_gap(std::vector<GapPlace> places, const Vector2d& curvatures,
                                const Matrix2d& axes) {
  static const double steepest =
      std::sqrt(1 - PatchSheet::min_facing * PatchSheet::min_facing);  // sine, where sheets end
  for (GapPlace& g : places) {
    const double r = g.place.norm();
    const Vector2d along = axes.transpose() * g.place / r;
    const double sine = curvatures.cwiseMax(0).dot(along.cwiseAbs2()) * r;
    g.gap = sine > steepest ? nowhere : sine * r / (1 + std::sqrt(1 - sine * sine));
  }
  return places;
}

double depth_of(const std::vector<GapPlace>& gap, double volume) {
  const auto volume_at = [&](double depth) {
    double sum = 0;
    for (const GapPlace& g : gap) sum += g.area * std::max(0.0, depth - g.gap);
    return sum;
  };
  double area = 0, highest = 0;
  for (const GapPlace& g : gap)
    if (g.gap < nowhere) area += g.area, highest = std::max(highest, g.gap);
  if (!(area > 0 && volume > 0)) return 0;
  // below all gaps the volume grows in proportion to the area
  const double full = volume_at(highest);
  if (volume >= full) return highest + (volume - full) / area;
  double low = 0, high = highest;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (volume_at(middle) < volume ? low : high) = middle;
  }
  return high;
}

}  // namespace clench
