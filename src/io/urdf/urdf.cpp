#include "clench/io/urdf/urdf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clench/base/suggest.h"
#include "clench/io/tree/tree_robot.h"
#include "clench/io/tree/tree_xml.h"
#include "clench/io/urdf/urdf_clench.h"
#include "clench/io/urdf/urdf_links.h"

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
        repairs_(cache.diagnostics()),
        link_reader_(path, cache, unused_, repairs_) {}
  RobotSpec read();

 private:
  void refuse_xacro(const XmlElement& element) const;
  void read_joint_names(const XmlElement& element);
  int link_of(const XmlElement& joint, const char* end) const;
  void find_still_joints();
  Pose read_joint_origin(const FileJoint& from);
  int find_root() const;
  void order_links();
  void read_joints();
  TreeJoint read_joint(const FileJoint& from);
  void read_axis(const FileJoint& from, TreeJoint& joint);
  void read_limits(const FileJoint& from, TreeJoint& joint);
  void read_mimics();

  const fs::path& path_;
  const std::string file_;
  FileCache& cache_;
  XmlFile xml_;
  Repairs repairs_;
  UnusedXml unused_;
  UrdfLinkReader link_reader_;
  UrdfLinks given_;  // in the file's order
  std::vector<FileJoint> joints_;
  std::set<std::string> names_;          // of joints
  std::map<std::string, double> still_;  // positions of joints that never move [rad or m]
  TreeModel tree_;
  std::map<std::string, int> joint_numbers_;  // in the tree
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

// --- joints ---

int UrdfReader::link_of(const XmlElement& joint, const char* end) const {
  const XmlElement element = joint.expected(end);
  const std::string name = element.expected_attribute("link");
  const auto found = given_.numbers.find(name);
  if (found != given_.numbers.end()) return found->second;
  element.fail("{}: no link {}{}", end, in_quotes(name),
               did_you_mean(name, names_in(given_.numbers)));
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
  if (given_.links[joint.child].parent >= 0)
    element.fail("joint '{}': link '{}' has a parent already, '{}'", excerpt(joint.name),
                 excerpt(given_.links[joint.child].body.name),
                 excerpt(given_.links[given_.links[joint.child].parent].body.name));
  if (joint.parent == joint.child)
    element.fail("joint '{}': expected two links, got '{}' twice", excerpt(joint.name),
                 excerpt(given_.links[joint.child].body.name));
  given_.links[joint.child].parent = joint.parent;
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
  const Pose origin = read_urdf_origin(from.element, unused_);
  const auto still = still_.find(from.name);
  if (still == still_.end() || still->second == 0) return origin;
  TreeJoint joint;
  joint.kind = from.type == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  read_axis(from, joint);
  return origin * joint_pose(joint, still->second);
}

int UrdfReader::find_root() const {
  if (given_.links.empty()) xml_.root().fail("robot: expected links, got none");
  std::vector<int> roots;
  for (int i = 0; i < static_cast<int>(given_.links.size()); ++i)
    if (given_.links[i].parent < 0) roots.push_back(i);
  if (roots.empty()) xml_.root().fail("robot: every link has a parent: its joints form a loop");
  if (roots.size() > 1)
    xml_.root().fail("robot: expected one link without a parent, got {}: '{}' and '{}'{}",
                     roots.size(), excerpt(given_.links[roots[0]].body.name),
                     excerpt(given_.links[roots[1]].body.name),
                     roots.size() > 2 ? " among them" : "");
  return roots.front();
}

/// Orders links from the root, each after its parent, branches in the file's order.
void UrdfReader::order_links() {
  std::vector<std::vector<const FileJoint*>> below(given_.links.size());
  for (const FileJoint& joint : joints_) below[joint.parent].push_back(&joint);
  std::vector<LinkPieces> pieces;
  struct Step {
    int link, parent;
    const FileJoint* joint;
  };
  std::vector<Step> stack = {{find_root(), -1, nullptr}};
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const int number = static_cast<int>(tree_.links.size());
    TreeLink link = std::move(given_.links[step.link]);
    link.parent = step.parent;
    if (step.joint) {
      link.X_PL = read_joint_origin(*step.joint);
      // joints keep the file's order; their numbers refer to it
      if (const auto found = joint_numbers_.find(step.joint->name); found != joint_numbers_.end())
        link.joints.push_back(found->second);
    }
    tree_.links.push_back(std::move(link));
    pieces.push_back(std::move(given_.pieces[step.link]));
    for (auto it = below[step.link].rbegin(); it != below[step.link].rend(); ++it)
      stack.push_back({(*it)->child, number, *it});
  }
  if (tree_.links.size() < given_.links.size())
    xml_.root().fail("robot: {} of its links are connected to no root: their joints form a loop",
                     given_.links.size() - tree_.links.size());
  given_.pieces = std::move(pieces);
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

void UrdfReader::read_joints() {
  for (const auto& child : xml_.root().children("joint")) read_joint_names(child);
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
  link_reader_.read_materials(root);
  for (const auto& child : root.children()) {
    if (child.name() == "link")
      link_reader_.read_link(child);
    else if (child.name() != "joint" && child.name() != "material" && child.name() != "clench")
      unused_.element(child);
  }
  const auto own = root.children("clench");
  if (own.size() > 1) own[1].fail("robot: expected one <clench>, got another");
  given_ = link_reader_.take();
  read_joints();
  order_links();
  read_mimics();
  dress_links(tree_, given_.pieces, link_reader_.geometry(), file_, cache_, !own.empty());
  std::function<bool(RobotSpec&)> known;
  if (!own.empty())
    known = [&](RobotSpec& made) {
      read_clench_element(own.front(), made, path_, cache_);
      return !own.front().children("dof").empty();  // they define how it closes
    };
  RobotSpec robot = make_robot(std::move(tree_), file_, cache_, known);
  robot.source = path_.generic_string();
  repairs_.tell();
  link_reader_.report();
  for (Diagnostic& loss : unused_.diagnostics()) cache_.diagnostics().warn(std::move(loss));
  return robot;
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
