#include "smooth_edges.h"

#include <doctest/doctest.h>

using namespace clench;
using clench::test::smooth_edges;

namespace {

// black below a slanted line, white above
Picture slant(double slope) {
  Picture out{80, 60, {}};
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      out.pixels.insert(out.pixels.end(), 3, y + 0.5 > 20 + slope * (x + 0.5) ? 0 : 255);
  return out;
}

// reference value of a pixel, by many samples
double covered(double slope, int x, int y) {
  double sum = 0;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j)
      sum += y + (j + 0.5) / 16 > 20 + slope * (x + (i + 0.5) / 16) ? 0 : 255;
  return sum / 256;
}

double error(const Picture& picture, double slope) {
  double sum = 0;
  for (int y = 4; y < 56; ++y)
    for (int x = 4; x < 76; ++x)
      sum += std::abs(picture.pixels[3 * (y * 80 + x)] - covered(slope, x, y));
  return sum;
}

}  // namespace

TEST_CASE("slanted edges approach the result of many samples") {
  for (const double slope : {0.1, 0.2, 0.35, 0.6}) {
    Picture picture = slant(slope);
    const double before = error(picture, slope);
    smooth_edges(picture);
    CHECK(error(picture, slope) < 0.6 * before);
  }
}

TEST_CASE("straight edges and uniform areas are unchanged") {
  Picture picture = slant(0);
  const Picture before = picture;
  smooth_edges(picture);
  CHECK(picture == before);
}
