#include "clench/contact/contact_set.h"

#include <algorithm>
#include <ctime>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/math/decompositions.h"
#include "support/shapes.h"

using namespace clench;
using Eigen::Vector3d;
using Touches = std::vector<Touch>;

namespace {

constexpr double thin = 5e-5;  // a gap within the threshold of 1e-4 [m]

ShapePtr shape(const Mesh& mesh) { return Shape::make(mesh, "test"); }

Mesh moved(Mesh mesh, const Pose& X) {
  for (Vector3d& v : mesh.vertices) v = X * v;
  return mesh;
}

Mesh joined(Mesh one, const Mesh& two) {
  const int base = static_cast<int>(one.vertices.size());
  one.vertices.insert(one.vertices.end(), two.vertices.begin(), two.vertices.end());
  for (const Triangle& t : two.triangles)
    one.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  return one;
}

// every triangle divided into four, `times` times
Mesh subdivided(Mesh mesh, int times) {
  for (; times > 0; --times) {
    Mesh fine;
    fine.vertices = mesh.vertices;
    for (const Triangle& t : mesh.triangles) {
      int middle[3];
      for (int k = 0; k < 3; ++k) {
        middle[k] = static_cast<int>(fine.vertices.size());
        fine.vertices.push_back(0.5 * (mesh.vertices[t[k]] + mesh.vertices[t[(k + 1) % 3]]));
      }
      fine.triangles.push_back({t[0], middle[0], middle[2]});
      fine.triangles.push_back({t[1], middle[1], middle[0]});
      fine.triangles.push_back({t[2], middle[2], middle[1]});
      fine.triangles.push_back({middle[0], middle[1], middle[2]});
    }
    mesh = weld(fine);
  }
  return mesh;
}

// every triangle with separate corners
Mesh soup(const Mesh& mesh) {
  Mesh out;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Vector3d& c : mesh.corners(static_cast<int>(t))) out.vertices.push_back(c);
    const int base = 3 * static_cast<int>(t);
    out.triangles.push_back({base, base + 1, base + 2});
  }
  return out;
}

// closed prism about x
Mesh cylinder(double radius, double length, int sides) {
  Mesh m;
  for (const double x : {-0.5 * length, 0.5 * length}) {
    for (int s = 0; s < sides; ++s) {
      const double angle = 2 * std::numbers::pi * s / sides;
      m.vertices.push_back({x, radius * std::sin(angle), -radius * std::cos(angle)});
    }
    m.vertices.push_back({x, 0, 0});
  }
  const int other = sides + 1;
  for (int s = 0; s < sides; ++s) {
    const int next = (s + 1) % sides;
    m.triangles.push_back({s, next, other + next});
    m.triangles.push_back({s, other + next, other + s});
    m.triangles.push_back({sides, next, s});
    m.triangles.push_back({other + sides, other + s, other + next});
  }
  return m;
}

Pose random_pose(Random& random, double reach) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return {q.normalized(),
          reach * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))};
}

double min_gap(const Touches& touches) {
  double least = std::numeric_limits<double>::infinity();
  for (const Touch& t : touches) least = std::min(least, t.gap);
  return least;
}

// whether both sets have the same points within the tolerance, and the same normals
bool same_points(const Touches& x, const Touches& y, double tolerance) {
  const auto covered = [&](const Touches& some, const Touches& by) {
    return std::all_of(some.begin(), some.end(), [&](const Touch& t) {
      return std::any_of(by.begin(), by.end(), [&](const Touch& u) {
        return (t.p_a - u.p_a).norm() <= tolerance && (t.p_b - u.p_b).norm() <= tolerance &&
               t.normal_b.dot(u.normal_b) > 1 - 1e-6;
      });
    });
  };
  return x.size() == y.size() && covered(x, y) && covered(y, x);
}

bool has_point(const Touches& touches, const Vector3d& p, double tolerance) {
  return std::any_of(touches.begin(), touches.end(),
                     [&](const Touch& t) { return (t.p_a - p).norm() <= tolerance; });
}

// properties of every contact set
void check_sound(const Touches& touches, const Shape& a, const Shape& b, const Pose& X_AB,
                 double threshold = 1e-4) {
  for (const Touch& t : touches) {
    CHECK(t.normal_b.norm() == doctest::Approx(1).epsilon(1e-14));
    CHECK(t.gap < threshold);
    // distances between points of size 1 are accurate to a few 1e-16
    CHECK(std::abs((t.p_b - t.p_a).norm() - t.gap) < 1e-14);
    CHECK(closest_point(a, t.p_a).distance < 1e-14);
    CHECK(closest_point(b, X_AB.inverse() * t.p_b).distance < 1e-14);
    if (t.gap > 1e-9) CHECK(t.normal_b.dot(t.p_b - t.p_a) > 0.999 * t.gap);
  }
  const double d = distance(a, b, X_AB).distance;
  if (d > 0 && d < threshold) CHECK(min_gap(touches) == d);
}

const Mesh floor_mesh = moved(test::box(1, 1, 0.02), Pose::translation({0, 0, -0.01}));

}  // namespace

TEST_CASE("a ball on a plane touches at one point") {
  const auto plane = shape(floor_mesh);
  for (const double radius : {0.001, 0.005, 0.02, 0.1})
    // facet angles of 4.5 degrees and more: steeper around the lowest point than a tilted face may
    // be
    for (const int rings : {8, 24, 40}) {
      const auto ball = shape(test::ball(radius, rings, 2 * rings));
      const Pose X_AB = Pose::translation({0.1, 0.05, radius + thin});
      const auto touches = contact_set(*plane, *ball, X_AB);
      REQUIRE(touches.size() == 1);
      CHECK((touches[0].p_a - Vector3d(0.1, 0.05, 0)).norm() < 1e-12);
      // rounding error divided by the gap
      CHECK((touches[0].normal_b - Vector3d::UnitZ()).norm() < 1e-9);
      CHECK(touches[0].gap == doctest::Approx(thin).epsilon(1e-9));
      check_sound(touches, *plane, *ball, X_AB);
    }
}

TEST_CASE(
    "a ball whose facets are within the tilt tolerance of faces still touches around its lowest "
    "point") {
  const auto plane = shape(floor_mesh);
  for (const double radius : {0.02, 0.2})
    for (const int rings : {60, 70}) {
      const auto ball = shape(test::ball(radius, rings, 2 * rings));
      const Pose X_AB = Pose::translation({0.1, 0.05, radius + thin});
      const auto touches = contact_set(*plane, *ball, X_AB);
      CHECK(touches.size() <= 8);
      CHECK(has_point(touches, {0.1, 0.05, 0}, 1e-12));
      // the tolerated slope of 1/30, and the facet that contains it
      const double reach = radius * (1.0 / 30 + std::numbers::pi / rings);
      for (const Touch& t : touches) CHECK((t.p_a - Vector3d(0.1, 0.05, 0)).norm() < reach);
      check_sound(touches, *plane, *ball, X_AB);
    }
}

TEST_CASE("a box on a plane touches at its four corners for any triangulation of its faces") {
  const auto plane = shape(floor_mesh), fine_plane = shape(subdivided(floor_mesh, 4));
  for (int times = 0; times < 4; ++times)
    for (const auto& below : {plane, fine_plane})
      for (int turn = 0; turn < 5; ++turn) {
        const Mesh mesh = subdivided(test::box(0.06, 0.04, 0.02), times);
        const Pose X_AB{Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * turn, Vector3d::UnitZ())),
                        {0.011, -0.007, 0.01 + thin}};
        for (const auto& box : {shape(mesh), shape(soup(mesh))}) {
          const auto touches = contact_set(*below, *box, X_AB);
          REQUIRE(touches.size() == 4);
          for (const double x : {-0.03, 0.03})
            for (const double y : {-0.02, 0.02})
              CHECK(has_point(touches, X_AB * Vector3d(x, y, -0.01) - thin * Vector3d::UnitZ(),
                              1e-9));
          check_sound(touches, *below, *box, X_AB);
        }
      }
}

TEST_CASE("a face offset over another face touches at the outline of the overlap") {
  const auto below = shape(test::box(0.06, 0.04, 0.02));
  for (int times = 0; times < 3; ++times) {
    const auto above = shape(subdivided(test::box(0.05, 0.05, 0.02), times));
    const Pose X_AB = Pose::translation({0.03, 0.02, 0.02 + thin});
    const auto touches = contact_set(*below, *above, X_AB);
    REQUIRE(touches.size() == 4);
    for (const double x : {0.005, 0.03})
      for (const double y : {-0.005, 0.02}) CHECK(has_point(touches, {x, y, 0.01}, 1e-9));
    check_sound(touches, *below, *above, X_AB);
  }
  // a square turned on a square: an octagon of crossings of edges only
  const Pose turned{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitZ())),
                    {0, 0, 0.04 + thin}};
  const auto square = shape(test::box(0.04, 0.04, 0.04));
  const auto touches = contact_set(*square, *square, turned);
  CHECK(touches.size() == 8);
  const double reach = 0.02 * std::tan(std::numbers::pi / 8);
  for (const double x : {-1, 1})
    for (const double y : {-1, 1}) {
      CHECK(has_point(touches, {0.02 * x, reach * y, 0.02}, 1e-9));
      CHECK(has_point(touches, {reach * x, 0.02 * y, 0.02}, 1e-9));
    }
}

TEST_CASE("faces with aligned edges touch along their normal, not obliquely from edge to edge") {
  const auto box = shape(test::box(0.06, 0.06, 0.06));
  const double gap = 2.5e-5;
  // displaced by less than a thirtieth of the gap, along one axis and along both
  for (const double aside : {2e-9, 2e-8, 2e-7, 6e-7})
    for (const Vector3d& way :
         {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(1, 1, 0), Vector3d(-1, 0.5, 0)}) {
      const auto touches =
          contact_set(*box, *box, Pose::translation(Vector3d(0, 0, 0.06 + gap) + aside * way));
      CHECK(touches.size() == 4);
      for (const Touch& touch : touches) {
        // rounding error of 1e-17 m in 25 um
        CHECK((touch.normal_b - Vector3d::UnitZ()).norm() < 1e-9);
        CHECK(std::abs(touch.gap - gap) < 1e-15);
      }
    }
}

TEST_CASE("a cylinder lying on a plane touches at the two ends of its line") {
  const auto plane = shape(floor_mesh);
  for (const int sides : {12, 48, 400}) {
    const auto lying = shape(cylinder(0.02, 0.1, sides));
    for (int turn = 0; turn < 8; ++turn) {
      const Pose X_AB{Eigen::Quaterniond(Eigen::AngleAxisd(0.4 * turn, Vector3d::UnitZ())),
                      {0.1, 0, 0.02 + thin}};
      const auto touches = contact_set(*plane, *lying, X_AB);
      // with 400 sides, the sides next to the lowest count as flat: they are within its slope of
      // 1/30
      const double beside = sides > 100 ? 0.02 / 30 + 0.001 : 1e-9;
      CHECK(touches.size() >= 2);
      CHECK(touches.size() <= (sides > 100 ? 4 : 2));
      const Vector3d end = X_AB.rotation * Vector3d(0.05, 0, 0), foot(0.1, 0, 0);
      CHECK(has_point(touches, foot + end, beside));
      CHECK(has_point(touches, foot - end, beside));
      for (const Touch& t : touches)
        CHECK(std::min((t.p_a - foot - end).norm(), (t.p_a - foot + end).norm()) <= beside);
      check_sound(touches, *plane, *lying, X_AB);
    }
  }
}

TEST_CASE("every foot of a table touches the floor") {
  Mesh table = moved(test::box(0.4, 0.4, 0.02), Pose::translation({0, 0, 0.11}));
  for (const double x : {-0.15, 0.15})
    for (const double y : {-0.15, 0.15})
      table = joined(table, moved(test::box(0.02, 0.02, 0.2), Pose::translation({x, y, 0})));
  const auto plane = shape(floor_mesh);
  const Pose X_AB = Pose::translation({0, 0, 0.1 + thin});
  for (const auto& stands : {shape(table), shape(subdivided(table, 2))}) {
    const auto touches = contact_set(*plane, *stands, X_AB);
    CHECK(touches.size() == 16);
    for (const double x : {-0.15, 0.15})
      for (const double y : {-0.15, 0.15})
        for (const double dx : {-0.01, 0.01})
          for (const double dy : {-0.01, 0.01})
            CHECK(has_point(touches, {x + dx, y + dy, 0}, 1e-9));
    // reduced to one contact per patch, each foot still has one
    const auto few = contact_set(*plane, *stands, X_AB, {.max_per_patch = 1});
    CHECK(few.size() == 4);
    CHECK(min_gap(few) == distance(*plane, *stands, X_AB).distance);
  }
}

TEST_CASE("a box in a corner touches floor and both walls, each at four corners") {
  const Mesh corner =
      joined(joined(floor_mesh, moved(test::box(0.02, 1, 1), Pose::translation({-0.51, 0, 0.5}))),
             moved(test::box(1, 0.02, 1), Pose::translation({0, -0.51, 0.5})));
  const auto room = shape(corner), box = shape(test::box(0.1, 0.1, 0.1));
  // three different gaps, so that each of the box's corners has a nearest side
  const Pose X_AB = Pose::translation({-0.45 + 7e-5, -0.45 + 3e-5, 0.05 + thin});
  const auto touches = contact_set(*room, *box, X_AB);
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = std::count_if(touches.begin(), touches.end(),
                                     [&](const Touch& t) { return t.normal_b[axis] > 0.999; });
    CHECK(count == 4);
  }
  CHECK(touches.size() == 12);
  check_sound(touches, *room, *box, X_AB);
}

TEST_CASE("an edge on a face touches at its ends, a corner at one point") {
  const auto plane = shape(floor_mesh), box = shape(test::box(0.05, 0.05, 0.05));
  const double h = 0.05 * std::sqrt(0.5);
  const Pose on_edge{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX())),
                     {0, 0, h + thin}};
  CHECK(contact_set(*plane, *box, on_edge).size() == 2);
  const Eigen::Quaterniond tip = shortest_rotation(Vector3d(1, 1, 1), -Vector3d::UnitZ());
  const Pose on_corner{tip, {0, 0, 0.025 * std::sqrt(3.0) + thin}};
  CHECK(contact_set(*plane, *box, on_corner).size() == 1);
  // two crossed edges touch only at their crossing
  const Pose over{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX())),
                  {0, 0, h}};
  const Pose under{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitY())),
                   {0, 0, -h - thin}};
  const auto crossed = contact_set(*box, *box, over.inverse() * under);
  REQUIRE(crossed.size() == 1);
  CHECK((over.rotation * crossed[0].normal_b + Vector3d::UnitZ()).norm() < 1e-9);
}

TEST_CASE("every set contains the closest pair, bit-exactly, for any two close bodies") {
  Random random(5);
  const std::vector<ShapePtr> shapes = {
      shape(test::box(0.1, 0.06, 0.04)), shape(test::ball(0.03, 10, 20)),
      shape(cylinder(0.02, 0.1, 16)), shape(subdivided(test::box(0.05, 0.05, 0.05), 2))};
  int near = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Shape &a = *shapes[random.bits() % 4], &b = *shapes[random.bits() % 4];
    Pose X_AB = random_pose(random, 0.2);
    const Distance d = distance(a, b, X_AB);
    if (!(d.distance > 0)) continue;
    // move b to a gap that is a random fraction of the threshold
    const double gap = std::pow(10, random.uniform(-12, -4.1));
    X_AB.position -= (d.p_b - d.p_a) * (1 - gap / d.distance);
    const double now = distance(a, b, X_AB).distance;
    if (!(now > 0)) continue;
    ++near;
    const auto touches = contact_set(a, b, X_AB);
    REQUIRE(!touches.empty());
    check_sound(touches, a, b, X_AB);
    // with swapped bodies: the same points, with reversed normals
    const auto swapped = contact_set(b, a, X_AB.inverse());
    Touches back;
    for (const Touch& t : swapped)
      back.push_back({X_AB * t.p_b, X_AB * t.p_a, -(X_AB.rotation * t.normal_b), t.gap});
    // points move by the rounding error over the sine of nearly parallel edges; normals are
    // compared only for gaps above rounding
    if (now > 1e-8) CHECK(same_points(touches, back, 1e-7));
  }
  CHECK(near > 200);
}

TEST_CASE("contacts move with the bodies") {
  Random random(6);
  const Mesh below = test::box(0.06, 0.04, 0.02),
             above = subdivided(test::box(0.05, 0.05, 0.02), 1);
  const Pose X_AB{Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d::UnitZ())),
                  {0.03, 0.02, 0.02 + thin}};
  const auto still = contact_set(*shape(below), *shape(above), X_AB);
  REQUIRE(still.size() >= 4);
  for (int trial = 0; trial < 20; ++trial) {
    // the same two solids, with other body frames
    const Pose X = random_pose(random, 1), Y = random_pose(random, 1);
    const auto a = shape(moved(below, X)), b = shape(moved(above, Y));
    auto touches = contact_set(*a, *b, X * X_AB * Y.inverse());
    const Pose back = X.inverse();
    for (Touch& t : touches)
      t.p_a = back * t.p_a, t.p_b = back * t.p_b, t.normal_b = back.rotation * t.normal_b;
    CHECK(same_points(still, touches, 1e-9));
  }
}

TEST_CASE("contacts of a scaled pair are the scaled contacts") {
  for (const double scale : {1e-4, 1e-2, 1.0, 1e2}) {
    const auto a = shape(test::box(0.6 * scale, 0.4 * scale, 0.2 * scale));
    const auto b = shape(test::box(0.5 * scale, 0.5 * scale, 0.2 * scale));
    const Pose X_AB = Pose::translation(scale * Vector3d(0.3, 0.2, 0.2 + 5e-4));
    const auto touches = contact_set(*a, *b, X_AB, {.threshold = 1e-3 * scale});
    REQUIRE(touches.size() == 4);
    for (const double x : {0.05, 0.3})
      for (const double y : {-0.05, 0.2})
        CHECK(has_point(touches, scale * Vector3d(x, y, 0.1), 1e-9 * scale));
  }
}

TEST_CASE("a gap too narrow to define a direction takes the face's normal") {
  const auto plane = shape(floor_mesh), box = shape(test::box(0.05, 0.05, 0.05));
  for (const double gap : {1e-15, 1e-13, 1e-11, 1e-9}) {
    const Pose X_AB = Pose::translation({0.1, 0.1, 0.025 + gap});
    const auto touches = contact_set(*plane, *box, X_AB);
    if (colliding(*plane, *box, X_AB)) continue;  // rounding may close the smallest gap
    REQUIRE(touches.size() == 4);
    // 1e-6: largest error of the direction of the narrowest gap that is used
    for (const Touch& t : touches) CHECK((t.normal_b - Vector3d::UnitZ()).norm() < 1e-6);
  }
  // also if edges seem closer than faces because of rounding
  const auto cube = shape(test::box(0.1, 0.1, 0.1));
  for (const double x : {0.1, 0.2, 0.3, 0.5})
    for (const double gap : {5e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9})
      for (int axis = 0; axis < 3; ++axis) {
        // as for two bodies of a world: their relative position is rounded
        const double apart = (x + 0.1) - (x - gap);
        const auto touches =
            contact_set(*cube, *cube, Pose::translation(apart * Vector3d::Unit(axis)));
        CHECK(touches.size() == 4);
        for (const Touch& t : touches) CHECK((t.normal_b - Vector3d::Unit(axis)).norm() < 1e-6);
      }
  // inverting a mesh does not change the side of the contact
  Mesh inverted = test::box(0.05, 0.05, 0.05);
  for (Triangle& t : inverted.triangles) std::swap(t[0], t[1]);
  const auto touches =
      contact_set(*plane, *shape(inverted), Pose::translation({0, 0, 0.025 + 1e-12}));
  REQUIRE(touches.size() == 4);
  for (const Touch& t : touches) CHECK((t.normal_b - Vector3d::UnitZ()).norm() < 1e-6);
}

TEST_CASE("bodies that are far apart, overlap or contain one another have no contacts") {
  const auto box = shape(test::box(0.1, 0.1, 0.1)),
             inner = shape(test::box(0.0999, 0.0999, 0.0999));
  CHECK(contact_set(*box, *box, Pose::translation({0, 0, 0.1 + 1.1e-4})).empty());
  CHECK(contact_set(*box, *box, Pose::translation({0.05, 0, 0})).empty());
  CHECK(contact_set(*box, *box, Pose::translation({0.1, 0, 0})).empty());
  CHECK(contact_set(*box, *inner, Pose()).empty());
  CHECK(contact_set(*inner, *box, Pose()).empty());
  CHECK(contact_set(*box, *inner, Pose::translation({2e-5, 0, 0})).empty());
}

TEST_CASE("inside a cavity, contact normals point outwards from the enclosed body") {
  // a closed shell: an outer box, and an inner box that faces inwards
  Mesh cavity = test::box(0.08, 0.08, 0.08);
  for (Triangle& t : cavity.triangles) std::swap(t[0], t[1]);
  const auto shell = shape(joined(test::box(0.1, 0.1, 0.1), cavity));
  const auto box = shape(test::box(0.04, 0.04, 0.04));
  const auto touches = contact_set(*shell, *box, Pose::translation({0, 0, -0.02 + thin}));
  REQUIRE(touches.size() == 4);
  for (const Touch& t : touches) CHECK(t.normal_b.z() > 0.999);
}

TEST_CASE("cracks and triangles without area do not change contacts") {
  Mesh cracked = soup(subdivided(test::box(0.06, 0.04, 0.02), 2));
  Random random(7);
  for (Vector3d& v : cracked.vertices)
    v += 1e-8 * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  Mesh degenerate = test::box(0.06, 0.04, 0.02);
  for (int i = 0; i < 8; ++i) {
    degenerate.triangles.push_back({i, i, i});
    degenerate.triangles.push_back({i, i, (i + 3) % 8});
  }
  const auto plane = shape(floor_mesh);
  const Pose X_AB = Pose::translation({0.011, -0.007, 0.01 + thin});
  for (const auto& box : {shape(cracked), shape(degenerate)}) {
    const auto touches = contact_set(*plane, *box, X_AB);
    for (const double x : {-0.03, 0.03})
      for (const double y : {-0.02, 0.02}) {
        const Vector3d corner = X_AB * Vector3d(x, y, -0.01);
        CHECK(has_point(touches, {corner.x(), corner.y(), 0}, 1e-7));
      }
    // with cracks the closest point may be anywhere on the face
    CHECK(touches.size() <= 5);
    check_sound(touches, *plane, *box, X_AB);
  }
}

TEST_CASE("the time to reduce thousands of coplanar triangles grows linearly with their number") {
  const auto plane = shape(floor_mesh);
  double before = 0;
  for (const int times : {4, 5}) {
    // for 512 triangles, then for 2048
    const auto box = shape(subdivided(test::box(0.2, 0.2, 0.02), times));
    const Pose X_AB = Pose::translation({0, 0, 0.01 + thin});
    const std::clock_t start = std::clock();
    const auto touches = contact_set(*plane, *box, X_AB);
    const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    CHECK(touches.size() == 4);
    // four times the triangles: a quadratic algorithm takes 16 times as long; 12 allows for a busy
    // machine
    if (before > 2e-3) CHECK(took < 12 * before);
    before = took;
  }
}

TEST_CASE("a long outline is reduced to points that surround the patch") {
  // a disc with 200 corners
  const auto disc =
      shape(moved(cylinder(0.05, 0.01, 200), Pose::turn(std::numbers::pi / 2, Vector3d::UnitY())));
  const auto plane = shape(floor_mesh);
  const Pose X_AB = Pose::translation({0, 0, 0.005 + thin});
  for (const int most : {3, 8, 20}) {
    const auto touches = contact_set(*plane, *disc, X_AB, {.max_per_patch = most});
    CHECK(static_cast<int>(touches.size()) == most);
    Vector3d middle = Vector3d::Zero();
    for (const Touch& t : touches) {
      CHECK(t.p_a.head<2>().norm() == doctest::Approx(0.05));
      middle += t.p_a / most;
    }
    CHECK(middle.norm() < 0.02);  // three of them at least 90 degrees apart
  }
}

TEST_CASE("a hundred contacts of one pair are bit-identical") {
  const auto a = shape(subdivided(test::box(0.06, 0.04, 0.02), 3)),
             b = shape(test::ball(0.03, 24, 48));
  const Pose X_AB = Pose::translation({0.001, 0.002, 0.04 + thin});
  const auto first = contact_set(*a, *b, X_AB);
  for (int i = 0; i < 100; ++i) {
    const auto again = contact_set(*a, *b, X_AB);
    REQUIRE(again.size() == first.size());
    for (size_t k = 0; k < first.size(); ++k) {
      CHECK(again[k].p_a == first[k].p_a);
      CHECK(again[k].normal_b == first[k].normal_b);
    }
  }
}

TEST_CASE("bad options are rejected by name and value") {
  const auto box = shape(test::box(0.1, 0.1, 0.1));
  const auto refuse = [&](const TouchOptions& options, const char* message) {
    CHECK_THROWS_WITH_AS(contact_set(*box, *box, Pose(), options), message, Error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse({.threshold = -1}, "contact set: threshold must be >= 0 [m], got -1");
  refuse({.threshold = nan}, "contact set: threshold must be >= 0 [m], got nan");
  refuse({.merge_radius = -0.5}, "contact set: merge_radius must be >= 0 [m], got -0.5");
  refuse({.max_per_patch = 0}, "contact set: max_per_patch must be >= 1, got 0");
}
