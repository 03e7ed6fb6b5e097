#include "clench/render/mesh/refine.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "clench/base/random.h"
#include "clench/render/mesh/draw_list.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

static std::vector<Corner> corners_of(const Mesh& mesh) {
  std::vector<Corner> corners;
  for (const Triangle& t : mesh.triangles)
    for (const int v : t)
      corners.push_back({mesh.vertices[v].cast<float>(), {0, 0, 1}, {1, 2, 3, 4}});
  return corners;
}

TEST_CASE("no edge within the ball is longer than requested, and no crack opens") {
  const auto fine = split_long_edges(corners_of(box(1, 0.8, 0.1)), 0.07f);
  using Point = std::tuple<float, float, float>;
  std::map<std::pair<Point, Point>, int> edges;
  for (size_t i = 0; i < fine.size(); i += 3)
    for (int k = 0; k < 3; ++k) {
      const auto &a = fine[i + k].p, &b = fine[i + (k + 1) % 3].p;
      CHECK((a - b).norm() <= 0.07f * 1.0001f);
      ++edges[{{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}}];
    }
  // a closed mesh stays closed: each edge occurs once in each direction
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
}

TEST_CASE("a floor far larger than the scene is fine near the scene") {
  const auto corners = corners_of(box(100, 100, 0.01));
  CHECK(affordable_length(corners, 0.07f, 200000) == 0.07f);
  const auto fine = split_long_edges(corners, 0.07f);
  CHECK(fine.size() / 3 < 200000);
  for (size_t i = 0; i < fine.size(); i += 3) {
    const Eigen::Vector3f middle = (fine[i].p + fine[i + 1].p + fine[i + 2].p) / 3;
    if (middle.norm() < 0.9f) CHECK((fine[i].p - fine[i + 1].p).norm() <= 0.07f * 1.0001f);
  }
}

TEST_CASE("a mesh that would have too many triangles keeps longer edges") {
  const auto corners = corners_of(ball(1, 60, 120));
  const auto fine = split_long_edges(corners, affordable_length(corners, 0.001f, 20000));
  CHECK(fine.size() >= corners.size());
  CHECK(fine.size() / 3 <= 20000);
  const float no_longer = affordable_length(corners, 0.001f, 10);
  CHECK(split_long_edges(corners, no_longer).size() >= corners.size());
}

TEST_CASE("equal corners are shared, in the order of their first occurrence") {
  DrawList list;
  const auto corners = corners_of(box(1, 1, 1));
  append_shared(corners, list.corners, list.indices);
  CHECK(list.corners.size() == 8);
  REQUIRE(list.indices.size() == 36);
  uint32_t next = 0;
  for (size_t i = 0; i < 36; ++i) {
    CHECK(list.corners[list.indices[i]].p == corners[i].p);
    CHECK(list.indices[i] <= next);
    next = std::max(next, list.indices[i] + 1);
  }
  // a second piece does not mix with the first
  append_shared(corners, list.corners, list.indices);
  CHECK(list.corners.size() == 16);
  CHECK(list.indices[36] == 8);
}
