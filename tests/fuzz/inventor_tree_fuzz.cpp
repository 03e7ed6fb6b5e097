// Trees of Inventor or VRML nodes with correct syntax and odd contents: the bytes choose nodes,
// fields, numbers, names and PROTOs. As a body and as a planner's primitives: a spec or an Error.
#include "clench/io/graspit/inventor_primitives.h"
#include "clench/io/inventor/inventor_types.h"
#include "fuzz_files.h"

using namespace clench;
using namespace clench::fuzz;

namespace {

constexpr const char* node_names[] = {"Separator",
                                      "Group",
                                      "TransformSeparator",
                                      "Switch",
                                      "LOD",
                                      "Array",
                                      "MultipleCopy",
                                      "Transform",
                                      "Translation",
                                      "Rotation",
                                      "RotationXYZ",
                                      "Scale",
                                      "MatrixTransform",
                                      "ResetTransform",
                                      "Units",
                                      "Material",
                                      "BaseColor",
                                      "PackedColor",
                                      "MaterialBinding",
                                      "ShapeHints",
                                      "Coordinate3",
                                      "Coordinate4",
                                      "Complexity",
                                      "VertexProperty",
                                      "Cube",
                                      "Sphere",
                                      "Cylinder",
                                      "Cone",
                                      "FaceSet",
                                      "IndexedFaceSet",
                                      "TriangleStripSet",
                                      "IndexedTriangleStripSet",
                                      "QuadMesh",
                                      "File",
                                      "WWWInline",
                                      "Inline",
                                      "Shape",
                                      "Appearance",
                                      "Coordinate",
                                      "Color",
                                      "Box",
                                      "ElevationGrid",
                                      "Extrusion",
                                      "IndexedLineSet",
                                      "Normal",
                                      "TextureUnit",
                                      "Anchor",
                                      "Collision",
                                      "Blinker",
                                      "Whirl",
                                      "Rotor"};
constexpr const char* odd_numbers[] = {
    "0",
    "1",
    "-1",
    "2",
    "3",
    "4",
    "0.5",
    "-0",
    "1e-30",
    "1e30",
    "-3e38",
    "1e39",
    "7",
    "30000",
    "2147483647",
    "-2147483648",
    "4294967295",
    "0x7f",
    "0xffffffff",
    "1e-400",
    "nan",
    "1.5.2",
    "+2",
    "11111111111111111111111111111111111111111111111111111111111111111111111111111111"};
constexpr const char* file_names[] = {"\"box.iv\"", "\"part.wrl\"", "\"tree.iv\"", "\"\"",
                                      "gone.iv"};

class TreeWriter {
 public:
  TreeWriter(const uint8_t* data, size_t size) : data_(data), left_(size) {}

  std::string text() {
    vrml2_ = pick(2) == 0;
    out_ = vrml2_ ? "#VRML V2.0 utf8\n" : "#Inventor V2.1 ascii\n";
    while (left_ > 0 && out_.size() < 100'000) statement(0);
    return out_;
  }

 private:
  /// below `count`; 0 if no bytes are left
  size_t pick(size_t count) {
    if (left_ == 0) return 0;
    --left_;
    return *data_++ % count;
  }
  template <size_t n>
  const char* one_of(const char* const (&list)[n]) {
    return list[pick(n)];
  }
  std::string name() { return std::string(1, static_cast<char>('a' + pick(6))); }
  void number(bool whole) {
    const size_t kind = pick(4);
    if (kind == 0)
      out_ += one_of(odd_numbers);
    else
      out_ += whole ? fmt::format("{}", static_cast<int>(pick(9)) - 1)
                    : fmt::format("{}", (static_cast<double>(pick(256)) - 100) / 16);
    out_ += ' ';
  }
  void statement(int depth);
  void node(int depth, const char* type);
  void proto();
  void value(const InventorField& field, int depth);
  void single(const InventorField& field, int depth);

  const uint8_t* data_;
  size_t left_;
  bool vrml2_ = false, in_proto_ = false;
  std::string out_;
};

void TreeWriter::statement(int depth) {
  switch (pick(12)) {
    case 0:
      out_ += "USE " + name() + "\n";
      return;
    case 1:
      out_ += "DEF " + name() + " ";
      break;
    case 2:
      if (!in_proto_) return proto();
      break;
    case 3:
      return node(depth, "P");
    case 4:
      out_ += "ROUTE a.x TO b.y\n";
      return;
  }
  node(depth, one_of(node_names));
}

void TreeWriter::proto() {
  out_ += "PROTO P [ field SFFloat x ";
  number(false);
  out_ += "field MFNode c [ ";
  in_proto_ = pick(8) > 0;  // sometimes a PROTO in a PROTO
  if (pick(2) == 0) statement(3);
  out_ += "] eventIn SFTime t ] {\n";
  for (size_t i = pick(3) + 1; i > 0; --i) statement(2);
  out_ += "}\n";
  in_proto_ = false;
}

void TreeWriter::node(int depth, const char* type_name) {
  const InventorType& type = inventor_type(type_name, vrml2_);
  out_ += fmt::format("{} {{ ", type_name);
  for (size_t i = type.fields.empty() ? 0 : pick(4); i > 0; --i) {
    const InventorField& field = type.fields[pick(type.fields.size())];
    out_ += fmt::format("{} ", field.name);
    if (pick(12) == 0)
      out_ += pick(2) == 0 ? "IS x " : "IS c ";
    else
      value(field, depth);
    if (pick(16) == 0) out_ += "= ElapsedTime { } . timeOut ";
  }
  if (type_name[0] == 'P' && type_name[1] == 0 && pick(2) == 0) {
    out_ += "x ";
    number(false);
    out_ += "c [ ";
    if (depth < 12) statement(depth + 1);
    out_ += "] ";
  }
  if (depth < 12 && (type.takes_children() || pick(8) == 0))
    for (size_t i = pick(5); i > 0; --i) statement(depth + 1);
  out_ += "}\n";
}

void TreeWriter::value(const InventorField& field, int depth) {
  if (!field.many || pick(4) == 0) return single(field, depth);
  out_ += "[ ";
  for (size_t i = pick(24); i > 0; --i) single(field, depth);
  out_ += "] ";
}

void TreeWriter::single(const InventorField& field, int depth) {
  switch (field.content) {
    case InventorField::number:
      for (int i = 0; i < field.width; ++i) number(false);
      return;
    case InventorField::word:
      out_ += fmt::format("{} ", field.choices[pick(field.choices.size())]);
      return;
    case InventorField::text:
      out_ += fmt::format("{} ", one_of(file_names));
      return;
    case InventorField::node:
      if (depth < 12) return statement(depth + 1);
      out_ += "NULL ";
      return;
    default:
      return number(true);
  }
}

const fs::path& tree_folder() {
  static const fs::path made = [] {
    const fs::path path = new_folder();
    write(path / "box.iv", "#Inventor V2.1 ascii\nCube { }\n");
    write(path / "part.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }\n");
    return path;
  }();
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fs::path path = tree_folder() / "tree.iv";
  write(path, TreeWriter(data, size).text());
  check(path, read_body);
  check(path, read_primitives);
  return 0;
}
