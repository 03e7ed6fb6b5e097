#include "clench/render/paint/edge_pass.h"

#include <algorithm>
#include <cstdlib>

#include "clench/base/random.h"
#include "clench/render/gl/gl_context.h"
#include "clench/render/paint/tile.h"
#include "pictures.h"
#include "smooth_edges.h"

using namespace clench;
using namespace clench::test;

namespace {

constexpr int edge_wide = 90, edge_high = 70;

// lines and discs of random colors, partly transparent
Picture random_shapes(uint64_t seed, bool clear) {
  Random random(seed);
  Picture out{edge_wide, edge_high, std::vector<uint8_t>(3 * edge_wide * edge_high), {}};
  if (clear) out.alpha.resize(edge_wide * edge_high);
  for (int k = 0; k < 25; ++k) {
    const double x = random.uniform(0, edge_wide), y = random.uniform(0, edge_high),
                 r = random.uniform(1, 20), slope = random.uniform(-1, 1);
    const double cover = clear ? random.uniform(0, 1) : 1;
    uint8_t color[3];
    for (uint8_t& c : color) c = static_cast<uint8_t>(255 * cover * random.uniform(0, 1));
    for (int i = 0; i < edge_wide * edge_high; ++i) {
      const double dx = i % edge_wide - x, dy = i / edge_wide - y;
      if (k % 2 ? std::abs(dy - slope * dx) > 0.1 * r : dx * dx + dy * dy > r * r) continue;
      std::copy_n(color, 3, &out.pixels[3 * i]);
      if (clear) out.alpha[i] = static_cast<uint8_t>(255 * cover);
    }
  }
  return out;
}

gl::Object upload(const Picture& picture) {
  std::vector<float> data;
  for (int y = edge_high - 1; y >= 0; --y)
    for (int x = 0; x < edge_wide; ++x) {
      const size_t at = static_cast<size_t>(y) * edge_wide + x;
      for (int k = 0; k < 3; ++k) data.push_back(picture.pixels[3 * at + k] / 255.0f);
      data.push_back(picture.alpha.empty() ? 1 : picture.alpha[at] / 255.0f);
    }
  return gl::make_texture(gl::Format::rgba8, edge_wide, edge_high, data.data());
}

int largest_difference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  int largest = 0;
  REQUIRE(a.size() == b.size());
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("edges smoothed on the graphics card equal the reference, for any target") {
  REQUIRE_PICTURES();
  const GlContext context;
  const GlContext::Entered entered(context);
  const Programs programs;
  const Cover cover;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const bool clear = seed % 2 == 0;
    const RenderOptions options{.width = edge_wide,
                                .height = edge_high,
                                .backdrop = clear ? Backdrop::transparent : Backdrop::studio};
    const Picture drawn = random_shapes(seed, clear);
    Picture expected = drawn;
    smooth_edges(expected);
    CHECK_FALSE(expected == drawn);
    const gl::Object colors = upload(drawn), large = gl::make_texture(gl::Format::rgba8, 120, 99),
                     target = gl::make_framebuffer({large}, 0);
    smooth_to(programs.edges, cover, colors, options, {target, 11, 17});
    Picture smoothed = empty_picture(options);
    // at a corner of the framebuffer, which is larger
    read_tile({0, 0, edge_wide, edge_high, 0}, smoothed, {11, 17});
    CHECK(largest_difference(smoothed.pixels, expected.pixels) <= 1);
    CHECK(largest_difference(smoothed.alpha, expected.alpha) <= 1);
  }
}
