// A mesh prepared for queries: immutable, shared between worlds and threads.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <mutex>

#include "clench/base/progress.h"
#include "clench/geometry/mesh/mass.h"
#include "clench/geometry/mesh/mesh.h"
#include "clench/geometry/round/round.h"
#include "clench/math/pose.h"

namespace clench {

// bounding volumes over the triangles; its layout is private to the queries
class Tree;

/// Which queries treat round pieces by closed formulas instead of their triangles.
enum class RoundIn {
  all,    ///< all distances and contacts
  motion  ///< only those of dynamics
};

/// The round solids of a mesh, in the order of their triangles; no triangle belongs to two solids.
struct RoundPieces {
  std::vector<RoundPiece> pieces;
  RoundIn in = RoundIn::all;
};

class Shape {
 public:
  using Extremes = std::array<Eigen::Vector3d, 6>;

  /// A closed mesh without `rounds` that is a tessellation of a ball, capsule or cylinder gets that
  /// as its round piece, for motion only.
  /// throws Error as check_mesh does, `subject` names the mesh in it; Stopped
  static std::shared_ptr<const Shape> make(Mesh mesh, const std::string& subject = "mesh",
                                           const Progress& progress = {}, RoundPieces rounds = {});
  ~Shape();

  const Mesh& mesh() const { return mesh_; }
  const MeshFaults& faults() const { return faults_; }
  const MassProperties& solid() const { return solid_; }
  bool has_triangle(int i) const { return i >= 0 && i < static_cast<int>(mesh_.triangles.size()); }
  const Bounds& bounds() const { return bounds_; }
  /// Bounds of the vertices, transformed by X.
  Bounds bounds_at(const Pose& X) const;
  bool closed() const { return faults_.closed(); }
  /// Is it closed, with a volume that is consistent with its surface? A sheet folded on itself has
  /// none.
  bool has_volume() const;
  /// closed and convex, and small enough for the test: see is_convex
  bool convex() const { return convex_; }
  /// center and radius [m] of a sphere that contains the mesh, and round pieces of RoundIn::all
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }
  const RoundPieces& rounds() const { return rounds_; }
  /// True if the shape has pieces that are treated as round for the purpose `where`.
  bool is_round(RoundIn where) const {
    return !rounds_.pieces.empty() && (where == RoundIn::motion || rounds_.in == RoundIn::all);
  }
  /// The triangles that belong to no round piece, as a shape; null if there are none. Only set for
  /// shapes with round pieces.
  const std::shared_ptr<const Shape>& facets() const { return facets_; }
  /// The index in mesh() of a triangle of facets().
  int facet(int number) const { return facet_numbers_[number]; }
  /// The index in mesh() of a vertex of facets().
  int facet_vertex(int number) const { return facet_vertices_[number]; }
  /// The axis of a round piece, as a triangle without area.
  const Shape& core(int piece) const { return *cores_[piece]; }
  /// one triangle of each connected part (vertices at the same position are connected), in index
  /// order
  const std::vector<int>& parts() const { return parts_; }
  /// of each part, its vertices farthest along -x, x, -y, y, -z and z; empty if there are many
  /// parts
  const std::vector<Extremes>& part_extremes() const { return part_extremes_; }
  /// fingerprint of vertices, triangles and round pieces: equal for equal bits
  uint64_t hash() const { return hash_; }
  /// approximate memory of the shape with its tree
  size_t bytes() const;
  /// built on first use: reading, checking or converting a mesh needs none. Any thread may call it.
  /// throws Stopped, and then has none
  const Tree& tree(const Progress& progress = {}) const {
    const Tree* const built = built_.load(std::memory_order_acquire);
    return built ? *built : build_tree(progress);
  }

 private:
  Shape();
  void find_parts();
  void set_rounds(RoundPieces rounds);
  const Tree& build_tree(const Progress& progress) const;
  Mesh mesh_;
  MeshFaults faults_;
  MassProperties solid_;
  Bounds bounds_;
  Eigen::Vector3d center_;
  double radius_ = 0;
  bool convex_ = false;
  RoundPieces rounds_;
  std::shared_ptr<const Shape> facets_;
  std::vector<int> facet_numbers_, facet_vertices_;
  std::vector<std::shared_ptr<const Shape>> cores_;
  std::vector<int> parts_;
  uint64_t hash_ = 0;
  std::vector<Extremes> part_extremes_;
  mutable std::mutex building_;
  mutable std::unique_ptr<const Tree> tree_;
  mutable std::atomic<const Tree*> built_ = nullptr;
};

using ShapePtr = std::shared_ptr<const Shape>;

}  // namespace clench
