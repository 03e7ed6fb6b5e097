#include "clench/render/gl/gl_objects.h"

#include <epoxy/gl.h>

#include <string>

#include "clench/base/error.h"

namespace clench::gl {
namespace {

void delete_texture(unsigned name) { glDeleteTextures(1, &name); }
void delete_framebuffer(unsigned name) { glDeleteFramebuffers(1, &name); }
void delete_buffer(unsigned name) { glDeleteBuffers(1, &name); }
void delete_vertex_array(unsigned name) { glDeleteVertexArrays(1, &name); }
void delete_program(unsigned name) { glDeleteProgram(name); }
void delete_shader(unsigned name) { glDeleteShader(name); }

Object compile(GLenum kind, const std::string& source) {
  Object shader(glCreateShader(kind), delete_shader);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char words[1024] = "";
  glGetShaderInfoLog(shader, sizeof words, nullptr, words);
  fail(ErrorKind::internal, "picture: the OpenGL driver rejects a shader: {}", words);
}

void filter(GLenum target, GLint mode) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, mode);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, mode);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

GLint stored(Format format) {
  switch (format) {
    case Format::rgba8:
      return GL_RGBA8;
    case Format::rgba16f:
      return GL_RGBA16F;
    case Format::rgba32f:
      return GL_RGBA32F;
    case Format::depth:
      return GL_DEPTH_COMPONENT32F;
  }
  return GL_RGBA8;
}

int at(unsigned program, const char* name) { return glGetUniformLocation(program, name); }

}  // namespace

Object make_texture(Format format, int width, int height, const void* data) {
  unsigned name = 0;
  glGenTextures(1, &name);
  Object texture(name, delete_texture);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, stored(format), width, height, 0,
               format == Format::depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, data);
  filter(GL_TEXTURE_2D, GL_NEAREST);
  return texture;
}

int max_texture_side() {
  GLint side = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  return side;
}

Object make_image_texture(int width, int height, const void* pixels, Edge u, Edge v) {
  const auto wrap = [](Edge edge) -> GLint {
    return edge.clamp ? GL_CLAMP_TO_EDGE : edge.mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
  };
  unsigned name = 0;
  glGenTextures(1, &name);
  Object texture(name, delete_texture);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, pixels);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (glGetError() == GL_OUT_OF_MEMORY)
    fail("picture: a texture of {} x {} pixels exceeds the memory of OpenGL", width, height);
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap(u));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap(v));
  return texture;
}

Object make_shadow_maps(int size, int layers) {
  unsigned name = 0;
  glGenTextures(1, &name);
  Object texture(name, delete_texture);
  glBindTexture(GL_TEXTURE_2D_ARRAY, name);
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, size, size, layers, 0,
               GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  filter(GL_TEXTURE_2D_ARRAY, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return texture;
}

Object make_framebuffer(const std::vector<unsigned>& colors, unsigned depth) {
  unsigned name = 0;
  glGenFramebuffers(1, &name);
  Object framebuffer(name, delete_framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  std::vector<GLenum> places;
  for (const unsigned color : colors) {
    places.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(places.size()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, places.back(), GL_TEXTURE_2D, color, 0);
  }
  if (depth) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
  if (colors.empty()) {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    return framebuffer;
  }
  glDrawBuffers(static_cast<int>(places.size()), places.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    fail(ErrorKind::internal, "picture: the OpenGL driver cannot draw to floating-point numbers");
  return framebuffer;
}

Object make_program(const std::string& head, const std::string& vertex,
                    const std::string& fragment) {
  const std::string version = "#version 330 core\n" + head;
  const Object v = compile(GL_VERTEX_SHADER, version + vertex),
               f = compile(GL_FRAGMENT_SHADER, version + fragment);
  Object program(glCreateProgram(), delete_program);
  glAttachShader(program, v);
  glAttachShader(program, f);
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good) return program;
  char words[1024] = "";
  glGetProgramInfoLog(program, sizeof words, nullptr, words);
  fail(ErrorKind::internal, "picture: the OpenGL driver rejects a program: {}", words);
}

Object make_buffer(const void* data, size_t bytes, bool indices) {
  unsigned name = 0;
  glGenBuffers(1, &name);
  Object buffer(name, delete_buffer);
  const GLenum target = indices ? GL_ELEMENT_ARRAY_BUFFER : GL_ARRAY_BUFFER;
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  if (glGetError() == GL_OUT_OF_MEMORY)
    fail("picture: {} bytes of triangles exceed the memory of OpenGL", bytes);
  return buffer;
}

Object make_vertex_array() {
  unsigned name = 0;
  glGenVertexArrays(1, &name);
  glBindVertexArray(name);
  return Object(name, delete_vertex_array);
}

void use(unsigned program) { glUseProgram(program); }
void set(unsigned program, const char* name, int value) {
  use(program);
  glUniform1i(at(program, name), value);
}
void set(unsigned program, const char* name, float value) {
  use(program);
  glUniform1f(at(program, name), value);
}
void set(unsigned program, const char* name, const Eigen::Vector2f& value) {
  use(program);
  glUniform2fv(at(program, name), 1, value.data());
}
void set(unsigned program, const char* name, const Eigen::Vector3f& value) {
  use(program);
  glUniform3fv(at(program, name), 1, value.data());
}
void set(unsigned program, const char* name, const Eigen::Vector4f& value) {
  use(program);
  glUniform4fv(at(program, name), 1, value.data());
}
void set(unsigned program, const char* name, const Eigen::Matrix4f& value) {
  use(program);
  glUniformMatrix4fv(at(program, name), 1, GL_FALSE, value.data());
}
void set(unsigned program, const char* name, const std::vector<float>& values) {
  use(program);
  glUniform1fv(at(program, name), static_cast<int>(values.size()), values.data());
}
void set(unsigned program, const char* name, const std::vector<Eigen::Vector3f>& values) {
  use(program);
  glUniform3fv(at(program, name), static_cast<int>(values.size()), values.front().data());
}
void set(unsigned program, const char* name, const std::vector<Eigen::Matrix3f>& values) {
  use(program);
  glUniformMatrix3fv(at(program, name), static_cast<int>(values.size()), GL_FALSE,
                     values.front().data());
}
void bind(unsigned program, const char* sampler, int unit, unsigned texture, bool layers) {
  set(program, sampler, unit);
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(layers ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, texture);
}

}  // namespace clench::gl
