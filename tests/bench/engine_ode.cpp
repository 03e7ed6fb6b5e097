// ODE, used as in its manual: its own shapes, collision of all pairs from its hash space, and
// contact joints that are created in every step.
#include <ode/ode.h>

#include <deque>

#include "bench/dynamic_engine.h"

namespace clench::bench {

namespace {

class Ode : public DynamicEngine {
 public:
  Ode(const DynamicScene& scene, double h, OdeMethod method, bool meshes)
      : scene_(scene), h_(h), method_(method) {
    static const bool started = (dInitODE2(0), dAllocateODEDataForThread(dAllocateMaskAll), true);
    (void)started;
    dSetMessageHandler([](int, const char*, va_list) {});
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0, 0, -gravity);
    dWorldSetQuickStepNumIterations(world_, 30);
    space_ = dHashSpaceCreate(nullptr);
    group_ = dJointGroupCreate(0);
    for (const Part& part : scene.parts) add_part(part, meshes);
    for (const Link& link : scene.links) add_link(link);
  }
  ~Ode() override {
    dJointGroupDestroy(group_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    for (const dTriMeshDataID data : meshes_) dGeomTriMeshDataDestroy(data);
  }
  Ode(const Ode&) = delete;

  void step(int count) override {
    for (int i = 0; i < count; ++i) {
      for (size_t l = 0; l < joints_.size(); ++l)
        if (scene_.links[l].slides) dJointAddSliderForce(joints_[l], scene_.links[l].effort);
      dSpaceCollide(space_, this,
                    [](void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->meet(a, b); });
      if (method_ == OdeMethod::quick_step)
        dWorldQuickStep(world_, h_);
      else
        dWorldStep(world_, h_);
      dJointGroupEmpty(group_);
    }
  }
  Pose pose(int part) const override {
    const dReal* p = dGeomGetPosition(geoms_[part]);
    dQuaternion q;
    dGeomGetQuaternion(geoms_[part], q);
    return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), {p[0], p[1], p[2]}};
  }
  Eigen::Vector3d velocity(int part) const override {
    const dBodyID body = dGeomGetBody(geoms_[part]);
    if (!body) return Eigen::Vector3d::Zero();
    const dReal* v = dBodyGetLinearVel(body);
    return {v[0], v[1], v[2]};
  }

 private:
  void add_part(const Part& part, bool meshes) {
    const Eigen::Vector3d& s = part.size;
    dGeomID geom;
    if (meshes || part.form == Form::mesh) {
      geom = add_mesh(mesh_of(part));
    } else if (part.form == Form::box) {
      geom = dCreateBox(space_, s.x(), s.y(), s.z());
    } else if (part.form == Form::cylinder) {
      geom = dCreateCylinder(space_, s.x(), s.z());
    } else {
      geom = dCreateCapsule(space_, s.x(), s.z());
    }
    geoms_.push_back(geom);
    if (part.mass > 0) {
      const dBodyID body = dBodyCreate(world_);
      dMass mass;
      if (part.form == Form::box || part.form == Form::mesh)
        dMassSetBoxTotal(&mass, part.mass, s.x(), s.y(), s.z());
      else if (part.form == Form::cylinder)
        dMassSetCylinderTotal(&mass, part.mass, 3, s.x(), s.z());
      else
        dMassSetCapsuleTotal(&mass, part.mass, 3, s.x(), s.z());
      dBodySetMass(body, &mass);
      dGeomSetBody(geom, body);
    }
    const Eigen::Quaterniond& q = part.X_W.rotation;
    const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
    dGeomSetPosition(geom, part.X_W.position.x(), part.X_W.position.y(), part.X_W.position.z());
    dGeomSetQuaternion(geom, turn);
  }

  dGeomID add_mesh(const Mesh& mesh) {
    std::vector<double>& vertices = vertices_.emplace_back();
    std::vector<dTriIndex>& indices = indices_.emplace_back();
    for (const auto& p : mesh.vertices) vertices.insert(vertices.end(), {p.x(), p.y(), p.z()});
    for (const auto& t : mesh.triangles)
      for (const int v : t) indices.push_back(static_cast<dTriIndex>(v));
    meshes_.push_back(dGeomTriMeshDataCreate());
    dGeomTriMeshDataBuildDouble(meshes_.back(), vertices.data(), 3 * sizeof(double),
                                static_cast<int>(vertices.size() / 3), indices.data(),
                                static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
    return dCreateTriMesh(space_, meshes_.back(), nullptr, nullptr, nullptr);
  }

  void add_link(const Link& link) {
    const dBodyID child = dGeomGetBody(geoms_[link.part]);
    const dBodyID parent = link.parent < 0 ? nullptr : dGeomGetBody(geoms_[link.parent]);
    if (link.slides) {
      const dJointID joint = dJointCreateSlider(world_, nullptr);
      dJointAttach(joint, child, parent);
      dJointSetSliderAxis(joint, link.axis.x(), link.axis.y(), link.axis.z());
      // a compliant motor at rest acts as a damper
      dJointSetSliderParam(joint, dParamVel, 0);
      dJointSetSliderParam(joint, dParamFMax, dInfinity);
      dJointSetSliderParam(joint, dParamCFM, 1 / link.viscous);
      joints_.push_back(joint);
      return;
    }
    const dJointID joint = dJointCreateHinge(world_, nullptr);
    dJointAttach(joint, child, parent);
    dJointSetHingeAnchor(joint, link.origin.x(), link.origin.y(), link.origin.z());
    dJointSetHingeAxis(joint, link.axis.x(), link.axis.y(), link.axis.z());
    // a compliant stop at the target acts as a spring and a damper (section 3.8.2 of ODE's manual)
    dJointSetHingeParam(joint, dParamLoStop, link.target);
    dJointSetHingeParam(joint, dParamHiStop, link.target);
    dJointSetHingeParam(joint, dParamStopERP, h_ * link.kp / (h_ * link.kp + link.kd));
    dJointSetHingeParam(joint, dParamStopCFM, 1 / (h_ * link.kp + link.kd));
    joints_.push_back(joint);
  }

  void meet(dGeomID a, dGeomID b) {
    const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
    if ((!first && !second) || (first && second && dAreConnected(first, second))) return;
    constexpr int most = 8;
    dContact contacts[most];
    const int count = dCollide(a, b, most, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      contacts[i].surface = {};
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = scene_.mu;
      dJointAttach(dJointCreateContact(world_, group_, &contacts[i]), first, second);
    }
  }

  DynamicScene scene_;
  double h_;
  OdeMethod method_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID group_;
  std::vector<dGeomID> geoms_;
  std::vector<dJointID> joints_;
  std::vector<dTriMeshDataID> meshes_;
  std::deque<std::vector<double>> vertices_;
  std::deque<std::vector<dTriIndex>> indices_;
};

}  // namespace

EngineKind ode_engine(OdeMethod method, bool meshes) {
  std::string name = method == OdeMethod::quick_step ? "ODE quick step" : "ODE world step";
  if (meshes) name += ", meshes";
  return {name, 0, [=](const DynamicScene& scene, double h) {
            return std::make_unique<Ode>(scene, h, method, meshes);
          }};
}

}  // namespace clench::bench
