// Hashes that identify shapes, bodies and robots by the content on which grasps depend, regardless
// of names, files and poses.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "clench/model/world.h"

namespace clench {

/// Fingerprint of a surface; it does not depend on the order of triangles and vertices.
uint64_t fingerprint(const Shape& shape);

/// Fingerprints of shapes, each computed once while the shape lives.
class ShapeFingerprints {
 public:
  /// 0 of no shape
  uint64_t of(const ShapePtr& shape);

 private:
  struct Known {
    std::weak_ptr<const Shape> shape;
    uint64_t value = 0;
  };
  std::map<const Shape*, Known> known_;
  size_t tidy_size_ = 100;  ///< size at which entries of deleted shapes are removed
};

/// Fingerprint of surface, mass, center of mass, inertia, material, elasticity, restitution,
/// damping of free motion and gravity compensation.
uint64_t fingerprint(const World& world, Id<Body> id);

/// Fingerprint of the bodies of base and links, of joints, DOFs, limits and motors, of the number
/// of joint tendons and of the approach frame. The posture is ignored.
uint64_t fingerprint(const World& world, Id<Robot> id);

/// Fingerprint of everything that determines poses: shapes of base and links, the tree of links,
/// frames, axes and DOFs of joints. Frames are rounded to 1e-9 m, because their rounding differs
/// between file formats. Masses, materials, limits and motors are not included: studies change
/// them.
uint64_t mechanism_fingerprint(const World& world, Id<Robot> id, ShapeFingerprints& shapes);

/// 16 hexadecimal digits.
std::string fingerprint_text(uint64_t value);

}  // namespace clench
