#include "clench/render/mesh/draw_list.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "clench/render/mesh/corner_normals.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/mesh/refine.h"

namespace clench {
namespace {

// maximum edges, over which light is interpolated [scene units]: of opaque and of transparent
// surfaces
constexpr float longest_edge = 0.07f, longest_clear_edge = 0.2f;
// maximum number of triangles of a piece after splitting; larger pieces are not split
constexpr size_t max_triangles = 200000;

Extent extent_of_pieces(std::span<const Piece> pieces) {
  const auto ball = ball_around([&](const auto& what) {
    for (const Piece& piece : pieces)
      for (const auto& p : piece.p_W) what(p);
  });
  return ball.value_or(Extent{});
}

// refines the corners of each texture, which end at `ends`; updates the ends to those of the result
std::vector<Corner> refined(const Piece& piece, const std::vector<Corner>& corners,
                            std::vector<size_t>& ends) {
  if (piece.mark) return corners;
  const float longest = affordable_length(
      corners, piece.opacity < solid_from ? longest_clear_edge : longest_edge, max_triangles);
  if (ends.size() == 1) {
    std::vector<Corner> out = split_long_edges(corners, longest);
    ends[0] = out.size();
    return out;
  }
  std::vector<Corner> out;
  size_t first = 0;
  for (size_t t = 0; t < ends.size(); ++t) {
    const auto at = corners.begin();
    const auto part = split_long_edges(
        {at + static_cast<long>(first), at + static_cast<long>(ends[t])}, longest, t > 0);
    out.insert(out.end(), part.begin(), part.end());
    first = std::exchange(ends[t], out.size());
  }
  return out;
}

Batch append(Piece& piece, DrawList& list) {
  for (auto& p : piece.p_W) p = (p - list.center) / list.scale;
  const auto normals = corner_normals(piece.p_W, piece.triangles);
  std::vector<Paint> paints;
  for (const auto& color : piece.colors) paints.push_back(make_paint(color, piece.opacity));
  const TextureOrder order(piece.triangles.size(), piece.skin);
  std::vector<Corner> corners;
  std::vector<size_t> ends;  // ends of the corners of each texture
  size_t next = 0;
  for (const size_t count : order.counts) {
    for (const size_t end = next + count; next < end; ++next) {
      const int i = order.triangles[next];
      if (normals[i][0].isZero()) continue;
      for (int k = 0; k < 3; ++k)
        corners.push_back({piece.p_W[piece.triangles[i][k]].cast<float>(), normals[i][k],
                           ends.empty() ? paints[paints.size() == 1 ? 0 : i]
                                        : paint_of_place(piece.skin->triangles[i].uv[k])});
    }
    ends.push_back(corners.size());
  }
  Batch batch{.opacity = piece.opacity, .closed = piece.closed};
  const std::vector<Corner> fine = refined(piece, corners, ends);
  if (const auto ball = ball_around([&](const auto& what) {
        for (const auto& p : piece.p_W) what(p);
      }))
    batch.center = ball->center, batch.radius = ball->scale;
  batch.first_caster = static_cast<int>(list.indices.size());
  if (piece.mark || piece.background) corners.clear();
  batch.caster_count = static_cast<int>(corners.size());
  batch.first = batch.first_caster + batch.caster_count;
  batch.count = static_cast<int>(fine.size());
  batch.plain_count = static_cast<int>(ends[0]);
  for (size_t t = 1; t < ends.size(); ++t)
    if (ends[t] > ends[t - 1])
      batch.textured.push_back({batch.first + static_cast<int>(ends[t - 1]),
                                static_cast<int>(ends[t] - ends[t - 1]),
                                static_cast<int>(list.textures.size() + t - 1), piece.opacity});
  if (piece.skin)
    list.textures.insert(list.textures.end(), piece.skin->textures.begin(),
                         piece.skin->textures.end());
  // original corners remain corners when triangles are split
  corners.insert(corners.end(), fine.begin(), fine.end());
  append_shared(corners, list.corners, list.indices);
  return batch;
}

// lines close together below the scene and increasingly farther apart outside
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
  // in this order: opaque, transparent, marks, background
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
    // too far away to be in any picture
    if (std::abs(*list.ground) > floor_reach)
      list.ground.reset();
    else
      append_floor(list);
  }
  return list;
}

// index runs of all batches, each of one texture
static std::vector<TexturedRun> runs_of(const std::vector<Batch>& batches) {
  std::vector<TexturedRun> runs;
  for (const Batch& batch : batches) {
    runs.push_back({batch.first, batch.plain_count, -1, batch.opacity});
    runs.insert(runs.end(), batch.textured.begin(), batch.textured.end());
  }
  std::erase_if(runs, [](const TexturedRun& run) { return run.count == 0; });
  return runs;
}

SortedTriangles back_to_front(const DrawList& list, const Eye& eye) {
  const Eigen::Vector3f from = eye.eye.cast<float>(),
                        away = (eye.eye - eye.target).normalized().cast<float>();
  struct Item {
    float depth;
    uint32_t at, run;
  };
  const std::vector<TexturedRun> runs = runs_of(list.clear);
  std::vector<Item> order;
  for (uint32_t r = 0; r < runs.size(); ++r)
    for (int at = runs[r].first; at < runs[r].first + runs[r].count; at += 3) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int k = 0; k < 3; ++k) sum += list.corners[list.indices[at + k]].p;
      order.push_back({eye.ortho_height > 0 ? away.dot(sum) : -(sum / 3 - from).squaredNorm(),
                       static_cast<uint32_t>(at), r});
    }
  std::sort(order.begin(), order.end(), [](const Item& a, const Item& b) {
    return std::pair(a.depth, a.at) < std::pair(b.depth, b.at);
  });
  SortedTriangles out;
  for (const Item& item : order) {
    TexturedRun run = runs[item.run];
    run.first = static_cast<int>(out.indices.size()), run.count = 3;
    const bool goes_on = !out.runs.empty() && out.runs.back().texture == run.texture &&
                         (run.texture < 0 || out.runs.back().opacity == run.opacity);
    if (goes_on)
      out.runs.back().count += 3;
    else
      out.runs.push_back(run);
    out.indices.insert(out.indices.end(), &list.indices[item.at], &list.indices[item.at] + 3);
  }
  return out;
}

}  // namespace clench
