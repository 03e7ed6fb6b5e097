// Polygons of one <mesh> of a COLLADA file.
#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/text/xml.h"
#include "clench/spec/body_spec.h"

namespace clench {

/// Resolves references "#name" to elements, which belong to the file.
class ColladaIds {
 public:
  explicit ColladaIds(const XmlElement& root);
  /// The element whose id is given by an attribute of `from`.
  /// throws Error  "part.dae:31: input: expected an element with the id 'x', got none"
  XmlElement find(const XmlElement& from, const char* attribute) const;

  /// Null if no element has this id.
  XmlElement named(const std::string& id) const;

 private:
  std::map<std::string, XmlElement> elements_;
};

struct ColladaLook {
  Eigen::Vector3f color = Appearance().color;
  bool given = false;
  std::shared_ptr<const Image> image = {};  ///< null: uniform color
  int texture = -1;                         ///< number of the texture in the builder
  std::optional<int> set = {};              ///< of texture coordinates; empty: the first
};

/// State shared by all meshes of a file.
struct ColladaWork {
  const ColladaIds& ids;
  GeometryBuilder& builder;
  std::set<std::string> warnings = {};  ///< about contents that are not used
  /// numbers and elements that may still be read; contents used several times count each time
  long left = 300'000'000;
};

/// Adds the faces of a <mesh>, with its points transformed by X.
/// look  appearance of faces by the symbol of their material
/// throws  Error  "part.dae:31: p: expected a vertex from 0 to 7, got 8"
void add_collada_mesh(const XmlElement& mesh, const Eigen::Affine3d& X,
                      const std::function<ColladaLook(const std::string& symbol)>& look,
                      ColladaWork& work);

}  // namespace clench
