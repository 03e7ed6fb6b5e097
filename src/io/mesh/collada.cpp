#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/units.h"
#include "clench/io/mesh/collada_mesh.h"
#include "clench/io/mesh/collada_textures.h"

namespace clench {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr size_t max_bytes = size_t{256} << 20;
constexpr long max_tags = 8'000'000;  // each takes about 100 bytes when parsed
constexpr int max_nodes = 200'000;    // those that are used several times count each time
constexpr int deepest_node = 200;

class ColladaReader {
 public:
  ColladaReader(const MeshInput& input, const std::string& text, GeometryBuilder& builder)
      : xml_(input.file(), text, max_bytes),
        ids_(xml_.root()),
        work_{ids_, builder},
        textures_(input, ids_, work_) {}
  /// returns  true if there are colors
  bool read();
  const std::set<std::string>& warnings() const { return work_.warnings; }

 private:
  void read_asset(const XmlElement& root);
  XmlElement scene(const XmlElement& root) const;
  void read_node(const XmlElement& node, const Affine3d& X_parent, int depth);
  Affine3d placement(const XmlElement& node);
  void read_controller(const XmlElement& instance, const Affine3d& X);
  void read_geometry(const XmlElement& geometry, const XmlElement& instance, const Affine3d& X);
  ColladaLook look(const XmlElement& instance, const std::string& symbol);

  XmlFile xml_;
  ColladaIds ids_;
  ColladaWork work_;
  ColladaTextures textures_;
  int nodes_ = 0;
  bool colors_given_ = false;
};

Affine3d from_rows(const std::vector<double>& m) {
  Affine3d X = Affine3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) X(r, c) = m[static_cast<size_t>(4 * r + c)];
  return X;
}

/// source  COLLADA 1.4.1, lookat: eye, the point of interest along -z, the up direction
Affine3d looking(const XmlElement& e) {
  const auto v = e.numbers(9);
  const Vector3d eye(v[0], v[1], v[2]), up(v[6], v[7], v[8]);
  const Vector3d back = eye - Vector3d(v[3], v[4], v[5]), side = up.cross(back);
  if (!(side.norm() > 0)) e.fail("lookat: expected an upward direction across the view");
  Affine3d X = Affine3d::Identity();
  X.linear().col(0) = side.normalized();
  X.linear().col(2) = back.normalized();
  X.linear().col(1) = X.linear().col(2).cross(X.linear().col(0));
  X.translation() = eye;
  return X;
}

void ColladaReader::read_asset(const XmlElement& root) {
  MeshReport& report = work_.builder.report;
  report.format = "COLLADA";
  report.unit_source = UnitSource::format;  // defaults: meters and y up
  report.up = 'y';
  const XmlElement asset = root.child("asset");
  if (!asset) return;
  if (const XmlElement unit = asset.child("unit"); unit && unit.attribute("meter")) {
    report.unit = unit.number_attribute("meter");
    report.unit_source = UnitSource::file;
    if (!(report.unit > 0)) unit.fail("unit: expected a length > 0 [m], got {}", report.unit);
  }
  if (const XmlElement up = asset.child("up_axis")) {
    const std::string axis = up.text();
    if (axis != "X_UP" && axis != "Y_UP" && axis != "Z_UP")
      up.fail("up_axis: expected X_UP, Y_UP or Z_UP, got {}", in_quotes(axis));
    report.up = static_cast<char>(axis[0] - 'X' + 'x');
  }
}

/// The displayed scene: the one named by <scene>, otherwise the first one; may be null.
XmlElement ColladaReader::scene(const XmlElement& root) const {
  if (const XmlElement shown = root.child("scene"))
    if (const XmlElement instance = shown.child("instance_visual_scene"))
      return ids_.find(instance, "url");
  const XmlElement library = root.child("library_visual_scenes");
  return library ? library.child("visual_scene") : XmlElement();
}

/// source  COLLADA 1.4.1, node: the transformations are multiplied in order
Affine3d ColladaReader::placement(const XmlElement& node) {
  Affine3d X = Affine3d::Identity();
  for (const XmlElement& e : node.children()) {
    const auto name = e.name();
    if (name == "matrix") {
      X = X * from_rows(e.numbers(16));
    } else if (name == "translate") {
      X.translate(e.vector());
    } else if (name == "scale") {
      X.scale(e.vector());
    } else if (name == "rotate") {
      const auto v = e.numbers(4);  // axis, degrees
      const Vector3d axis(v[0], v[1], v[2]);
      if (axis.norm() > 0) X.rotate(Eigen::AngleAxisd(v[3] * units::degree, axis.normalized()));
    } else if (name == "lookat") {
      X = X * looking(e);
    } else if (name == "skew") {
      e.fail("skew: expected matrix, translate, rotate, scale or lookat");
    }
  }
  return X;
}

void ColladaReader::read_node(const XmlElement& node, const Affine3d& X_parent, int depth) {
  if (depth > deepest_node)
    node.fail("node: expected at most {} nodes in each other, and none in itself", deepest_node);
  if (++nodes_ > max_nodes)
    node.fail("node: expected at most {} nodes, those used several times counted each time",
              max_nodes);
  const Affine3d X = X_parent * placement(node);
  for (const XmlElement& e : node.children()) {
    const auto name = e.name();
    if (name == "node")
      read_node(e, X, depth + 1);
    else if (name == "instance_node")
      read_node(ids_.find(e, "url"), X, depth + 1);
    else if (name == "instance_geometry")
      read_geometry(ids_.find(e, "url"), e, X);
    else if (name == "instance_controller")
      read_controller(e, X);
  }
}

void ColladaReader::read_controller(const XmlElement& instance, const Affine3d& X) {
  work_.warnings.insert("skins and morphs are not used: their meshes keep their shape at rest");
  const XmlElement controller = ids_.find(instance, "url");
  const XmlElement skin = controller.child("skin");
  if (!skin) return;
  const XmlElement source = ids_.find(skin, "source");
  const XmlElement bind = skin.child("bind_shape_matrix");
  const Affine3d X_bind = bind ? from_rows(bind.numbers(16)) : Affine3d::Identity();
  if (source.name() == "geometry") read_geometry(source, instance, X * X_bind);
}

void ColladaReader::read_geometry(const XmlElement& geometry, const XmlElement& instance,
                                  const Affine3d& X) {
  const XmlElement mesh = geometry.child("mesh");
  if (!mesh) {
    work_.warnings.insert("a geometry that is no mesh is not used");
    return;
  }
  const auto found_look = [&](const std::string& symbol) {
    const ColladaLook found = instance ? look(instance, symbol) : ColladaLook();
    colors_given_ = colors_given_ || found.given;
    return found;
  };
  add_collada_mesh(mesh, X, found_look, work_);
}

/// The diffuse color or image of the material that an instance binds to the symbol.
ColladaLook ColladaReader::look(const XmlElement& instance, const std::string& symbol) {
  const XmlElement bound = inner_element(instance, {"bind_material", "technique_common"});
  if (!bound) return {};
  for (const XmlElement& material : bound.children("instance_material")) {
    if (material.attribute("symbol") != symbol) continue;
    const XmlElement effect = ids_.find(material, "target").child("instance_effect");
    if (!effect) return {};
    const XmlElement profile = ids_.find(effect, "url").child("profile_COMMON");
    const XmlElement technique = inner_element(profile, {"technique"});
    if (!technique) return {};
    for (const XmlElement& shading : technique.children()) {
      if (const XmlElement color = inner_element(shading, {"diffuse", "color"})) {
        const auto rgb = color.numbers();
        if (rgb.size() < 3) color.fail("color: expected three or four numbers, got {}", rgb.size());
        return {Vector3d(rgb[0], rgb[1], rgb[2]).cwiseMax(0).cwiseMin(1).cast<float>(), true};
      }
      if (const XmlElement texture = inner_element(shading, {"diffuse", "texture"}))
        return textures_.look(texture, profile, material);
    }
  }
  return {};
}

bool ColladaReader::read() {
  const XmlElement root = xml_.root();
  if (root.name() != "COLLADA")
    root.fail("expected an element <COLLADA>, got <{}>", excerpt(root.name()));
  read_asset(root);
  if (const XmlElement shown = scene(root)) {
    for (const XmlElement& node : shown.children("node")) read_node(node, Affine3d::Identity(), 0);
    return colors_given_;
  }
  work_.warnings.insert("it has no scene; its geometries are used without transforms");
  for (const XmlElement& library : root.children("library_geometries"))
    for (const XmlElement& geometry : library.children("geometry"))
      read_geometry(geometry, {}, Affine3d::Identity());
  return colors_given_;
}

}  // namespace

bool read_collada(const MeshInput& input, GeometryBuilder& builder) {
  const std::string file = input.file(), text = plain_text(input.bytes);
  const auto tags = std::count(text.begin(), text.end(), '<');
  if (tags > max_tags) fail("{}: expected at most {} tags, got {}", file, max_tags, tags);
  return run_reader(input, [&] { return ColladaReader(input, text, builder); });
}

}  // namespace clench
