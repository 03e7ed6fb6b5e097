// Transforms of scene graphs: 4 x 4 matrices of 32-bit numbers that multiply row vectors. Every sum
// is evaluated in a fixed order, so that points are bit-identical to those of other readers of
// these files, which round in the same way.
#pragma once
#include <array>
#include <span>

namespace clench {

using InventorVector = std::array<float, 3>;

struct InventorMatrix {
  std::array<std::array<float, 4>, 4> m = {
      {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  static InventorMatrix translation(std::span<const float> t);
  static InventorMatrix scale(std::span<const float> s);
  /// Rotation about an axis of any length, "x y z angle".
  static InventorMatrix rotation(std::span<const float> axis_angle);
  /// Scaling along the axes of scale_orientation and rotation, both about the center, followed by
  /// the translation.
  static InventorMatrix transform(std::span<const float> translation,
                                  std::span<const float> rotation, std::span<const float> scale,
                                  std::span<const float> scale_orientation,
                                  std::span<const float> center);

  bool is_identity() const { return m == InventorMatrix().m; }
  InventorMatrix operator*(const InventorMatrix& b) const;
  InventorVector apply(const InventorVector& p) const;
  bool mirrors() const;
};

}  // namespace clench
