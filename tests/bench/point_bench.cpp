#include "bench/point_bench.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "bench/peers.h"
#include "clench/base/random.h"
#include "clench/geometry/query/triangle.h"
#include "clench/geometry/tree/tree.h"
#include "clench/io/mesh/mesh_files.h"
#include "clench/io/mesh/write_mesh.h"
#include "support/meshes.h"

namespace clench::bench {

void measure_points(const std::string& name, const Shape& shape, int count, Report& report) {
  std::vector<std::pair<std::string, std::unique_ptr<PointPeer>>> others;
  for (const Peer& peer : peers())
    if (peer.point) others.emplace_back(peer.name, peer.point(shape));
  Times cold, seeded, rays;
  Random random(2);
  struct Question {
    Eigen::Vector3d p, next, aim;
  };
  for (int begin = 0; begin < count; begin += block) {
    std::vector<Question> questions;
    for (int i = 0; i < block; ++i) {
      const Eigen::Vector3d p = shape.center() + shape.radius() * random.uniform(0.5, 1.5) *
                                                     test::random_direction(random);
      const Eigen::Vector3d inside =
          shape.center() + 0.5 * shape.radius() * test::random_direction(random);
      questions.push_back(
          {p, p + 2e-4 * test::random_direction(random), (inside - p).normalized()});
    }
    std::vector<ClosestPoint> found;
    for (const auto& q : questions)
      found.push_back(timed(cold["ours"], [&] { return closest_point(shape, q.p); }));
    for (int i = 0; i < block; ++i) {
      const auto& q = questions[i];
      const ClosestPoint again =
          timed(seeded["ours"], [&] { return closest_point(shape, q.next, found[i].triangle); });
      report.check(again.distance == closest_point(shape, q.next).distance, name + " seeded point");
    }
    for (const auto& q : questions)
      timed(rays["ours"], [&] { return cast_ray(shape, q.p, q.aim); });
    for (auto& [library, other] : others) {
      for (int i = 0; i < block; ++i) {
        std::vector<double> time;
        const auto d = timed(time, [&] { return other->distance(questions[i].p); });
        if (!d) break;
        cold[library].push_back(time[0]);
        // boxes in single precision
        report.check(std::abs(*d - found[i].distance) < 1e-6 * shape.radius(),
                     name + " point: " + library);
      }
      for (const auto& q : questions) {
        std::vector<double> time;
        if (!timed(time, [&] { return other->cast(q.p, q.aim); })) break;
        rays[library].push_back(time[0]);
      }
    }
    if (begin % 100 != 0) continue;
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; shape.has_triangle(t); ++t)
      least = std::min(least, point_triangle(questions[0].p, shape.mesh().corners(t)).distance);
    report.check(least == found[0].distance, name + " point: brute force");
  }
  report.add("closest point", name, cold);
  report.add("seeded closest point", name, seeded);
  report.add("ray", name, rays);
}

void measure_building(const std::string& name, const Shape& shape, Report& report) {
  const double count = static_cast<double>(shape.mesh().triangles.size());
  Times build, bytes;
  for (int i = 0; i < 5; ++i) {
    std::vector<double> time;
    const auto again =
        timed(time, [&] { return std::make_unique<Tree>(shape.mesh(), Progress()); });
    build["ours"].push_back(time[0] / count);
    const double mesh = static_cast<double>(shape.mesh().vertices.size() * sizeof(Eigen::Vector3d) +
                                            shape.mesh().triangles.size() * sizeof(Triangle));
    bytes["ours"].push_back((static_cast<double>(again->bytes()) + mesh) / count);
  }
  report.add("build, us a triangle", name, build);
  report.add("memory, bytes a triangle", name, bytes);
}

void measure_large_mesh(int triangles, Report& report) {
  const int rings = static_cast<int>(std::sqrt(triangles / 4.0));
  const Mesh mesh = test::ball(1, rings, 2 * rings);
  const std::string name = fmt::format("{} triangles", mesh.triangles.size());
  const auto once = [&](const std::string& what, auto&& act) {
    Times seconds;
    const double start = now();
    act();
    seconds["ours"].push_back((now() - start) * 1e-6);
    report.add(what, name, seconds);
  };
  once("large mesh: ready for queries, s", [&] { Shape::make(mesh, name)->tree(); });
  for (const char* ending : {"stl", "ply"}) {
    const auto path =
        std::filesystem::temp_directory_path() / fmt::format("clench_bench_{}.{}", now(), ending);
    write_mesh(mesh, path);
    once(fmt::format("large mesh: read from {}, s", ending),
         [&] { read_mesh_file(path, ReadOptions{}); });
    std::filesystem::remove(path);
  }
}

}  // namespace clench::bench
