// Shared by the tests of pictures.
#pragma once
#include <doctest/doctest.h>

#include <array>

#include "clench/base/error.h"
#include "clench/render/render.h"
#include "support/shapes.h"
#include "support/skip.h"

namespace clench::test {

/// Whether this machine and this build can draw. If not, the test case is skipped.
inline bool pictures() {
  try {
    render({}, {.width = 16, .height = 16, .samples = 1});
    return true;
  } catch (const Error& error) {
    const std::string why = error.what();
    // all other errors are failures of the test
    REQUIRE((why.find("install the packages libegl1, libgl1 and libgl1-mesa-dri") != why.npos ||
             why == "this build has no pictures: configure with -DCLENCH_GL=ON"));
    skip(why);
    return false;
  }
}

using Color = std::array<int, 3>;

inline Color pixel(const Picture& picture, int x, int y) {
  const uint8_t* p = &picture.pixels[3 * (static_cast<size_t>(y) * picture.width + x)];
  return {p[0], p[1], p[2]};
}

inline bool is_red(const Color& c) { return c[0] > 60 && c[0] > 2 * c[1] && c[0] > 2 * c[2]; }

inline int brightness(const Color& c) { return c[0] + c[1] + c[2]; }

inline DrawMesh solid(const Mesh& mesh, const Eigen::Vector3f& color = {0.85f, 0.05f, 0.05f},
                      const Pose& X_WM = {}) {
  DrawMesh out;
  out.shape = Shape::make(mesh);
  out.X_WM = X_WM;
  out.color = color;
  return out;
}

}  // namespace clench::test

/// Ends the test case as skipped if pictures cannot be drawn.
#define REQUIRE_PICTURES() \
  if (!clench::test::pictures()) return;
