#include "clench/render/gl/gl_state.h"

#include <epoxy/gl.h>

#include <array>

namespace clench::gl {
namespace {

constexpr int units = 8;  // texture units used by pictures

// switches that drawing changes or depends on
constexpr std::array switches{
    GL_BLEND,        GL_DEPTH_TEST,        GL_POLYGON_OFFSET_FILL, GL_CULL_FACE,
    GL_SCISSOR_TEST, GL_STENCIL_TEST,      GL_FRAMEBUFFER_SRGB,    GL_COLOR_LOGIC_OP,
    GL_DEPTH_CLAMP,  GL_PRIMITIVE_RESTART, GL_RASTERIZER_DISCARD,  GL_SAMPLE_ALPHA_TO_COVERAGE};

struct BindingOf {
  GLenum target, query;
};
constexpr std::array textures{BindingOf{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                              BindingOf{GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                              BindingOf{GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER}};
constexpr std::array buffers{BindingOf{GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
                             BindingOf{GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
                             BindingOf{GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
                             BindingOf{GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER}};
// layout of rows of pixels in memory
constexpr std::array packing{GL_PACK_ALIGNMENT,    GL_PACK_ROW_LENGTH,  GL_PACK_SKIP_ROWS,
                             GL_PACK_SKIP_PIXELS,  GL_PACK_SWAP_BYTES,  GL_UNPACK_ALIGNMENT,
                             GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                             GL_UNPACK_SWAP_BYTES};

GLint number(GLenum what) {
  GLint value = 0;
  glGetIntegerv(what, &value);
  return value;
}

GLuint name(GLenum what) { return static_cast<GLuint>(number(what)); }

}  // namespace

struct SavedState::Values {
  std::array<GLboolean, switches.size()> on;
  std::array<GLuint, buffers.size()> bound;
  std::array<std::array<GLuint, textures.size()>, units> bound_textures;
  std::array<GLuint, units> samplers;
  std::array<GLint, packing.size()> packed;
  GLint unit, viewport[4], scissor[4], depth_func, cull, front, polygon[2];
  GLint blend[4], equation[2];
  GLuint program, array, draw, read;
  GLboolean colors[4], depth_mask;
  GLfloat clear_color[4], clear_depth, offset_factor, offset_units;
  GLdouble depth_range[2];
};

SavedState::SavedState() : values_(std::make_unique<Values>()) {
  Values& v = *values_;
  v.unit = number(GL_ACTIVE_TEXTURE);
  for (size_t i = 0; i < switches.size(); ++i) {
    v.on[i] = glIsEnabled(switches[i]);
    glDisable(switches[i]);
  }
  for (size_t i = 0; i < buffers.size(); ++i) v.bound[i] = name(buffers[i].query);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (int unit = 0; unit < units; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (size_t i = 0; i < textures.size(); ++i)
      v.bound_textures[unit][i] = name(textures[i].query);
    v.samplers[unit] = name(GL_SAMPLER_BINDING);
    glBindSampler(unit, 0);
  }
  for (size_t i = 0; i < packing.size(); ++i) {
    v.packed[i] = number(packing[i]);
    const bool alignment = packing[i] == GL_PACK_ALIGNMENT || packing[i] == GL_UNPACK_ALIGNMENT;
    glPixelStorei(packing[i], alignment ? 4 : 0);
  }
  glGetIntegerv(GL_VIEWPORT, v.viewport);
  glGetIntegerv(GL_SCISSOR_BOX, v.scissor);
  glGetIntegerv(GL_POLYGON_MODE, v.polygon);
  glGetDoublev(GL_DEPTH_RANGE, v.depth_range);
  glGetFloatv(GL_COLOR_CLEAR_VALUE, v.clear_color);
  glGetFloatv(GL_DEPTH_CLEAR_VALUE, &v.clear_depth);
  glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &v.offset_factor);
  glGetFloatv(GL_POLYGON_OFFSET_UNITS, &v.offset_units);
  glGetBooleanv(GL_COLOR_WRITEMASK, v.colors);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &v.depth_mask);
  v.depth_func = number(GL_DEPTH_FUNC);
  v.cull = number(GL_CULL_FACE_MODE), v.front = number(GL_FRONT_FACE);
  v.blend[0] = number(GL_BLEND_SRC_RGB), v.blend[1] = number(GL_BLEND_DST_RGB);
  v.blend[2] = number(GL_BLEND_SRC_ALPHA), v.blend[3] = number(GL_BLEND_DST_ALPHA);
  v.equation[0] = number(GL_BLEND_EQUATION_RGB), v.equation[1] = number(GL_BLEND_EQUATION_ALPHA);
  v.program = name(GL_CURRENT_PROGRAM), v.array = name(GL_VERTEX_ARRAY_BINDING);
  v.draw = name(GL_DRAW_FRAMEBUFFER_BINDING), v.read = name(GL_READ_FRAMEBUFFER_BINDING);
  glFrontFace(GL_CCW);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBlendEquation(GL_FUNC_ADD);
  glDepthRange(0, 1);
  glClearDepth(1);
}

SavedState::~SavedState() {
  const Values& v = *values_;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, v.draw);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, v.read);
  glUseProgram(v.program);
  glBindVertexArray(v.array);
  for (size_t i = 0; i < buffers.size(); ++i) glBindBuffer(buffers[i].target, v.bound[i]);
  for (int unit = 0; unit < units; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (size_t i = 0; i < textures.size(); ++i)
      glBindTexture(textures[i].target, v.bound_textures[unit][i]);
    glBindSampler(unit, v.samplers[unit]);
  }
  glActiveTexture(static_cast<GLenum>(v.unit));
  for (size_t i = 0; i < packing.size(); ++i) glPixelStorei(packing[i], v.packed[i]);
  glViewport(v.viewport[0], v.viewport[1], v.viewport[2], v.viewport[3]);
  glScissor(v.scissor[0], v.scissor[1], v.scissor[2], v.scissor[3]);
  glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(v.polygon[0]));
  glDepthRange(v.depth_range[0], v.depth_range[1]);
  glClearColor(v.clear_color[0], v.clear_color[1], v.clear_color[2], v.clear_color[3]);
  glClearDepth(v.clear_depth);
  glPolygonOffset(v.offset_factor, v.offset_units);
  glColorMask(v.colors[0], v.colors[1], v.colors[2], v.colors[3]);
  glDepthMask(v.depth_mask);
  glDepthFunc(static_cast<GLenum>(v.depth_func));
  glCullFace(static_cast<GLenum>(v.cull));
  glFrontFace(static_cast<GLenum>(v.front));
  glBlendFuncSeparate(v.blend[0], v.blend[1], v.blend[2], v.blend[3]);
  glBlendEquationSeparate(v.equation[0], v.equation[1]);
  for (size_t i = 0; i < switches.size(); ++i)
    v.on[i] ? glEnable(switches[i]) : glDisable(switches[i]);
}

}  // namespace clench::gl
