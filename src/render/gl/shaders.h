// Shader source. Shared parts precede a program's own text, and all are preceded by LIGHTS, the
// number of lights per pass: a constant, so that loops over them are unrolled.
#pragma once

namespace clench::shaders {

/// vertex shader: transforms corners to the picture, with the light that was gathered for them
inline constexpr const char* surface_vertex = R"(
layout(location = 0) in vec3 p;
layout(location = 1) in vec3 n;
#ifdef SKIN
layout(location = 5) in vec2 place;
out vec2 on_image;
uniform float opacity;
#else
layout(location = 2) in vec4 own_paint;
#endif
layout(location = 3) in vec4 room;
layout(location = 4) in vec4 lamp;
uniform mat4 to_clip;
out vec3 at;
out vec3 normal;
flat out vec4 paint;  // all corners of a triangle have the same paint
out vec4 room_light;
out vec4 lamp_light;
void main() {
  at = p;
  normal = n;
#ifdef SKIN
  on_image = place;
  paint = vec4(1, 1, 1, opacity);
#else
  paint = own_paint;
#endif
  room_light = room;
  lamp_light = lamp;
  gl_Position = to_clip * vec4(p, 1);
}
)";

/// part of programs that show surfaces, before their own text: their color as linear light; with
/// SKIN that of an image
inline constexpr const char* skin_part = R"(
#ifdef SKIN
uniform sampler2D skin;
uniform vec3 tint;
in vec2 on_image;
// black surfaces are slightly brightened, so that their shape stays visible
vec3 light_of(vec4 paint) { return 0.012 + 0.988 * tint * texture(skin, on_image).rgb; }
#else
vec3 light_of(vec4 paint) { return paint.rgb; }
#endif
)";

/// vertex shader of a lamp's depth map; rows of axes: across, across, towards the lamp
inline constexpr const char* shadow_vertex = R"(
layout(location = 0) in vec3 p;
uniform mat3 axes[LIGHTS];
void main() {
  vec3 q = axes[0] * p;
  gl_Position = vec4(q.xy, -q.z, 1);
}
)";

/// one triangle that covers the screen, at maximum depth
inline constexpr const char* cover_vertex = R"(
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 1, 1);
}
)";

/// part of other programs: contribution of several lights
inline constexpr const char* light_part = R"(
uniform sampler2DArrayShadow maps;
uniform mat3 axes[LIGHTS];
uniform vec3 to_light[LIGHTS];
uniform float radiance[LIGHTS];
uniform float texel;  // of a map, in scene units
uniform float power;  // of each light, multiplied by its own strength

// start of the shadow ray off the surface: farther off at grazing angles
vec3 off(vec3 p, vec3 n, float facing) {
  return p + n * texel * (0.6 + 1.6 * sqrt(max(0, 1 - facing * facing)));
}
// fraction of light i that reaches p
float seen(int i, vec3 p) {
  vec3 q = axes[i] * p;
  return texture(maps, vec4(0.5 + 0.5 * q.xy, i, min(0.5 - 0.5 * q.z, 0.99999)));
}
// light that a matte white surface reflects, from a lamp whose points are all near its first one
float lamp_on(vec3 p, vec3 n) {
  vec3 start = off(p, n, dot(n, to_light[0]));
  float sum = 0;
  for (int i = 0; i < LIGHTS; ++i)
    sum += power * radiance[i] * max(0, dot(n, to_light[i])) * seen(i, start);
  return sum;
}
)";

/// for each corner, front and back: ambient light that reaches it, and its openness
inline constexpr const char* gather_fragment = R"(
uniform sampler2D points;
uniform sampler2D normals;
uniform float share[LIGHTS];
out vec4 result;
void main() {
  vec3 p = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
  vec3 n = texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz;
  result = vec4(0);
  for (int i = 0; i < LIGHTS; ++i) {
    float facing = dot(n, to_light[i]);
    float part = abs(facing) * seen(i, off(p, facing < 0 ? -n : n, facing));
    vec2 more = part * vec2(radiance[i], share[i]);
    result += facing < 0 ? vec4(0, 0, more) : vec4(more, 0, 0);
  }
}
)";

/// depth only
inline constexpr const char* depth_fragment = R"(
void main() {}
)";

/// first visible surface: position, normal, paint, and ambient light
inline constexpr const char* seen_fragment = R"(
in vec3 at;
in vec3 normal;
flat in vec4 paint;
in vec4 room_light;
uniform float floor_sign;  // -1 for the floor, else 1
layout(location = 0) out vec4 place;
layout(location = 1) out vec4 facing;
layout(location = 2) out vec4 colors;
void main() {
  float side = gl_FrontFacing ? 1 : -1;
  vec2 light = gl_FrontFacing ? room_light.xy : room_light.zw;
  place = vec4(at, light.x);
  facing = vec4(side * normalize(normal), light.y);
  // stored as square roots, because bytes are too coarse for dark values
  colors = vec4(sqrt(light_of(paint)), 0.5 + 0.5 * floor_sign);
}
)";

/// part of programs that shade: matte paint under a varnish
inline constexpr const char* shade_part = R"(
uniform vec3 eye;

vec3 mirrored(vec3 d) {
  return mix(vec3(0.30), vec3(0.98, 1.0, 1.04), smoothstep(-0.35, 0.5, d.z));
}
// reflection by the varnish; direct: light of the lamp, open: visible fraction of the room
vec3 varnish(vec3 n, vec3 v, vec3 to_lamp, float direct, float open) {
  float over = 1 - clamp(dot(n, v), 0, 1), over2 = over * over;
  float fresnel = 0.04 + 0.96 * over2 * over2 * over;
  // to the power of 48
  float g = max(0, dot(n, normalize(to_lamp + v)));
  g *= g, g *= g, g *= g, g *= g;
  float gloss = g * g * g;
  return 0.35 * (vec3(direct * gloss) + mirrored(reflect(-v, n)) * fresnel * min(1, open));
}
)";

/// shades the first visible surfaces in the light of the lamps
inline constexpr const char* shade_fragment = R"(
uniform sampler2D places;
uniform sampler2D facings;
uniform sampler2D paints;
uniform sampler2D depths;
uniform float open_light;  // ambient light on an unoccluded floor
uniform float reach;  // of the floor
uniform float bare;  // 1: no backdrop, only a shadow on the floor
out vec4 result;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(places, here, 0), facing = texelFetch(facings, here, 0),
       paint = texelFetch(paints, here, 0);
  bool nothing = texelFetch(depths, here, 0).r == 1, on_floor = paint.a < 0.5;
  vec3 p = place.xyz, n = facing.xyz;
  float direct = lamp_on(p, n);
  vec3 behind = backdrop(), v = normalize(eye - p);
  // the floor is the backdrop, reduced by the light that bodies block
  vec3 light = on_floor ? behind * (place.w + direct) / open_light
                        : paint.rgb * paint.rgb * (place.w + direct) + varnish(n, v, to_light[0], direct, facing.w);
  // with distance everything fades to the backdrop
  float fade = nothing ? 1 : smoothstep(0.5, 1.0, length(p) / reach);
  // a loss of a tenth of the light is present everywhere, and is not shown as a shadow
  float shadow = clamp((1 - (place.w + direct) / open_light - 0.1) / 0.9, 0, 1);
  vec4 alone = on_floor || nothing ? vec4(0, 0, 0, 0.75 * shadow * (1 - fade)) : vec4(light, 1);
  result = mix(vec4(mix(light, behind, fade), 1), alone, bare);
}
)";

/// glass; red green blue are multiplied by the opacity
inline constexpr const char* through_fragment = R"(
in vec3 at;
in vec3 normal;
flat in vec4 paint;
in vec4 room_light;
in vec4 lamp_light;
uniform vec3 to_lamp;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  vec3 v = normalize(eye - at);
  vec2 room = gl_FrontFacing ? room_light.xy : room_light.zw;
  float direct = gl_FrontFacing ? lamp_light.x : lamp_light.z;
  // more opaque at grazing angles
  float over = 1 - clamp(dot(n, v), 0, 1);
  float cover = mix(paint.a, 1, 0.75 * over * over * sqrt(over));
  result = vec4(light_of(paint) * (room.x + direct) * cover + varnish(n, v, to_lamp, direct, room.y), cover);
}
)";

/// cones: they glow, so that their color is visible in any light
inline constexpr const char* mark_fragment = R"(
in vec3 at;
in vec3 normal;
flat in vec4 paint;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  float across = clamp(dot(n, normalize(eye - at)), 0, 1);
  result = vec4(paint.rgb * (0.75 + 0.30 * across + 0.25 * max(0, n.z)) * paint.a, paint.a);
}
)";

/// smooths the floor's light over its grid: over a wider range where its cells are larger
inline constexpr const char* smooth_fragment = R"(
uniform sampler2D light;
uniform int first;  // corner of the floor's grid
uniform int lines;  // in each direction
out vec4 result;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  int width = textureSize(light, 0).x;
  int i = here.x + width * here.y - first;
  result = texelFetch(light, here, 0);
  if (i < 0 || i >= lines * lines) return;
  vec4 sum = vec4(0);
  float all = 0;
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) {
      ivec2 at = clamp(ivec2(i % lines + dx, i / lines + dy), ivec2(0), ivec2(lines - 1));
      int from = first + at.x + lines * at.y;
      float weight = float((3 - abs(dx)) * (3 - abs(dy)));
      sum += weight * texelFetch(light, ivec2(from % width, from / width), 0);
      all += weight;
    }
  result = sum / all;
}
)";

/// part of programs that shade: the backdrop, by the height in the picture
inline constexpr const char* backdrop_part = R"(
uniform vec2 corner;  // origin of the tile in the picture, pixels
uniform vec2 size;  // size of the picture, pixels
vec3 backdrop() {
  vec2 here = (gl_FragCoord.xy + corner) / size;
  return mix(vec3(0.80, 0.81, 0.82), vec3(0.52, 0.58, 0.66), smoothstep(0.1, 1.0, here.y));
}
)";

/// lines around bodies, where the surface seen in one pixel does not continue in its neighbors, and
/// along edges
inline constexpr const char* outline_fragment = R"(
uniform sampler2D places;
uniform sampler2D facings;
uniform sampler2D paints;
uniform vec3 eye;
uniform float spread;  // size of a pixel, in scene units, at a distance of 1 in perspective views
uniform float flat_view;  // 1: the size of a pixel is independent of distance
uniform float radius;  // width of the line, pixels
uniform float cover;
uniform float smooth_line;  // 1: a line has soft sides, used with one sample per pixel
out vec4 result;
bool there(ivec2 at) { return texelFetch(paints, at, 0).a > 0.5; }
bool differ(ivec2 a, ivec2 b, float step) {
  if (there(a) != there(b)) return true;
  if (!there(a)) return false;
  vec3 p = texelFetch(places, a, 0).xyz, q = texelFetch(places, b, 0).xyz,
       n = texelFetch(facings, a, 0).xyz, m = texelFetch(facings, b, 0).xyz;
  return max(abs(dot(n, q - p)), abs(dot(m, q - p))) > 2.5 * step + 0.004 || dot(n, m) < 0.6;
}
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(places, 0) - 1;
  float away = flat_view > 0.5 ? 1 : length(eye - texelFetch(places, here, 0).xyz);
  float hits = 0;
  for (int ring = 1; ring <= 2; ++ring)
    for (int k = 0; k < 8; ++k) {
      float angle = 0.785398163 * float(k), r = 0.5 * radius * float(ring);
      ivec2 at = ivec2(floor(gl_FragCoord.xy + r * vec2(cos(angle), sin(angle))));
      at = clamp(at, ivec2(0), last);
      if (differ(here, at, spread * away * max(r, 1))) hits += 1;
    }
  float part = cover * (smooth_line > 0.5 ? min(1, hits / 5) : min(1, hits));
  result = vec4(0, 0, 0, part);
}
)";

/// adds one pass, weighted
inline constexpr const char* add_fragment = R"(
uniform sampler2D light;
uniform float weight;
out vec4 result;
void main() { result = weight * texelFetch(light, ivec2(gl_FragCoord.xy), 0); }
)";

/// linear light to display values: a shoulder for highlights, then the sRGB curve
inline constexpr const char* develop_fragment = R"(
uniform sampler2D light;
out vec4 result;
void main() {
  vec4 all = texelFetch(light, ivec2(gl_FragCoord.xy), 0);
  result = vec4(developed(max(vec3(0), all.rgb / max(all.a, 1e-4))), all.a);
}
)";

/// part of programs that output display colors
inline constexpr const char* curve_part = R"(
vec3 developed(vec3 c) {
  const float knee = 0.7;
  vec3 over = max(vec3(0), c - knee);
  c = min(c, knee) + (1 - knee) * (1 - exp(-over / (1 - knee)));
  c = mix(12.92 * c, 1.055 * pow(c, vec3(1 / 2.4)) - 0.055, step(0.0031308, c));
  return c;
}
)";

}  // namespace clench::shaders
