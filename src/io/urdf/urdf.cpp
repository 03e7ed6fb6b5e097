#include "clench/io/urdf/urdf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clench/base/suggest.h"
#include "clench/io/tree/tree_links.h"
#include "clench/io/tree/tree_robot.h"
#include "clench/io/tree/tree_xml.h"
#include "clench/io/urdf/urdf_clench.h"
#include "clench/io/urdf/urdf_files.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

/// A joint as in the file, before the tree is known.
struct FileJoint {
  XmlElement element;
  std::string name, type;
  int parent = -1, child = -1;  // links, in the file's order
};

class UrdfReader {
 public:
  UrdfReader(const fs::path& path, FileCache& cache)
      : path_(path),
        file_(path.filename().string()),
        cache_(cache),
        xml_(path),
        geometry_(cache.options()),
        repairs_(cache.diagnostics()) {}
  RobotSpec read();

 private:
  void warn_of_undrawn() const;
  void refuse_xacro(const XmlElement& element) const;
  void read_materials();
  void read_link(const XmlElement& element);
  void read_inertial(const XmlElement& element, BodySpec& body, LinkPieces& pieces);
  std::optional<GeometryPiece> read_piece(const XmlElement& element, const std::string& link,
                                          bool visual);
  std::optional<GeometryPiece> read_geometry_of(const XmlElement& shape, bool visual);
  std::optional<PieceColor> read_color(const XmlElement& material);
  Pose read_origin(const XmlElement& element);
  void read_joint_names(const XmlElement& element);
  int link_of(const XmlElement& joint, const char* end) const;
  void find_still_joints();
  Pose read_joint_origin(const FileJoint& from);
  void order_links();
  TreeJoint read_joint(const FileJoint& from);
  void read_axis(const FileJoint& from, TreeJoint& joint);
  void read_limits(const FileJoint& from, TreeJoint& joint);
  void read_mimics();

  const fs::path& path_;
  const std::string file_;
  FileCache& cache_;
  XmlFile xml_;
  TreeGeometry geometry_;
  Repairs repairs_;
  UnusedXml unused_;
  InertialFaults inertial_faults_;
  std::map<std::string, PieceColor> materials_;
  std::vector<TreeLink> links_;  // in the file's order
  std::vector<LinkPieces> pieces_;
  std::map<std::string, int> link_numbers_;
  std::vector<FileJoint> joints_;
  std::set<std::string> names_;          // of joints
  std::map<std::string, double> still_;  // positions of joints that never move [rad or m]
  size_t piece_count_ = 0;
  TreeModel tree_;
  std::map<std::string, int> joint_numbers_;  // in the tree
  int undrawn_ = 0;                           // visual meshes that are missing
  Diagnostic first_undrawn_;
};

void UrdfReader::refuse_xacro(const XmlElement& element) const {
  // an expanded file contains neither elements of xacro nor its expressions
  bool raw = element.name().starts_with("xacro:");
  for (const auto& name : element.attributes())
    raw = raw || element.attribute(name)->find("${") != std::string::npos ||
          element.attribute(name)->find("$(") != std::string::npos;
  if (raw)
    element.fail("<{}> is xacro; expand it first: xacro {} > robot.urdf", excerpt(element.name()),
                 file_);
  for (const auto& child : element.children()) refuse_xacro(child);
}

Pose UrdfReader::read_origin(const XmlElement& element) {
  const XmlElement origin = element.child("origin");
  if (!origin) return {};
  unused_.attributes(origin, {"xyz", "rpy"});
  const XmlValues values(origin);
  const Eigen::Vector3d rpy = values.vec3("rpy", {0, 0, 0});
  // about the fixed axes x, then y, then z
  const Pose turn = Pose::turn(rpy.z(), Eigen::Vector3d::UnitZ()) *
                    Pose::turn(rpy.y(), Eigen::Vector3d::UnitY()) *
                    Pose::turn(rpy.x(), Eigen::Vector3d::UnitX());
  return Pose::translation(values.vec3("xyz", {0, 0, 0})) * turn;
}

// --- links ---

std::optional<PieceColor> UrdfReader::read_color(const XmlElement& material) {
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

void UrdfReader::read_materials() {
  for (const auto& material : xml_.root().children("material"))
    if (const auto color = read_color(material))
      materials_[material.attribute("name").value_or("")] = *color;
}

void UrdfReader::read_inertial(const XmlElement& element, BodySpec& body, LinkPieces& pieces) {
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
    const Pose X_LC = read_origin(element);
    const Inertial inertial = set_inertial(body, m, X_LC, I);
    inertial_faults_.add(inertia ? inertial : Inertial::not_given, element.place(), body.name);
    pieces.has_inertial = true;
  } catch (const Error& error) {
    cache_.diagnostics().warn(
        fmt::format("{}; the inertial of link '{}' is not used", error.what(), excerpt(body.name)));
  }
}

std::optional<GeometryPiece> UrdfReader::read_geometry_of(const XmlElement& shape, bool visual) {
  const XmlValues values(shape);
  const std::string kind(shape.name());
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
  if (kind != "mesh") return geometry_.primitive(kind, {positive("radius"), positive("length")});
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

std::optional<GeometryPiece> UrdfReader::read_piece(const XmlElement& element,
                                                    const std::string& link, bool visual) {
  if (++piece_count_ > max_pieces)
    element.fail("expected at most {} pieces of geometry", max_pieces);
  unused_.attributes(element, {"name"});
  for (const auto& child : element.children())
    if (child.name() != "geometry" && child.name() != "origin" && child.name() != "material")
      unused_.element(child);
  const XmlElement geometry = element.expected("geometry");
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
  unused_.attributes(shape, {"size", "radius", "length", "filename", "scale"});
  auto piece = read_geometry_of(shape, visual);
  if (!piece) return {};
  piece->X_LG = read_origin(element);
  if (const XmlElement material = element.child("material"); material && visual)
    piece->color = read_color(material);
  return piece;
}

void UrdfReader::read_link(const XmlElement& element) {
  TreeLink link;
  link.body.name = element.expected_attribute("name");
  link.body.source = path_.generic_string();
  if (link.body.name.empty()) element.fail("link: expected a name, got nothing");
  const auto [other, is_new] =
      link_numbers_.emplace(link.body.name, static_cast<int>(links_.size()));
  if (!is_new) {
    repairs_.add("link", element.place().of("link '{}'", excerpt(link.body.name)),
                 "there is another one of this name; the first one counts");
    return;
  }
  if (links_.size() >= max_links) element.fail("expected at most {} links", max_links);
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
  links_.push_back(std::move(link));
  pieces_.push_back(std::move(pieces));
}

// --- joints ---

int UrdfReader::link_of(const XmlElement& joint, const char* end) const {
  const XmlElement element = joint.expected(end);
  const std::string name = element.expected_attribute("link");
  const auto found = link_numbers_.find(name);
  if (found != link_numbers_.end()) return found->second;
  element.fail("{}: no link {}{}", end, in_quotes(name),
               did_you_mean(name, names_in(link_numbers_)));
}

void UrdfReader::read_joint_names(const XmlElement& element) {
  FileJoint joint{element, element.expected_attribute("name"), "", -1, -1};
  if (joint.name.empty()) element.fail("joint: expected a name, got nothing");
  if (joints_.size() >= max_joints) element.fail("expected at most {} joints", max_joints);
  if (!names_.insert(joint.name).second) {
    const std::string own = unused_name(joint.name, names_);
    repairs_.add("joint", element.place().of("joint '{}'", excerpt(joint.name)),
                 "there is another one of this name; it is called '{}'", excerpt(own));
    names_.insert(joint.name = own);
  }
  element.expected_attribute("type");
  joint.type = XmlValues(element).word(
      "type", {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"}, "");
  joint.parent = link_of(element, "parent");
  joint.child = link_of(element, "child");
  if (links_[joint.child].parent >= 0)
    element.fail("joint '{}': link '{}' has a parent already, '{}'", excerpt(joint.name),
                 excerpt(links_[joint.child].body.name),
                 excerpt(links_[links_[joint.child].parent].body.name));
  if (joint.parent == joint.child)
    element.fail("joint '{}': expected two links, got '{}' twice", excerpt(joint.name),
                 excerpt(links_[joint.child].body.name));
  links_[joint.child].parent = joint.parent;
  unused_.attributes(element, {"name", "type"});
  for (const auto& child : element.children()) {
    constexpr std::string_view known[] = {"parent", "child", "origin",  "axis",
                                          "limit",  "mimic", "dynamics"};
    if (std::find(std::begin(known), std::end(known), child.name()) == std::end(known))
      unused_.element(child);
  }
  joints_.push_back(std::move(joint));
}

/// Finds fixed, floating and planar joints, and joints that mimic one of them.
void UrdfReader::find_still_joints() {
  for (const FileJoint& joint : joints_)
    if (joint.type == "fixed" || joint.type == "floating" || joint.type == "planar")
      still_[joint.name] = 0;
  // repeated until no more followers of followers are found
  for (bool found = true; found;) {
    found = false;
    for (const FileJoint& joint : joints_) {
      const XmlElement mimic = joint.element.child("mimic");
      if (!mimic || still_.contains(joint.name)) continue;
      const auto leader = still_.find(mimic.attribute("joint").value_or(""));
      if (leader == still_.end()) continue;
      const XmlValues values(mimic);
      const double value =
          values.number("multiplier", 1) * leader->second + values.number("offset", 0);
      if (!std::isfinite(value))
        mimic.fail("joint '{}': expected a finite position, got {}", excerpt(joint.name), value);
      repairs_.add("still mimic", mimic.place(),
                   "joint '{}' mimics '{}', which does not move; it is fixed at {:.6g} {}",
                   excerpt(joint.name), excerpt(leader->first), value,
                   joint.type == "prismatic" ? "m" : "rad");
      still_[joint.name] = value;
      found = true;
    }
  }
}

/// Pose of the joint's link in its parent; for moving joints, at position 0.
Pose UrdfReader::read_joint_origin(const FileJoint& from) {
  const Pose origin = read_origin(from.element);
  const auto still = still_.find(from.name);
  if (still == still_.end() || still->second == 0) return origin;
  TreeJoint joint;
  joint.kind = from.type == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  read_axis(from, joint);
  return origin * joint_pose(joint, still->second);
}

/// Orders links from the root, each after its parent, branches in the file's order.
void UrdfReader::order_links() {
  if (links_.empty()) xml_.root().fail("robot: expected links, got none");
  std::vector<int> roots;
  for (int i = 0; i < static_cast<int>(links_.size()); ++i)
    if (links_[i].parent < 0) roots.push_back(i);
  if (roots.empty()) xml_.root().fail("robot: every link has a parent: its joints form a loop");
  if (roots.size() > 1)
    xml_.root().fail("robot: expected one link without a parent, got {}: '{}' and '{}'{}",
                     roots.size(), excerpt(links_[roots[0]].body.name),
                     excerpt(links_[roots[1]].body.name), roots.size() > 2 ? " among them" : "");
  std::vector<std::vector<const FileJoint*>> below(links_.size());
  for (const FileJoint& joint : joints_) below[joint.parent].push_back(&joint);
  std::vector<LinkPieces> pieces;
  struct Step {
    int link, parent;
    const FileJoint* joint;
  };
  std::vector<Step> stack = {{roots.front(), -1, nullptr}};
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const int number = static_cast<int>(tree_.links.size());
    TreeLink link = std::move(links_[step.link]);
    link.parent = step.parent;
    if (step.joint) {
      link.X_PL = read_joint_origin(*step.joint);
      // joints keep the file's order; their numbers refer to it
      if (const auto found = joint_numbers_.find(step.joint->name); found != joint_numbers_.end())
        link.joints.push_back(found->second);
    }
    tree_.links.push_back(std::move(link));
    pieces.push_back(std::move(pieces_[step.link]));
    for (auto it = below[step.link].rbegin(); it != below[step.link].rend(); ++it)
      stack.push_back({(*it)->child, number, *it});
  }
  if (tree_.links.size() < links_.size())
    xml_.root().fail("robot: {} of its links are connected to no root: their joints form a loop",
                     links_.size() - tree_.links.size());
  pieces_ = std::move(pieces);
}

void UrdfReader::read_axis(const FileJoint& from, TreeJoint& joint) {
  const XmlElement element = from.element.child("axis");
  const Eigen::Vector3d axis =
      element ? XmlValues(element).vec3("xyz", {1, 0, 0}) : Eigen::Vector3d(1, 0, 0);
  if (!(axis.stableNorm() > 1e-9))
    element.fail("joint '{}': axis: expected a direction, got ({}, {}, {})", excerpt(joint.name),
                 axis.x(), axis.y(), axis.z());
  joint.axis = axis.stableNormalized();
}

void UrdfReader::read_limits(const FileJoint& from, TreeJoint& joint) {
  const XmlElement element = from.element.child("limit");
  const bool slides = joint.kind == JointKind::prismatic;
  const char* unit = slides ? "m" : "rad";
  const double far = slides ? endless_slide : endless_turn;
  joint.min = -far, joint.max = far, joint.endless = true;
  if (element) {
    unused_.attributes(element, {"lower", "upper", "effort", "velocity"});
    const XmlValues values(element);
    const auto limit = [&](const char* name) {
      const double value = values.not_negative(name, 0, repairs_);
      return value < unlimited ? value : 0;
    };
    joint.motor.max_effort = limit("effort");
    joint.motor.max_velocity = limit("velocity");
    const bool given = from.type != "continuous" && (values.has("lower") || values.has("upper"));
    const double low = given ? values.number("lower", 0) : -unlimited,
                 high = given ? values.number("upper", 0) : unlimited;
    if (low > -unlimited || high < unlimited) {
      joint.min = low, joint.max = high, joint.endless = false;
      repairs_.order(joint.min, joint.max, element.place().of("joint '{}'", excerpt(joint.name)),
                     {"lower", "upper"});
      return;
    }
  }
  cache_.diagnostics().note(
      from.element.place(), "joint '{}' {}; planners try values up to {:.4g} {} from where it is",
      excerpt(joint.name), from.type == "continuous" ? "turns without end" : "has no limits", far,
      unit);
}

TreeJoint UrdfReader::read_joint(const FileJoint& from) {
  TreeJoint joint;
  joint.name = from.name;
  joint.place = from.element.place();
  joint.kind = from.type == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  read_axis(from, joint);
  read_limits(from, joint);
  joint.motor.default_value = std::clamp(0.0, joint.min, joint.max);
  if (const XmlElement dynamics = from.element.child("dynamics")) {
    unused_.attributes(dynamics, {"damping", "friction"});
    joint.viscous = XmlValues(dynamics).not_negative("damping", 0, repairs_);
    joint.coulomb = XmlValues(dynamics).not_negative("friction", 0, repairs_);
  }
  return joint;
}

void UrdfReader::read_mimics() {
  for (const FileJoint& from : joints_) {
    const XmlElement mimic = from.element.child("mimic");
    if (!mimic) continue;
    const auto self = joint_numbers_.find(from.name);
    if (self == joint_numbers_.end()) {
      if (from.type == "fixed" || from.type == "floating" || from.type == "planar")
        cache_.diagnostics().warn(mimic.place(),
                                  "joint '{}' does not move, so its mimic is not used",
                                  excerpt(from.name));
      continue;
    }
    const XmlValues values(mimic);
    const std::string name = values.text("joint");
    const auto leader = joint_numbers_.find(name);
    if (leader == joint_numbers_.end()) {
      repairs_.add("mimic of none", mimic.place().of("joint '{}'", excerpt(from.name)),
                   "mimic: no joint is called {}{}; it moves independently", in_quotes(name),
                   did_you_mean(name, names_in(joint_numbers_)));
      continue;
    }
    TreeJoint& joint = tree_.joints[self->second];
    joint.leader = leader->second;
    joint.ratio = values.number("multiplier", 1);
    joint.offset = values.number("offset", 0);
    if (joint.ratio == 0)
      cache_.diagnostics().warn(mimic.place().of("joint '{}'", excerpt(joint.name)),
                                "its multiplier is 0; it stays at {}", joint.offset);
  }
}

RobotSpec UrdfReader::read() {
  const XmlElement root = xml_.root();
  if (root.name() != "robot")
    root.fail("expected an element <robot>, got <{}>", excerpt(root.name()));
  refuse_xacro(root);
  tree_.name = root.attribute("name").value_or("");
  tree_.class_name = tree_.name;
  if (tree_.name.empty()) tree_.name = path_.stem().string();
  unused_.attributes(root, {"name", "version", "xmlns", "xmlns:xacro"});
  read_materials();
  for (const auto& child : root.children()) {
    if (child.name() == "link")
      read_link(child);
    else if (child.name() != "joint" && child.name() != "material" && child.name() != "clench")
      unused_.element(child);
  }
  const auto own = root.children("clench");
  if (own.size() > 1) own[1].fail("robot: expected one <clench>, got another");
  for (const auto& child : root.children("joint")) read_joint_names(child);
  find_still_joints();
  for (const FileJoint& joint : joints_) {
    if (joint.type == "floating" || joint.type == "planar")
      cache_.diagnostics().warn(joint.element.place(),
                                "joint '{}' is {}; its link stays where the file puts it",
                                excerpt(joint.name), joint.type);
    else if (!still_.contains(joint.name)) {
      joint_numbers_[joint.name] = static_cast<int>(tree_.joints.size());
      tree_.joints.push_back(read_joint(joint));
    }
  }
  order_links();
  read_mimics();
  dress_links(tree_, pieces_, geometry_, file_, cache_, !own.empty());
  std::function<bool(RobotSpec&)> known;
  if (!own.empty())
    known = [&](RobotSpec& made) {
      read_clench_element(own.front(), made, path_, cache_);
      return !own.front().children("dof").empty();  // they define how it closes
    };
  RobotSpec robot = make_robot(std::move(tree_), file_, cache_, known);
  robot.source = path_.generic_string();
  repairs_.tell();
  inertial_faults_.tell(cache_);
  warn_of_undrawn();
  for (Diagnostic& loss : unused_.diagnostics()) cache_.diagnostics().warn(std::move(loss));
  return robot;
}

// Hands with a missing package lack one mesh per link: one message reports all of them.
void UrdfReader::warn_of_undrawn() const {
  if (undrawn_ == 0) return;
  Diagnostic first = first_undrawn_;
  first.text += undrawn_ == 1 ? "; it is not drawn"
                              : fmt::format("; it and {} other meshes are not drawn", undrawn_ - 1);
  cache_.diagnostics().warn(std::move(first));
}

}  // namespace

RobotSpec read_robot_urdf(const fs::path& path, FileCache& cache) {
  return UrdfReader(path, cache).read();
}

bool looks_like_urdf(std::string_view text) {
  // GraspIt!'s XML has <robot> and <link>, too, and always a <palm>
  return xml_root_name(text) == "robot" && text.find("<link") != std::string_view::npos &&
         text.find("<palm") == std::string_view::npos;
}

}  // namespace clench
