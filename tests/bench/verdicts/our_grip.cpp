#include "bench/verdicts/our_grip.h"

#include <cmath>

#include "clench/dynamics/control/joint_dynamics.h"
#include "clench/dynamics/stepper.h"
#include "clench/geometry/mesh/hull.h"

namespace clench::bench {

namespace {

Pose to_pose(const Eigen::Isometry3d& X) {
  return {Eigen::Quaterniond(X.linear()), X.translation()};
}

ShapePtr shape_of(const GripBody& body) {
  Mesh mesh;
  for (const Points& piece : body.pieces) {
    Eigen::MatrixXd points(3, Eigen::Index(piece.size()));
    const int first = int(mesh.vertices.size());
    for (size_t p = 0; p < piece.size(); ++p)
      points.col(Eigen::Index(p)) = piece[p], mesh.vertices.push_back(piece[p]);
    for (const auto& t : hull_triangles(convex_hull(points), points))
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return mesh.triangles.empty() ? nullptr : Shape::make(std::move(mesh), body.name);
}

BodySpec body_of(const GripBody& body) {
  BodySpec out;
  out.name = body.name;
  out.shape = shape_of(body);
  out.mass = std::max(body.mass, 1e-4);
  out.com = body.com;
  out.inertia_per_mass = body.inertia / out.mass;
  return out;
}

// DOF values are relative to those of the scene
RobotSpec robot_of(const GripScene& scene) {
  RobotSpec out;
  out.name = scene.hand_name;
  out.base = body_of(scene.links[0].body);
  for (size_t i = 1; i < scene.links.size(); ++i) {
    const GripLink& link = scene.links[i];
    const Pose parent = to_pose(scene.links[link.parent].pose), pose = to_pose(link.pose),
               joint = Pose::translation(link.point);
    LinkSpec spec{.body = body_of(link.body), .parent = link.parent - 1};
    if (link.has_joint) {
      const GripDof& dof = scene.dofs[link.dof];
      const double a = link.ratio * (dof.min - dof.value), b = link.ratio * (dof.max - dof.value);
      spec.joints = {{.kind = link.turns ? JointKind::revolute : JointKind::prismatic,
                      .X_PJ = parent.inverse() * joint,
                      .axis = link.axis,
                      .dof = link.dof,
                      .ratio = link.ratio,
                      .min = std::min(a, b),
                      .max = std::max(a, b),
                      .viscous = dof.damping,
                      .coulomb = dof.friction,
                      .armature = dof.armature}};
      spec.X_JL = joint.inverse() * pose;
    } else {
      spec.X_JL = parent.inverse() * pose;
    }
    out.links.push_back(std::move(spec));
  }
  out.dofs.resize(scene.dofs.size());
  return out;
}

class Ours : public Grip {
 public:
  Ours(const GripScene& scene, const StoredGrasp& grasp, const GripOptions& options)
      : grasp_(grasp) {
    const auto robot = world_.add_robot(robot_of(scene), to_pose(grasp.pose));
    object_ = world_.add_body(body_of(scene.object), BodyKind::object, {});
    world_.set_gravity(Eigen::Vector3d::Zero());
    world_.set_friction("wood", "wood", {scene.mu, scene.mu});
    // the hand collides with the object only, as in the other engines
    std::vector<Id<Body>> parts = {world_.robot(robot).base};
    for (const auto& link : world_.robot(robot).links) parts.push_back(link.body);
    for (size_t a = 0; a < parts.size(); ++a)
      for (size_t b = a + 1; b < parts.size(); ++b) world_.set_collision(false, parts[a], parts[b]);

    Eigen::VectorXd q(Eigen::Index(scene.dofs.size()));
    for (size_t i = 0; i < scene.dofs.size(); ++i)
      q[Eigen::Index(i)] = grasp.dofs[i] - scene.dofs[i].value;
    const Eigen::MatrixXd M = joint_dynamics(world_, robot).mass_matrix;
    world_.set_dofs(robot, q);
    // the other engines have one servo per joint
    std::vector<double> kp(scene.dofs.size(), 0);
    joints_.assign(scene.dofs.size(), 0);
    for (const GripLink& link : scene.links)
      if (link.has_joint)
        ++joints_[link.dof],
            kp[link.dof] += options.kp * (link.turns ? 1 : 100) * link.ratio * link.ratio;
    DynamicSettings settings;
    settings.step = 1e-3;
    for (size_t i = 0; i < kp.size(); ++i)
      settings.robots[robot].gains.push_back(
          Gains{kp[i], 2 * std::sqrt(kp[i] * M(Eigen::Index(i), Eigen::Index(i)))});
    world_.set_dynamic_settings(settings);
    DynamicState& state = world_.edit_dynamics();
    for (size_t i = 0; i < scene.dofs.size(); ++i)
      state.controls[i] = {.target = q[Eigen::Index(i)], .trajectory = {}};
    stepper_.emplace(world_);
  }

  double step_length() const override { return world_.dynamic_settings().step; }
  void step(double share, const Eigen::Vector3d& force) override {
    DynamicState& state = world_.edit_dynamics();
    for (size_t i = 0; i < grasp_.torques.size(); ++i)
      state.controls[i].effort = share * grasp_.torques[i] * joints_[i];
    state.loads[object_.index].force = force;
    stepper_->run(step_length());
  }
  Eigen::Isometry3d pose() const override {
    Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
    out.linear() = world_.pose(object_).matrix();
    out.translation() = world_.pose(object_).position;
    return out;
  }
  int contacts() override { return world_.dynamics()->report.contacts; }
  void save() override { saved_ = world_.snapshot(); }
  void restore() override { world_.restore(*saved_); }

 private:
  const StoredGrasp& grasp_;
  World world_;
  Id<Body> object_;
  std::vector<int> joints_;  // of each DOF
  std::optional<Stepper> stepper_;
  std::shared_ptr<const Snapshot> saved_;
};

}  // namespace

std::unique_ptr<Grip> our_grip(const GripScene& scene, const StoredGrasp& grasp,
                               const GripOptions& options) {
  return std::make_unique<Ours>(scene, grasp, options);
}

}  // namespace clench::bench
