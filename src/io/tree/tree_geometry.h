// Geometry of a link of a robot tree: pieces, each a primitive or a mesh file, made one shape.
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
  std::shared_ptr<const Geometry> geometry;  ///< as its file or its formula gives it
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Pose X_LG;                            ///< in the link, after scaling
  std::optional<PieceColor> color;      ///< over that of the file
  SkinPtr skin = {};                    ///< over that of the file, even where there is a color
  std::optional<MassProperties> solid;  ///< of a round shape, which its mesh only comes near
  std::optional<Round> round = {};      ///< the solid that a round shape touches as
};

/// Mass properties of what a piece shows, without its scale.
MassProperties solid_of(const GeometryPiece& piece);

/// Meshes already read and shapes already made for one robot: five fingers share theirs.
class TreeGeometry {
 public:
  explicit TreeGeometry(const ReadOptions& options, BarePoints bare_points = BarePoints::refused);

  /// A mesh file in meters.   throws what read_mesh_file throws
  std::shared_ptr<const Geometry> file(const std::filesystem::path& path);
  /// A mesh made by a formula, kept under its name.
  std::shared_ptr<const Geometry> made(const std::string& name, Mesh mesh);
  /// A box of three edges, an ellipsoid of three radii, a sphere of its radius, or a capsule or
  /// cylinder about z of radius and length [m].
  GeometryPiece primitive(const std::string& kind, const std::vector<double>& sizes);

  struct Body {
    ShapePtr shape;  ///< null: no pieces
    Appearance appearance;
    std::optional<MeshReport> report;  ///< when it is one file's mesh
  };
  /// `subject` names the link in errors
  Body merge(const std::vector<GeometryPiece>& pieces, const Place& subject);

 private:
  /// Textures of all pieces, in their order; null: none, or more than a robot may have.
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
