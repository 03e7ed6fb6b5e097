// Bullet: GImpact, its trees of quantized boxes for moving meshes, in single precision.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletCollisionCommon.h>

#include "bench/peers.h"

namespace clench::bench {

namespace {

class BulletMesh {
 public:
  explicit BulletMesh(const Mesh& mesh) {
    const auto at = [&](int v) {
      const Eigen::Vector3d& p = mesh.vertices[v];
      return btVector3(static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()),
                       static_cast<btScalar>(p.z()));
    };
    for (const auto& t : mesh.triangles) triangles_.addTriangle(at(t[0]), at(t[1]), at(t[2]));
    shape_ = std::make_unique<btGImpactMeshShape>(&triangles_);
    shape_->setMargin(0);
    shape_->updateBound();
    object.setCollisionShape(shape_.get());
  }
  BulletMesh(const BulletMesh&) = delete;
  btCollisionObject object;

 private:
  btTriangleMesh triangles_;
  std::unique_ptr<btGImpactMeshShape> shape_;
};

class BulletPair : public PairPeer {
 public:
  BulletPair(const Shape& a, const Shape& b)
      : dispatcher_(&configuration_), a_(a.mesh()), b_(b.mesh()) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
  }
  std::optional<bool> collide(const Pose& X_AB) override {
    const auto& q = X_AB.rotation;
    const auto& p = X_AB.position;
    const auto scalar = [](double x) { return static_cast<btScalar>(x); };
    b_.object.setWorldTransform(
        btTransform(btQuaternion(scalar(q.x()), scalar(q.y()), scalar(q.z()), scalar(q.w())),
                    btVector3(scalar(p.x()), scalar(p.y()), scalar(p.z()))));
    const btCollisionObjectWrapper a(nullptr, a_.object.getCollisionShape(), &a_.object,
                                     a_.object.getWorldTransform(), -1, -1),
        b(nullptr, b_.object.getCollisionShape(), &b_.object, b_.object.getWorldTransform(), -1,
          -1);
    btCollisionAlgorithm* algorithm =
        dispatcher_.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    btManifoldResult result(&a, &b);
    algorithm->processCollision(&a, &b, btDispatcherInfo(), &result);
    bool hit = false;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      hit = hit || dispatcher_.getManifoldByIndexInternal(i)->getNumContacts() > 0;
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
    return hit;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  BulletMesh a_, b_;
};

}  // namespace

std::unique_ptr<PairPeer> bullet_pair(const Shape& a, const Shape& b) {
  return std::make_unique<BulletPair>(a, b);
}

}  // namespace clench::bench
