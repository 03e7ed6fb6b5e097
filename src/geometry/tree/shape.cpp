#include "clench/geometry/tree/shape.h"

#include <algorithm>
#include <cmath>

#include "clench/base/hash.h"
#include "clench/base/watched.h"
#include "clench/geometry/mesh/parts.h"
#include "clench/geometry/round/recognize.h"
#include "clench/geometry/tree/tree.h"

namespace clench {

namespace {

Shape::Extremes farthest_along_axes(const Mesh& mesh, const std::vector<int>& vertices) {
  Shape::Extremes out;
  out.fill(mesh.vertices[vertices[0]]);
  for (const int v : vertices) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    for (int k = 0; k < 3; ++k) {
      if (p[k] < out[2 * k][k]) out[2 * k] = p;
      if (p[k] > out[2 * k + 1][k]) out[2 * k + 1] = p;
    }
  }
  return out;
}

}  // namespace

Shape::Shape() = default;
Shape::~Shape() = default;

bool Shape::has_volume() const {
  return closed() && std::abs(solid_.volume) > 1e-9 * radius_ * radius_ * radius_;
}

void Shape::find_parts() {
  // beyond that number of parts, their extremes would take more memory than the mesh
  constexpr size_t few = 64;
  DisjointSets parts = connected_vertices(mesh_);
  // the index of the part by the vertex that represents it
  std::vector<int> numbers(mesh_.vertices.size(), -1);
  for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
    int& number = numbers[parts.find(mesh_.triangles[i][0])];
    if (number >= 0) continue;
    number = static_cast<int>(parts_.size());
    parts_.push_back(static_cast<int>(i));
  }
  if (parts_.size() > few) return;
  std::vector<std::vector<int>> vertices(parts_.size());
  for (int v = 0; v < static_cast<int>(numbers.size()); ++v)
    if (const int number = numbers[parts.find(v)]; number >= 0) vertices[number].push_back(v);
  for (const auto& members : vertices)
    part_extremes_.push_back(farthest_along_axes(mesh_, members));
}

// the axis of a round solid, as a triangle without area
static Mesh core_mesh(const RoundPiece& piece) {
  const Eigen::Vector3d end = core_of(piece.solid).end;
  Mesh out;
  out.vertices = {piece.X_SR * Eigen::Vector3d(-end), piece.X_SR * end, piece.X_SR * end};
  out.triangles = {{0, 1, 2}};
  return out;
}

void Shape::set_rounds(RoundPieces rounds) {
  rounds_ = std::move(rounds);
  Mesh rest;
  int next = 0;
  const auto keep_until = [&](int end) {
    for (; next < end; ++next) {
      rest.triangles.push_back(mesh_.triangles[next]);
      facet_numbers_.push_back(next);
    }
  };
  for (const RoundPiece& piece : rounds_.pieces) {
    check_stop();
    keep_until(piece.first);
    next = piece.first + piece.count;
    cores_.push_back(make(core_mesh(piece)));
  }
  keep_until(static_cast<int>(mesh_.triangles.size()));
  if (rest.triangles.empty()) return;
  std::vector<int> numbers(mesh_.vertices.size(), -1);
  for (Triangle& triangle : rest.triangles)
    for (int& v : triangle) {
      if (numbers[v] < 0) {
        numbers[v] = static_cast<int>(rest.vertices.size());
        rest.vertices.push_back(mesh_.vertices[v]);
        facet_vertices_.push_back(v);
      }
      v = numbers[v];
    }
  facets_ = make(std::move(rest));
}

// An upper bound of the distance from p to the points of a round piece [m].
static double farthest_from(const RoundPiece& piece, const Eigen::Vector3d& p) {
  const Core core = core_of(piece.solid);
  const Eigen::Vector3d away = piece.X_SR.inverse() * p;
  double out = 0;
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d to = away - side * core.end;
    out = std::max(out, piece.solid.kind == Round::cylinder
                            ? std::hypot(std::hypot(to.x(), to.y()) + core.around, to.z())
                            : to.norm() + core.around);
  }
  return out;
}

std::shared_ptr<const Shape> Shape::make(Mesh mesh, const std::string& subject,
                                         const Progress& progress, RoundPieces rounds) {
  check_mesh(mesh, subject);
  const std::shared_ptr<Shape> shape(new Shape);
  shape->mesh_ = std::move(mesh);
  shape->faults_ = find_faults(shape->mesh_, progress);
  progress.check();
  shape->solid_ = solid_mass(shape->mesh_);
  progress.check();
  for (const Triangle& t : shape->mesh_.triangles)
    for (const int v : t) shape->bounds_.add(shape->mesh_.vertices[v]);
  check_stop();
  shape->center_ = shape->bounds_.center();
  shape->radius_ = largest_radius(shape->mesh_, shape->center_);
  if (rounds.in == RoundIn::all)
    for (const RoundPiece& piece : rounds.pieces) {
      for (int k = 0; k < 3; ++k)
        for (const double side : {-1.0, 1.0}) {
          const Eigen::Vector3d along =
              piece.X_SR.rotation.conjugate() * Eigen::Vector3d(side * Eigen::Vector3d::Unit(k));
          shape->bounds_.add(piece.X_SR * support(piece.solid, along));
        }
      shape->radius_ = std::max(shape->radius_, farthest_from(piece, shape->center_));
    }
  shape->convex_ = shape->closed() && is_convex(shape->mesh_);
  if (rounds.pieces.empty() && shape->closed())
    if (const auto piece = round_of(shape->mesh_)) rounds = {{*piece}, RoundIn::motion};
  if (!rounds.pieces.empty()) shape->set_rounds(std::move(rounds));
  progress.check();
  shape->find_parts();
  progress.check();
  check_stop();
  Hasher hasher;
  for (const Eigen::Vector3d& v : shape->mesh_.vertices)
    for (const double x : v) hasher.add(x);
  for (const Triangle& t : shape->mesh_.triangles)
    for (const int v : t) hasher.add(static_cast<uint64_t>(v));
  if (shape->is_round(RoundIn::all)) {
    for (const RoundPiece& piece : shape->rounds_.pieces) {
      hasher.add(static_cast<uint64_t>(piece.solid.kind));
      for (const double x : piece.solid.radii) hasher.add(x);
      hasher.add(piece.solid.half);
      add(hasher, piece.X_SR);
      hasher.add(static_cast<uint64_t>(piece.first));
    }
  }
  shape->hash_ = hasher.value();
  return shape;
}

Bounds Shape::bounds_at(const Pose& X) const {
  Bounds out;
  for (const Eigen::Vector3d& p : mesh_.vertices) out.add(X * p);
  return out;
}

size_t Shape::bytes() const {
  constexpr size_t tree_bytes = 100;  // per triangle, in bundles that are not full
  return sizeof *this + mesh_.vertices.capacity() * sizeof(Eigen::Vector3d) +
         mesh_.triangles.capacity() * (sizeof(Triangle) + tree_bytes) +
         part_extremes_.capacity() * sizeof(Extremes) + (facets_ ? facets_->bytes() : 0) +
         cores_.size() * (sizeof(Shape) + 500) +
         (facet_numbers_.capacity() + facet_vertices_.capacity()) * sizeof(int);
}

const Tree& Shape::build_tree(const Progress& progress) const {
  const std::lock_guard lock(building_);
  if (!tree_) {
    tree_ = std::make_unique<const Tree>(mesh_, progress);
    built_.store(tree_.get(), std::memory_order_release);
  }
  return *tree_;
}

}  // namespace clench
