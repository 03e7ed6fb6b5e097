// Shader source of the anti-aliasing of edges.
#pragma once

namespace clench::shaders {

/// mixes a pixel at a stepped edge with the pixel across the edge: the nearer to the step, the more
inline constexpr const char* edge_fragment = R"(
uniform sampler2D pixels;
uniform vec2 window;  // position in the picture of the first pixel of the window
uniform vec2 size;  // size of the picture
uniform float bare;  // 1: alpha is used, as on white
out vec4 result;

const int reach_along = 12, min_contrast = 12;
const float part_contrast = 0.1, max_spot = 0.6;
const ivec2 down = ivec2(0, -1), right = ivec2(1, 0);

int bright(ivec2 at) {
  ivec4 c = ivec4(texelFetch(pixels, at, 0) * 255.0 + 0.5);
  int white = bare > 0.5 ? 255 - c.a : 0;
  return min(255, (2 * c.r + 5 * c.g + c.b) / 8 + white);
}
bool within(ivec2 at) {
  return all(greaterThanEqual(at, ivec2(1))) && all(lessThan(at, ivec2(size) - 1));
}

// fraction of the pixel across that is mixed in here
float part_of(ivec2 here, int m, int n, int s, int e, int w, int range,
              out ivec2 across) {
  int ne = bright(here - down + right), nw = bright(here - down - right),
      se = bright(here + down + right), sw = bright(here + down - right);
  bool level = 2 * abs(n + s - 2 * m) + abs(ne + se - 2 * e) + abs(nw + sw - 2 * w) >=
               2 * abs(e + w - 2 * m) + abs(ne + nw - 2 * n) + abs(se + sw - 2 * s);
  int before = level ? n : w, after = level ? s : e;
  int side = abs(before - m) >= abs(after - m) ? -1 : 1, beside = side < 0 ? before : after;
  ivec2 along = level ? right : down;
  across = side * (level ? down : right);
  float steep = 0.25 * float(abs(beside - m)), middle = 0.5 * float(m + beside);
  float nearest = 0, all_steps = 0, end = 0, part = 0;
  for (int way = -1; way <= 1; way += 2) {
    float off = 0;
    int steps = 1;
    for (; steps < reach_along; ++steps) {
      ivec2 at = here + way * steps * along;
      if (!within(at)) {
        steps = reach_along;
        break;
      }
      off = 0.5 * float(bright(at) + bright(at + across)) - middle;
      if (abs(off) >= steep) break;
    }
    if (way < 0 || float(steps) < nearest) nearest = float(steps), end = off;
    all_steps += float(steps);
  }
  if (abs(end) >= steep && (end < 0) != (float(m) - middle < 0)) part = 0.5 - nearest / all_steps;
  float around = float(2 * (n + s + e + w) + ne + nw + se + sw) / 12;
  float unlike = abs(around - float(m)) / float(range);
  float alone = clamp((unlike - 0.35) / 0.65, 0, 1);
  float spot = alone * alone * (3 - 2 * alone);
  return max(part, max_spot * spot * spot);
}

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy) + ivec2(window);
  vec4 own = texelFetch(pixels, here, 0);
  result = own;
  if (within(here)) {
    int m = bright(here), n = bright(here - down), s = bright(here + down),
        e = bright(here + right), w = bright(here - right);
    int high = max(max(max(n, s), max(e, w)), m), low = min(min(min(n, s), min(e, w)), m);
    int range = high - low;
    if (range >= min_contrast && float(range) >= part_contrast * float(high)) {
      ivec2 across;
      float part = part_of(here, m, n, s, e, w, range, across);
      vec4 other = texelFetch(pixels, here + across, 0);
      vec4 sum = (1 - part) * floor(own * 255 + 0.5) + part * floor(other * 255 + 0.5);
      if (part > 0) result = floor(sum + 0.5) / 255;
    }
  }
  if (bare < 0.5) result.a = 1;
}
)";

}  // namespace clench::shaders
