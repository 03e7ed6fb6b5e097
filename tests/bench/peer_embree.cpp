// Embree: point queries with its tree of axis-aligned boxes and Clench's exact test at the leaves,
// as in its manual; rays with its own test in single precision.
#include <embree3/rtcore.h>

#include <limits>

#include "bench/peers.h"
#include "clench/geometry/query/triangle.h"

namespace clench::bench {

namespace {

class EmbreePoint : public PointPeer {
 public:
  explicit EmbreePoint(const Shape& shape) : mesh_(shape.mesh()) {
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh_.vertices.size()));
    for (const auto& p : mesh_.vertices)
      for (const double x : p) *vertices++ = static_cast<float>(x);
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh_.triangles.size()));
    for (const auto& t : mesh_.triangles)
      for (const int v : t) *indices++ = static_cast<unsigned>(v);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreePoint() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  std::optional<double> distance(const Eigen::Vector3d& p) override { return search(p).distance; }
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& p) override { return search(p).q; }

  std::optional<double> cast(const Eigen::Vector3d& o, const Eigen::Vector3d& d) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(o.x());
    hit.ray.org_y = static_cast<float>(o.y());
    hit.ray.org_z = static_cast<float>(o.z());
    hit.ray.dir_x = static_cast<float>(d.x());
    hit.ray.dir_y = static_cast<float>(d.y());
    hit.ray.dir_z = static_cast<float>(d.z());
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<double>::infinity()
                                                     : hit.ray.tfar;
  }

 private:
  struct Search {
    const Mesh& mesh;
    Eigen::Vector3d p;
    double distance;
    Eigen::Vector3d q = {};
  };
  Search search(const Eigen::Vector3d& p) const {
    Search out{mesh_, p, std::numeric_limits<double>::infinity()};
    RTCPointQuery query{};
    query.x = static_cast<float>(p.x());
    query.y = static_cast<float>(p.y());
    query.z = static_cast<float>(p.z());
    query.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, visit, &out);
    return out;
  }
  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    const auto found =
        point_triangle(search.p, search.mesh.corners(static_cast<int>(arguments->primID)));
    const double d = found.distance;
    if (d >= search.distance) return false;
    search.distance = d;
    search.q = found.q;
    arguments->query->radius = static_cast<float>(d * 1.00001);
    return true;
  }

  const Mesh& mesh_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

std::unique_ptr<PointPeer> embree_point(const Shape& shape) {
  return std::make_unique<EmbreePoint>(shape);
}

}  // namespace clench::bench
