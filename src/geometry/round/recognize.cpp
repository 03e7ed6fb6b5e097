#include "clench/geometry/round/recognize.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/geometry/mesh/mass.h"
#include "clench/geometry/mesh/parts.h"
#include "clench/geometry/mesh/principal_axes.h"
#include "clench/math/axes.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

static constexpr double filled = 0.95, exact = 1e-6;

static double volume_of(const Round& round) {
  const double r = round.radii.x(), middle = pi * r * r * 2 * round.half;
  return round.kind == Round::cylinder ? middle : middle + 4 * pi / 3 * r * r * r;
}

static double size_of(const Round& round) { return round.radii.maxCoeff() + round.half; }

bool lies_on(const Mesh& mesh, const RoundPiece& piece) {
  const Pose into = piece.X_SR.inverse();
  for (int i = piece.first; i < piece.first + piece.count; ++i)
    for (const Vector3d& p : mesh.corners(i))
      if (!(std::abs(nearest(piece.solid, into * p).distance) <= exact * size_of(piece.solid)))
        return false;
  return true;
}

// Do all vertices of the mesh lie on the solid, and does the mesh fill it?
static bool stands_for(const Mesh& mesh, double volume, const RoundPiece& piece) {
  return piece.solid.radii.x() > 0 && volume >= filled * volume_of(piece.solid) &&
         lies_on(mesh, piece);
}

static std::optional<RoundPiece> ball_of(const Mesh& mesh, const Bounds& bounds) {
  const Vector3d size = bounds.size();
  if (size.minCoeff() < 0.9 * size.maxCoeff()) return std::nullopt;
  // |v|^2 = 2 c.v + (r^2 - |c|^2), by least squares about the middle of the box
  const Vector3d middle = bounds.center();
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (const Vector3d& vertex : mesh.vertices) {
    const Vector3d v = vertex - middle;
    const Eigen::Vector4d row(2 * v.x(), 2 * v.y(), 2 * v.z(), 1);
    A += row * row.transpose();
    b += v.squaredNorm() * row;
  }
  const Eigen::Vector4d x = A.ldlt().solve(b);
  const Vector3d center = x.head<3>();
  return RoundPiece{.solid = Round::ball(std::sqrt(x[3] + center.squaredNorm())),
                    .X_SR = Pose::translation(middle + center)};
}

// The cylinder or capsule about an axis through the centroid that extends to the farthest vertices.
static RoundPiece about_axis(const Mesh& mesh, const Vector3d& centroid, const Vector3d& axis,
                             Round::Kind kind) {
  double low = 0, high = 0, radius = 0;
  for (const Vector3d& v : mesh.vertices) {
    const Vector3d from = v - centroid;
    const double along = axis.dot(from);
    low = std::min(low, along), high = std::max(high, along);
    radius = std::max(radius, (from - along * axis).norm());
  }
  const double length = kind == Round::cylinder ? high - low : high - low - 2 * radius;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis);
  return {.solid = kind == Round::cylinder ? Round::cylinder_of(radius, length)
                                           : Round::capsule_of(radius, std::max(length, 0.0)),
          .X_SR = {turn, centroid + (low + high) / 2 * axis}};
}

// Candidates for an axis of symmetry: the principal axes of the solid, the vertices and the faces.
// If two principal moments of one of them are equal, those of another may differ.
static std::vector<Vector3d> axes_of(const Mesh& mesh, const MassProperties& solid) {
  Matrix3d points = Matrix3d::Zero(), faces = Matrix3d::Zero();
  for (const Vector3d& v : mesh.vertices)
    points += (v - solid.centroid) * (v - solid.centroid).transpose();
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    const auto c = mesh.corners(i);
    const Vector3d area = (c[1] - c[0]).cross(c[2] - c[0]);
    if (area.norm() > 0) faces += area * area.transpose() / area.norm();
  }
  std::vector<Vector3d> out;
  for (const Matrix3d& matrix : {solid.inertia, points, faces}) {
    const Matrix3d axes = principal_axes(matrix);
    for (int k = 0; k < 3; ++k) out.push_back(axes.col(k));
  }
  return out;
}

std::optional<RoundPiece> round_of(const Mesh& mesh) {
  if (mesh.vertices.size() < 12) return std::nullopt;
  const MassProperties solid = solid_mass(mesh);
  if (!(solid.volume > 0)) return std::nullopt;
  const Bounds bounds = mesh.bounds();
  const auto accepted = [&](RoundPiece piece) -> std::optional<RoundPiece> {
    piece.count = static_cast<int>(mesh.triangles.size());
    if (!stands_for(mesh, solid.volume, piece)) return std::nullopt;
    return piece;
  };
  if (const auto ball = ball_of(mesh, bounds))
    if (const auto piece = accepted(*ball)) return piece;
  for (const Vector3d& axis : axes_of(mesh, solid))
    for (const Round::Kind kind : {Round::cylinder, Round::capsule})
      if (const auto piece = accepted(about_axis(mesh, solid.centroid, axis, kind))) return piece;
  return std::nullopt;
}

std::vector<RoundPiece> round_parts(const Mesh& mesh) {
  DisjointSets parts = connected_vertices(mesh);
  std::vector<RoundPiece> out;
  std::vector<bool> begun(mesh.vertices.size());
  const int count = static_cast<int>(mesh.triangles.size());
  const auto part_of = [&](int i) { return parts.find(mesh.triangles[i][0]); };
  for (int first = 0; first < count;) {
    const int part = part_of(first);
    int end = first;
    Mesh alone;
    std::vector<std::pair<int, int>> numbers;  // of the vertices
    for (; end < count && part_of(end) == part; ++end)
      for (const int v : mesh.triangles[end]) numbers.emplace_back(v, 0);
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (auto& [v, number] : numbers) {
      number = static_cast<int>(alone.vertices.size());
      alone.vertices.push_back(mesh.vertices[v]);
    }
    for (int i = first; i < end; ++i) {
      Triangle t = mesh.triangles[i];
      for (int& v : t) v = std::ranges::lower_bound(numbers, std::pair(v, 0))->second;
      alone.triangles.push_back(t);
    }
    if (begun[part]) {  // its triangles are not consecutive
      std::erase_if(out, [&](const RoundPiece& piece) { return part_of(piece.first) == part; });
    } else if (auto piece = round_of(alone); piece && find_faults(alone).closed()) {
      piece->first = first;
      out.push_back(*piece);
    }
    begun[part] = true;
    first = end;
  }
  return out;
}

}  // namespace clench
