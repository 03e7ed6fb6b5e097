// Shader source of drafts: one pass, one shadow, lighting computed per fragment.
#pragma once

namespace clench::shaders {

/// vertex shader: transforms a mesh from its own units to the picture
inline constexpr const char* draft_vertex = R"(
layout(location = 0) in vec3 p;
layout(location = 1) in vec3 n;
#ifdef SKIN
layout(location = 5) in vec2 place;
out vec2 on_image;
#else
layout(location = 2) in vec4 own_paint;
#endif
uniform mat4 to_scene;
uniform mat4 to_clip;  // in the mesh's units
uniform float painted;  // 1: each corner has its own color
uniform vec4 one_paint;
out vec3 at;
out vec3 normal;
flat out vec4 paint;  // all corners of a triangle have the same paint
void main() {
  at = (to_scene * vec4(p, 1)).xyz;
  normal = mat3(to_scene) * n;
#ifdef SKIN
  on_image = place;
  paint = one_paint;
#else
  paint = vec4(mix(one_paint.rgb, own_paint.rgb, painted), one_paint.a);
#endif
  gl_Position = to_clip * vec4(p, 1);
}
)";

/// vertex shader of the lamp's depth map
inline constexpr const char* draft_shadow_vertex = R"(
layout(location = 0) in vec3 p;
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(p, 1); }
)";

/// part of programs that output display colors: highlight shoulder and sRGB curve, within 6 of 255,
/// without pow()
inline constexpr const char* draft_curve_part = R"(
vec3 developed(vec3 c) {
  const float knee = 0.7;
  vec3 over = max(vec3(0), c - knee) / (1 - knee), more = over * (1 + 0.5 * over);
  vec3 root = sqrt(min(c, knee) + (1 - knee) * more / (1 + more));
  return root * (1.0498 - 0.0285 * root);
}
)";

/// part of programs that shade: a lamp with one shadow map, and ambient light
inline constexpr const char* draft_light_part = R"(
uniform sampler2DArrayShadow map;
uniform mat3 map_axes;  // rows: across, across, towards the lamp
uniform vec3 to_lamp;
uniform float texel;  // of the map, in scene units

// fraction of the lamp that reaches p; 1 unless `asked`. A loop instead of a branch, which would
// compute both sides
float lit(vec3 p, vec3 n, bool asked) {
  float facing = dot(n, to_lamp);
  vec3 q = map_axes * (p + n * texel * (1.5 + 2.5 * sqrt(max(0, 1 - facing * facing))));
  vec3 at = vec3(0.5 + 0.5 * q.xy, min(0.5 - 0.5 * q.z, 0.99999));
  bool inside = asked && dot(q.xy, q.xy) < 1.1;
  float part = 1;
  int count = inside ? 1 : 0;
  for (int i = 0; i < count; ++i) part = texture(map, vec4(at.xy, 0, at.z));
  return part;
}
)";

/// bodies; MARKS: friction cones and arrows, independent of lighting; GLASS: transparent bodies,
/// which receive no shadow
inline constexpr const char* draft_fragment = R"(
uniform vec3 eye;
// specular reflection of the lamp and of the ambient light by the varnish
vec3 shine(vec3 n, vec3 v, float direct) {
  float over = 1 - clamp(dot(n, v), 0, 1), over2 = over * over;
  float half_way = max(0, dot(n, normalize(to_lamp + v)));
  float g = half_way * half_way;
  g *= g, g *= g, g *= g;
  float gloss = g * g * g;  // to the power of 48
  vec3 room = mix(vec3(0.30), vec3(0.98, 1.0, 1.04), smoothstep(-0.35, 0.5, reflect(-v, n).z));
  return 0.35 * (vec3(direct * gloss) + 0.8 * room * (0.04 + 0.96 * over2 * over2 * over));
}
in vec3 at;
in vec3 normal;
flat in vec4 paint;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal), v = normalize(eye - at);
  float across = clamp(dot(n, v), 0, 1), cover = paint.a;
#ifdef MARKS
  vec3 color = paint.rgb * (0.75 + 0.30 * across + 0.25 * max(0, n.z));
#else
  float direct = 0.62 * max(0, dot(n, to_lamp));
#ifdef GLASS
  cover = mix(cover, 1, 0.75 * (1 - across) * (1 - across));
#else
  direct *= lit(at, n, direct > 0);
#endif
  float room = 0.62 * mix(0.42, 1.0, smoothstep(0, 1, 0.5 + 0.5 * n.z)) * (0.75 + 0.25 * across);
  vec3 color = light_of(paint) * (room + direct) + shine(n, v, direct);
#endif
  result = vec4(developed(color) * cover, cover);
}
)";

/// unbounded floor that receives the shadow
inline constexpr const char* draft_floor_fragment = R"(
in vec3 at;
in vec3 normal;
flat in vec4 paint;
uniform float bare;  // 1: no backdrop, only the shadow
out vec4 result;
void main() {
  vec3 n = vec3(0, 0, 1);
  float shadow = 0.45 * (1 - lit(at, n, true)) * (1 - smoothstep(0.5, 1.0, length(at) / 5));
  vec3 color = developed(backdrop() * (1 - shadow));
  result = mix(vec4(color, 1), vec4(0, 0, 0, 0.8 * shadow), bare);
}
)";

/// backdrop
inline constexpr const char* draft_behind_fragment = R"(
out vec4 result;
void main() { result = vec4(developed(backdrop()), 1); }
)";

/// input of the line detection: position, normal, coverage
inline constexpr const char* draft_seen_fragment = R"(
in vec3 at;
in vec3 normal;
flat in vec4 paint;
layout(location = 0) out vec4 place;
layout(location = 1) out vec4 facing;
layout(location = 2) out vec4 colors;
void main() {
  place = vec4(at, 0);
  facing = vec4(normalize(gl_FrontFacing ? normal : -normal), 0);
  colors = vec4(1);
}
)";

}  // namespace clench::shaders
