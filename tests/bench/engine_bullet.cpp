// Bullet, set up like its examples: sequential impulses on rigid bodies, ten iterations, its own
// shapes, with collision margins inside them.
#include <btBulletDynamicsCommon.h>

#include "bench/dynamic_engine.h"

namespace clench::bench {

namespace {

btVector3 to_bullet(const Eigen::Vector3d& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}
Eigen::Vector3d from_bullet(const btVector3& v) {
  return {double(v.x()), double(v.y()), double(v.z())};
}
btTransform to_bullet(const Pose& X) {
  const Eigen::Quaterniond& q = X.rotation;
  return btTransform(
      btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())),
      to_bullet(X.position));
}

class Bullet : public DynamicEngine {
 public:
  Bullet(const DynamicScene& scene, double h)
      : scene_(scene),
        h_(h),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(btVector3(0, 0, btScalar(-gravity)));
    for (const Part& part : scene.parts) add_part(part);
    for (const Link& link : scene.links) add_link(link);
  }
  ~Bullet() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  Bullet(const Bullet&) = delete;

  void step(int count) override {
    for (int i = 0; i < count; ++i) {
      for (size_t l = 0; l < joints_.size(); ++l) push(scene_.links[l], l);
      world_.stepSimulation(btScalar(h_), 0);
    }
  }
  Pose pose(int part) const override {
    const btTransform& X = bodies_[part]->getWorldTransform();
    const btQuaternion q = X.getRotation();
    return {Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()), from_bullet(X.getOrigin())};
  }
  Eigen::Vector3d velocity(int part) const override {
    return from_bullet(bodies_[part]->getLinearVelocity());
  }

 private:
  void add_part(const Part& part) {
    const btScalar r = btScalar(part.size.x());
    if (part.form == Form::box)
      shapes_.push_back(std::make_unique<btBoxShape>(to_bullet(0.5 * part.size)));
    else if (part.form == Form::cylinder)
      shapes_.push_back(
          std::make_unique<btCylinderShapeZ>(to_bullet(Eigen::Vector3d(r, r, part.size.z() / 2))));
    else
      shapes_.push_back(std::make_unique<btCapsuleShapeZ>(r, btScalar(part.size.z())));
    btCollisionShape& shape = *shapes_.back();
    if (part.form != Form::capsule) shape.setMargin(btScalar(0.001));
    btVector3 inertia(0, 0, 0);
    if (part.mass > 0) shape.calculateLocalInertia(btScalar(part.mass), inertia);
    btRigidBody::btRigidBodyConstructionInfo info(btScalar(part.mass), nullptr, &shape, inertia);
    info.m_startWorldTransform = to_bullet(part.X_W);
    // Bullet multiplies the coefficients of the two bodies
    info.m_friction = btScalar(std::sqrt(scene_.mu));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }

  void add_link(const Link& link) {
    btRigidBody& child = *bodies_[link.part];
    btRigidBody& parent =
        link.parent < 0 ? btTypedConstraint::getFixedBody() : *bodies_[link.parent];
    // the axis is z of a hinge's frame and x of a slider's
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(
        link.slides ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ(), link.axis);
    const Pose frame{turn, link.origin};
    const btTransform at = to_bullet(frame);
    const btTransform in_child = child.getWorldTransform().inverse() * at;
    const btTransform in_parent = link.parent < 0 ? at : parent.getWorldTransform().inverse() * at;
    if (link.slides) {
      auto slider = std::make_unique<btSliderConstraint>(parent, child, in_parent, in_child, true);
      slider->setLowerLinLimit(-1);
      slider->setUpperLinLimit(1);
      slider->setLowerAngLimit(0);
      slider->setUpperAngLimit(0);
      joints_.push_back(std::move(slider));
    } else {
      joints_.push_back(
          std::make_unique<btHingeConstraint>(parent, child, in_parent, in_child, true));
    }
    world_.addConstraint(joints_.back().get(), true);
  }

  // forces of sliders; springs of hinges as motors whose maximal impulse is that of the spring
  void push(const Link& link, size_t number) {
    if (link.slides) {
      btRigidBody& body = *bodies_[link.part];
      const double force =
          link.effort - link.viscous * from_bullet(body.getLinearVelocity()).dot(link.axis);
      body.applyCentralForce(to_bullet(force * link.axis));
      return;
    }
    auto& hinge = static_cast<btHingeConstraint&>(*joints_[number]);
    const double error = link.target - hinge.getHingeAngle();
    hinge.enableAngularMotor(true, btScalar(link.kp / link.kd * error),
                             btScalar(link.kp * std::abs(error) * h_));
  }

  DynamicScene scene_;
  double h_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace

EngineKind bullet_engine() {
  return {"Bullet", 0,
          [](const DynamicScene& scene, double h) { return std::make_unique<Bullet>(scene, h); }};
}

}  // namespace clench::bench
