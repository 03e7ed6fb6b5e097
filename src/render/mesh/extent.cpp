#include "clench/render/mesh/extent.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "clench/render/mesh/pieces.h"

namespace clench {
namespace {

template <class Use>
void each_vertex(const DrawMesh& mesh, Use&& use) {
  const Eigen::Matrix3d R = mesh.X_WM.rotation.toRotationMatrix();
  for (const auto& p : mesh.shape->mesh().vertices)
    use(Eigen::Vector3d(R * p + mesh.X_WM.position));
}

// upper bound on the distance of its vertices from the center, in units of the ball, with slack for
// the rounding of positions far from the origin
double reach_of(const DrawMesh& mesh, const BallAround& ball) {
  const Eigen::Vector3d middle = mesh.X_WM * mesh.shape->center();
  const double reach = (middle - ball.center()).norm() + mesh.shape->radius(),
               far = middle.norm() + ball.center().norm() + mesh.shape->center().norm();
  return ball.unit() * ((1 + 1e-9) * reach + 1e-13 * far);
}

}  // namespace

Eye Extent::to_scene(const Eye& world) const {
  Eye out = world;
  out.eye = (world.eye - center) / scale;
  out.target = (world.target - center) / scale;
  out.ortho_height = world.ortho_height / scale;
  return out;
}

const Bounds& ExtentFinder::bounds_of(const Scene& scene, size_t i) {
  const DrawMesh& mesh = scene.meshes[i];
  Kept& kept = kept_[i];
  if (kept.shape == mesh.shape && kept.X_WM.position == mesh.X_WM.position &&
      kept.X_WM.rotation.coeffs() == mesh.X_WM.rotation.coeffs())
    return kept.bounds;
  kept.shape.reset();
  kept.bounds = {};
  each_vertex(mesh, [&](const Eigen::Vector3d& p_W) {
    if (!p_W.allFinite()) fail("picture: mesh {}: position exceeds the range of numbers", i + 1);
    kept.bounds.add(p_W);
  });
  kept.shape = mesh.shape, kept.X_WM = mesh.X_WM;
  return kept.bounds;
}

std::optional<Extent> ExtentFinder::find(const Scene& scene, bool background,
                                         const std::vector<Eigen::Vector3d>& marks) {
  Bounds all;
  std::vector<const DrawMesh*> meshes;
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const DrawMesh& mesh = scene.meshes[i];
    if (!mesh.shape || mesh.opacity == 0 || mesh.background != background) continue;
    const Bounds& bounds = bounds_of(scene, i);
    if (bounds.empty()) continue;
    all.add(bounds.low), all.add(bounds.high);
    meshes.push_back(&mesh);
  }
  for (const auto& p : marks) all.add(p);
  if (all.empty()) return std::nullopt;

  BallAround ball(all);
  for (const auto& p : marks) ball.add(p);
  // meshes that may reach farthest come first, so that the vertices of most need not be visited
  std::vector<std::pair<double, const DrawMesh*>> order;
  for (const DrawMesh* mesh : meshes) order.push_back({reach_of(*mesh, ball), mesh});
  std::ranges::stable_sort(order, std::ranges::greater{},
                           &std::pair<double, const DrawMesh*>::first);
  for (const auto& [reach, mesh] : order) {
    if (reach * reach < ball.farthest()) break;
    each_vertex(*mesh, [&](const Eigen::Vector3d& p_W) { ball.add(p_W); });
  }
  return ball.extent();
}

Extent ExtentFinder::find(const Scene& scene) {
  std::vector<Eigen::Vector3d> marks;
  const auto append = [&](const Piece& piece) {
    marks.insert(marks.end(), piece.p_W.begin(), piece.p_W.end());
  };
  for (const DrawCone& cone : scene.cones) append(cone_piece(cone));
  for (const DrawArrow& arrow : scene.arrows) append(arrow_piece(arrow));
  kept_.resize(scene.meshes.size());
  if (const auto bodies = find(scene, false, marks)) return *bodies;
  return find(scene, true, marks).value_or(Extent{});
}

}  // namespace clench
