// Geometry of a link of a robot tree: pieces, each a primitive or a mesh file, merged into one
// shape.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "clench/geometry/mesh/mass.h"
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"
#include "clench/math/pose.h"

namespace clench {

struct PieceColor {
  Eigen::Vector3f color;
  float transparency = 0;
};

/// A part of a link's surface.
struct GeometryPiece {
  std::shared_ptr<const Geometry> geometry;  ///< as given by its file or formula
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Pose X_LG;                        ///< in the link, after scaling
  std::optional<PieceColor> color;  ///< replaces that of the file
  SkinPtr skin = {};                ///< replaces that of the file, even if there is a color
  /// exact, for round shapes, which their meshes only approximate
  std::optional<MassProperties> solid;
  std::optional<Round> round = {};  ///< exact solid for contacts of round shapes
};

/// Mass properties of a piece, without its scale.
MassProperties solid_of(const GeometryPiece& piece);

/// Meshes read and shapes built for one robot: equal parts of fingers share them.
class TreeGeometry {
 public:
  explicit TreeGeometry(const ReadOptions& options, BarePoints bare_points = BarePoints::refused);

  /// A mesh file in meters.   throws as read_mesh_file
  std::shared_ptr<const Geometry> file(const std::filesystem::path& path);
  /// A generated mesh, stored by name.
  std::shared_ptr<const Geometry> made(const std::string& name, Mesh mesh);
  /// A box given by three edges, an ellipsoid by three radii, a sphere by its radius, or a capsule
  /// or cylinder about z by radius and length [m].
  GeometryPiece primitive(const std::string& kind, const std::vector<double>& sizes);

  struct Body {
    ShapePtr shape;  ///< null: no pieces
    Appearance appearance;
    std::optional<MeshReport> report;  ///< if it is a single file's mesh
  };
  /// `subject` names the link in errors
  Body merge(const std::vector<GeometryPiece>& pieces, const Place& subject);

 private:
  /// Textures of all pieces in order; null: none, or more than a robot may have.
  SkinPtr skin_of_all(const std::vector<GeometryPiece>& pieces, const Place& subject);

  ReadOptions options_;
  BarePoints bare_points_;
  std::map<std::string, std::shared_ptr<const Geometry>> geometries_;  // by path or name
  std::map<std::string, Body> bodies_;                                 // by pieces
  size_t triangles_ = 0, round_triangles_ = 0;                         // of all shapes
  std::set<std::shared_ptr<const Image>> images_;                      // of all skins
  size_t image_bytes_ = 0;
};

}  // namespace clench
