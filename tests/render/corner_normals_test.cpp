#include "clench/render/mesh/corner_normals.h"

#include <numbers>

#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

static std::vector<std::array<Eigen::Vector3f, 3>> normals_of(const Mesh& mesh) {
  return corner_normals(mesh.vertices, mesh.triangles);
}

TEST_CASE("a ball is smooth: its normals point away from its center") {
  const Mesh mesh = ball(2, 24, 48);
  const auto normals = normals_of(mesh);
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d out = mesh.vertices[mesh.triangles[i][k]] / 2;
      // facets of 7.5 degrees: the error of their mean is less than a quarter of that, 0.03 rad
      CHECK(normals[i][k].cast<double>().dot(out) > std::cos(0.03));
    }
}

TEST_CASE("a box is sharp: each corner has its face's normal") {
  const Mesh mesh = box(1, 2, 3);
  const auto normals = normals_of(mesh);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.corners(static_cast<int>(i));
    const Eigen::Vector3f face = (b - a).cross(c - a).normalized().cast<float>();
    for (const auto& n : normals[i]) CHECK((n - face).norm() < 1e-6);
  }
}

TEST_CASE(
    "a triangle with reversed orientation has the opposite normals, and its neighbors are "
    "unaffected") {
  Mesh mesh = ball(1);
  const auto before = normals_of(mesh);
  std::swap(mesh.triangles[100][1], mesh.triangles[100][2]);
  const auto after = normals_of(mesh);
  CHECK((after[100][0] + before[100][0]).norm() < 1e-5);
  CHECK((after[100][1] + before[100][2]).norm() < 1e-5);
  CHECK((after[100][2] + before[100][1]).norm() < 1e-5);
  for (size_t i = 0; i < before.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (i != 100) CHECK((after[i][k] - before[i][k]).norm() < 1e-5);
}

TEST_CASE("triangles without area have no normal and do not affect others") {
  Mesh mesh = ball(1);
  const auto before = normals_of(mesh);
  const size_t count = mesh.triangles.size();
  mesh.triangles.push_back({5, 5, 6});
  mesh.triangles.push_back({7, 7, 7});
  const auto after = normals_of(mesh);
  for (size_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) CHECK(after[i][k] == before[i][k]);
  for (size_t i = count; i < after.size(); ++i)
    for (const auto& n : after[i]) CHECK(n.isZero());
}

TEST_CASE("the center of a huge fan costs no more than its triangles") {
  // a fan of 200,000: quadratic time would take minutes
  Mesh mesh;
  const int count = 200000;
  mesh.vertices.push_back({0, 0, 0.5});
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  const auto normals = normals_of(mesh);
  for (int i = 0; i < count; i += 1000)
    for (const auto& n : normals[i]) CHECK(n.norm() == doctest::Approx(1));
}
