// Geoms of written bodies: round solids and boxes as primitives, all other surfaces as meshes.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "clench/geometry/tree/shape.h"
#include "clench/io/mjcf_write/written_scene.h"

namespace clench {

/// A geom that collides, or is only drawn.
struct WrittenGeom {
  std::string name;
  std::string type;  ///< "mesh", "box", "sphere" ...
  std::string size;  ///< of a primitive
  int mesh = -1;     ///< index of its mesh; -1: a primitive
  Pose X_BG;         ///< of a primitive
  bool collides = true;
};

struct WrittenMesh {
  std::string name, file;  ///< file: relative to the folder of the scene
  Mesh mesh;
};

/// Geoms of all bodies; equal meshes are shared.
class SceneGeoms {
 public:
  /// folder  of the mesh files, relative to the folder of the scene: "scene_files/"
  explicit SceneGeoms(std::string folder) : folder_(std::move(folder)) {}

  void add(const WrittenBody& body);

  /// Geoms of each body, in the order of `add`.
  const std::vector<std::vector<WrittenGeom>>& geoms() const { return geoms_; }
  const std::vector<WrittenMesh>& meshes() const { return meshes_; }
  /// Messages about surfaces that collide differently in MuJoCo, each with names of bodies.
  std::vector<std::string> losses() const;

 private:
  void add_surface(const WrittenBody& body, const Shape& shape);
  void add_triangles(const WrittenBody& body, const Shape& shape);
  void add_hull(const WrittenBody& body, const Mesh& mesh);
  void add_mesh(const WrittenBody& body, Mesh mesh, bool collides);
  void add_primitive(const WrittenBody& body, const std::string& type, const std::string& size,
                     const Pose& X_BG);
  void push(const WrittenBody& body, WrittenGeom geom);

  std::string folder_;
  std::vector<std::vector<WrittenGeom>> geoms_;
  std::vector<WrittenMesh> meshes_;
  std::vector<std::string> mesh_names_, file_names_, geom_names_;
  std::map<uint64_t, int> by_hash_;
  std::vector<std::string> concave_, open_, flat_;
};

/// Pose and half lengths [m] of a mesh that is a box; empty for other meshes.
struct BoxFit {
  Pose X_MB;
  Eigen::Vector3d half;
};
std::optional<BoxFit> box_of(const Mesh& mesh);

}  // namespace clench
