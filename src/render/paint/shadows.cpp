#include "clench/render/paint/shadows.h"

#include <epoxy/gl.h>

#include <cmath>
#include <cstddef>

#include "clench/base/error.h"

namespace clench {
namespace {

constexpr double reach = 1.03;  // half width of a map: the scene's ball and a margin [scene units]
constexpr int gathered_width = 2048;

// copies the drawn pixels to a buffer, row by row
gl::Object to_buffer(int rows) {
  gl::Object out = gl::make_buffer(nullptr, size_t{16} * gathered_width * rows);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, out);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, gathered_width, rows, GL_RGBA, GL_FLOAT, nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return out;
}

// averages the light of neighboring corners of the floor, so that no single shadow is visible
gl::Object smooth_floor(const Programs& programs, const DrawList& list, unsigned gathered,
                        int rows) {
  if (!list.ground) return to_buffer(rows);
  const gl::Object smooth = gl::make_texture(gl::Format::rgba32f, gathered_width, rows),
                   framebuffer = gl::make_framebuffer({smooth}, 0);
  const unsigned program = programs.smooth;
  gl::bind(program, "light", 1, gathered);
  gl::set(program, "first", static_cast<int>(list.floor_corner));
  gl::set(program, "lines", floor_lines);
  Cover().draw(program);
  return to_buffer(rows);
}

}  // namespace

LoadedCorners::LoadedCorners(const std::vector<Corner>& from, const std::vector<uint32_t>& order)
    : array(gl::make_vertex_array()),
      corners(gl::make_buffer(from.data(), from.size() * sizeof(Corner))),
      indices(gl::make_buffer(order.data(), order.size() * sizeof(uint32_t), true)),
      count(static_cast<int>(order.size())) {
  const auto field = [](int at, int numbers, GLenum type, size_t offset) {
    glEnableVertexAttribArray(at);
    glVertexAttribPointer(at, numbers, type, type == GL_UNSIGNED_SHORT, sizeof(Corner),
                          reinterpret_cast<const void*>(offset));
  };
  field(0, 3, GL_FLOAT, offsetof(Corner, p));
  field(1, 3, GL_FLOAT, offsetof(Corner, n));
  field(2, 4, GL_UNSIGNED_SHORT, offsetof(Corner, paint));
  field(5, 2, GL_FLOAT, offsetof(Corner, paint));
}

void read_light(const LoadedCorners& loaded, int place, unsigned light) {
  glBindVertexArray(loaded.array);
  glBindBuffer(GL_ARRAY_BUFFER, light);
  glEnableVertexAttribArray(place);
  glVertexAttribPointer(place, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void Cover::draw(unsigned program) const {
  gl::use(program);
  glBindVertexArray(array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Shadows::Shadows(const Programs& programs, int size, int count)
    : programs_(programs),
      size_(size),
      maps_(gl::make_shadow_maps(size, count)),
      framebuffer_(gl::make_framebuffer({}, 0)) {}

void Shadows::cast(const DrawList& list, const LoadedCorners& loaded,
                   std::span<const Light> lights) {
  const unsigned program = programs_.shadow;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_, size_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2);
  glBindVertexArray(loaded.array);
  axes_.assign(most, Eigen::Matrix3f::Zero());
  to_light_.assign(most, Eigen::Vector3f::Zero());
  radiance_.assign(most, 0);
  share_.assign(most, 0);
  for (size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights[i];
    const Eigen::Vector3d to = light.to_light.cast<double>();
    const Eigen::Vector3d across = to.unitOrthogonal();
    Eigen::Matrix3d rows;
    rows << across.transpose(), to.cross(across).transpose(), to.transpose();
    axes_[i] = (rows / reach).cast<float>();
    to_light_[i] = light.to_light;
    radiance_[i] = light.radiance;
    share_[i] = light.share;

    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, maps_, 0, static_cast<int>(i));
    glClear(GL_DEPTH_BUFFER_BIT);
    gl::set(program, "axes", std::vector{axes_[i]});
    // of closed bodies only the side that faces the lamp can be nearest to it
    const auto draw = [](const Batch& batch) {
      (batch.closed ? glEnable : glDisable)(GL_CULL_FACE);
      glDrawElements(GL_TRIANGLES, batch.caster_count, GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(batch.first_caster * sizeof(uint32_t)));
    };
    for (const Batch& batch : list.solid) draw(batch);
    // bodies are offset, so that two of half opacity do not block the same lights
    for (size_t b = 0; b < list.clear.size(); ++b) {
      const double turn = light.chance + 0.38196601125 * static_cast<double>(b);
      if (turn - std::floor(turn) < list.clear[b].opacity) draw(list.clear[b]);
    }
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void Shadows::give(unsigned program) const {
  gl::set(program, "axes", axes_);
  gl::set(program, "to_light", to_light_);
  gl::set(program, "radiance", radiance_);
  gl::set(program, "share", share_);
  gl::set(program, "texel", static_cast<float>(2 * reach / size_));
  gl::bind(program, "maps", 0, maps_, true);
}

gl::Object gather(const Programs& programs, const DrawList& list, const LoadedCorners& loaded,
                  Shadows& shadows, const std::vector<Light>& lights, const Progress& progress) {
  const int rows = std::max<int>(1, (list.corners.size() + gathered_width - 1) / gathered_width);
  GLint max_rows = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_rows);
  if (rows > max_rows)
    fail(ErrorKind::limit,
         "picture: {} corners of triangles exceed the {} that OpenGL supports here",
         list.corners.size(), static_cast<size_t>(max_rows) * gathered_width);

  // corners as textures, four numbers each
  std::vector<Eigen::Vector4f> p(static_cast<size_t>(rows) * gathered_width,
                                 Eigen::Vector4f::Zero()),
      n = p;
  for (size_t i = 0; i < list.corners.size(); ++i) {
    p[i].head<3>() = list.corners[i].p;
    n[i].head<3>() = list.corners[i].n;
  }
  const gl::Object points = gl::make_texture(gl::Format::rgba32f, gathered_width, rows, p.data()),
                   normals = gl::make_texture(gl::Format::rgba32f, gathered_width, rows, n.data());
  const gl::Object gathered = gl::make_texture(gl::Format::rgba32f, gathered_width, rows);
  const gl::Object framebuffer = gl::make_framebuffer({gathered}, 0);
  const unsigned program = programs.gather;
  const Cover cover;
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  for (size_t i = 0; i < lights.size(); i += Shadows::most) {
    if (list.corners.size() > 100000)
      glFinish();  // otherwise a stop would wait for all earlier commands
    progress.check();
    shadows.cast(list, loaded,
                 std::span(lights).subspan(i, std::min<size_t>(Shadows::most, lights.size() - i)));
    shadows.give(program);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, gathered_width, rows);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    gl::bind(program, "points", 1, points);
    gl::bind(program, "normals", 2, normals);
    cover.draw(program);
    glDisable(GL_BLEND);
  }
  return smooth_floor(programs, list, gathered, rows);
}

}  // namespace clench
