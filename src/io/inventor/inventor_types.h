// Types of Inventor and VRML nodes that describe triangles, colors, units and transforms, with
// their fields; and the names of types without effect on these.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clench {

enum class InventorKind {
  unknown,
  idle,   ///< without effect on triangles and colors
  value,  ///< value of a field of another node
  odd,    ///< has an effect that is not supported
  flat,   ///< a shape without triangles: lines, points, text
  odd_shape,
  group,
  separator,
  transform_separator,
  vrml_transform,
  switching,
  detail,  ///< its first child is the finest
  array,
  copies,
  include,
  transform,
  translation,
  rotation,
  rotation_xyz,
  scale,
  matrix,
  reset,
  units,
  material,
  base_color,
  packed_color,
  binding,
  hints,
  coordinates,
  complexity,
  vrml_shape,
  appearance,
  cube,
  sphere,
  cylinder,
  cone,
  extrusion,
  listed_faces,
  indexed_faces,
  quad_mesh,
  vrml_faces,
  heights,
};

struct InventorNode;
using InventorValue = std::variant<std::vector<float>, std::vector<int32_t>,
                                   std::vector<std::string>, std::vector<const InventorNode*>>;

struct InventorField {
  enum Content { unused, number, integer, color, flag, word, text, node };
  std::string_view name;
  Content content = unused;
  int width = 1;                               ///< numbers per value
  bool many = false;                           ///< true for lists of values
  std::vector<std::string_view> choices = {};  ///< allowed words
  InventorValue absent = {};                   ///< default value
};

struct InventorType {
  InventorKind kind = InventorKind::unknown;
  std::string_view name;  ///< without a prefix
  std::vector<InventorField> fields = {};

  const InventorField* field(std::string_view name) const;
  bool is_shape() const { return kind >= InventorKind::cube || is_other_shape(); }
  bool is_other_shape() const {
    return kind == InventorKind::flat || kind == InventorKind::odd_shape;
  }
  bool takes_children() const {
    return kind >= InventorKind::group && kind <= InventorKind::copies;
  }
};

/// The type with that name in a file, which may begin with So or VRML. In VRML 2 files, nodes of
/// VRML 2 take precedence over Inventor nodes of the same name.   returns  a type of kind unknown
/// if there is none
const InventorType& inventor_type(std::string_view name, bool vrml2);

}  // namespace clench
