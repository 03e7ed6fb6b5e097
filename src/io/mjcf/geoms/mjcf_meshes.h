// Mesh assets of MJCF: files, points and faces in the model, and built-in shapes; their mass
// properties, and primitives fitted to them.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "clench/io/mjcf/document/mjcf_document.h"
#include "clench/io/mjcf/geoms/mjcf_mesh_mass.h"
#include "clench/io/tree/tree_geometry.h"

namespace clench {

struct MjcfMesh {
  std::shared_ptr<const Geometry> geometry;
  MassProperties mass;   ///< for unit density, by the asset's rule; for a shell, per area
  std::string material;  ///< for geoms that name none; empty: none
};

/// A primitive that replaces a mesh.
struct FittedPrimitive {
  std::vector<double> size;  ///< like a geom's `size`: radii and half lengths [m]
  Pose X_MF;                 ///< its frame in the mesh's frame
};

class MjcfMeshes {
 public:
  MjcfMeshes(MjcfDocument& document, FileCache& cache, TreeGeometry& geometry)
      : document_(document), cache_(cache), geometry_(geometry) {}

  /// Adds a <mesh> element of the assets.
  void add(const XmlElement& element);
  /// The mesh named by a geom, read when first used.
  /// returns  null, with a warning, if it cannot be read and the geom does not collide
  const MjcfMesh* find(const XmlValues& geom, bool collides);
  /// A primitive "box", "sphere", "capsule", "cylinder" or "ellipsoid" with the same inertia as the
  /// mesh, or around it if the compiler's `fitaabb` is set.
  FittedPrimitive fit(const MjcfMesh& mesh, const std::string& type, const XmlValues& geom) const;

 private:
  struct Asset {
    XmlValues values;
    std::optional<MjcfMesh> mesh = {};  // read when first used
    bool is_missing = false;            // true once it was reported
  };
  const MjcfMesh& read(Asset& asset);
  std::shared_ptr<const Geometry> shape(const Asset& asset);
  Mesh own_points(const XmlValues& values) const;

  MjcfDocument& document_;
  FileCache& cache_;
  TreeGeometry& geometry_;
  std::map<std::string, Asset> assets_;
  size_t builtin_triangles_ = 0;
};

}  // namespace clench
