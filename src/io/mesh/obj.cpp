#include "clench/io/mesh/mesh_readers.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "clench/io/mesh/obj_materials.h"
#include "clench/io/text/word_reader.h"

namespace clench {

namespace {

constexpr size_t max_material_files = 1000;  // limit of files searched

/// Data of a face, completed when all points are known.
struct Face {
  int first;  // index of its first corner
  int line;
  int material;  // number of its name, or -1
};

struct UsedMaterial {
  int number;
  Place place;  // of its first use
};

class ObjReader {
 public:
  ObjReader(const MeshInput& input, const std::string& text, GeometryBuilder& builder)
      : input_(input), builder_(builder), words_(input.file(), text, true) {}
  bool read();

 private:
  void read_point();
  void read_texture_point();
  void read_face();
  void read_other(std::string_view keyword);
  void use_material(const std::string& name);
  void read_materials(const std::string& names);
  std::vector<Eigen::Vector2d> image_points(const Face& face, size_t end,
                                            const MtlMaterial& look) const;
  std::vector<MtlMaterial> used_materials();
  void add_faces();
  void note_objects();
  void warn_once(const std::string& about, const std::string& sentence) {
    warn_once(about, words_.place(), sentence);
  }
  void warn_once(const std::string& about, const Place& place, const std::string& sentence);

  const MeshInput& input_;
  GeometryBuilder& builder_;
  WordReader words_;
  std::vector<Eigen::Vector3f> point_colors_;
  std::vector<Eigen::Vector2d> texture_points_;
  std::vector<int> corners_, texture_corners_;  // of texture corners, -1: none
  std::vector<Face> faces_;
  int material_ = -1;
  std::map<std::string, UsedMaterial> used_materials_;  // by the names that faces use
  MtlMaterials materials_;                              // by the names that MTL files define
  size_t material_files_ = 0;                           // number searched so far
  std::string object_;                                  // named by the last line "o NAME"
  std::vector<std::string> objects_;                    // names of objects with faces, in order
  std::set<std::string> warned_;
  std::vector<Diagnostic> warnings_;
};

void ObjReader::warn_once(const std::string& about, const Place& place,
                          const std::string& sentence) {
  constexpr size_t max_warnings = 10;
  if (warned_.size() < max_warnings && warned_.insert(about).second)
    warnings_.emplace_back(place, sentence);
}

void ObjReader::read_point() {
  double numbers[7];
  int count = 0;
  for (auto word = words_.word(); !word.empty() || count < 3; word = words_.word()) {
    const auto value = parse_number(word);
    if (!value) words_.fail("expected three numbers after v, got {}", in_quotes(word));
    if (count == 7) {
      warn_once("point",
                "expected at most a point, a weight and a color after v; only the point is "
                "used");
      words_.rest();
      count = 3;
      break;
    }
    numbers[count++] = *value;
  }
  builder_.add_vertex({numbers[0], numbers[1], numbers[2]}, words_.line());
  // x y z [w] [r g b]
  if (count < 6) return;
  const double* c = numbers + count - 3;
  point_colors_.push_back(Eigen::Vector3d(c[0], c[1], c[2]).cast<float>());
}

void ObjReader::read_texture_point() {
  const auto u = parse_number(words_.word()), v = parse_number(words_.word());
  words_.rest();
  if (texture_points_.size() >= max_mesh_vertices)
    words_.fail("expected at most {} texture coordinates", max_mesh_vertices);
  const bool finite = u && std::isfinite(*u) && v && std::isfinite(*v);
  if (!finite) warn_once("vt", "expected two numbers after vt; (0, 0) is used");
  // v points up
  texture_points_.push_back(finite ? Eigen::Vector2d(*u, 1 - *v) : Eigen::Vector2d::Zero());
}

// number of the texture point of a corner "7/3/1", from 0; -1: none
static int texture_corner(std::string_view word, size_t count) {
  const size_t slash = word.find('/');
  if (slash == word.npos) return -1;
  const std::string_view rest = word.substr(slash + 1);
  const auto number = parse_integer(rest.substr(0, rest.find('/')));
  if (!number || *number == 0) return -1;
  return static_cast<int>(*number > 0 ? *number - 1 : static_cast<int64_t>(count) + *number);
}

void ObjReader::read_face() {
  const int first = static_cast<int>(corners_.size()),
            points = static_cast<int>(builder_.vertex_count());
  for (auto word = words_.word(); !word.empty(); word = words_.word()) {
    const auto number = parse_integer(word.substr(0, word.find('/')));
    if (!number || word.find_first_not_of("+-0123456789/") != std::string_view::npos)
      words_.fail("expected numbers of points after f, got {}", in_quotes(word));
    // references to later points are resolved after the last line
    if (*number == 0 || *number < -points)
      words_.fail("expected one of {} points after f, got {}", points, *number);
    corners_.push_back(*number > 0 ? *number - 1 : points + *number);
    texture_corners_.push_back(texture_corner(word, texture_points_.size()));
  }
  if (corners_.size() - first < 3) {
    warn_once("short face", "a face of fewer than three points is not used");
    corners_.resize(first), texture_corners_.resize(first);
    return;
  }
  if (faces_.size() >= max_mesh_triangles)
    words_.fail("expected at most {} faces", max_mesh_triangles);
  faces_.push_back({first, words_.line(), material_});
  if (objects_.empty() || objects_.back() != object_) objects_.push_back(object_);
}

// All objects of the file become one body.
void ObjReader::note_objects() {
  if (objects_.size() < 2 || !input_.diagnostics()) return;
  if (objects_.front().empty()) objects_.front() = "without a name";
  input_.diagnostics().note(Place(words_.file()), "its {} objects ({}) are read as one body",
                            objects_.size(), name_list(objects_));
}

void ObjReader::use_material(const std::string& name) {
  const UsedMaterial next{static_cast<int>(used_materials_.size()), words_.place()};
  material_ = used_materials_.emplace(name, next).first->second.number;
}

void ObjReader::read_other(std::string_view keyword) {
  static const std::set<std::string_view> silent = {
      "vn",         "vp",        "g",        "s",        "mg",  "usemap", "maplib",
      "shadow_obj", "trace_obj", "d_interp", "c_interp", "lod", "bevel"};
  static const std::set<std::string_view> free_form = {
      "cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",  "parm",
      "trim",   "hole", "scrv", "sp",   "end",  "con",   "ctech", "stech"};
  if (silent.contains(keyword)) return;
  if (keyword == "o")
    object_ = words_.rest();
  else if (keyword == "usemtl")
    use_material(std::string(words_.rest()));
  else if (keyword == "mtllib")
    read_materials(std::string(words_.rest()));
  else if (keyword == "l" || keyword == "p")
    warn_once("lines", "lines and points are not used as geometry");
  else if (free_form.contains(keyword))
    warn_once("free form", "free-form curves and surfaces are not used");
  else
    warn_once(std::string(keyword), in_quotes(keyword) + " is unknown, and its line is not used");
}

void ObjReader::read_materials(const std::string& names) {
  // one name, possibly with blanks, or several names
  std::vector<std::string> candidates = {names};
  for (const auto word : split_words(names, "", max_material_files)) candidates.emplace_back(word);
  material_files_ += candidates.size();
  if (material_files_ > max_material_files)
    return warn_once(
        "mtllib",
        fmt::format(
            "expected at most {} files of materials; this one and further ones are not read",
            max_material_files));
  std::string missing;
  bool found = false;
  for (const auto& name : candidates) {
    try {
      materials_.read(find_file(name, input_.path, input_.options), input_,
                      [&](const std::string& about, const Place& place,
                          const std::string& sentence) { warn_once(about, place, sentence); });
      found = true;
    } catch (const Error& error) {
      if (missing.empty()) missing = error.what();
    }
    if (found && name == names) break;
  }
  if (!found) input_.diagnostics().note(words_.place(), "{}; the body has one color", missing);
}

// texture coordinates of a face in the image of its material; empty: it has none
std::vector<Eigen::Vector2d> ObjReader::image_points(const Face& face, size_t end,
                                                     const MtlMaterial& look) const {
  std::vector<Eigen::Vector2d> out;
  for (size_t i = face.first; i < end; ++i) {
    const int t = texture_corners_[i];
    if (t < 0 || t >= static_cast<int>(texture_points_.size())) return {};
    out.push_back(look.placed(texture_points_[t]));
  }
  return out;
}

// by number; materials with images become textures of the builder
std::vector<MtlMaterial> ObjReader::used_materials() {
  std::vector<MtlMaterial> out(used_materials_.size());
  for (const auto& [name, used] : used_materials_)
    if (const auto found = materials_.by_name.find(name); found != materials_.by_name.end())
      out[used.number] = found->second;
    else if (!materials_.by_name.empty())
      warn_once("usemtl" + name, used.place,
                fmt::format("usemtl: no material {} is defined", in_quotes(name)));
  for (MtlMaterial& look : out) {
    if (!look.image) continue;
    if (!look.colored) look.color.setOnes();
    look.number = static_cast<int>(builder_.textures.size());
    builder_.textures.push_back(look.texture());
  }
  return out;
}

void ObjReader::add_faces() {
  const std::vector<MtlMaterial> by_number = used_materials();
  const int points = static_cast<int>(builder_.vertex_count());
  const bool colored = !point_colors_.empty() && point_colors_.size() == builder_.vertex_count();
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const size_t end = f + 1 < faces_.size() ? faces_[f + 1].first : corners_.size();
    const std::span<const int> corners(corners_.data() + face.first, end - face.first);
    for (const int v : corners)
      if (v >= points)
        fail("{}:{}: expected one of {} points after f, got {}", words_.file(), face.line, points,
             int64_t{v} + 1);
    const MtlMaterial look = face.material < 0 ? MtlMaterial() : by_number[face.material];
    Eigen::Vector3f color = look.color;
    std::vector<Eigen::Vector2d> uv;
    if (colored) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (const int v : corners) sum += point_colors_[v];
      color = (sum / static_cast<float>(corners.size())).cwiseMax(0.0f).cwiseMin(1.0f);
    } else if (uv = image_points(face, end, look); !uv.empty() && look.image) {
      color = mean_color(*look.image, uv).cwiseProduct(look.texture().tint);
    }
    const FaceTexture texture{look.number, uv};
    try {
      builder_.add_face(corners, color, look.transparency, uv.empty() ? nullptr : &texture);
    } catch (const Error& error) {
      fail(error.kind(), "{}:{}: {}", words_.file(), face.line, error.what());
    }
  }
}

bool ObjReader::read() {
  while (words_.next_line()) {
    const auto keyword = words_.word();
    if (keyword == "v")
      read_point();
    else if (keyword == "vt")
      read_texture_point();
    else if (keyword == "f" || keyword == "fo")
      read_face();
    else
      read_other(keyword);
  }
  add_faces();
  note_objects();
  for (const auto& warning : warnings_) input_.diagnostics().warn(warning);
  if (!point_colors_.empty()) return point_colors_.size() == builder_.vertex_count();
  for (const auto& [name, used] : used_materials_)
    if (materials_.by_name.contains(name)) return true;
  return false;
}

}  // namespace

bool read_obj(const MeshInput& input, GeometryBuilder& builder) {
  const std::string text = plain_text(input.bytes);
  builder.report.format = "OBJ";
  return ObjReader(input, text, builder).read();
}

}  // namespace clench
