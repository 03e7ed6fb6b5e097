// Clench's engine: fixed parts are obstacles, parts on links form a robot with a base without
// geometry, and all others are objects.
#include <algorithm>

#include "bench/dynamic_engine.h"
#include "clench/dynamics/stepper.h"

namespace clench::bench {

namespace {

class Ours : public DynamicEngine {
 public:
  Ours(const DynamicScene& scene, double h) : h_(h) {
    world_.set_gravity({0, 0, -gravity});
    world_.set_friction("wood", "wood", {scene.mu, scene.mu});
    parts_.resize(scene.parts.size());
    std::vector<int> link_of(scene.parts.size(), -1);
    RobotSpec robot;
    robot.name = "robot";
    robot.base.name = "base";
    for (const Link& link : scene.links) {
      link_of[link.part] = static_cast<int>(robot.links.size());
      const Pose at = Pose::translation(link.origin);
      const Pose parent = link.parent < 0 ? Pose{} : scene.parts[link.parent].X_W;
      DofSpec dof;
      dof.kp = link.kp;
      dof.kd = link.kd;
      const int number = static_cast<int>(robot.dofs.size());
      LinkSpec spec{.body = body(scene.parts[link.part], "link")};
      spec.parent = link.parent < 0 ? -1 : link_of[link.parent];
      spec.joints = {{.kind = link.slides ? JointKind::prismatic : JointKind::revolute,
                      .X_PJ = parent.inverse() * at,
                      .axis = link.axis,
                      .dof = number,
                      .min = -1,
                      .max = 1,
                      .viscous = link.viscous}};
      spec.X_JL = at.inverse() * scene.parts[link.part].X_W;
      robot.dofs.push_back(dof);
      robot.links.push_back(spec);
    }
    for (size_t i = 0; i < parts_.size(); ++i)
      if (link_of[i] < 0)
        parts_[i] = world_.add_body(body(scene.parts[i], "part"),
                                    scene.parts[i].mass > 0 ? BodyKind::object : BodyKind::obstacle,
                                    scene.parts[i].X_W);
    DynamicSettings settings;
    settings.step = h;
    if (!scene.links.empty()) {
      const auto id = world_.add_robot(robot, {});
      for (size_t i = 0; i < parts_.size(); ++i)
        if (link_of[i] >= 0) parts_[i] = world_.robot(id).links[link_of[i]].body;
      settings.robots[id].gravity_compensation = false;
      DynamicState& state = world_.edit_dynamics();
      for (size_t i = 0; i < scene.links.size(); ++i)
        state.controls[i] = {
            .mode = scene.links[i].slides ? ControlMode::effort : ControlMode::position,
            .target = scene.links[i].target,
            .effort = scene.links[i].effort,
            .trajectory = {}};
    }
    world_.set_dynamic_settings(settings);
    stepper_.emplace(world_);
  }

  void step(int count) override {
    for (int i = 0; i < count; ++i) stepper_->run(h_);
  }
  Pose pose(int part) const override { return world_.pose(parts_[part]); }
  Eigen::Vector3d velocity(int part) const override { return world_.twist(parts_[part]).linear; }
  const World& world() const { return world_; }
  Id<Body> id(int part) const { return parts_[part]; }

 private:
  static BodySpec body(const Part& part, const std::string& name) {
    BodySpec spec;
    spec.name = name;
    spec.shape = Shape::make(mesh_of(part), name);
    if (part.mass > 0) spec.mass = part.mass;
    return spec;
  }

  double h_;
  World world_;
  std::vector<Id<Body>> parts_;
  std::optional<Stepper> stepper_;
};

}  // namespace

EngineKind our_engine() {
  // a quarter of the contact threshold
  return {"ours", 2.5e-5,
          [](const DynamicScene& scene, double h) { return std::make_unique<Ours>(scene, h); }};
}

const World& world_of(const DynamicEngine& ours) { return dynamic_cast<const Ours&>(ours).world(); }

GripForces our_grip(const DynamicScene& scene, double h, double seconds) {
  Ours engine(scene, h);
  engine.step(static_cast<int>(0.5 / h));
  GripForces out;
  std::vector<Eigen::Vector3d> before;
  for (double t = 0; t < seconds; t += h) {
    engine.step(1);
    // one force per pad
    std::vector<Eigen::Vector3d> forces;
    out.tangential = 0;
    for (const Manifold& m : engine.world().dynamics()->manifolds) {
      if (m.points.empty()) continue;
      Eigen::Vector3d force = Eigen::Vector3d::Zero();
      for (const ManifoldPoint& p : m.points) force += engine.world().pose(m.a).rotation * p.force;
      if (m.a == engine.id(scene.watched)) force = -force;
      out.tangential += force.z();
      forces.push_back(force);
    }
    if (before.size() == forces.size())
      for (size_t i = 0; i < forces.size(); ++i)
        out.jitter = std::max(out.jitter, (forces[i] - before[i]).norm() / forces[i].norm());
    before = std::move(forces);
  }
  return out;
}

}  // namespace clench::bench
