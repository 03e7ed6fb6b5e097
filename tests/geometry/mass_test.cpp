#include "clench/geometry/mesh/mass.h"

#include <doctest/doctest.h>

#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST_CASE("a box has the volume, center and inertia of the formulas at any position") {
  Random random(1);
  const Vector3d size(0.1, 0.25, 0.4);
  const Vector3d squares = size.cwiseAbs2();
  const Matrix3d inertia =
      (squares.sum() * Vector3d::Ones() - squares).asDiagonal() * Matrix3d::Identity() / 12;
  for (int i = 0; i < 50; ++i) {
    const Pose X = random_pose(random, i < 25 ? 0.5 : 100);
    const MassProperties m = solid_mass(moved(box(size.x(), size.y(), size.z()), X));
    // corners are rounded to 1e-14 m at 100 m: 1e-13 of the size
    CHECK(m.volume == doctest::Approx(size.prod()).epsilon(1e-11));
    CHECK((m.centroid - X.position).norm() < 1e-12);
    const Matrix3d turned = X.matrix() * inertia * X.matrix().transpose();
    CHECK((m.inertia - turned).norm() < 1e-11 * inertia.norm());
  }
}

TEST_CASE("refined balls converge to the formulas with the square of the edge length") {
  const double pi = std::numbers::pi;
  double last = 1;
  for (const int rings : {8, 16, 32, 64}) {
    const MassProperties m = solid_mass(ball(2, rings, 2 * rings));
    const double off = std::abs(m.volume / (4.0 / 3 * pi * 8) - 1);
    CHECK(off < 0.3 * last);  // a quarter, in the limit
    last = off;
    CHECK(m.centroid.norm() < 1e-14 * rings);
    CHECK((m.inertia / (0.4 * 4) - Matrix3d::Identity()).norm() < 4 * off);
  }
  CHECK(last < 2e-3);
}

TEST_CASE("parts add up: volumes, and centers weighted by volume") {
  Random random(2);
  const Pose A = random_pose(random, 1), B = random_pose(random, 1);
  const Mesh a = moved(box(1, 2, 3), A), b = moved(ball(0.7), B);
  const MassProperties ma = solid_mass(a), mb = solid_mass(b), both = solid_mass(joined(a, b));
  CHECK(both.volume == doctest::Approx(ma.volume + mb.volume).epsilon(1e-13));
  const Vector3d center = (ma.volume * ma.centroid + mb.volume * mb.centroid) / both.volume;
  CHECK((both.centroid - center).norm() < 1e-14);
  // parallel axis theorem
  Matrix3d inertia = Matrix3d::Zero();
  for (const MassProperties& m : {ma, mb}) {
    const Vector3d r = m.centroid - center;
    inertia += m.volume / both.volume *
               (m.inertia + r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  }
  CHECK((both.inertia - inertia).norm() < 1e-14);
}

TEST_CASE("inversion changes only the sign of the volume") {
  const Mesh mesh = moved(box(1, 2, 3), Pose::translation({1, 2, 3}));
  const MassProperties m = solid_mass(mesh), turned = solid_mass(inverted(mesh));
  CHECK(turned.volume == doctest::Approx(-6));
  CHECK((m.centroid - turned.centroid).norm() < 1e-14);
  CHECK((m.inertia - turned.inertia).norm() < 1e-14);
}

TEST_CASE("a flat sheet has no volume, and its center is that of its surface") {
  Mesh sheet;
  sheet.vertices = {{1, 1, 5}, {3, 1, 5}, {3, 2, 5}, {1, 2, 5}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MassProperties m = solid_mass(sheet);
  CHECK(m.volume == 0);
  CHECK((m.centroid - Vector3d(2, 1.5, 5)).norm() < 1e-14);
  CHECK(m.inertia.isZero(0));
}

TEST_CASE("the center of the surface weights triangles by area") {
  // two distant squares of areas 1 and 3
  Mesh mesh;
  mesh.vertices = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},
                   {10, 0, 0}, {13, 0, 0}, {13, 1, 0}, {10, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  CHECK((surface_centroid(mesh) - Vector3d((0.5 + 3 * 11.5) / 4, 0.5, 0)).norm() < 1e-14);
  Mesh point;
  point.vertices = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  point.triangles = {{0, 1, 2}};
  CHECK(surface_centroid(point) == Vector3d(1, 2, 3));
  CHECK(surface_centroid(Mesh()) == Vector3d::Zero());
}

TEST_CASE("the maximal radius is that of the farthest corner of any triangle") {
  Mesh mesh = box(2, 4, 4);
  CHECK(largest_radius(mesh, {0, 0, 0}) == 3);
  CHECK(largest_radius(mesh, {-1, -2, -2}) == 6);
  mesh.vertices.push_back({100, 0, 0});
  CHECK(largest_radius(mesh, {0, 0, 0}) == 3);
}
