#include "clench_reader.h"

#include "clench/base/error.h"
#include "clench/io/mjcf/mjcf_model.h"
#include "clench/io/read/read.h"
#include "support/listening.h"

namespace clench::test {

namespace {

/// One body directly in the world, with the names of all bodies and joints below it in MuJoCo's
/// order: depth first.
struct TopNames {
  std::string name;
  bool free = false;
  std::vector<Pose> X_TB;                          // pose of each body in the first one
  std::vector<std::string> bodies;                 // as named by our readers
  std::map<std::string, std::string> facts_name;   // of bodies
  std::map<std::string, std::string> facts_joint;  // of joints
  std::map<std::string, JointFacts::Kind> kinds;   // of joints, by our names
  std::map<std::string, std::string> parents;      // of bodies, by the names of the facts
};

/// "#3" for an element without a name.
std::string facts_name(const XmlElement& element, int number) {
  const std::string name = element.attribute("name").value_or("");
  return name.empty() ? '#' + std::to_string(number) : name;
}

class Elements {
 public:
  /// Bodies and joints of a tree, in MuJoCo's order.
  void walk(const MjcfNode& node) {
    for (const MjcfNode& child : node.children)
      if (child.name() == "joint" || child.name() == "freejoint")
        joints.push_back(child.element);
      else if (child.name() == "frame")
        walk(child);
    for (const MjcfNode& child : node.children) descend(child);
  }
  std::vector<XmlElement> bodies, joints;

 private:
  void descend(const MjcfNode& node) {
    if (node.name() == "body") {
      bodies.push_back(node.element);
      walk(node);
    } else if (node.name() == "frame") {
      for (const MjcfNode& child : node.children) descend(child);
    }
  }
};

std::vector<TopNames> names_of(const std::filesystem::path& path) {
  const ReadOptions options;
  const Loaders none = {};
  FileCache cache(options, none);
  MjcfModel model(path, cache, "world");
  std::vector<TopNames> out;
  int body_number = 1, joint_number = 0;
  for (const TopBody& top : model.worldbody().bodies) {
    TopNames names;
    names.name = top.name;
    names.free = top.free;
    const MjcfTree tree = model.read_tree(top);
    Elements elements;
    elements.bodies.push_back(top.node->element);
    elements.walk(*top.node);
    size_t body = 0, joint = 0;
    std::vector<Pose> X;
    for (size_t l = 0; l < tree.model.links.size(); ++l) {
      const TreeLink& link = tree.model.links[l];
      X.push_back(link.parent < 0 ? link.X_PL : X[link.parent] * link.X_PL);
      if (link.parent < 0 && top.own_joints) continue;  // the world's frame
      const std::string& own = link.body.name;
      const std::string name = facts_name(elements.bodies.at(body++), body_number++);
      names.bodies.push_back(own);
      names.X_TB.push_back(X.back());
      names.facts_name[own] = name;
      const bool first = names.bodies.size() == 1;
      names.parents[own] =
          first ? "world" : names.facts_name.at(tree.model.links[link.parent].body.name);
      for (const QposSlot& slot : tree.slots[l]) {
        const std::string joint_name = facts_name(elements.joints.at(joint++), joint_number++);
        if (slot.kind == QposSlot::Kind::free) continue;
        const TreeJoint& at = tree.model.joints[slot.joint];
        const bool ball = slot.kind == QposSlot::Kind::ball;
        names.facts_joint[at.name] = joint_name;
        names.kinds[at.name] = ball                              ? JointFacts::Kind::ball
                               : at.kind == JointKind::prismatic ? JointFacts::Kind::slide
                                                                 : JointFacts::Kind::hinge;
      }
    }
    out.push_back(std::move(names));
  }
  return out;
}

void weigh(BodyFacts& out, const BodySpec& spec) {
  out.mass = spec.mass;
  out.com_W = out.X_WB * com_of(spec);
  const Eigen::Matrix3d R = out.X_WB.matrix();
  out.inertia_W = spec.mass * R * inertia_of(spec) * R.transpose();
}

void add_robot(const PlacedRobot& placed, const TopNames& names, const ModelFacts& theirs,
               ModelFacts& into) {
  const RobotSpec& robot = placed.robot;
  const size_t prefix = robot.name.size() + 1;
  const auto add = [&](const BodySpec& spec, const Pose& X_WB) {
    const std::string own = spec.name.substr(prefix);
    const auto found = names.facts_name.find(own);
    if (found == names.facts_name.end()) return;  // the world's frame
    BodyFacts body;
    body.name = found->second;
    body.X_WB = X_WB;
    body.parent = names.parents.at(own);
    weigh(body, spec);
    into.bodies.push_back(std::move(body));
  };
  const auto joint_name = [&](const std::string& own) {
    const auto found = names.facts_joint.find(own);
    return found == names.facts_joint.end() ? std::string() : found->second;
  };
  std::vector<double> q;
  for (const DofSpec& dof : robot.dofs) {
    const JointFacts* joint = theirs.joint(joint_name(dof.name));
    q.push_back(joint ? joint->ref : dof.default_value);
  }
  add(robot.base, placed.X_WB);
  const auto poses = link_poses(robot, q);
  for (size_t l = 0; l < robot.links.size(); ++l) {
    const LinkSpec& link = robot.links[l];
    add(link.body, placed.X_WB * poses[l]);
    Pose X = placed.X_WB * (link.parent < 0 ? Pose{} : poses[link.parent]);
    for (const JointSpec& joint : link.joints) {
      X = X * joint.X_PJ;
      if (const std::string name = joint_name(joint.name); !name.empty()) {
        JointFacts facts;
        facts.name = name;
        facts.body = names.facts_name.at(link.body.name.substr(prefix));
        facts.kind = names.kinds.at(joint.name);
        facts.axis_W = X.rotation * joint.axis;
        facts.anchor_W = X.position;
        if (!joint.endless) facts.range = {joint.min, joint.max};
        facts.range_compared = robot.dofs[joint.dof].name == joint.name;
        facts.damping = joint.viscous;
        facts.friction = joint.coulomb;
        facts.armature = joint.armature;
        facts.stiffness = joint.spring;
        facts.rest = joint.rest;
        into.joints.push_back(facts);
      }
      X = X * joint_motion(joint, joint.ratio * q[joint.dof]);
    }
  }
}

void add_body(const WorldSpec& world, const PlacedBody* placed, const TopNames& names,
              const ModelFacts& theirs, ModelFacts& into) {
  if (!names.free) {
    for (size_t i = 0; i < names.bodies.size(); ++i) {
      BodyFacts body;
      body.name = names.facts_name.at(names.bodies[i]);
      body.weighed = false;
      bool stands = false;
      for (const PlacedBody& obstacle : world.bodies)
        if (obstacle.body.name == names.bodies[i]) body.X_WB = obstacle.X_WB, stands = true;
      // without geometry it is not an obstacle
      if (const BodyFacts* same = theirs.body(body.name); same && !stands) body.X_WB = same->X_WB;
      into.bodies.push_back(std::move(body));
    }
    return;
  }
  BodyFacts body;
  body.name = names.facts_name.at(names.bodies.front());
  if (!placed) {
    into.error += "no object '" + names.name + "'";
    return;
  }
  body.X_WB = placed->X_WB;
  weigh(body, placed->body);
  body.merged.emplace();
  for (const std::string& own : names.bodies) body.merged->push_back(names.facts_name.at(own));
  into.bodies.push_back(std::move(body));
}

}  // namespace

ModelFacts read_by_clench(const std::filesystem::path& path, const ModelFacts& theirs,
                          std::vector<std::string>& warnings) {
  ModelFacts out;
  try {
    ReadOptions options;
    options.diagnostics =
        Listening{.warn = [&](const std::string& sentence) { warnings.push_back(sentence); }};
    const WorldSpec world = read_world(path, options);
    for (const TopNames& names : names_of(path)) {
      const PlacedRobot* robot = nullptr;
      for (const PlacedRobot& placed : world.robots)
        if (placed.robot.files.body == names.name) robot = &placed;
      const PlacedBody* object = nullptr;
      for (const PlacedBody& placed : world.bodies)
        if (placed.body.name == names.name) object = &placed;
      if (robot)
        add_robot(*robot, names, theirs, out);
      else
        add_body(world, object, names, theirs, out);
    }
  } catch (const Error& error) {
    out.error = error.what();
  }
  return out;
}

}  // namespace clench::test
