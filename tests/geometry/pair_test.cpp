#include "base/error.h"
#include "base/random.h"
#include "geometry/queries.h"
#include "geometry/triangle.h"
#include "support/shapes.h"

using namespace clench;
using Eigen::Vector3d;

TEST_CASE("smoke") {
  Random r(1);
  const auto a = Shape::make(test::ball(1, 6, 9)), b = Shape::make(test::box(0.5, 0.7, 0.9));
  for (int i = 0; i < 300; ++i) {
    const Pose X{Eigen::Quaterniond(r.normal(), r.normal(), r.normal(), r.normal()).normalized(),
                 2 * Vector3d(r.normal(), r.normal(), r.normal()).normalized() * r.uniform()};
    double least = 1e9;
    for (int s = 0; s < (int)a->mesh().triangles.size(); ++s)
      for (int t = 0; t < 12; ++t) {
        auto c = b->mesh().corners(t);
        for (auto& p : c) p = X.rotation.normalized().toRotationMatrix() * p + X.position;
        const auto d = triangle_triangle(a->mesh().corners(s), c);
        CHECK(triangles_meet(a->mesh().corners(s), c) == (d.distance == 0));
        least = std::min(least, d.distance);
      }
    const bool hit = colliding(*a, *b, X);
    const Distance d = distance(*a, *b, X);
    CHECK(hit == (d.distance == 0));
    if (X.position.norm() > 0.5) CHECK(least == d.distance);
    if (X.position.norm() < 0.2) CHECK(hit);
  }
}
