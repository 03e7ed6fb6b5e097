#include "clench/io/mjcf/mjcf.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/mjcf/mjcf_couplings.h"
#include "clench/io/mjcf/mjcf_geoms.h"
#include "clench/io/tree/tree_robot.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

/// A body directly in the world, with the frame that it stands in.
struct TopBody {
  const MjcfNode* node;
  std::string child_class;
  Pose X_frame;
  int joints = 0;     // in it and beyond
  bool free = false;  // does it move freely?
};

class MjcfReader {
 public:
  MjcfReader(const fs::path& path, Library& library)
      : library_(library), document_(path, library), geoms_(document_, library) {}
  RobotSpec read();

 private:
  void warn(const XmlElement& at, const std::string& what) const {
    library_.warn(at.place() + ": " + what);
  }
  void find_top_bodies(const MjcfNode& node, const std::string& child_class, const Pose& X_frame,
                       std::vector<TopBody>& into);
  void warn_of_loss(const MjcfNode& node, bool in_world);
  void choose_base(std::vector<TopBody> bodies);
  int add_link(const XmlElement& element, const std::string& name, int parent, const Pose& X_PL);
  void read_body(const MjcfNode& node, int parent, const std::string& child_class,
                 const Pose& X_frame, bool base);
  void read_contents(const MjcfNode& node, int link, const std::string& child_class,
                     const Pose& X_frame);
  void read_joint(const XmlElement& element, int link, const std::string& child_class,
                  const Pose& X_frame);
  std::string own_name(const XmlElement& element, const std::string& name,
                       const std::map<std::string, int>& taken);
  void add_joint(TreeJoint joint, const XmlElement& element, int link);
  void set_range(const XmlValues& values, TreeJoint& joint);
  void read_inertial(const XmlElement& element, int link, const Pose& X_frame);
  void weigh_geoms(int link);
  void read_excludes();
  void keep_masks();

  Library& library_;
  MjcfDocument document_;
  MjcfGeoms geoms_;
  TreeModel tree_;
  std::vector<LinkPieces> pieces_;
  std::vector<std::vector<MjcfGeom>> link_geoms_;
  InertialFaults inertial_faults_;
  std::map<std::string, int> links_;   // by name
  std::map<std::string, int> joints_;  // by name
  int world_geoms_ = 0;                // that hang on no body
  std::string first_world_geom_;       // its place
};

// --- which bodies are the robot ---

int count_joints(const MjcfNode& node) {
  int count = 0;
  for (const auto& child : node.children) {
    if (child.name() == "joint" && child.element.attribute("type").value_or("") != "free") ++count;
    count += count_joints(child);
  }
  return count;
}

int count_elements(const MjcfNode& node, const std::string& name) {
  int count = 0;
  for (const auto& child : node.children)
    count += (child.name() == name) + count_elements(child, name);
  return count;
}

bool moves_freely(const MjcfNode& node) {
  return std::any_of(node.children.begin(), node.children.end(), [](const MjcfNode& child) {
    return child.name() == "freejoint" ||
           (child.name() == "joint" && child.element.attribute("type").value_or("") == "free");
  });
}

void MjcfReader::find_top_bodies(const MjcfNode& node, const std::string& child_class,
                                 const Pose& X_frame, std::vector<TopBody>& into) {
  const std::string inherited = node.element.attribute("childclass").value_or(child_class);
  if (node.name() == "body") {
    into.push_back({&node, child_class, X_frame, count_joints(node), moves_freely(node)});
  } else if (node.name() == "frame") {
    const Pose X = X_frame * document_.pose(XmlValues(node.element));
    for (const auto& child : node.children) find_top_bodies(child, inherited, X, into);
  } else {
    warn_of_loss(node, true);
  }
}

/// What holds bodies and geoms that the robot lacks is told as such.
void MjcfReader::warn_of_loss(const MjcfNode& node, bool in_world) {
  const std::string name = node.name();
  if (in_world && name == "geom") {
    if (++world_geoms_ == 1) first_world_geom_ = node.element.place();
  } else if (name == "replicate" || name == "composite" || name == "flexcomp") {
    const std::string what =
        name == "replicate"
            ? fmt::format("all that it repeats (bodies: {}, geoms: {})",
                          count_elements(node, "body"), count_elements(node, "geom"))
            : "the bodies that it makes";
    warn(node.element, fmt::format("<{}> is not used: the robot lacks {}; save the model expanded "
                                   "by MuJoCo",
                                   excerpt(name), what));
  } else if (name == "attach") {
    warn(node.element,
         fmt::format("<attach> is not used: the robot lacks the body {} of model {} and all that "
                     "hangs on it; save the model expanded by MuJoCo",
                     in_quotes(node.element.attribute("body").value_or("")),
                     in_quotes(node.element.attribute("model").value_or(""))));
  } else {
    document_.unused().element(node.element);
  }
}

/// The body with the most joints is the robot; others that move freely are things beside it. One
/// body alone is the base, as long as it has no joints of its own; else the world is.
void MjcfReader::choose_base(std::vector<TopBody> bodies) {
  if (bodies.empty()) fail("{}: expected bodies in <worldbody>, got none", document_.file());
  const auto robot =
      std::max_element(bodies.begin(), bodies.end(),
                       [](const TopBody& a, const TopBody& b) { return a.joints < b.joints; });
  const MjcfNode* kept = robot->node;
  std::erase_if(bodies, [&](const TopBody& body) {
    if (body.node == kept || !body.free) return false;
    warn(body.node->element,
         fmt::format("body '{}' moves freely beside the robot; it is not read",
                     excerpt(body.node->element.attribute("name").value_or(""))));
    return true;
  });
  const TopBody& first = bodies.front();
  const bool own_joints = std::any_of(
      first.node->children.begin(), first.node->children.end(), [](const MjcfNode& child) {
        return child.name() == "joint" && child.element.attribute("type").value_or("") != "free";
      });
  if (bodies.size() == 1 && !own_joints) {
    read_body(*first.node, -1, first.child_class, first.X_frame, true);
    return;
  }
  add_link(document_.root().element, "world", -1, {});
  for (const TopBody& body : bodies)
    read_body(*body.node, 0, body.child_class, body.X_frame, false);
}

// --- bodies ---

/// The name, or another where an element before has it.
std::string MjcfReader::own_name(const XmlElement& element, const std::string& name,
                                 const std::map<std::string, int>& taken) {
  if (!taken.contains(name)) return name;
  const std::string own = unused_name(name, taken);
  document_.repairs().add(std::string(element.name()),
                          fmt::format("{}: {}: there is another one of the name '{}'; it is called "
                                      "'{}'",
                                      element.place(), element.name(), excerpt(name), own));
  return own;
}

int MjcfReader::add_link(const XmlElement& element, const std::string& name, int parent,
                         const Pose& X_PL) {
  const int number = static_cast<int>(tree_.links.size());
  if (number >= max_links) element.fail("expected at most {} bodies", max_links);
  TreeLink link;
  link.parent = parent;
  link.X_PL = X_PL;
  link.body.name = name.empty() ? fmt::format("body{}", number) : name;
  link.body.source = document_.path().generic_string();
  link.body.name = own_name(element, link.body.name, links_);
  links_[link.body.name] = number;
  tree_.links.push_back(std::move(link));
  pieces_.emplace_back().place = element.place();
  link_geoms_.emplace_back();
  return number;
}

void MjcfReader::read_body(const MjcfNode& node, int parent, const std::string& child_class,
                           const Pose& X_frame, bool base) {
  const XmlElement& element = node.element;
  document_.unused().attributes(
      element, {"name", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "childclass"});
  const XmlValues values(element);
  const std::string inherited = values.text("childclass", child_class);
  document_.check_class(element, inherited);
  const Pose X = X_frame * document_.pose(values);
  // where the base stands is the world's to say
  const int link = add_link(element, values.text("name", ""), parent, base ? Pose{} : X);
  if (base && !(X == Pose{}))
    library_.note(fmt::format("{}: body '{}' is the base; its place in the file is not used",
                              element.place(), excerpt(tree_.links[link].body.name)));
  read_contents(node, link, inherited, Pose{});
  if (!pieces_[link].has_inertial || document_.inertia_from_geoms()) weigh_geoms(link);
}

void MjcfReader::read_contents(const MjcfNode& node, int link, const std::string& child_class,
                               const Pose& X_frame) {
  for (const MjcfNode& child : node.children) {
    const std::string name = child.name();
    if (name == "body") {
      read_body(child, link, child_class, X_frame, false);
    } else if (name == "frame") {
      const XmlValues values(child.element);
      const std::string inherited = values.text("childclass", child_class);
      document_.check_class(child.element, inherited);
      read_contents(child, link, inherited, X_frame * document_.pose(values));
    } else if (name == "joint" || name == "freejoint") {
      read_joint(child.element, link, child_class, X_frame);
    } else if (name == "inertial") {
      read_inertial(child.element, link, X_frame);
    } else if (name == "geom") {
      if (auto geom = geoms_.read(child.element, child_class, X_frame))
        link_geoms_[link].push_back(std::move(*geom));
    } else {
      warn_of_loss(child, false);
    }
  }
}

// --- joints ---

/// Is there a range that limits?
static bool given_range(const XmlValues& values) {
  if (!values.has("range")) return false;
  const auto range = values.numbers("range", 2, 2);
  return range[0] != 0 || range[1] != 0 || values.text("limited", "auto") == "true";
}

void MjcfReader::set_range(const XmlValues& values, TreeJoint& joint) {
  const bool turns = joint.kind == JointKind::revolute;
  const double unit = turns ? document_.angle_unit() : 1;
  const std::string limited = values.word("limited", {"auto", "true", "false"}, "auto");
  // two zeros undo what a class says
  const bool has_range = given_range(values);
  if (limited == "auto" && has_range && !document_.autolimits())
    document_.repairs().add(
        "autolimits", values.subject("range") +
                          ": expected limited=\"true\" beside it, as autolimits is off; the range "
                          "is used");
  if (limited == "true" && !values.has("range"))
    document_.repairs().add(
        "limited", values.subject("limited") + ": expected a range, got none; there are no limits");
  if (limited == "false" || !has_range) {
    const double endless = turns ? endless_turn : endless_slide;
    joint.min = joint.zero - endless, joint.max = joint.zero + endless;
    library_.note(fmt::format("{}: joint '{}' has no limits; it may go from {:.4g} to {:.4g} {}",
                              joint.place, excerpt(joint.name), joint.min, joint.max,
                              turns ? "rad" : "m"));
    return;
  }
  const auto range = values.range("range", document_.repairs());
  joint.min = range[0] * unit;
  joint.max = range[1] * unit;
  if (joint.min == joint.max)
    library_.note(fmt::format("{}: joint '{}' may only stand at {:.4g} {}", joint.place,
                              excerpt(joint.name), joint.min, turns ? "rad" : "m"));
}

void MjcfReader::add_joint(TreeJoint joint, const XmlElement& element, int link) {
  if (tree_.joints.size() >= max_joints) element.fail("expected at most {} joints", max_joints);
  const int number = static_cast<int>(tree_.joints.size());
  joint.name = own_name(element, joint.name, joints_);
  joints_[joint.name] = number;
  joint.start = std::clamp(joint.zero, joint.min, joint.max);
  tree_.joints.push_back(std::move(joint));
  tree_.links[link].joints.push_back(number);
}

void MjcfReader::read_joint(const XmlElement& element, int link, const std::string& child_class,
                            const Pose& X_frame) {
  const XmlValues values = document_.values(element, child_class);
  values.tell_unused(document_.unused(),
                     {"name", "class", "type", "pos", "axis", "range", "limited", "ref",
                      "stiffness", "springref", "damping", "frictionloss"});
  const std::string type = element.name() == "freejoint"
                               ? "free"
                               : values.word("type", {"hinge", "slide", "ball", "free"}, "hinge");
  TreeJoint joint;
  joint.place = element.place();
  joint.name = values.text("name", "");
  const std::string& body = tree_.links[link].body.name;
  if (joint.name.empty())
    joint.name = tree_.links[link].joints.empty()
                     ? body + "_joint"
                     : fmt::format("{}_joint{}", body, tree_.links[link].joints.size() + 1);
  if (type == "free") {
    // the base goes where the world puts it
    if (link == 0) return;
    warn(element, fmt::format("joint '{}' is free; body '{}' stays where the file puts it",
                              excerpt(joint.name), excerpt(body)));
    return;
  }
  joint.kind = type == "slide" ? JointKind::prismatic : JointKind::revolute;
  const double unit = type == "slide" ? 1 : document_.angle_unit();
  joint.anchor = X_frame * values.vec3("pos", {0, 0, 0});
  const Eigen::Vector3d axis = values.vec3("axis", {0, 0, 1});
  if (!(axis.stableNorm() > 1e-9)) values.fail("axis", "expected a direction, got none");
  joint.axis = (X_frame.rotation * axis.stableNormalized()).normalized();
  joint.viscous = values.not_negative("damping", 0, document_.repairs());
  joint.coulomb = values.not_negative("frictionloss", 0, document_.repairs());
  joint.spring = values.not_negative("stiffness", 0, document_.repairs());
  joint.rest = values.number("springref", 0) * unit;
  if (type != "ball") {
    joint.zero = values.number("ref", 0) * unit;
    set_range(values, joint);
    add_joint(std::move(joint), element, link);
    return;
  }
  // a ball is three turns, about x, y and z; its range is the most that it leans
  double most = endless_turn / 2;
  if (given_range(values) && values.text("limited", "auto") != "false")
    most = std::min(most, values.numbers("range", 2, 2)[1] * unit);
  if (!(most > 0)) values.fail("range", "expected a largest angle > 0");
  library_.note(
      fmt::format("{}: joint '{}' is a ball; it becomes three turns of at most {:.4g} rad",
                  joint.place, excerpt(joint.name), most));
  for (int i = 0; i < 3; ++i) {
    TreeJoint turn = joint;
    turn.name += fmt::format("_{}", "xyz"[i]);
    turn.axis = X_frame.rotation * Eigen::Vector3d::Unit(i);
    turn.min = -most, turn.max = most, turn.rest = 0;
    add_joint(std::move(turn), element, link);
  }
}

// --- masses ---

void MjcfReader::read_inertial(const XmlElement& element, int link, const Pose& X_frame) {
  document_.unused().attributes(element, {"pos", "quat", "axisangle", "euler", "xyaxes", "zaxis",
                                          "mass", "diaginertia", "fullinertia"});
  BodySpec& body = tree_.links[link].body;
  const XmlValues values(element);
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  if (values.has("fullinertia")) {
    const auto v = values.numbers("fullinertia", 6, 6);
    inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  } else if (values.has("diaginertia")) {
    inertia.diagonal() = values.vec3("diaginertia", {0, 0, 0});
  }
  const double mass = values.number("mass");
  if (const auto wrong = fault(mass_rule, mass); !wrong.empty()) {
    warn(element,
         fmt::format("body '{}': mass: {}; the geometry gives it", excerpt(body.name), wrong));
    return;
  }
  const Inertial inertial = set_inertial(body, mass, X_frame * document_.pose(values), inertia);
  const bool given = values.has("fullinertia") || values.has("diaginertia");
  inertial_faults_.add(given ? inertial : Inertial::not_given, element.place(), body.name);
  pieces_[link].has_inertial = true;
}

/// Mass, centre and inertia of all geoms of a body, as MuJoCo takes them where a file gives none.
void MjcfReader::weigh_geoms(int link) {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  std::vector<std::pair<const MjcfGeom*, MassProperties>> parts;
  for (const MjcfGeom& geom : link_geoms_[link]) {
    if (!(geom.mass > 0)) continue;
    parts.emplace_back(&geom, solid_of(geom.piece));
    if (!parts.back().second.centroid.allFinite()) return;
    mass += geom.mass;
    moment += geom.mass * (geom.piece.X_LG * parts.back().second.centroid);
  }
  if (!mass_rule.allows(mass)) return;
  const Eigen::Vector3d com = moment / mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const auto& [geom, solid] : parts) {
    const Eigen::Matrix3d R = geom->piece.X_LG.matrix();
    const Eigen::Vector3d off = geom->piece.X_LG * solid.centroid - com;
    inertia +=
        geom->mass * (R * solid.inertia * R.transpose() +
                      off.squaredNorm() * Eigen::Matrix3d::Identity() - off * off.transpose());
  }
  BodySpec with = tree_.links[link].body;
  if (set_inertial(with, mass, Pose::translation(com), inertia) == Inertial::not_definite) return;
  tree_.links[link].body = std::move(with);
  pieces_[link].has_inertial = true;
}

// --- what may meet ---

void MjcfReader::read_excludes() {
  for (const MjcfNode* node : document_.section("contact")) {
    if (node->name() != "exclude") {
      document_.unused().element(node->element);
      continue;
    }
    document_.unused().attributes(node->element, {"name", "class", "body1", "body2"});
    const XmlValues values(node->element);
    int pair[2];
    bool known = true;
    for (int i = 0; i < 2; ++i) {
      const char* attribute = i ? "body2" : "body1";
      const auto found = links_.find(values.text(attribute));
      known = known && found != links_.end();
      if (known) pair[i] = found->second;
    }
    if (!known)
      warn(node->element,
           fmt::format("exclude: '{}' and '{}' are not both bodies of the robot; not used",
                       excerpt(values.text("body1")), excerpt(values.text("body2"))));
    else if (pair[0] != pair[1])
      tree_.never_meet.emplace_back(pair[0], pair[1]);
  }
}

/// Pairs that the geoms' bits keep apart. Geoms of one link are one surface here, so bits count for
/// the link whole.
void MjcfReader::keep_masks() {
  const int count = static_cast<int>(tree_.links.size());
  std::vector<unsigned> type(count), affinity(count);
  for (int i = 0; i < count; ++i)
    for (const MjcfGeom& geom : link_geoms_[i]) type[i] |= geom.type, affinity[i] |= geom.affinity;
  int apart = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      if ((type[i] | affinity[i]) == 0 || (type[j] | affinity[j]) == 0) continue;
      if ((type[i] & affinity[j]) || (type[j] & affinity[i])) continue;
      tree_.never_meet.emplace_back(i, j);
      ++apart;
    }
  if (apart > 0)
    library_.note(
        fmt::format("{}: {} pair{} of links never collide{}, as contype and conaffinity say",
                    document_.file(), apart, apart == 1 ? "" : "s", apart == 1 ? "s" : ""));
}

RobotSpec MjcfReader::read() {
  const XmlElement root = document_.root().element;
  tree_.name = root.attribute("model").value_or("");
  tree_.class_name = tree_.name;
  if (tree_.name.empty()) tree_.name = document_.path().stem().string();
  constexpr std::string_view known[] = {"compiler", "default",  "asset",  "worldbody",
                                        "contact",  "equality", "tendon", "actuator"};
  for (const auto& node : document_.root().children)
    if (std::find(std::begin(known), std::end(known), node.name()) == std::end(known))
      document_.unused().element(node.element);

  std::vector<TopBody> bodies;
  for (const MjcfNode* node : document_.section("worldbody"))
    find_top_bodies(*node, "", Pose{}, bodies);
  if (world_geoms_ > 0)
    library_.warn(fmt::format(
        "{}: {} of the world itself, on no body, {} no part of the robot and "
        "not used",
        first_world_geom_, world_geoms_ == 1 ? "a geom" : fmt::format("{} geoms", world_geoms_),
        world_geoms_ == 1 ? "is" : "are"));
  choose_base(std::move(bodies));
  read_excludes();
  keep_masks();
  read_mjcf_couplings(document_, library_, tree_);
  for (size_t i = 0; i < link_geoms_.size(); ++i)
    for (const MjcfGeom& geom : link_geoms_[i]) {
      if (geom.collides()) pieces_[i].collision.push_back(geom.piece);
      if (geom.drawn) pieces_[i].visual.push_back(geom.piece);
    }
  dress_links(tree_, pieces_, geoms_.geometry(), document_.file(), library_);
  RobotSpec robot = make_robot(std::move(tree_), document_.file(), library_);
  robot.source = document_.path().generic_string();
  document_.repairs().tell();
  inertial_faults_.tell(library_);
  for (const auto& sentence : document_.unused().sentences()) library_.warn(sentence);
  return robot;
}

}  // namespace

RobotSpec read_robot_mjcf(const fs::path& path, Library& library) {
  return MjcfReader(path, library).read();
}

}  // namespace clench
