// Collects triangles from any mesh reader into a connected surface with colors.
#pragma once
#include <map>
#include <span>
#include <string>

#include "clench/geometry/mesh/mesh.h"
#include "clench/io/text/find_file.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Larger files are rejected as hostile: they would take about 2 GB of memory.
inline constexpr size_t max_mesh_triangles = 10'000'000, max_mesh_vertices = 30'000'000,
                        max_mesh_faces = 20'000'000;

struct Geometry {
  Mesh mesh;  ///< repaired if possible; without triangles that have a vertex twice; may be empty
  Appearance appearance;
  /// texture coordinates of the file, for images named by other files; null: none
  SkinPtr places = {};
  MeshReport report;
};

/// Texture of a face and its coordinates in the image.
struct FaceTexture {
  int number;                           ///< index into the builder's textures; -1: none
  std::span<const Eigen::Vector2d> uv;  ///< one per corner, as in TexturedTriangle
};

class GeometryBuilder {
 public:
  /// Adds a triangle that shares no vertex indices with others. If two corners are equal it is
  /// dropped.
  /// line  last line of the triangle, for text files
  void add(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3f& color,
           float transparency, int line = 0);

  /// Adds a vertex that faces share by number.   returns  the number, from 0
  int add_vertex(const Eigen::Vector3d& p, int line = 0);
  /// Adds a face over shared vertices, cut into triangles; triangles that have a vertex twice are
  /// dropped.
  /// texture  drawn over the color, which is used if single images cannot be drawn; null: none
  /// throws  Error if it has too many corners, or the file too many triangles
  void add_face(std::span<const int> corners, const Eigen::Vector3f& color, float transparency,
                const FaceTexture* texture = nullptr);
  /// Textures of faces, numbered from 0.
  std::vector<Texture> textures = {};

  /// Triangulates the outline of a face; triangles contain corner numbers.
  /// throws  Error if it has too many corners, or all faces so far take too long
  std::vector<Triangle> cut(const std::vector<Eigen::Vector3d>& outline, bool convex = false);

  /// Limits triangles to a quarter of the file's size in bytes, but to no less than 400,000: parts
  /// that a small file places many times could otherwise create any number. Vertices are limited to
  /// three times that.
  void limit_to(size_t file_bytes);

  size_t triangle_count() const { return mesh_.triangles.size(); }
  size_t vertex_count() const { return mesh_.vertices.size(); }
  const Eigen::Vector3d& vertex(int i) const { return mesh_.vertices[i]; }
  /// of the vertices used by triangles
  Bounds bounds() const;
  /// Replaces each p by factor * turn * p; without rounding errors from `turn` if it only exchanges
  /// axes.
  void transform(double factor, const Eigen::Matrix3d& turn);

  /// Finishes the surface. If it has open edges, repairs are tried and kept if they close edges:
  /// merging vertices at the same position, then vertices that differ by rounding errors; dropping
  /// triangles without area, then duplicate triangles. A closed mesh that is inside out is
  /// reversed, with a warning. The connectivity of closed meshes is not changed. Colors are stored
  /// per triangle if they differ.
  /// colors_given  true if the colors come from the file
  /// throws  Error with line and vertex for coordinates that are too large, "huge.off:4: vertex 2:
  ///         ..."
  Geometry finish(bool colors_given, const std::string& subject, const ReadOptions& options);

  /// Checked for requests to stop; throws Stopped.
  Progress progress = {};
  MeshReport report;  ///< format, unit and axes are set by the reader
  /// If true, all triangles are kept except those that have a corner twice.
  bool keeps_triangles = false;

 private:
  std::string for_its_size() const;
  void add_triangle(const Triangle& t, const Eigen::Vector3f& color, float transparency,
                    const FaceTexture* texture = nullptr, const Triangle& of_face = {0, 1, 2});
  SkinPtr places(const std::vector<int>& kept) const;
  Appearance mean_appearance(const std::vector<int>& kept) const;
  void note_far(const Eigen::Vector3d& p, int line);
  void check_reach(const std::string& subject) const;

  Mesh mesh_;
  size_t max_triangles_ = max_mesh_triangles, max_vertices_ = max_mesh_vertices;
  size_t faces_ = 0;
  size_t cutting_work_ = 0;
  bool loose_ = false;            // true if there are triangles that share no vertex by number
  std::map<int, int> far_lines_;  // vertex with possibly too large coordinates -> line
  std::vector<Eigen::Vector3f> colors_;
  std::vector<TexturedTriangle> textured_;  // one per triangle up to the last that has an image
  Eigen::Vector3d weighted_color_ = Eigen::Vector3d::Zero();
  double weighted_transparency_ = 0, weight_ = 0;
};

}  // namespace clench
