#include "clench/geometry/query/triangle.h"

#include <doctest/doctest.h>

#include <limits>

#include "clench/base/random.h"
#include "clench/geometry/query/exact_points.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

Corners triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return {a, b, c}; }

double extent(const Corners& a, const Corners& b) {
  double size = 0;
  for (const Corners& t : {a, b})
    for (const Vector3d& p : t) size = std::max(size, (p - a[0]).norm());
  return size;
}

// distance of x from the triangle: exact formulas would give 0
double outside(const Vector3d& x, const Corners& t) {
  const auto area = [](const Vector3d& u, const Vector3d& v) { return u.cross(v).norm(); };
  const double whole = area(t[1] - t[0], t[2] - t[0]);
  double parts = 0, perimeter = 0, nearest_edge = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector3d &u = t[i], &v = t[(i + 1) % 3];
    parts += area(u - x, v - x);
    perimeter += (u - v).norm();
    nearest_edge = std::min(nearest_edge, (u - x).norm() + (v - x).norm() - (u - v).norm());
  }
  if (perimeter == 0) return (x - t[0]).norm();
  return std::min(nearest_edge, (parts - whole) / perimeter);
}

// A proof instead of a reference: nearest points of convex sets are those whose connecting line
// separates the sets.
void check_certificate(const Corners& a, const Corners& b) {
  const double size = extent(a, b), tolerance = 1e-13 * size;  // some 500 rounding errors
  const Closest c = triangle_triangle(a, b);
  CHECK(triangles_meet(a, b) == (c.distance == 0));
  CHECK(triangles_meet(b, a) == triangles_meet(a, b));
  CHECK(outside(c.p, a) <= tolerance);
  CHECK(outside(c.q, b) <= tolerance);
  CHECK(std::abs((c.p - c.q).norm() - c.distance) <= tolerance);
  const Vector3d d = c.q - c.p;
  for (int i = 0; i < 3; ++i) {
    CHECK(d.dot(a[i] - c.p) <= tolerance * size);
    CHECK(d.dot(b[i] - c.q) >= -tolerance * size);
  }
}

// corners of all kinds: random ones, and ones of a small grid, which touch, coincide or degenerate
Corners random_triangle(Random& random, bool grid) {
  Corners t;
  for (Vector3d& p : t) {
    p = random_point(random);
    if (grid) p = Vector3d(std::round(p.x()), std::round(p.y()), std::round(0.7 * p.z()));
  }
  return t;
}

}  // namespace

TEST_CASE("nearest points of random triangles are certified by the plane between them") {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Corners a = random_triangle(random, false);
    Corners b = random_triangle(random, false);
    const Vector3d shift = random_point(random, random.uniform(0, 3));
    for (Vector3d& p : b) p += shift;
    check_certificate(a, b);
  }
}

TEST_CASE("the same for triangles that touch, share corners, are coplanar or have no area") {
  Random random(2);
  int touching = 0, meeting = 0;
  for (int i = 0; i < 10000; ++i) {
    const Corners a = random_triangle(random, true), b = random_triangle(random, true);
    check_certificate(a, b);
    touching += triangles_meet(a, b);
    meeting += a[0] == b[0];
  }
  CHECK(touching > 1000);
  CHECK(meeting > 100);
}

TEST_CASE("touching triangles intersect") {
  const Corners t = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK(triangles_meet(t, t));
  CHECK(triangles_meet(t, triangle({0, 0, 0}, {-1, 0, 1}, {0, -1, 1})));         // corner to corner
  CHECK(triangles_meet(t, triangle({0.25, 0.25, 0}, {0, 0, 1}, {1, 1, 1})));     // corner on face
  CHECK(triangles_meet(t, triangle({0.5, 0.5, 0}, {1, 1, 1}, {1, 1, 0})));       // corner on edge
  CHECK(triangles_meet(t, triangle({0.5, -1, -1}, {0.5, 1, 1}, {0.5, -2, 0})));  // edge on edge
  CHECK(triangles_meet(t, triangle({1, 0, 0}, {0, 1, 0}, {1, 1, 0})));           // a whole edge
  CHECK(triangles_meet(t,
                       // one inside the other
                       triangle({0.1, 0.1, 0}, {0.2, 0.1, 0}, {0.1, 0.2, 0})));
  CHECK_FALSE(triangles_meet(t, triangle({1, 0.1, 0}, {0.1, 1, 0}, {1, 1, 0})));
  CHECK_FALSE(triangles_meet(t, triangle({0, 0, 1e-9}, {1, 0, 1e-9}, {0, 1, 1e-9})));
}

TEST_CASE("a triangle without area is a segment or a point") {
  const Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), up(0.25, 0.25, 2), down(0.25, 0.25, -2);
  const Corners face = triangle(o, x, y), point = triangle(up, up, up),
                segment = triangle(up, down, down), line = triangle(up, 0.5 * (up + down), down);
  CHECK(triangle_triangle(face, point).distance == 2);
  CHECK(triangle_triangle(point, face).q.isApprox(Vector3d(0.25, 0.25, 0)));
  CHECK(triangles_meet(face, segment));
  CHECK(triangles_meet(line, face));
  CHECK(triangle_triangle(face, segment).p.isApprox(Vector3d(0.25, 0.25, 0)));
  CHECK(triangle_triangle(point, point).distance == 0);
  CHECK(triangle_triangle(point, triangle(down, down, down)).distance == 4);
  // collinear segments, apart and overlapping
  CHECK(triangle_triangle(triangle(o, x, x), triangle(3 * x, 2 * x, 3 * x)).distance == 1);
  CHECK(triangles_meet(triangle(o, x, x), triangle(3 * x, 0.5 * x, 2 * x)));
  CHECK(point_triangle(Vector3d(0.5, 3, 0), triangle(o, x, o)).distance == 3);
}

TEST_CASE("results for slivers agree with those for segments") {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    Corners a = random_triangle(random, false);
    Corners b = random_triangle(random, false);
    const double thin = std::pow(10, random.uniform(-18, -3));
    a[2] = a[0] + random.uniform() * (a[1] - a[0]) + thin * random_point(random);
    check_certificate(a, b);
    // the sliver's third corner deviates from the segment by `thin` times the length of a normal
    // vector
    const double along_edge = triangle_triangle({a[0], a[1], a[1]}, b).distance;
    CHECK(std::abs(triangle_triangle(a, b).distance - along_edge) < 8 * thin + 1e-13);
  }
}

TEST_CASE("nearly parallel edges keep their accuracy") {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    // two unit segments that cross over one point at a height and a tiny angle
    const double angle = std::pow(10, random.uniform(-12, -1));
    const double height = std::pow(10, random.uniform(-6, 0));
    const Vector3d middle = random_point(random), u = random_direction(random);
    const Vector3d n = u.unitOrthogonal(), v = std::cos(angle) * u + std::sin(angle) * n.cross(u);
    const Closest c = segment_segment(middle - u, middle + 0.7 * u, middle + height * n - 0.3 * v,
                                      middle + height * n + v);
    // a few rounding errors of coordinates of size 3
    CHECK(std::abs(c.distance - height) < 1e-14);
  }
}

TEST_CASE("distances do not depend on the unit of length or on a distant origin") {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Corners a = random_triangle(random, i % 2), b = random_triangle(random, i % 2);
    const Closest plain = triangle_triangle(a, b);
    for (const double scale : {1e-9, 1e-6, 1e6}) {
      Corners sa = a, sb = b;
      for (Vector3d& p : sa) p *= scale;
      for (Vector3d& p : sb) p *= scale;
      CHECK(std::abs(triangle_triangle(sa, sb).distance - scale * plain.distance) < 1e-14 * scale);
      check_certificate(sa, sb);
    }
    // 1 km away; positions on a grid of 2^-30 so that moving them is exact
    Corners ma = a, mb = b;
    const Vector3d far(1024, -2048, 512);
    for (Corners* t : {&ma, &mb})
      for (Vector3d& p : *t) p = (p * 0x1p30).array().round() * 0x1p-30;
    const double near_distance = triangle_triangle(ma, mb).distance;
    for (Corners* t : {&ma, &mb})
      for (Vector3d& p : *t) p += far;
    CHECK(triangle_triangle(ma, mb).distance == near_distance);
  }
}

TEST_CASE("micrometer gaps between meter triangles are exact up to rounding") {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    // b's corner is above a's face by the gap, all in a random pose
    const double gap = std::pow(10, random.uniform(-9, -3));
    const Pose X = random_pose(random, 1);
    Corners a = triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    Corners b = triangle({0, 0, gap}, {1, 1, 1}, {-1, 0.5, 1});
    for (Vector3d& p : a) p = X * p;
    for (Vector3d& p : b) p = X * p;
    CHECK(std::abs(triangle_triangle(a, b).distance - gap) < 2e-15);
    CHECK_FALSE(triangles_meet(a, b));
  }
}

TEST_CASE(
    "the nearest point of a triangle is inside it, and no corner is nearer along the direction") {
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    const Corners t = random_triangle(random, i % 2);
    Vector3d p = random_point(random, 2);
    if (i % 4 == 3) p = Vector3d(std::round(p.x()), std::round(p.y()), std::round(p.z()));
    const Closest c = point_triangle(p, t);
    CHECK(c.p == p);
    CHECK(std::abs((c.p - c.q).norm() - c.distance) < 1e-14);
    CHECK(outside(c.q, t) < 1e-12);
    for (const Vector3d& corner : t) CHECK((c.q - p).dot(corner - c.q) > -1e-12);
  }
}

TEST_CASE("nearest points of four triangles at once equal those of one at a time, bit-exactly") {
  Random random(8);
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10, random.uniform(-3, 3));
    Corners triangles[point_step];
    CornerLanes lanes;
    for (int lane = 0; lane < point_step; ++lane) {
      triangles[lane] = random_triangle(random, i % 3 == 0);
      for (int k = 0; k < 3; ++k) {
        triangles[lane][k] *= size;
        lanes.at[k][lane] = triangles[lane][k].data();
      }
    }
    Vector3d p = size * random_point(random, 2);
    // at a corner, and beyond the range of squares
    if (i % 5 == 0) p = triangles[0][1];
    if (i % 100 == 1) p *= 1e200;
    NearestToPoint out;
    nearest_to_point(p.data(), lanes, out);
    for (int lane = 0; lane < point_step; ++lane) {
      const Closest c = point_triangle(p, triangles[lane]);
      CHECK(std::sqrt(out.squared[lane]) == c.distance);
      CHECK(Vector3d(out.q[0][lane], out.q[1][lane], out.q[2][lane]) == c.q);
    }
  }
}
