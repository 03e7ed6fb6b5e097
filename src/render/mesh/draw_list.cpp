#include "clench/render/mesh/draw_list.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "clench/render/mesh/corner_normals.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/mesh/refine.h"

namespace clench {
namespace {

// across which light is interpolated [scene units]: of what is solid, and of what is seen through
constexpr float longest_edge = 0.07f, longest_clear_edge = 0.2f;
// of one piece, by splitting; what comes with more keeps them
constexpr size_t max_triangles = 200000;

Extent extent_of_pieces(std::span<const Piece> pieces) {
  const auto ball = ball_around([&](const auto& what) {
    for (const Piece& piece : pieces)
      for (const auto& p : piece.p_W) what(p);
  });
  return ball.value_or(Extent{});
}

Batch append(Piece& piece, DrawList& list) {
  for (auto& p : piece.p_W) p = (p - list.center) / list.scale;
  const auto normals = corner_normals(piece.p_W, piece.triangles);
  std::vector<Paint> paints;
  for (const auto& color : piece.colors) paints.push_back(make_paint(color, piece.opacity));
  std::vector<Corner> corners;
  for (size_t i = 0; i < piece.triangles.size(); ++i) {
    if (normals[i][0].isZero()) continue;
    const Paint& paint = paints[paints.size() == 1 ? 0 : i];
    for (int k = 0; k < 3; ++k)
      corners.push_back({piece.p_W[piece.triangles[i][k]].cast<float>(), normals[i][k], paint});
  }
  const float longest = piece.opacity < solid_from ? longest_clear_edge : longest_edge;
  const auto fine = piece.mark ? corners : split_long_edges(corners, longest, max_triangles);
  Batch batch{.opacity = piece.opacity, .closed = piece.closed};
  if (const auto ball = ball_around([&](const auto& what) {
        for (const auto& p : piece.p_W) what(p);
      }))
    batch.center = ball->center, batch.radius = ball->scale;
  batch.first_caster = static_cast<int>(list.indices.size());
  if (piece.mark || piece.background) corners.clear();
  batch.caster_count = static_cast<int>(corners.size());
  batch.first = batch.first_caster + batch.caster_count;
  batch.count = static_cast<int>(fine.size());
  // corners as they are remain corners when they are split
  corners.insert(corners.end(), fine.begin(), fine.end());
  append_shared(corners, list.corners, list.indices);
  return batch;
}

// lines close together below the scene and ever farther apart outside
void append_floor(DrawList& list) {
  constexpr int lines = floor_lines;
  constexpr double bend = 3.6;
  const auto at = [](int i) {
    const double t = 2.0 * i / (lines - 1) - 1;
    return static_cast<float>(floor_reach * std::sinh(bend * t) / std::sinh(bend));
  };
  list.floor.first = static_cast<int>(list.indices.size());
  const auto base = static_cast<uint32_t>(list.corners.size());
  for (int y = 0; y < lines; ++y)
    for (int x = 0; x < lines; ++x)
      list.corners.push_back({{at(x), at(y), static_cast<float>(*list.ground)}, {0, 0, 1}, {}});
  for (int y = 0; y + 1 < lines; ++y)
    for (int x = 0; x + 1 < lines; ++x) {
      const uint32_t a = base + y * lines + x, b = a + 1, c = a + lines, d = c + 1;
      list.indices.insert(list.indices.end(), {a, b, d, a, d, c});
    }
  list.floor.count = static_cast<int>(list.indices.size()) - list.floor.first;
}

}  // namespace

DrawList make_draw_list(const Scene& scene) {
  check(scene);
  // in this order: solid, seen through, marks, background
  std::vector<Piece> pieces, clear, behind;
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const DrawMesh& m = scene.meshes[i];
    if (!m.shape || m.opacity == 0) continue;
    auto& group = m.background ? behind : m.opacity >= solid_from ? pieces : clear;
    group.push_back(mesh_piece(m, i + 1));
  }
  const size_t first_clear = pieces.size(), first_mark = first_clear + clear.size(),
               first_behind = first_mark + scene.cones.size() + scene.arrows.size();
  for (Piece& piece : clear) pieces.push_back(std::move(piece));
  for (const DrawCone& c : scene.cones) pieces.push_back(cone_piece(c));
  for (const DrawArrow& a : scene.arrows) pieces.push_back(arrow_piece(a));
  for (Piece& piece : behind) pieces.push_back(std::move(piece));

  const size_t counted = first_behind > 0 ? first_behind : pieces.size();
  DrawList list;
  static_cast<Extent&>(list) = extent_of_pieces(std::span(pieces).first(counted));
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Batch batch = append(pieces[i], list);
    if (i < first_clear)
      list.solid.push_back(batch);
    else if (i < first_mark)
      list.clear.push_back(batch);
    else if (i == first_mark && i < first_behind)
      list.marks = batch;
    else if (i < first_behind)
      list.marks.count += batch.count;
    else
      list.behind.push_back(batch);
  }
  list.floor_corner = list.corners.size();
  if (scene.ground) {
    list.ground = (*scene.ground - list.center.z()) / list.scale;
    // so far away that it is not in any picture
    if (std::abs(*list.ground) > floor_reach)
      list.ground.reset();
    else
      append_floor(list);
  }
  return list;
}

std::vector<uint32_t> back_to_front(const DrawList& list, const Eye& eye) {
  const Eigen::Vector3f from = eye.eye.cast<float>(),
                        away = (eye.eye - eye.target).normalized().cast<float>();
  std::vector<std::pair<float, uint32_t>> order;
  const auto add = [&](const Batch& batch) {
    for (int at = batch.first; at < batch.first + batch.count; at += 3) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int k = 0; k < 3; ++k) sum += list.corners[list.indices[at + k]].p;
      order.push_back({eye.ortho_height > 0 ? away.dot(sum) : -(sum / 3 - from).squaredNorm(),
                       static_cast<uint32_t>(at)});
    }
  };
  for (const Batch& batch : list.clear) add(batch);
  std::sort(order.begin(), order.end());
  std::vector<uint32_t> out;
  for (const auto& [depth, at] : order)
    out.insert(out.end(), &list.indices[at], &list.indices[at] + 3);
  return out;
}

}  // namespace clench
