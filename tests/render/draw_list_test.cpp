#include "clench/render/mesh/draw_list.h"

#include <limits>
#include <numbers>

#include "clench/render/mesh/pieces.h"
#include "pictures.h"

using namespace clench;
using namespace clench::test;

namespace {

Scene one_box() {
  Scene scene;
  scene.meshes.push_back(solid(box(2, 1, 1), {1, 0.5f, 0}, Pose::translation({5, 6, 7})));
  return scene;
}

double area(const DrawList& list, const Batch& batch) {
  double sum = 0;
  for (int i = batch.first; i < batch.first + batch.count; i += 3) {
    const auto p = [&](int k) { return list.corners[list.indices[i + k]].p.cast<double>().eval(); };
    sum += (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("a scene is moved to its center and divided by its radius") {
  const DrawList list = make_draw_list(one_box());
  CHECK(list.center == Eigen::Vector3d(5, 6, 7));
  CHECK(list.scale == doctest::Approx(std::sqrt(1.5)));
  double most = 0;
  for (const Corner& corner : list.corners) {
    CHECK(corner.n.norm() == doctest::Approx(1));
    // (1, 0.5, 0) on a screen has the linear brightness 0.012 + 0.988 x^2.2, in units of 1/65535
    CHECK(corner.paint == Paint{65535, 14878, 786, 65535});
    most = std::max<double>(most, corner.p.norm());
  }
  CHECK(most == doctest::Approx(1));
}

TEST_CASE("meshes are subdivided for light and not for shadows, with the same area") {
  const DrawList list = make_draw_list(one_box());
  REQUIRE(list.solid.size() == 1);
  const Batch& b = list.solid[0];
  CHECK(b.caster_count == 36);
  CHECK(b.count > 36 * 10);
  const double expected = 10 / (list.scale * list.scale);
  // corners are floats: seven digits
  CHECK(area(list, b) == doctest::Approx(expected).epsilon(1e-5));
  CHECK(area(list, {.first = b.first_caster, .count = b.caster_count}) ==
        doctest::Approx(expected).epsilon(1e-5));
}

TEST_CASE("solid, transparent, marked and background objects are in separate runs") {
  Scene scene = one_box();
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes[1].opacity = 0.5f;
  scene.meshes.push_back(solid(box(100, 100, 1)));
  scene.meshes[2].background = true;
  scene.cones.resize(2);
  scene.cones[0].height = scene.cones[1].height = 0.1;
  scene.cones[0].apex = scene.cones[1].apex = {5, 6, 7};
  scene.ground = 6.5;
  const DrawList list = make_draw_list(scene);
  CHECK(list.solid.size() == 1);
  CHECK(list.clear.size() == 1);
  CHECK(list.clear[0].opacity == 0.5f);
  CHECK(list.behind.size() == 1);
  CHECK(list.marks.count > 0);
  CHECK(list.floor.count == 6 * (floor_lines - 1) * (floor_lines - 1));
  CHECK(list.center == Eigen::Vector3d(5, 6, 7));
  // runs do not overlap, and consist of complete triangles
  size_t all = 0;
  for (const auto& run : {list.solid[0], list.clear[0], list.behind[0], list.marks, list.floor}) {
    CHECK(run.count % 3 == 0);
    all += run.count;
    all += run.caster_count;
  }
  CHECK(all == list.indices.size());
  CHECK(list.floor_corner + floor_lines * floor_lines == list.corners.size());
}

TEST_CASE("the farthest triangles come first") {
  Scene scene = one_box();
  scene.meshes[0].opacity = 0.5f;
  const DrawList list = make_draw_list(scene);
  const Eigen::Vector3f eye(3, -4, 2);
  Eye from;
  from.eye = eye.cast<double>();
  const auto order = back_to_front(list, from).indices;
  CHECK(order.size() == static_cast<size_t>(list.clear[0].count));
  float last = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < order.size(); i += 3) {
    const Eigen::Vector3f middle =
        (list.corners[order[i]].p + list.corners[order[i + 1]].p + list.corners[order[i + 2]].p) /
        3;
    const float distance = (middle - eye).norm();
    // the centroid is rounded in another order here: seven digits of 5
    CHECK(distance <= last + 1e-5f);
    last = distance;
  }
}

TEST_CASE("a cone has its apex, its angle and its height") {
  Scene scene;
  scene.cones.resize(1);
  DrawCone& cone = scene.cones[0];
  cone = {
      .apex = {1, 2, 3}, .axis = Eigen::Vector3d(1, 2, 2) / 3, .half_angle = 0.4, .height = 0.5};
  const auto widest = [&] {
    const DrawList list = make_draw_list(scene);
    double far = 0, wide = 0;
    for (const Corner& corner : list.corners) {
      const Eigen::Vector3d p = list.center + list.scale * corner.p.cast<double>() - cone.apex;
      far = std::max(far, p.dot(cone.axis));
      wide = std::max(wide, p.cross(cone.axis).norm());
    }
    return std::pair(far, wide);
  };
  // corners are floats: seven digits
  CHECK(widest().first == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(widest().second == doctest::Approx(0.5 * std::tan(0.4)).epsilon(1e-5));
  // a needle: thinner than its dot
  cone.half_angle = 0;
  CHECK(widest().second < 0.06);
  // very flat: still within a few heights
  cone.half_angle = 1.57;
  CHECK(widest().second < 2);
}

TEST_CASE("an arrow has the volume of its rod and its head, and ends at its tip") {
  DrawArrow arrow{.tail = {1, 2, 3}, .tip = {1, 4, 3}, .radius = 0.05};
  // the circle is a polygon: an arrow has 24 sides
  const double circle = 12 * std::sin(2 * std::numbers::pi / 24);
  for (const double length : {2.0, 0.1}) {
    arrow.tip = arrow.tail + Eigen::Vector3d(0, length, 0);
    const Piece piece = arrow_piece(arrow);
    const double head = std::min(0.35, length / 2), width = 3 * head / 7;
    double volume = 0, far = 0;
    for (const Triangle& t : piece.triangles)
      volume += (piece.p_W[t[0]] - arrow.tail)
                    .dot((piece.p_W[t[1]] - arrow.tail).cross(piece.p_W[t[2]] - arrow.tail)) /
                6;
    for (const auto& p : piece.p_W) far = std::max(far, p.y() - arrow.tail.y());
    CHECK(volume ==
          doctest::Approx(circle * (0.05 * 0.05 * (length - head) + width * width * head / 3)));
    CHECK(far == doctest::Approx(length));
  }
  arrow.tip = arrow.tail;
  CHECK(arrow_piece(arrow).triangles.empty());
}

TEST_CASE("invalid contents of a scene are rejected by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               huge = std::numeric_limits<double>::max();
  const auto with = [](auto&& change) {
    Scene scene = one_box();
    scene.cones.resize(1);
    scene.arrows.resize(1);
    scene.labels.resize(1);
    change(scene);
    make_draw_list(scene);
  };
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.meshes[0].X_WM.position.x() = nan; }),
                       "picture: mesh 1: pose must be finite numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.meshes[0].opacity = 1.5f; }),
                       "picture: mesh 1: opacity must be between 0 and 1, got 1.5", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.meshes[0].color[1] = static_cast<float>(nan); }),
                       "picture: mesh 1: color must be finite numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) {
                         s.meshes[0].triangle_colors.resize(3, {0, 0, 0});
                       }),
                       "picture: mesh 1: expected one color for each of 12 triangles, got 3",
                       Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) {
                         s.meshes[0].triangle_colors.assign(12, {0, static_cast<float>(nan), 0});
                       }),
                       "picture: mesh 1: triangle colors must be finite numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.meshes[0].X_WM.rotation.coeffs().fill(1e200); }),
                       "picture: mesh 1: position exceeds the range of numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) {
                         s.meshes.push_back(s.meshes[0]);
                         s.meshes[0].X_WM.position.fill(huge);
                         s.meshes[1].X_WM.position.fill(-huge);
                       }),
                       "picture: the size of the scene exceeds the range of numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.cones[0].apex.x() = nan; }),
                       "picture: cone 1: apex and color must be finite numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.cones[0].axis *= 2; }),
                       "picture: cone 1: axis must have length 1", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.cones[0].half_angle = 2; }),
                       "picture: cone 1: half angle must be at least 0 and less than pi/2, got 2",
                       Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.cones[0].height = -1; }),
                       "picture: cone 1: height must be >= 0, got -1 [m]", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.arrows[0].tip.x() = nan; }),
                       "picture: arrow 1: tail, tip and color must be finite numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.arrows[0].radius = 0; }),
                       "picture: arrow 1: radius must be > 0, got 0 [m]", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.labels[0].p_W.x() = nan; }),
                       "picture: label 1: place and color must be finite numbers", Error);
  CHECK_THROWS_WITH_AS(with([&](Scene& s) { s.ground = nan; }),
                       "picture: height of the ground must be a finite number", Error);
}

TEST_CASE("the largest valid shape has finite corners") {
  Scene scene = one_box();
  scene.meshes[0].shape = Shape::make(box(1e9, 1, 1));
  for (const Corner& corner : make_draw_list(scene).corners) {
    CHECK(corner.p.allFinite());
    CHECK(corner.n.allFinite());
  }
}
