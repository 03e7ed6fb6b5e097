// CGAL: its tree of axis-aligned boxes, in double precision, with acceleration of distance queries.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "bench/peers.h"

namespace clench::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

class CgalPoint : public PointPeer {
 public:
  explicit CgalPoint(const Shape& shape) {
    const auto point = [](const Eigen::Vector3d& p) {
      return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    for (int t = 0; shape.has_triangle(t); ++t) {
      const auto c = shape.mesh().corners(t);
      triangles_.emplace_back(point(c[0]), point(c[1]), point(c[2]));
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
    tree_.accelerate_distance_queries();
  }
  std::optional<double> distance(const Eigen::Vector3d& p) override {
    return std::sqrt(tree_.squared_distance({p.x(), p.y(), p.z()}));
  }

 private:
  Triangles triangles_;
  CgalTree tree_;
};

}  // namespace

std::unique_ptr<PointPeer> cgal_point(const Shape& shape) {
  return std::make_unique<CgalPoint>(shape);
}

}  // namespace clench::bench
