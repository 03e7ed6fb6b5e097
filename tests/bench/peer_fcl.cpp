// FCL: trees of OBBRSS volumes, its fastest exact method for meshes.
#include <fcl/fcl.h>

#include "bench/peers.h"

namespace clench::bench {

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const Mesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  std::vector<fcl::Vector3d> vertices(mesh.vertices.begin(), mesh.vertices.end());
  const auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

class FclPair : public PairPeer {
 public:
  FclPair(const Shape& a, const Shape& b) : a_(model_of(a.mesh())), b_(model_of(b.mesh())) {}

  std::optional<bool> collide(const Pose& X_AB) override {
    b_.setTransform(X_AB.rotation.normalized().toRotationMatrix(), X_AB.position);
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::collide(&a_, &b_, request, result);
    return result.isCollision();
  }
  std::optional<double> distance(const Pose& X_AB) override {
    b_.setTransform(X_AB.rotation.normalized().toRotationMatrix(), X_AB.position);
    fcl::DistanceRequestd request(true);
    request.enable_signed_distance = false;
    fcl::DistanceResultd result;
    return fcl::distance(&a_, &b_, request, result);
  }

 private:
  fcl::CollisionObjectd a_, b_;
};

}  // namespace

std::unique_ptr<PairPeer> fcl_pair(const Shape& a, const Shape& b) {
  return std::make_unique<FclPair>(a, b);
}

}  // namespace clench::bench
