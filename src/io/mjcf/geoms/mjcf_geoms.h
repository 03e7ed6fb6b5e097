// Reads MJCF geoms, and the meshes and materials that they name, as pieces of links.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>

#include "clench/io/mjcf/geoms/mjcf_meshes.h"
#include "clench/io/mjcf/geoms/mjcf_textures.h"
#include "clench/io/tree/tree_links.h"
#include "clench/spec/own_friction.h"

namespace clench {

struct MjcfGeom {
  GeometryPiece piece;
  bool drawn = false;  ///< in groups 0 to 2, which viewers show
  /// bits: two geoms collide if the type of one and the affinity of the other share a bit
  unsigned type = 1, affinity = 1;
  /// Mass, center of mass and inertia in the frame of the piece. Geoms of groups that the compiler
  /// excludes have none.
  double mass = 0;       ///< [kg]
  bool weighed = true;   ///< true if it is in the compiler's groups
  MassProperties solid;  ///< for unit density; for a shell, per area
  std::string name;      ///< empty: it has none
  bool paired = false;   ///< named by a <pair>, which determines its contacts

  OwnFriction friction;         ///< frictionless if condim is 1
  bool friction_given = false;  ///< by the geom or its class

  bool collides() const { return type != 0 || affinity != 0 || paired; }
};

class MjcfGeoms {
 public:
  /// scene  true if planes are read
  MjcfGeoms(MjcfDocument& document, FileCache& cache, bool scene);

  /// A geom in the frame of its body; empty, with a warning, for a type that is not used.
  std::optional<MjcfGeom> read(const XmlElement& element, const std::string& child_class,
                               const Pose& X_frame, bool of_world = false);
  TreeGeometry& geometry() { return geometry_; }
  /// Types of the geoms that were not used: hfield, sdf, plane.
  const std::set<std::string>& unused_types() const { return unused_types_; }

 private:
  void read_assets();
  void set_primitive(const std::string& type, const XmlValues& values, MjcfGeom& geom, Pose& X);
  void set_fitted(const std::string& type, const XmlValues& values, const MjcfMesh& mesh,
                  MjcfGeom& geom, Pose& X);
  void set_solid(const std::string& type, std::vector<double> size, const XmlValues& values,
                 MjcfGeom& geom);
  void set_plane(const XmlValues& values, MjcfGeom& geom);
  void read_friction(const XmlValues& values, MjcfGeom& geom);
  void read_mass(const XmlValues& values, MjcfGeom& geom);
  void set_look(const XmlValues& values, const std::string& fallback_material, MjcfGeom& geom);
  std::optional<PieceColor> color(const XmlValues& geom, const std::string& fallback) const;

  MjcfDocument& document_;
  FileCache& cache_;
  TreeGeometry geometry_;
  MjcfMeshes meshes_;
  bool scene_;
  MjcfTextures textures_;
  std::map<std::string, PieceColor> materials_;
  std::map<std::string, MjcfTextureUse> texture_uses_;  // by material
  std::set<std::string> unused_types_, paired_;
  size_t count_ = 0;
};

}  // namespace clench
