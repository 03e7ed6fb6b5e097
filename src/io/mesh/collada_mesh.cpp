#include "clench/io/mesh/collada_mesh.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "clench/io/mesh/image_file.h"
#include "clench/io/text/file_errors.h"

namespace clench {

namespace {

using Eigen::Vector3d;

constexpr int max_inputs = 64, max_stride = 64;

/// A vertex of the builder and its texture coordinates; -1: none.
struct FaceCorner {
  int vertex = 0, place = -1;
};

/// Range of the vertices of a <vertices> element in the builder.
struct Points {
  int first = 0, count = 0;
};

class MeshReader {
 public:
  MeshReader(const XmlElement& mesh, const Eigen::Affine3d& X, ColladaWork& work)
      : mesh_(mesh), X_(X), mirrored_(X.linear().determinant() < 0), work_(work) {}
  void read(const std::function<ColladaLook(const std::string&)>& look);

 private:
  Points points(const XmlElement& input);
  void read_primitive(const XmlElement& primitive, const ColladaLook& look);
  void read_places(const XmlElement& primitive, const ColladaLook& look);
  std::vector<FaceCorner> corners(const XmlElement& p);
  void add_polygons(const XmlElement& list, const std::vector<FaceCorner>& all,
                    const ColladaLook& look);
  void add(const XmlElement& at, std::vector<FaceCorner> face, const ColladaLook& look);
  void add_strip(const XmlElement& p, bool fan, const ColladaLook& look);

  XmlElement mesh_;
  const Eigen::Affine3d& X_;
  bool mirrored_;
  ColladaWork& work_;
  std::map<std::string, Points> known_;  // by the id of <vertices>
  // state of the current primitive
  Points at_;
  int offset_ = 0, stride_ = 1;
  int place_offset_ = -1;                // of texture coordinates; -1: none
  std::vector<Eigen::Vector2d> places_;  // v down from the top
  size_t faces_ = 0;
};

void spend(const XmlElement& e, size_t count, ColladaWork& work) {
  work.left -= static_cast<long>(count);
  if (work.left < 0)
    e.fail("{}: expected less data, with meshes that are used several times counted each time",
           e.name());
}

std::vector<double> read_numbers(const XmlElement& e, ColladaWork& work) {
  auto numbers = e.numbers();
  spend(e, 1 + numbers.size(), work);
  return numbers;
}

/// Warns if the count given by an element differs from the number of its contents, which is used.
void check_count(const XmlElement& e, size_t got, ColladaWork& work) {
  if (!e.attribute("count") || static_cast<size_t>(e.integer_attribute("count", 0)) == got) return;
  work.warnings.insert(
      fmt::format("counts of <{}> that differ from its contents are not used", e.name()));
}

/// Rows of at most three numbers with these names, as described by a <source> and its accessor.
std::vector<Vector3d> read_source(const XmlElement& source, ColladaWork& work,
                                  std::string_view names = "XYZ") {
  XmlElement accessor, array = source.child("float_array");
  if (const XmlElement technique = source.child("technique_common"))
    accessor = technique.child("accessor");
  const int width = static_cast<int>(names.size());
  int stride = width, offset = 0, at[3] = {0, 1, width - 1};
  if (accessor) {
    if (accessor.attribute("source")) array = work.ids.find(accessor, "source");
    if (accessor.attribute("stride")) stride = accessor.integer_attribute("stride", 1, max_stride);
    if (accessor.attribute("offset")) offset = accessor.integer_attribute("offset", 0);
    int i = 0;
    for (const XmlElement& param : accessor.children("param")) {
      const std::string name = param.attribute("name").value_or("");
      for (int k = 0; k < width; ++k)
        if (name == names.substr(static_cast<size_t>(k), 1)) at[k] = i;
      ++i;
    }
  }
  if (!array) source.fail("source: expected a float_array, got none");
  const auto numbers = read_numbers(array, work);
  check_count(array, numbers.size(), work);
  std::vector<Vector3d> out;
  const size_t last = static_cast<size_t>(std::max({at[0], at[1], at[2]}));
  for (size_t row = static_cast<size_t>(offset); row + last < numbers.size();
       row += static_cast<size_t>(stride))
    out.emplace_back(numbers[row + at[0]], numbers[row + at[1]], numbers[row + at[2]]);
  if (accessor && accessor.attribute("count")) {
    const int count = accessor.integer_attribute("count", 0);
    if (static_cast<size_t>(count) > out.size())
      accessor.fail("accessor: expected {} points, got {}", count, out.size());
    if (static_cast<size_t>(count) < out.size())
      work.warnings.insert("points beyond an accessor's count are not used");
    out.resize(static_cast<size_t>(count));
  }
  return out;
}

Points MeshReader::points(const XmlElement& input) {
  const XmlElement vertices = work_.ids.find(input, "source");
  const auto [found, added] = known_.emplace(input.expected_attribute("source"), Points());
  if (!added) return found->second;
  for (const XmlElement& inner : vertices.children("input")) {
    if (inner.attribute("semantic") != "POSITION") continue;
    found->second.first = static_cast<int>(work_.builder.vertex_count());
    const XmlElement source = work_.ids.find(inner, "source");
    for (const Vector3d& p : read_source(source, work_))
      work_.builder.add_vertex(X_ * p, source.line());
    found->second.count = static_cast<int>(work_.builder.vertex_count()) - found->second.first;
    return found->second;
  }
  vertices.fail("vertices: expected an input POSITION, got none");
}

/// The vertices listed in a <p>, as numbers of the builder, with their texture coordinates.
std::vector<FaceCorner> MeshReader::corners(const XmlElement& p) {
  const auto numbers = read_numbers(p, work_);
  if (numbers.size() % static_cast<size_t>(stride_) != 0)
    p.fail("p: expected {} numbers per corner, got {} in total", stride_, numbers.size());
  const auto number = [&](size_t i, size_t count, const char* what) {
    const double v = numbers[i];
    if (!(v >= 0 && v < static_cast<double>(count)) || v != std::floor(v))
      p.fail("p: expected {} from 0 to {}, got {}", what, static_cast<int64_t>(count) - 1, v);
    return static_cast<int>(v);
  };
  std::vector<FaceCorner> out;
  out.reserve(numbers.size() / static_cast<size_t>(stride_));
  for (size_t i = 0; i < numbers.size(); i += static_cast<size_t>(stride_)) {
    FaceCorner corner;
    corner.vertex = at_.first + number(i + static_cast<size_t>(offset_),
                                       static_cast<size_t>(at_.count), "a vertex");
    if (place_offset_ >= 0)
      corner.place =
          number(i + static_cast<size_t>(place_offset_), places_.size(), "texture coordinates");
    out.push_back(corner);
  }
  return out;
}

void MeshReader::add(const XmlElement& at, std::vector<FaceCorner> face, const ColladaLook& look) {
  if (mirrored_) std::reverse(face.begin(), face.end());
  ++faces_;
  std::vector<int> vertices;
  std::vector<Eigen::Vector2d> uv;
  for (const FaceCorner& corner : face) {
    vertices.push_back(corner.vertex);
    if (look.image && corner.place >= 0) uv.push_back(places_[static_cast<size_t>(corner.place)]);
  }
  const bool textured = look.image && uv.size() == vertices.size() && uv.size() > 2;
  const Eigen::Vector3f color = textured ? mean_color(*look.image, uv) : look.color;
  const FaceTexture texture{look.texture, uv};
  errors_at(at, [&] { work_.builder.add_face(vertices, color, 0, textured ? &texture : nullptr); });
}

/// Faces with three corners, or with the numbers of corners in <vcount>.
void MeshReader::add_polygons(const XmlElement& list, const std::vector<FaceCorner>& all,
                              const ColladaLook& look) {
  size_t at = 0;
  const auto next = [&](size_t count) {
    if (count > all.size() - at)
      list.fail("{}: expected {} corners of a face, got {}", list.name(), count, all.size() - at);
    const auto first = all.begin() + static_cast<long>(at);
    add(list, std::vector<FaceCorner>(first, first + static_cast<long>(count)), look);
    at += count;
  };
  if (const XmlElement counts = list.child("vcount"); counts && list.name() == "polylist") {
    for (const double count : read_numbers(counts, work_)) {
      if (!(count >= 0 && count <= 1 << 30) || count != std::floor(count))
        counts.fail("vcount: expected numbers of corners, got {}", count);
      next(static_cast<size_t>(count));
    }
    if (at < all.size()) work_.warnings.insert("corners beyond the last face are not used");
  } else {
    while (at < all.size()) next(3);
  }
}

/// source  COLLADA 1.4.1, tristrips and trifans
void MeshReader::add_strip(const XmlElement& p, bool fan, const ColladaLook& look) {
  const auto all = corners(p);
  for (size_t i = 2; i < all.size(); ++i) {
    const bool odd = i % 2 == 1;
    if (fan)
      add(p, {all[0], all[i - 1], all[i]}, look);
    else
      add(p, {all[i - (odd ? 1 : 2)], all[i - (odd ? 2 : 1)], all[i]}, look);
  }
}

/// Texture coordinates of the set selected by the material.
void MeshReader::read_places(const XmlElement& primitive, const ColladaLook& look) {
  place_offset_ = -1;
  places_.clear();
  if (!look.image) return;
  for (const XmlElement& input : primitive.children("input")) {
    if (input.attribute("semantic") != "TEXCOORD") continue;
    const int set = input.attribute("set") ? input.integer_attribute("set", 0) : 0;
    if (look.set && set != *look.set) continue;
    for (const Vector3d& uv : read_source(work_.ids.find(input, "source"), work_, "ST"))
      places_.emplace_back(uv.x(), 1 - uv.y());
    place_offset_ = input.integer_attribute("offset", 0, max_inputs);
    return;
  }
  work_.warnings.insert(
      "faces of a material with an image, but without texture coordinates, have one color");
}

void MeshReader::read_primitive(const XmlElement& primitive, const ColladaLook& look) {
  bool found = false;
  stride_ = 1;
  faces_ = 0;
  for (const XmlElement& input : primitive.children("input")) {
    const int offset = input.integer_attribute("offset", 0, max_inputs);
    stride_ = std::max(stride_, offset + 1);
    if (input.attribute("semantic") != "VERTEX") continue;
    offset_ = offset;
    at_ = points(input);
    found = true;
  }
  const auto lists = primitive.children("p");
  const auto holes = primitive.children("ph");
  if (!found && lists.empty() && holes.empty()) return;  // nothing to draw
  if (!found) primitive.fail("{}: expected an input VERTEX, got none", primitive.name());

  read_places(primitive, look);
  const auto kind = primitive.name();
  const bool strips = kind == "tristrips" || kind == "trifans";
  for (const XmlElement& p : lists) {
    if (kind == "polygons")
      add(p, corners(p), look);
    else if (strips)
      add_strip(p, kind == "trifans", look);
    else
      add_polygons(primitive, corners(p), look);
  }
  for (const XmlElement& ph : holes) {
    work_.warnings.insert("holes in polygons are not used");
    add(ph, corners(ph.expected("p")), look);
  }
  check_count(primitive, strips ? lists.size() : faces_, work_);
}

void MeshReader::read(const std::function<ColladaLook(const std::string&)>& look) {
  for (const XmlElement& e : mesh_.children()) {
    spend(e, 10, work_);
    const auto name = e.name();
    if (name == "lines" || name == "linestrips")
      work_.warnings.insert("lines are not used as geometry");
    else if (name == "triangles" || name == "polylist" || name == "polygons" ||
             name == "tristrips" || name == "trifans")
      read_primitive(e, look(e.attribute("material").value_or("")));
  }
}

}  // namespace

ColladaIds::ColladaIds(const XmlElement& root) {
  std::vector<XmlElement> waiting = {root};
  while (!waiting.empty()) {
    const XmlElement e = waiting.back();
    waiting.pop_back();
    if (auto id = e.attribute("id")) elements_.emplace(*id, e);
    const auto children = e.children();
    // the first of several equal ids is used
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
}

XmlElement ColladaIds::find(const XmlElement& from, const char* attribute) const {
  const std::string url = from.expected_attribute(attribute);
  if (!url.starts_with('#'))
    from.fail("{}: expected '#' and the id of an element of this file, got {}", from.name(),
              in_quotes(url));
  const auto found = elements_.find(url.substr(1));
  if (found == elements_.end())
    from.fail("{}: expected an element with the id {}, got none", from.name(),
              in_quotes(url.substr(1)));
  return found->second;
}

XmlElement ColladaIds::named(const std::string& id) const {
  const auto found = elements_.find(id);
  return found == elements_.end() ? XmlElement() : found->second;
}

void add_collada_mesh(const XmlElement& mesh, const Eigen::Affine3d& X,
                      const std::function<ColladaLook(const std::string& symbol)>& look,
                      ColladaWork& work) {
  MeshReader(mesh, X, work).read(look);
}

}  // namespace clench
