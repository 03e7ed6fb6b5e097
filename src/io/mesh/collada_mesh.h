// The polygons of one <mesh> of a COLLADA file.
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

/// What an element's "#name" refers to; it belongs to the file.
class ColladaIds {
 public:
  explicit ColladaIds(const XmlElement& root);
  /// The element with the id that an attribute of `from` names.
  /// throws Error  "part.dae:31: input: expected an element with the id 'x', got none"
  XmlElement find(const XmlElement& from, const char* attribute) const;

  /// None if no element has it.
  XmlElement named(const std::string& id) const;

 private:
  std::map<std::string, XmlElement> elements_;
};

struct ColladaLook {
  Eigen::Vector3f color = Appearance().color;
  bool given = false;
  std::shared_ptr<const Image> image = {};  ///< null: one color
  int texture = -1;                         ///< its number in the builder
  std::optional<int> set = {};              ///< of texture coordinates; empty: the first
};

/// What the meshes of a file share.
struct ColladaWork {
  const ColladaIds& ids;
  GeometryBuilder& builder;
  std::set<std::string> warnings = {};  ///< what is not used
  /// numbers and elements that may still be read, those that are used several times each time
  long left = 300'000'000;
};

/// Adds the faces of a <mesh>, its points moved by X.
/// `look`: what the faces with a material of that symbol look like
/// throws  Error  "part.dae:31: p: expected a vertex from 0 to 7, got 8"
void add_collada_mesh(const XmlElement& mesh, const Eigen::Affine3d& X,
                      const std::function<ColladaLook(const std::string& symbol)>& look,
                      ColladaWork& work);

}  // namespace clench
