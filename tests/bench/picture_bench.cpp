// Pictures of 640 x 480 in software or on the graphics card: of a world the first picture, the
// second, one after its hand has moved, and one from another side, in draft and paper quality,
// compared with the same triangles drawn once by bare OpenGL. Then frames of 1070 x 937, not read
// back: with a turning camera, and with a moving hand.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/motion/drive.h"
#include "clench/render/render.h"
#include "clench/render/renderer.h"
#include "clench/render/view/frame.h"
#include "peer_bare_gl.h"
#include "report.h"

using namespace clench;
using namespace clench::bench;

namespace {

constexpr int width = 640, height = 480;
constexpr double aspect = static_cast<double>(width) / height;

// a number of DLR hands with flasks, side by side: 31,708 triangles each
Scene hands(int count, bool moved) {
  World world = build_world(read_world("worlds/dlr_flask.wld", {.root = "."}));
  autograsp(world, world.robots()[0]);
  if (moved) {
    const auto hand = world.robots()[0];
    Eigen::VectorXd dofs = world.dofs(hand);
    dofs[1] -= 0.1;
    world.set_dofs(hand, dofs);
  }
  const Scene one = make_scene(world);
  Scene scene = one;
  for (int i = 1; i < count; ++i) {
    const Pose aside = Pose::translation({0.35 * (i % 3), 0.35 * (i / 3), 0});
    for (DrawMesh mesh : one.meshes) {
      mesh.X_WM = aside * mesh.X_WM;
      scene.meshes.push_back(std::move(mesh));
    }
    for (DrawCone cone : one.cones) {
      cone.apex = aside * cone.apex;
      scene.cones.push_back(cone);
    }
  }
  return scene;
}

int triangles(const Scene& scene) {
  int count = 0;
  for (const DrawMesh& mesh : scene.meshes)
    if (mesh.shape) count += static_cast<int>(mesh.shape->mesh().triangles.size());
  return count;
}

Scene from_aside(const Scene& scene) {
  Scene out = scene;
  Eye eye = frame_all(scene, aspect);
  eye.eye = eye.target + Pose::turn(0.5, Eigen::Vector3d::UnitZ()) * (eye.eye - eye.target);
  out.eye = eye;
  return out;
}

void measure(int count, const std::string& name, Quality quality, int rounds, Report& report) {
  const Font font;
  const RenderOptions options{.width = width, .height = height, .quality = quality};
  const std::string kind = quality == Quality::draft ? "draft" : "paper";
  const Scene scene = hands(count, false), moved = hands(count, true), aside = from_aside(scene);
  Eye eye = frame_all(scene, aspect);
  BareGl bare(scene, view_projection(eye, aspect, 0.01, 10), width, height);
  report.check(bare.draw() > width * height / 20, "the bare peer shows nothing");
  Times first, second, posed, turned;
  Renderer used;
  for (int i = 0; i < rounds; ++i) {
    Renderer fresh;
    const Picture a = timed(first["ours"], [&] { return fresh.draw(scene, options, font); });
    used.draw(scene, options, font);
    const Picture b = timed(second["ours"], [&] { return used.draw(scene, options, font); });
    report.check(a == b, name + ", " + kind + ": a used renderer draws something else");
    timed(turned["ours"], [&] { return used.draw(aside, options, font); });
    timed(posed["ours"], [&] { return used.draw(moved, options, font); });
    for (int k = 0; k < 3; ++k) timed(second["bare"], [&] { return bare.draw(); });
  }
  for (Times* times : {&first, &posed, &turned}) (*times)["bare"] = second["bare"];
  report.add("first, " + kind, name, first);
  report.add("second, " + kind, name, second);
  report.add("from aside, " + kind, name, turned);
  report.add("moved, " + kind, name, posed);
}

// frames as a viewer shows them; returns the median of bare OpenGL [ms]
double measure_frames(int count, const std::string& name, int rounds, Report& report) {
  constexpr int wide = 1070, high = 937;
  constexpr double ratio = static_cast<double>(wide) / high;
  const RenderOptions options{.width = wide, .height = high, .quality = Quality::draft};
  const Scene scene = hands(count, false), moved = hands(count, true);
  const Eye from = frame_all(scene, ratio);
  Eye eye = from;
  BareGl bare(scene, view_projection(eye, ratio, 0.01, 10), wide, high);
  report.check(bare.draw() > wide * high / 20, "the bare peer shows nothing");
  Renderer renderer;
  Times turned, posed;
  const auto draw = [&](const Scene& what) {
    renderer.draw_to({}, what, eye, options);
    renderer.finish();
    return true;
  };
  draw(scene);
  for (int i = 0; i < rounds; ++i) {
    const Pose turn = Pose::turn(0.05 * (i + 1), Eigen::Vector3d::UnitZ());
    eye.eye = from.target + turn * (from.eye - from.target);
    timed(turned["ours"], [&] { return draw(scene); });
    timed(posed["ours"], [&] { return draw(i % 2 ? scene : moved); });
    timed(turned["bare"], [&] {
      bare.draw_frame(view_projection(eye, ratio, 0.01, 10));
      return true;
    });
  }
  draw(scene);
  Scene there = scene;
  there.eye = eye;
  report.check(renderer.read() == Renderer().draw(there, options, Font()),
               name + ": the last frame differs from its picture");
  posed["bare"] = turned["bare"];
  report.add("frame, camera turns", name, turned);
  report.add("frame, hand moves", name, posed);
  std::vector<double>& times = turned["bare"];
  std::ranges::nth_element(times, times.begin() + times.size() / 2);
  return times[times.size() / 2] / 1000;
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = read_options(argc, argv, "bench_picture");
  if (!options) return 2;
  const auto [brief, check, csv] = *options;
  Report report;
  const int few = triangles(hands(1, false)), many = triangles(hands(9, false));
  const std::string small = fmt::format("{} triangles", few),
                    large = fmt::format("{} triangles", many);
  for (const Quality quality : {Quality::draft, Quality::paper}) {
    measure(1, small, quality, brief ? 1 : 7, report);
    if (!brief) measure(9, large, quality, 5, report);
  }
  const double bare_frame = measure_frames(1, small, brief ? 2 : 60, report);
  if (!brief) measure_frames(9, large, 30, report);
  report.print({"ours", "bare"});
  std::vector<Aim> aims;
  const auto aim = [&](const std::string& query, const std::string& pair, double must) {
    aims.push_back({query + ", " + pair + " [ms]", report.median(query, pair) / 1000, must, true});
  };
  aim("second, draft", small, 40);
  aim("moved, draft", small, 40);
  aim("second, paper", small, 1000);
  if (!brief) {
    aim("second, draft", large, 150);
    aim("moved, draft", large, 150);
    aim("second, paper", large, 1000);
  }
  // relative to drawing the triangles once by bare OpenGL: geometric mean over the worlds
  aims.push_back(
      {"second draft / bare", 1 / report.ratio("second, draft", "bare", "second, draft"), 8, true});
  aims.push_back({"second paper / bare", 1 / report.ratio("second, paper", "bare", "second, paper"),
                  60, true});
  // 24 frames per second, or a quarter of the rate of bare OpenGL
  aim("frame, camera turns", small, std::max(1000.0 / 24, 4 * bare_frame));
  const bool good = report.judge(aims);
  const bool written = csv.empty() || report.write_csv(csv);
  return written && (good || !check) ? 0 : 1;
}
