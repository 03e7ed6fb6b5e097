#include "clench/geometry/query/triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/geometry/query/exact_pairs.h"

namespace clench {

using Eigen::Vector3d;

namespace {

double unit_clamp(double x) { return x > 0 ? (x < 1 ? x : 1) : 0; }  // NaN becomes 0

// Two triangles relative to the first corner of the first one, so that a distant origin costs no
// digits.
struct Local {
  Vector3d origin;
  Corners a, b, edge_a, edge_b;
  Vector3d normal_a, normal_b;  // twice the area long
  double extent = 0;            // largest coordinate

  Local(const Corners& first, const Corners& second) : origin(first[0]) {
    for (int i = 0; i < 3; ++i) {
      a[i] = first[i] - origin;
      b[i] = second[i] - origin;
      extent = std::max({extent, a[i].cwiseAbs().maxCoeff(), b[i].cwiseAbs().maxCoeff()});
    }
    for (int i = 0; i < 3; ++i) {
      edge_a[i] = a[(i + 1) % 3] - a[i];
      edge_b[i] = b[(i + 1) % 3] - b[i];
    }
    normal_a = edge_a[0].cross(edge_a[1]);
    normal_b = edge_b[0].cross(edge_b[1]);
  }

  // are the triangles separated along the axis, by more than rounding could cause?
  bool apart_along(const Vector3d& axis) const {
    const auto [low_a, high_a] = std::minmax({axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2])});
    const auto [low_b, high_b] = std::minmax({axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2])});
    return std::max(low_b - high_a, low_a - high_b) >
           projection_rounding * extent * axis.lpNorm<1>();
  }

  // the axes that decide for triangles with area in different planes
  bool apart() const {
    if (apart_along(normal_a) || apart_along(normal_b)) return true;
    for (const Vector3d& u : edge_a)
      for (const Vector3d& v : edge_b)
        if (apart_along(u.cross(v))) return true;
    return false;
  }
};

// Nearest points p = a0 + s u and q = b0 + t v. Crossed lines by cross products, which keep their
// digits where the normal equations lose them: nearly parallel edges are the rule in meshes.
Vector3d between_segments(const Vector3d& a0, const Vector3d& u, const Vector3d& b0,
                          const Vector3d& v, double& s, double& t) {
  const Vector3d r = a0 - b0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), ur = u.dot(r), vr = v.dot(r);
  if (uu == 0 || vv == 0) {
    s = uu == 0 ? 0 : unit_clamp(-ur / uu);
    t = vv == 0 ? 0 : unit_clamp(vr / vv);
    return b0 + t * v - a0 - s * u;
  }
  const Vector3d n = u.cross(v);
  const double nn = n.squaredNorm(), uv = u.dot(v);
  s = nn > 0 ? unit_clamp(v.cross(r).dot(n) / nn) : 0;
  t = (uv * s + vr) / vv;
  if (t < 0) {
    t = 0, s = unit_clamp(-ur / uu);
  } else if (t > 1) {
    t = 1, s = unit_clamp((uv - ur) / uu);
  }
  return b0 + t * v - a0 - s * u;
}

struct NearestPoints {
  double squared = std::numeric_limits<double>::infinity();
  Vector3d p = Vector3d::Zero(), q = Vector3d::Zero();  // on the first and on the second

  void offer(double squared_distance, const Vector3d& on_first, const Vector3d& on_second) {
    if (squared_distance < squared) squared = squared_distance, p = on_first, q = on_second;
  }
};

// Foot of x on the plane, if it lies inside the triangle and is nearer than the present result.
bool foot_inside(const Vector3d& x, const Vector3d& corner, const Vector3d& u, const Vector3d& v,
                 const Vector3d& normal, double nearer_than_squared, Vector3d& foot) {
  const double nn = normal.squaredNorm();
  if (!(nn > 0)) return false;
  const Vector3d d = x - corner;
  const double height = d.dot(normal);
  if (height * height >= nearer_than_squared * nn) return false;
  const double along_u = d.cross(v).dot(normal) / nn, along_v = u.cross(d).dot(normal) / nn;
  if (!(along_u >= 0 && along_v >= 0 && along_u + along_v <= 1)) return false;
  foot = corner + along_u * u + along_v * v;
  return true;
}

// The arithmetic of eight lanes for one pair, so that one and eight give the same bits.
NearestBundle nearest_features(const Local& l) {
  PairBundle pairs;
  for (int k = 0; k < 3; ++k)
    for (int m = 0; m < 3; ++m)
      for (int lane = 0; lane < nearest_step; ++lane)
        pairs.a[3 * k + m][lane] = l.a[k][m], pairs.b[3 * k + m][lane] = l.b[k][m];
  NearestBundle out;
  nearest_of(pairs, 1, out);
  return out;
}

// A common point: where an edge of one pierces the other, or where boundaries cross.
Vector3d common_point(const Local& l, double nearest_squared, const Vector3d& nearest) {
  double best = nearest_squared;
  Vector3d point = nearest;
  const auto pierce = [&](const Corners& edges_of, const Corners& face, const Vector3d& normal) {
    for (int i = 0; i < 3; ++i) {
      const Vector3d &from = edges_of[i], &to = edges_of[(i + 1) % 3];
      const double h0 = normal.dot(from - face[0]), h1 = normal.dot(to - face[0]);
      if (h0 == h1 || (h0 > 0) == (h1 > 0)) continue;
      const Closest c = point_triangle(from + h0 / (h0 - h1) * (to - from), face);
      if (c.distance * c.distance < best) best = c.distance * c.distance, point = c.q;
    }
  };
  pierce(l.a, l.b, l.normal_b);
  pierce(l.b, l.a, l.normal_a);
  return point;
}

}  // namespace

Closest segment_segment(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                        const Vector3d& b1) {
  double s, t;
  const Vector3d u = a1 - a0, v = b1 - b0;
  const Vector3d d = between_segments(a0, u, b0, v, s, t);
  return {d.norm(), a0 + s * u, b0 + t * v};
}

Closest point_triangle(const Vector3d& p, const Corners& triangle) {
  // the boundary first: a triangle without area consists of nothing else
  NearestPoints best;
  Corners edge;
  for (int i = 0; i < 3; ++i) {
    edge[i] = triangle[(i + 1) % 3] - triangle[i];
    const double length = edge[i].squaredNorm();
    const double t = length > 0 ? unit_clamp(edge[i].dot(p - triangle[i]) / length) : 0;
    const Vector3d q = triangle[i] + t * edge[i];
    best.offer((p - q).squaredNorm(), p, q);
  }
  Vector3d foot;
  if (foot_inside(p, triangle[0], edge[0], -edge[2], edge[0].cross(edge[1]), best.squared, foot))
    best.offer((p - foot).squaredNorm(), p, foot);
  return {std::sqrt(best.squared), p, best.q};
}

// Triangles are disjoint if one of the usual axes separates them, or the line between their nearest
// points: the latter alone would be sufficient but for rounding, and it covers coplanar and
// degenerate triangles.
static Closest closest_of(const Local& l, const NearestBundle& nearest, int lane) {
  const auto at = [&](const double(&rows)[3][8]) {
    return Vector3d(rows[0][lane], rows[1][lane], rows[2][lane]);
  };
  const Vector3d p = at(nearest.p), q = at(nearest.q);
  const double squared = nearest.squared[lane];
  if (nearest.apart >> lane & 1 || l.apart()) {
    const double apart = std::max(std::sqrt(squared), std::numeric_limits<double>::min());
    return {apart, p + l.origin, q + l.origin};
  }
  const Vector3d point = common_point(l, squared, p) + l.origin;
  return {0, point, point};
}

bool triangles_meet(const Corners& a, const Corners& b) {
  const Local local(a, b);
  return !local.apart() && !(nearest_features(local).apart & 1);
}

Closest triangle_triangle(const Corners& a, const Corners& b) {
  const Local local(a, b);
  return closest_of(local, nearest_features(local), 0);
}

void triangle_pairs(const Corners* a, const Corners* b, int count, Closest* out) {
  for (int begin = 0; begin < count; begin += 8) {
    // the last ones fill up the step
    const int here = std::min(8, count - begin);
    PairBundle pairs;
    for (int lane = 0; lane < (here + nearest_step - 1) / nearest_step * nearest_step; ++lane) {
      const int i = std::min(begin + lane, count - 1);
      const Vector3d& origin = a[i][0];
      for (int k = 0; k < 3; ++k) {
        const Vector3d p = a[i][k] - origin, q = b[i][k] - origin;
        for (int m = 0; m < 3; ++m)
          pairs.a[3 * k + m][lane] = p[m], pairs.b[3 * k + m][lane] = q[m];
      }
    }
    NearestBundle nearest;
    nearest_of(pairs, here, nearest);
    for (int lane = 0; lane < here; ++lane) {
      const int i = begin + lane;
      if (!(nearest.apart >> lane & 1)) {
        out[i] = closest_of(Local(a[i], b[i]), nearest, lane);
        continue;
      }
      const Vector3d p(nearest.p[0][lane], nearest.p[1][lane], nearest.p[2][lane]),
          q(nearest.q[0][lane], nearest.q[1][lane], nearest.q[2][lane]);
      const double apart =
          std::max(std::sqrt(nearest.squared[lane]), std::numeric_limits<double>::min());
      out[i] = {apart, p + a[i][0], q + a[i][0]};
    }
  }
}

}  // namespace clench
