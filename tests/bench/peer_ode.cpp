// ODE: OPCODE's trees of axis-aligned boxes, in double precision.
#include <ode/ode.h>

#include "bench/peers.h"

namespace clench::bench {

namespace {

class OdeMesh {
 public:
  explicit OdeMesh(const Mesh& mesh) {
    for (const auto& p : mesh.vertices) vertices_.insert(vertices_.end(), {p.x(), p.y(), p.z()});
    for (const auto& t : mesh.triangles)
      for (const int v : t) indices_.push_back(static_cast<dTriIndex>(v));
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double),
                                static_cast<int>(vertices_.size() / 3), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
    geom_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }
  ~OdeMesh() {
    dGeomDestroy(geom_);
    dGeomTriMeshDataDestroy(data_);
  }
  OdeMesh(const OdeMesh&) = delete;

  void place(const Pose& X) {
    const Eigen::Matrix3d r = X.rotation.normalized().toRotationMatrix();
    const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0,       r(1, 0), r(1, 1),
                               r(1, 2), 0,       r(2, 0), r(2, 1), r(2, 2), 0};
    dGeomSetRotation(geom_, rotation);
    dGeomSetPosition(geom_, X.position.x(), X.position.y(), X.position.z());
  }
  dGeomID geom() const { return geom_; }

 private:
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_;
  dGeomID geom_;
};

class OdePair : public PairPeer {
 public:
  OdePair(const Shape& a, const Shape& b) : a_(a.mesh()), b_(b.mesh()) { a_.place({}); }
  std::optional<bool> collide(const Pose& X_AB) override {
    b_.place(X_AB);
    dContactGeom contact;
    return dCollide(a_.geom(), b_.geom(), 1, &contact, sizeof contact) > 0;
  }

 private:
  OdeMesh a_, b_;
};

}  // namespace

std::unique_ptr<PairPeer> ode_pair(const Shape& a, const Shape& b) {
  static const bool started = (dInitODE2(0), true);
  return started ? std::make_unique<OdePair>(a, b) : nullptr;
}

}  // namespace clench::bench
