#include "clench/io/urdf/urdf_links.h"

#include <algorithm>

#include "clench/io/urdf/urdf_files.h"

namespace clench {

Pose read_urdf_origin(const XmlElement& element, UnusedXml& unused) {
  const XmlElement origin = element.child("origin");
  if (!origin) return {};
  unused.attributes(origin, {"xyz", "rpy"});
  const XmlValues values(origin);
  const Eigen::Vector3d rpy = values.vec3("rpy", {0, 0, 0});
  // about the fixed axes x, then y, then z
  const Pose turn = Pose::turn(rpy.z(), Eigen::Vector3d::UnitZ()) *
                    Pose::turn(rpy.y(), Eigen::Vector3d::UnitY()) *
                    Pose::turn(rpy.x(), Eigen::Vector3d::UnitX());
  return Pose::translation(values.vec3("xyz", {0, 0, 0})) * turn;
}

std::optional<PieceColor> UrdfLinkReader::read_color(const XmlElement& material) {
  unused_.attributes(material, {"name"});
  for (const auto& child : material.children())
    if (child.name() != "color") unused_.element(child);
  const XmlElement color = material.child("color");
  if (!color) {
    const auto found = materials_.find(material.attribute("name").value_or(""));
    if (found == materials_.end()) return {};
    return found->second;
  }
  const auto rgba = XmlValues(color).color("rgba", 3, repairs_);
  PieceColor out{Eigen::Vector3d(rgba[0], rgba[1], rgba[2]).cast<float>(), 0};
  if (rgba.size() == 4) out.transparency = static_cast<float>(1 - rgba[3]);
  return out;
}

void UrdfLinkReader::read_materials(const XmlElement& robot) {
  for (const auto& material : robot.children("material"))
    if (const auto color = read_color(material))
      materials_[material.attribute("name").value_or("")] = *color;
}

void UrdfLinkReader::read_inertial(const XmlElement& element, BodySpec& body, LinkPieces& pieces) {
  // a robot with an invalid inertia can still be used for grasps
  try {
    const XmlElement mass = element.expected("mass"), inertia = element.child("inertia");
    Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
    if (inertia) {
      const XmlValues v(inertia);
      const double xy = v.number("ixy", 0), xz = v.number("ixz", 0), yz = v.number("iyz", 0);
      // read all numbers first: an error must not leave the matrix incomplete
      const double xx = v.number("ixx"), yy = v.number("iyy"), zz = v.number("izz");
      I << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    }
    const XmlValues values(mass);
    const double m = values.number("value");
    if (const auto wrong = fault(mass_rule, m); !wrong.empty()) values.fail("value", "{}", wrong);
    const Pose X_LC = read_urdf_origin(element, unused_);
    const Inertial inertial = set_inertial(body, m, X_LC, I);
    inertial_faults_.add(inertia ? inertial : Inertial::not_given, element.place(), body.name);
    pieces.has_inertial = true;
  } catch (const Error& error) {
    cache_.diagnostics().warn(
        fmt::format("{}; the inertial of link '{}' is not used", error.what(), excerpt(body.name)));
  }
}

std::optional<GeometryPiece> UrdfLinkReader::read_shape(const XmlElement& shape, bool visual) {
  const std::string kind(shape.name());
  if (kind == "mesh") return read_mesh(shape, visual);
  const XmlValues values(shape);
  const auto positive = [&](const char* name) {
    const double length = repairs_.magnitude(values.number(name), values.subject(name));
    if (!(length > 0)) values.fail(name, "expected a length > 0, got {}", length);
    return length;
  };
  if (kind == "box") {
    auto edges = values.numbers("size", 3, 3);
    for (double& x : edges) {
      x = repairs_.magnitude(x, values.subject("size"));
      if (!(x > 0)) values.fail("size", "expected lengths > 0, got {}", x);
    }
    return geometry_.primitive(kind, edges);
  }
  if (kind == "sphere") return geometry_.primitive(kind, {positive("radius")});
  return geometry_.primitive(kind, {positive("radius"), positive("length")});
}

std::optional<GeometryPiece> UrdfLinkReader::read_mesh(const XmlElement& shape, bool visual) {
  const XmlValues values(shape);
  GeometryPiece piece;
  piece.scale = values.vec3("scale", {1, 1, 1});
  if (piece.scale.cwiseAbs().minCoeff() == 0) values.fail("scale", "expected factors other than 0");
  const std::string name = values.text("filename");
  try {
    piece.geometry = geometry_.file(find_robot_file(name, path_, cache_.options()));
  } catch (const Error& error) {
    // visual geometry may be missing
    if (!visual) shape.fail("mesh: {}", error.what());
    if (undrawn_++ == 0) first_undrawn_ = {shape.place().of("mesh"), error.what()};
    return {};
  }
  return piece;
}

/// The one element of a geometry that describes a shape.
XmlElement UrdfLinkReader::shape_of(const XmlElement& geometry, const std::string& link) {
  unused_.attributes(geometry, {"name"});
  constexpr std::string_view kinds[] = {"box", "sphere", "cylinder", "capsule", "mesh"};
  XmlElement shape;
  for (const auto& child : geometry.children()) {
    if (std::find(std::begin(kinds), std::end(kinds), child.name()) == std::end(kinds))
      unused_.element(child);
    else if (shape)
      child.fail("link '{}': expected one shape in a geometry, got a second, <{}>", excerpt(link),
                 excerpt(child.name()));
    else
      shape = child;
  }
  if (!shape)
    geometry.fail("link '{}': expected a box, sphere, cylinder, capsule or mesh, got none",
                  excerpt(link));
  return shape;
}

std::optional<GeometryPiece> UrdfLinkReader::read_piece(const XmlElement& element,
                                                        const std::string& link, bool visual) {
  if (++piece_count_ > max_pieces)
    element.fail("expected at most {} pieces of geometry", max_pieces);
  unused_.attributes(element, {"name"});
  for (const auto& child : element.children())
    if (child.name() != "geometry" && child.name() != "origin" && child.name() != "material")
      unused_.element(child);
  const XmlElement shape = shape_of(element.expected("geometry"), link);
  unused_.attributes(shape, {"size", "radius", "length", "filename", "scale"});
  auto piece = read_shape(shape, visual);
  if (!piece) return {};
  piece->X_LG = read_urdf_origin(element, unused_);
  if (const XmlElement material = element.child("material"); material && visual)
    piece->color = read_color(material);
  return piece;
}

void UrdfLinkReader::read_link(const XmlElement& element) {
  TreeLink link;
  link.body.name = element.expected_attribute("name");
  link.body.source = path_.generic_string();
  if (link.body.name.empty()) element.fail("link: expected a name, got nothing");
  const auto [other, is_new] =
      given_.numbers.emplace(link.body.name, static_cast<int>(given_.links.size()));
  if (!is_new) {
    repairs_.add("link", element.place().of("link '{}'", excerpt(link.body.name)),
                 "there is another one of this name; the first one counts");
    return;
  }
  if (given_.links.size() >= max_links) element.fail("expected at most {} links", max_links);
  unused_.attributes(element, {"name"});
  LinkPieces pieces;
  pieces.place = element.place();
  for (const auto& child : element.children()) {
    const bool visual = child.name() == "visual";
    if (visual || child.name() == "collision") {
      if (auto piece = read_piece(child, link.body.name, visual))
        (visual ? pieces.visual : pieces.collision).push_back(std::move(*piece));
    } else if (child.name() == "inertial") {
      read_inertial(child, link.body, pieces);
    } else {
      unused_.element(child);
    }
  }
  given_.links.push_back(std::move(link));
  given_.pieces.push_back(std::move(pieces));
}

// Hands with a missing package lack one mesh per link: one message reports all of them.
void UrdfLinkReader::warn_of_undrawn() const {
  if (undrawn_ == 0) return;
  Diagnostic first = first_undrawn_;
  first.text += undrawn_ == 1 ? "; it is not drawn"
                              : fmt::format("; it and {} other meshes are not drawn", undrawn_ - 1);
  cache_.diagnostics().warn(std::move(first));
}

void UrdfLinkReader::report() const {
  inertial_faults_.tell(cache_);
  warn_of_undrawn();
}

}  // namespace clench
