#include "clench/io/mesh/mesh_readers.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "clench/io/mesh/gltf_document.h"
#include "clench/io/mesh/texture_files.h"

namespace clench {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr size_t max_primitives = 1'000'000;

class GltfReader {
 public:
  GltfReader(const MeshInput& input, GeometryBuilder& builder)
      : document_(input), builder_(builder) {}
  bool read();
  const std::set<std::string>& warnings() const { return warnings_; }

 private:
  struct Look {
    Eigen::Vector3f color = Appearance().color;
    float transparency = 0;
    std::shared_ptr<const Image> image = {};  // null: uniform color
    int coordinates = 0;                      // number of the coordinate set that is used
    int number = -1;                          // number of the texture in the builder
    Eigen::Affine2d placed = Eigen::Affine2d::Identity();  // from coordinates to the image
  };
  using ImagePoints = std::vector<Eigen::Vector2d>;  // one per vertex; empty: no image
  std::vector<int> roots() const;
  void read_node(int i, const std::string& named_by, const Affine3d& X);
  Affine3d placement(const GltfValue& node) const;
  void read_mesh(const GltfValue& mesh, const Affine3d& X);
  void read_primitive(const GltfValue& primitive, const Affine3d& X);
  void add(const std::vector<int>& corners, int mode, const Affine3d& X, const Look& look,
           const ImagePoints& points, int first);
  Look look(const GltfValue& primitive);
  Look read_look(const GltfValue& material);
  void read_texture(const GltfValue& metallic, Look& look);
  void read_transform(const GltfValue& used, Look& look);
  Wrap wrap(const GltfValue& texture, const char* key) const;
  void add_texture(const GltfValue& material, Look& look);
  std::shared_ptr<const Image> image(int number, const std::string& expected_by);
  ImagePoints image_points(const GltfValue& primitive, const Look& look, int count);

  GltfDocument document_;
  GeometryBuilder& builder_;
  std::vector<std::pair<int, Affine3d>> waiting_;  // nodes and the poses of their parents
  std::set<int> seen_;
  std::set<std::string> warnings_;
  TextureFiles images_;
  std::map<int, Look> looks_;  // by number of the material
  size_t primitives_ = 0;
  bool colors_given_ = false;
};

/// Root nodes of the scene that is displayed by default; for a file without scenes, the nodes
/// without parents.
std::vector<int> GltfReader::roots() const {
  std::vector<int> out;
  if (document_.count("scenes") > 0) {
    const int shown = document_.integer(document_.root(), "scene", 0);
    const GltfValue scene = document_.item("scenes", shown, "scene");
    for (const GltfValue& node : document_.items(document_.member(scene, "nodes"))) {
      if (!node.json->is_number_integer()) document_.fail("{}: expected a number", node.name);
      out.push_back(static_cast<int>(std::clamp<int64_t>(node.json->get<int64_t>(), -1, 1 << 30)));
    }
    return out;
  }
  std::set<int64_t> children;
  for (int i = 0; i < document_.count("nodes"); ++i)
    for (const GltfValue& child :
         document_.items(document_.member(document_.item("nodes", i, "nodes"), "children")))
      if (child.json->is_number_integer()) children.insert(child.json->get<int64_t>());
  for (int i = 0; i < document_.count("nodes"); ++i)
    if (!children.contains(i)) out.push_back(i);
  return out;
}

Affine3d GltfReader::placement(const GltfValue& node) const {
  Affine3d X = Affine3d::Identity();
  if (const GltfValue matrix = document_.member(node, "matrix")) {
    const auto m = document_.numbers(matrix, 16);  // in column-major order
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 3; ++r) X(r, c) = m[static_cast<size_t>(4 * c + r)];
    return X;
  }
  if (const GltfValue t = document_.member(node, "translation")) {
    const auto v = document_.numbers(t, 3);
    X.translate(Vector3d(v[0], v[1], v[2]));
  }
  if (const GltfValue r = document_.member(node, "rotation")) {
    const auto v = document_.numbers(r, 4);  // x y z w
    const Eigen::Quaterniond q(v[3], v[0], v[1], v[2]);
    if (!(q.norm() > 1e-6)) document_.fail("{}: expected a unit quaternion", r.name);
    X.rotate(q.normalized());
  }
  if (const GltfValue s = document_.member(node, "scale")) {
    const auto v = document_.numbers(s, 3);
    X.scale(Vector3d(v[0], v[1], v[2]));
  }
  return X;
}

void GltfReader::read_node(int i, const std::string& named_by, const Affine3d& X_parent) {
  const GltfValue node = document_.item("nodes", i, named_by);
  if (!seen_.insert(i).second)
    document_.fail("{}: expected nodes to form a tree, got one with two parents or in a circle",
                   node.name);
  const Affine3d X = X_parent * placement(node);
  if (document_.member(node, "skin"))
    warnings_.insert("its skins are not used: skinned meshes keep their shape at rest");
  if (document_.member(node, "mesh"))
    read_mesh(document_.item("meshes", document_.expected_integer(node, "mesh"), node.name), X);
  const auto children = document_.items(document_.member(node, "children"));
  // pushed in reverse, so that the first child is visited first
  for (auto child = children.rbegin(); child != children.rend(); ++child) {
    if (!child->json->is_number_integer()) document_.fail("{}: expected a number", child->name);
    const auto number = std::clamp<int64_t>(child->json->get<int64_t>(), -1, 1 << 30);
    waiting_.emplace_back(static_cast<int>(number), X);
  }
}

void GltfReader::read_mesh(const GltfValue& mesh, const Affine3d& X) {
  if (document_.member(mesh, "weights")) warnings_.insert("its morph targets are not used");
  const GltfValue primitives = document_.member(mesh, "primitives");
  if (!primitives) return;
  primitives_ += primitives.json->size();
  if (primitives_ > max_primitives)
    document_.fail("{}: expected at most {} primitives, those used several times counted each time",
                   mesh.name, max_primitives);
  for (const GltfValue& primitive : document_.items(primitives)) read_primitive(primitive, X);
}

GltfReader::Look GltfReader::look(const GltfValue& primitive) {
  if (!document_.member(primitive, "material")) return {};
  const int number = document_.expected_integer(primitive, "material");
  const GltfValue material = document_.item("materials", number, primitive.name);
  const auto [found, is_new] = looks_.try_emplace(number);
  if (is_new) {
    found->second = read_look(material);
    add_texture(material, found->second);
  }
  return found->second;
}

GltfReader::Look GltfReader::read_look(const GltfValue& material) {
  Look out;
  const GltfValue metallic = document_.member(material, "pbrMetallicRoughness");
  read_texture(metallic, out);
  const GltfValue factor = document_.member(metallic, "baseColorFactor");
  if (!factor) return out;
  const auto rgba = document_.numbers(factor, 4);
  out.color = Vector3d(rgba[0], rgba[1], rgba[2]).cwiseMax(0).cwiseMin(1).cast<float>();
  const GltfValue mode = document_.member(material, "alphaMode");
  if (mode && *mode.json == "BLEND")
    out.transparency = static_cast<float>(std::clamp(1 - rgba[3], 0.0, 1.0));
  colors_given_ = true;
  return out;
}

void GltfReader::read_texture(const GltfValue& metallic, Look& look) {
  const GltfValue used = document_.member(metallic, "baseColorTexture");
  if (!used) return;
  const GltfValue texture =
      document_.item("textures", document_.expected_integer(used, "index"), used.name);
  if (!document_.member(texture, "source")) return;
  look.coordinates = document_.integer(used, "texCoord", 0);
  look.image = image(document_.expected_integer(texture, "source"), texture.name);
  if (!look.image) return;
  read_transform(used, look);
  look.color.setOnes();
  colors_given_ = true;
}

/// source  glTF extension KHR_texture_transform: offset * rotation * scale
void GltfReader::read_transform(const GltfValue& used, Look& look) {
  const GltfValue transform =
      document_.member(document_.member(used, "extensions"), "KHR_texture_transform");
  if (!transform) return;
  look.coordinates = document_.integer(transform, "texCoord", look.coordinates);
  Eigen::Vector2d offset = Eigen::Vector2d::Zero(), scale = Eigen::Vector2d::Ones();
  if (const GltfValue v = document_.member(transform, "offset"))
    offset = Eigen::Map<const Eigen::Vector2d>(document_.numbers(v, 2).data());
  if (const GltfValue v = document_.member(transform, "scale"))
    scale = Eigen::Map<const Eigen::Vector2d>(document_.numbers(v, 2).data());
  double angle = 0;  // counter-clockwise in the image, whose v points down
  if (const GltfValue v = document_.member(transform, "rotation")) {
    if (!v.json->is_number()) document_.fail("{}: expected a number", v.name);
    angle = v.json->get<double>();
  }
  look.placed = Eigen::Translation2d(offset) * Eigen::Rotation2Dd(-angle) * Eigen::Scaling(scale);
}

Wrap GltfReader::wrap(const GltfValue& texture, const char* key) const {
  if (!document_.member(texture, "sampler")) return Wrap::repeat;
  const GltfValue sampler =
      document_.item("samplers", document_.expected_integer(texture, "sampler"), texture.name);
  const int mode = document_.integer(sampler, key, 10497);
  return mode == 33071 ? Wrap::clamp : mode == 33648 ? Wrap::mirror : Wrap::repeat;
}

void GltfReader::add_texture(const GltfValue& material, Look& look) {
  if (!look.image) return;
  const GltfValue used =
      document_.member(document_.member(material, "pbrMetallicRoughness"), "baseColorTexture");
  const GltfValue texture =
      document_.item("textures", document_.expected_integer(used, "index"), used.name);
  look.number = static_cast<int>(builder_.textures.size());
  builder_.textures.push_back(
      {look.image, wrap(texture, "wrapS"), wrap(texture, "wrapT"), look.color});
}

std::shared_ptr<const Image> GltfReader::image(int number, const std::string& expected_by) {
  const std::string shown = fmt::format("images[{}]", number);
  return images_.decode(
      shown, shown, [&] { return document_.image_bytes(number, expected_by); },
      [&](const std::string& sentence) { warnings_.insert(sentence); });
}

GltfReader::ImagePoints GltfReader::image_points(const GltfValue& primitive, const Look& look,
                                                 int count) {
  const std::string key = fmt::format("TEXCOORD_{}", look.coordinates);
  const GltfValue attributes = document_.member(primitive, "attributes");
  if (!look.image || !document_.member(attributes, key.c_str())) return {};
  const auto uv = document_.read_floats(document_.expected_integer(attributes, key.c_str()), 2,
                                        attributes.name + "." + key);
  if (uv.size() != 2 * static_cast<size_t>(count)) {
    warnings_.insert("texture coordinates that differ in number from the positions are not used");
    return {};
  }
  ImagePoints out;
  for (int i = 0; i < count; ++i)
    out.push_back(look.placed * Eigen::Vector2d(uv[2 * i], uv[2 * i + 1]));
  return out;
}

void GltfReader::read_primitive(const GltfValue& primitive, const Affine3d& X) {
  const int mode = document_.integer(primitive, "mode", 4);
  if (mode < 4 || mode > 6) {
    warnings_.insert("its points and lines are not used as geometry");
    return;
  }
  if (const GltfValue used = document_.member(primitive, "extensions"))
    if (document_.member(used, "KHR_draco_mesh_compression"))
      document_.fail("{}: meshes compressed by Draco are not supported", primitive.name);
  const GltfValue position =
      document_.member(document_.member(primitive, "attributes"), "POSITION");
  if (!position) {
    warnings_.insert("its primitives without positions are not used");
    return;
  }
  const auto p = document_.read_floats(
      document_.expected_integer(document_.member(primitive, "attributes"), "POSITION"), 3,
      position.name);
  builder_.limit_to(document_.bytes());
  const int first = static_cast<int>(builder_.vertex_count()),
            count = static_cast<int>(p.size() / 3);
  for (int i = 0; i < count; ++i)
    builder_.add_vertex(X * Vector3d(p[3 * i], p[3 * i + 1], p[3 * i + 2]));

  std::vector<int> corners;
  if (document_.member(primitive, "indices")) {
    corners = document_.read_indices(document_.expected_integer(primitive, "indices"),
                                     primitive.name + ".indices");
    for (int& v : corners) {
      if (v >= count)
        document_.fail("{}: expected an index below {}, got {}", primitive.name, count, v);
      v += first;
    }
  } else {
    for (int i = 0; i < count; ++i) corners.push_back(first + i);
  }
  const Look looks = look(primitive);
  add(corners, mode, X, looks, image_points(primitive, looks, count), first);
}

/// source  glTF 2.0, section 3.7.2.1: triangles, strips and fans
void GltfReader::add(const std::vector<int>& corners, int mode, const Affine3d& X, const Look& look,
                     const ImagePoints& points, int first) {
  const bool mirrored = X.linear().determinant() < 0;
  const size_t count = corners.size(), step = mode == 4 ? 3 : 1;
  for (size_t i = 0; i + 2 < count; i += step) {
    std::array<int, 3> t = {corners[i], corners[i + 1], corners[i + 2]};
    if (mode == 5 && i % 2 == 1) std::swap(t[1], t[2]);
    if (mode == 6) t[0] = corners[0];
    if (mirrored) std::swap(t[1], t[2]);
    if (points.empty()) {
      builder_.add_face(t, look.color, look.transparency);
      continue;
    }
    const std::array<Eigen::Vector2d, 3> at = {points[t[0] - first], points[t[1] - first],
                                               points[t[2] - first]};
    const Eigen::Vector3f color = look.color.cwiseProduct(mean_color(*look.image, at));
    const FaceTexture texture{look.number, at};
    builder_.add_face(t, color, look.transparency, &texture);
  }
  if (mode == 4 && count % 3 != 0)
    warnings_.insert("its indices after the last complete triangle are not used");
}

bool GltfReader::read() {
  if (document_.count("animations") > 0) warnings_.insert("its animations are not used");
  const auto first = roots();
  for (auto node = first.rbegin(); node != first.rend(); ++node)
    waiting_.emplace_back(*node, Affine3d::Identity());
  while (!waiting_.empty()) {
    const auto [node, X] = waiting_.back();
    waiting_.pop_back();
    read_node(node, "nodes", X);
  }
  return colors_given_;
}

}  // namespace

bool read_gltf(const MeshInput& input, GeometryBuilder& builder) {
  builder.report.format = "glTF";
  builder.report.unit_source = UnitSource::format;
  builder.report.up = 'y';
  return run_reader(input, [&] { return GltfReader(input, builder); });
}

}  // namespace clench
