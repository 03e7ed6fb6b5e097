#include "bench/verdicts/bullet_grip.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>
#include <memory>

namespace clench::bench {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double margin = 1e-4;  // around convex shapes [m]

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion turn_to_bullet(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}
btTransform to_bullet(const Isometry3d& X) {
  return btTransform(turn_to_bullet(X.linear()), to_bullet(Vector3d(X.translation())));
}
Isometry3d from_bullet(const btTransform& X) {
  const btQuaternion q = X.getRotation();
  Isometry3d out = Isometry3d::Identity();
  out.linear() = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).toRotationMatrix();
  out.translation() = Vector3d(X.getOrigin().x(), X.getOrigin().y(), X.getOrigin().z());
  return out;
}

// Frames of Bullet's bodies are at the center of mass, along the principal axes.
struct Principal {
  Isometry3d X_LP = Isometry3d::Identity();  // in the body's frame
  Vector3d moments = Vector3d::Zero();
};

Principal principal(const GripBody& body) {
  Principal out;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(body.inertia);
  out.X_LP.linear() = solver.eigenvectors();
  if (out.X_LP.linear().determinant() < 0) out.X_LP.linear().col(2) *= -1;
  out.X_LP.translation() = body.com;
  out.moments = solver.eigenvalues().cwiseMax(1e-9);
  return out;
}

class BulletGrip : public Grip {
 public:
  BulletGrip(const GripScene& scene, const StoredGrasp& grasp, const GripOptions& options,
             const BulletOptions& bullet)
      : scene_(scene),
        grasp_(grasp),
        kp_(options.kp),
        options_(bullet),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(btVector3(0, 0, 0));
    world_.getSolverInfo().m_numIterations = bullet.iterations;
    world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    add_object();
    add_hand();
  }
  ~BulletGrip() override {
    for (const auto& limit : limits_) world_.removeMultiBodyConstraint(limit.get());
    for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    world_.removeMultiBody(hand_.get());
    world_.removeRigidBody(object_.get());
  }
  BulletGrip(const BulletGrip&) = delete;

  double step_length() const override { return options_.step; }
  void step(double share, const Vector3d& force) override {
    for (size_t j = 0; j < joints_.size(); ++j) {
      const GripLink& link = scene_.links[joints_[j].link];
      const int i = joints_[j].index;
      const double scale = link.turns ? 1 : 100;
      double torque = scale * (kp_ * (joints_[j].target - hand_->getJointPos(i)) -
                               options_.kd * hand_->getJointVel(i));
      torque -= scene_.dofs[link.dof].damping * hand_->getJointVel(i);
      if (!grasp_.torques.empty()) torque += share * grasp_.torques[link.dof] / link.ratio;
      hand_->addJointTorque(i, torque);
    }
    object_->applyCentralForce(to_bullet(force));
    world_.stepSimulation(options_.step, 0);
  }
  Isometry3d pose() const override {
    return from_bullet(object_->getWorldTransform()) * object_frame_.inverse();
  }

  int contacts() override {
    int count = 0;
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(m);
      for (int p = 0; p < manifold->getNumContacts(); ++p)
        count += manifold->getContactPoint(p).getDistance() < 1e-3;
    }
    return count;
  }

  void save() override {
    saved_.q.clear();
    for (int i = 0; i < hand_->getNumLinks(); ++i)
      saved_.q.push_back(hand_->getJointPos(i)), saved_.q.push_back(hand_->getJointVel(i));
    saved_.X = object_->getWorldTransform(), saved_.v = object_->getLinearVelocity(),
    saved_.w = object_->getAngularVelocity();
  }
  void restore() override {
    for (int i = 0; i < hand_->getNumLinks(); ++i) {
      if (hand_->getLink(i).m_dofCount == 0) continue;
      hand_->setJointPos(i, saved_.q[2 * i]);
      hand_->setJointVel(i, saved_.q[2 * i + 1]);
    }
    object_->setWorldTransform(saved_.X), object_->setInterpolationWorldTransform(saved_.X);
    object_->setLinearVelocity(saved_.v), object_->setAngularVelocity(saved_.w);
    update_hand();
    // lets Bullet find the contacts again
    for (double t = 0; t < 0.02; t += options_.step) step(1, Vector3d::Zero());
  }

 private:
  struct Joint {
    size_t link;
    int index;
    double target;
  };

  btCollisionShape* shape_of(const GripBody& body, const Isometry3d& X_PL) {
    std::vector<btConvexHullShape*> hulls;
    for (const Points& piece : body.pieces) {
      auto hull = std::make_unique<btConvexHullShape>();
      for (const Vector3d& p : piece) hull->addPoint(to_bullet(X_PL * p), false);
      hull->recalcLocalAabb();
      hull->setMargin(margin);
      hulls.push_back(hull.get());
      shapes_.push_back(std::move(hull));
    }
    if (hulls.size() == 1) return hulls[0];
    auto all = std::make_unique<btCompoundShape>();
    for (btConvexHullShape* hull : hulls) all->addChildShape(btTransform::getIdentity(), hull);
    all->setMargin(margin);
    shapes_.push_back(std::move(all));
    return shapes_.back().get();
  }

  void add_object() {
    const Principal p = principal(scene_.object);
    object_frame_ = p.X_LP;
    btCollisionShape* shape = shape_of(scene_.object, p.X_LP.inverse());
    btRigidBody::btRigidBodyConstructionInfo info(scene_.object.mass, nullptr, shape,
                                                  to_bullet(p.moments));
    info.m_startWorldTransform = to_bullet(p.X_LP);
    // Bullet multiplies the coefficients of the two bodies
    info.m_friction = std::sqrt(scene_.mu);
    object_ = std::make_unique<btRigidBody>(info);
    object_->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(object_.get(), 2, 1);
  }

  void add_collider(int index, const GripBody& body, const Isometry3d& X_PL) {
    if (body.pieces.empty()) return;
    auto collider = std::make_unique<btMultiBodyLinkCollider>(hand_.get(), index);
    collider->setCollisionShape(shape_of(body, X_PL));
    collider->setFriction(std::sqrt(scene_.mu));
    collider->setActivationState(DISABLE_DEACTIVATION);
    world_.addCollisionObject(collider.get(), 1, 2);
    if (index < 0)
      hand_->setBaseCollider(collider.get());
    else
      hand_->getLink(index).m_collider = collider.get();
    colliders_.push_back(std::move(collider));
  }

  void add_hand() {
    const int count = int(scene_.links.size()) - 1;
    hand_ = std::make_unique<btMultiBody>(count, 1, btVector3(1, 1, 1), true, false);
    hand_->setBaseWorldTransform(to_bullet(grasp_.pose));
    std::vector<Isometry3d> X_HP(scene_.links.size(), Isometry3d::Identity());
    X_HP[0] = scene_.links[0].pose;
    for (int i = 0; i < count; ++i) {
      const GripLink& link = scene_.links[i + 1];
      const Principal p = principal(link.body);
      X_HP[i + 1] = link.pose * p.X_LP;
      const Isometry3d &X_H = X_HP[i + 1], &parent = X_HP[link.parent];
      const Eigen::Matrix3d turn =
          // rotation from the parent's axes to those of the link
          X_H.linear().transpose() * parent.linear();
      const Vector3d pivot = parent.inverse() * link.point,
                     to_com = X_H.linear().transpose() * (X_H.translation() - link.point);
      const Vector3d axis = X_H.linear().transpose() * link.axis;
      Vector3d moments = p.moments;
      const double mass = std::max(link.body.mass, 1e-4);
      if (link.has_joint) {
        // the inertia that an implicit servo adds about its axis; without it, explicit servos
        // oscillate
        const GripDof& dof = scene_.dofs[link.dof];
        moments.array() += options_.step * options_.kd + options_.step * options_.step * kp_ +
                           options_.step * dof.damping + dof.armature;
      }
      if (!link.has_joint)
        hand_->setupFixed(i, mass, to_bullet(moments), link.parent - 1, turn_to_bullet(turn),
                          to_bullet(pivot), to_bullet(to_com));
      else if (link.turns)
        hand_->setupRevolute(i, mass, to_bullet(moments), link.parent - 1, turn_to_bullet(turn),
                             to_bullet(axis), to_bullet(pivot), to_bullet(to_com), true);
      else
        hand_->setupPrismatic(i, mass, to_bullet(moments), link.parent - 1, turn_to_bullet(turn),
                              to_bullet(axis), to_bullet(pivot), to_bullet(to_com), true);
    }
    hand_->finalizeMultiDof();
    hand_->setHasSelfCollision(false);
    hand_->setLinearDamping(0), hand_->setAngularDamping(0);
    hand_->setCanSleep(false);
    world_.addMultiBody(hand_.get());
    add_collider(-1, scene_.links[0].body, Isometry3d::Identity());
    for (int i = 0; i < count; ++i) {
      const GripLink& link = scene_.links[i + 1];
      add_collider(i, link.body, principal(link.body).X_LP.inverse());
      if (!link.has_joint) continue;
      const GripDof& dof = scene_.dofs[link.dof];
      const double target = link.ratio * (grasp_.dofs[link.dof] - dof.value);
      joints_.push_back({size_t(i) + 1, i, target});
      hand_->setJointPos(i, target);
      if (std::isfinite(dof.min) && std::isfinite(dof.max)) {
        limits_.push_back(std::make_unique<btMultiBodyJointLimitConstraint>(
            hand_.get(), i, link.ratio * (dof.min - dof.value),
            link.ratio * (dof.max - dof.value)));
        world_.addMultiBodyConstraint(limits_.back().get());
      }
    }
    update_hand();
  }

  void update_hand() {
    btAlignedObjectArray<btQuaternion> turns;
    btAlignedObjectArray<btVector3> origins;
    hand_->forwardKinematics(turns, origins);
    hand_->updateCollisionObjectWorldTransforms(turns, origins);
  }

  const GripScene& scene_;
  const StoredGrasp& grasp_;
  double kp_;
  BulletOptions options_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::unique_ptr<btRigidBody> object_;
  std::unique_ptr<btMultiBody> hand_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> limits_;
  std::vector<Joint> joints_;
  Isometry3d object_frame_ = Isometry3d::Identity();
  struct {
    std::vector<double> q;
    btTransform X;
    btVector3 v, w;
  } saved_;
};

}  // namespace

std::unique_ptr<Grip> bullet_grip(const GripScene& scene, const StoredGrasp& grasp,
                                  const GripOptions& options, const BulletOptions& bullet) {
  return std::make_unique<BulletGrip>(scene, grasp, options, bullet);
}

}  // namespace clench::bench
