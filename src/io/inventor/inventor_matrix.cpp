#include "clench/io/inventor/inventor_matrix.h"

#include <cmath>

namespace clench {

namespace {

struct Turn {
  float x, y, z, w;
};

Turn turn_of(std::span<const float> axis_angle) {
  float x = axis_angle[0], y = axis_angle[1], z = axis_angle[2];
  const float length = std::sqrt(x * x + y * y + z * z);
  if (length > 0) {
    const float inverse = 1.0f / length;
    x *= inverse, y *= inverse, z *= inverse;
  }
  const float half = axis_angle[3] / 2, sine = std::sin(half);
  return {x * sine, y * sine, z * sine, std::cos(half)};
}

float norm_of(const Turn& q) { return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w); }

Turn inverse(const Turn& q) {
  const float factor = 1.0f / norm_of(q);
  return {-q.x * factor, -q.y * factor, -q.z * factor, q.w * factor};
}

InventorMatrix matrix_of(Turn q) {
  const float length = norm_of(q);
  if (length > 0) q = {q.x / length, q.y / length, q.z / length, q.w / length};
  const auto [x, y, z, w] = q;
  InventorMatrix out;
  out.m = {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (z * x - y * w), 0},
            {2 * (x * y - z * w), 1 - 2 * (z * z + x * x), 2 * (y * z + x * w), 0},
            {2 * (z * x + y * w), 2 * (y * z - x * w), 1 - 2 * (y * y + x * x), 0},
            {0, 0, 0, 1}}};
  return out;
}

}  // namespace

InventorMatrix InventorMatrix::translation(std::span<const float> t) {
  InventorMatrix out;
  out.m[3] = {t[0], t[1], t[2], 1};
  return out;
}

InventorMatrix InventorMatrix::scale(std::span<const float> s) {
  InventorMatrix out;
  for (int i = 0; i < 3; ++i) out.m[i][i] = s[i];
  return out;
}

InventorMatrix InventorMatrix::rotation(std::span<const float> axis_angle) {
  return matrix_of(turn_of(axis_angle));
}

InventorMatrix InventorMatrix::transform(std::span<const float> t, std::span<const float> turn,
                                         std::span<const float> factors,
                                         std::span<const float> scale_orientation,
                                         std::span<const float> center) {
  const InventorVector back = {-center[0], -center[1], -center[2]},
                       forth = {center[0] + t[0], center[1] + t[1], center[2] + t[2]};
  InventorMatrix scaled = translation(back);
  if (!scale(factors).is_identity()) {
    const Turn o = turn_of(scale_orientation);
    scaled = scaled * matrix_of(inverse(o)) * scale(factors) * matrix_of(o);
  }
  return scaled * rotation(turn) * translation(forth);
}

// products with the identity are omitted, because they would lose the sign of zeros
InventorMatrix InventorMatrix::operator*(const InventorMatrix& b) const {
  if (is_identity()) return b;
  if (b.is_identity()) return *this;
  InventorMatrix out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      out.m[i][j] =
          m[i][0] * b.m[0][j] + m[i][1] * b.m[1][j] + m[i][2] * b.m[2][j] + m[i][3] * b.m[3][j];
  return out;
}

InventorVector InventorMatrix::apply(const InventorVector& p) const {
  if (is_identity()) return p;
  const auto sum = [&](int j) {
    return p[0] * m[0][j] + p[1] * m[1][j] + p[2] * m[2][j] + m[3][j];
  };
  const float w = sum(3);
  return {sum(0) / w, sum(1) / w, sum(2) / w};
}

bool InventorMatrix::mirrors() const {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
         0;
}

}  // namespace clench
