// Triangles from any mesh reader, gathered into a surface whose parts hang together, and its
// colors.
#pragma once
#include <map>
#include <span>
#include <string>

#include "clench/geometry/mesh/mesh.h"
#include "clench/io/text/find_file.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Beyond these a file is taken for hostile: some 2 GB of memory.
inline constexpr size_t max_mesh_triangles = 10'000'000, max_mesh_vertices = 30'000'000,
                        max_mesh_faces = 20'000'000;

struct Geometry {
  Mesh mesh;  ///< repaired where it can be; no triangle with a vertex twice; may be empty
  Appearance appearance;
  /// texture coordinates of the file, for images that other files name; null: none
  SkinPtr places = {};
  MeshReport report;
};

/// Where a face lies in an image.
struct FaceTexture {
  int number;                           ///< of the builder's textures; -1: none of them
  std::span<const Eigen::Vector2d> uv;  ///< one per corner, as those of TexturedTriangle
};

class GeometryBuilder {
 public:
  /// A triangle that shares no vertex with others by number. With two equal corners it is dropped.
  /// `line`: where it ends, in a file that has lines
  void add(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3f& color,
           float transparency, int line = 0);

  /// A vertex that faces share by its number.   returns  the number, from 0 on
  int add_vertex(const Eigen::Vector3d& p, int line = 0);
  /// A face over shared vertices, cut into triangles; those with a vertex twice are dropped.
  /// `texture`: over the color, which stands for it where single images cannot be drawn; null: none
  /// throws  Error when it has too many corners, or the file too many triangles
  void add_face(std::span<const int> corners, const Eigen::Vector3f& color, float transparency,
                const FaceTexture* texture = nullptr);
  /// Textures of faces, numbered from 0 on.
  std::vector<Texture> textures = {};

  /// The triangles of a face's outline, numbers of its corners.
  /// throws  Error when it has too many corners, or all faces so far take too long
  std::vector<Triangle> cut(const std::vector<Eigen::Vector3d>& outline, bool convex = false);

  /// Limits triangles to a quarter of the file's bytes, but to no less than 400,000: parts that a
  /// small file places many times could ask for any number. Vertices are limited to three times that.
  void limit_to(size_t file_bytes);

  size_t triangle_count() const { return mesh_.triangles.size(); }
  size_t vertex_count() const { return mesh_.vertices.size(); }
  const Eigen::Vector3d& vertex(int i) const { return mesh_.vertices[i]; }
  /// of the vertices that triangles use
  Bounds bounds() const;
  /// p becomes factor * turn * p, and loses no digits where the turn exchanges axes.
  void transform(double factor, const Eigen::Matrix3d& turn);

  /// A surface with open edges is repaired as far as that closes edges: vertices at the same place
  /// become one, then those that lie within rounding of each other; triangles without area go, and
  /// those that lie on each other.
  /// A closed mesh that is inside out is turned, with a warning. A closed one stays as its file
  /// connects it. Colors are kept one per triangle when they differ.
  /// `colors_given`: do the colors come from the file?
  /// throws  Error naming line and vertex that lie too far out, "huge.off:4: vertex 2: ..."
  Geometry finish(bool colors_given, const std::string& subject, const ReadOptions& options);

  /// Asked whether to go on; it throws Stopped.
  Progress progress = {};
  MeshReport report;  ///< format, unit and axes are the reader's to say
  /// Is every triangle kept but those with a corner twice?
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
  bool loose_ = false;            // are there triangles that share no vertex by number?
  std::map<int, int> far_lines_;  // of vertices that may lie too far out
  std::vector<Eigen::Vector3f> colors_;
  std::vector<TexturedTriangle> textured_;  // one per triangle up to the last that has an image
  Eigen::Vector3d weighted_color_ = Eigen::Vector3d::Zero();
  double weighted_transparency_ = 0, weight_ = 0;
};

}  // namespace clench
