#include "clench/geometry/query/containment.h"

#include "clench/geometry/query/queries.h"

namespace clench {

namespace {

// One shape in the frame of the other, whose solid may contain its parts.
class Holding {
 public:
  // p_outer = R p_inner + t, off by rounding at most
  Holding(const Shape& inner, const Shape& outer, const Eigen::Matrix3d& R,
          const Eigen::Vector3d& t, double rounding)
      : inner_(inner), outer_(outer), R_(R), t_(t), bounds_(outer.bounds()) {
    bounds_.low.array() -= rounding;
    bounds_.high.array() += rounding;
  }

  /// first part whose first corner, given by corner(triangle), lies in the solid; -1: none
  template <class Corner>
  int find(Corner corner) const {
    if (!outer_.closed()) return -1;
    for (size_t i = 0; i < inner_.parts().size(); ++i) {
      const int part = inner_.parts()[i];
      if (!sticks_out(i) && contains(outer_, corner(part))) return part;
    }
    return -1;
  }

 private:
  // is an extreme vertex of the part outside? A part that is contained has none
  bool sticks_out(size_t part) const {
    if (inner_.part_extremes().empty()) return false;
    for (const Eigen::Vector3d& p : inner_.part_extremes()[part])
      for (int k = 0; k < 3; ++k) {
        const double x = R_(k, 0) * p.x() + R_(k, 1) * p.y() + R_(k, 2) * p.z() + t_[k];
        if (x < bounds_.low[k] || x > bounds_.high[k]) return true;
      }
    return false;
  }

  const Shape &inner_, &outer_;
  const Eigen::Matrix3d R_;
  const Eigen::Vector3d t_;
  Bounds bounds_;
};

}  // namespace

std::optional<Containment> find_containment(const Shape& a, const Shape& b,
                                            const Placement& placement) {
  const Eigen::Matrix3d& R = placement.rotation();
  const Eigen::Vector3d& t = placement.position();
  const auto in_a = [&](int triangle) { return placement.corners_b(triangle)[0]; };
  const auto in_b = [&](int triangle) { return placement.to_b(placement.corners_a(triangle)[0]); };
  const double rounding = placement.rounding();
  if (const int part = Holding(b, a, R, t, rounding).find(in_a); part >= 0)
    return Containment{in_a(part), -1, part};
  const Eigen::Matrix3d back = R.transpose();
  if (const int part = Holding(a, b, back, -(back * t), rounding).find(in_b); part >= 0)
    return Containment{placement.corners_a(part)[0], part, -1};
  return {};
}

}  // namespace clench
