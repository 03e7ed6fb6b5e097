#include "peer_bare_gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <stdexcept>
#include <vector>

namespace clench::bench {

namespace {

const char* const corners_in = R"(#version 330 core
layout(location = 0) in vec3 p;
uniform mat4 to_clip;
out vec3 at;
void main() { at = p; gl_Position = to_clip * vec4(p, 1); }
)";
const char* const color_out = R"(#version 330 core
in vec3 at;
out vec4 color;
void main() { color = vec4(0.5 + 0.5 * normalize(cross(dFdx(at), dFdy(at))), 1); }
)";

unsigned compile(unsigned kind, const char* text) {
  const unsigned shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  return shader;
}

}  // namespace

struct BareGl::Gl {
  EGLDisplay display;
  EGLContext context;
  int width, height, count;
  unsigned program;
  int clip_place;
  std::vector<uint8_t> pixels;

  void enter() const {
    eglBindAPI(EGL_OPENGL_API);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  }
  void leave() const { eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
};

BareGl::BareGl(const Scene& scene, const Eigen::Matrix4d& to_clip, int width, int height)
    : gl_(std::make_unique<Gl>()) {
  Gl& gl = *gl_;
  gl.display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  eglInitialize(gl.display, nullptr, nullptr);
  eglBindAPI(EGL_OPENGL_API);
  const EGLint expected[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
  gl.context = eglCreateContext(gl.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, expected);
  if (gl.context == EGL_NO_CONTEXT) throw std::runtime_error("no OpenGL for the bare peer");
  gl.width = width, gl.height = height;
  gl.pixels.resize(4 * static_cast<size_t>(width) * height);
  gl.enter();

  std::vector<Eigen::Vector3f> corners;
  std::vector<uint32_t> indices;
  for (const DrawMesh& mesh : scene.meshes) {
    if (!mesh.shape) continue;
    const auto base = static_cast<uint32_t>(corners.size());
    for (const auto& p : mesh.shape->mesh().vertices)
      corners.push_back((mesh.X_WM * p).cast<float>());
    for (const Triangle& t : mesh.shape->mesh().triangles)
      for (const int v : t) indices.push_back(base + static_cast<uint32_t>(v));
  }
  gl.count = static_cast<int>(indices.size());
  unsigned names[3];
  glGenVertexArrays(1, names);
  glBindVertexArray(names[0]);
  glGenBuffers(2, names + 1);
  glBindBuffer(GL_ARRAY_BUFFER, names[1]);
  glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof corners[0]), corners.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, names[2]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof indices[0]),
               indices.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.program = glCreateProgram();
  glAttachShader(gl.program, compile(GL_VERTEX_SHADER, corners_in));
  glAttachShader(gl.program, compile(GL_FRAGMENT_SHADER, color_out));
  glLinkProgram(gl.program);
  glUseProgram(gl.program);
  gl.clip_place = glGetUniformLocation(gl.program, "to_clip");
  const Eigen::Matrix4f clip = to_clip.cast<float>();
  glUniformMatrix4fv(gl.clip_place, 1, GL_FALSE, clip.data());

  unsigned framebuffer, buffers[2];
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenRenderbuffers(2, buffers);
  glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  glEnable(GL_DEPTH_TEST);
  glViewport(0, 0, width, height);
  gl.leave();
}

// destroying the context releases its objects
BareGl::~BareGl() { eglDestroyContext(gl_->display, gl_->context); }

int BareGl::draw() {
  gl_->enter();
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, gl_->count, GL_UNSIGNED_INT, nullptr);
  glReadPixels(0, 0, gl_->width, gl_->height, GL_RGBA, GL_UNSIGNED_BYTE, gl_->pixels.data());
  gl_->leave();
  int shown = 0;
  for (size_t i = 3; i < gl_->pixels.size(); i += 4) shown += gl_->pixels[i] > 0;
  return shown;
}

void BareGl::draw_frame(const Eigen::Matrix4d& to_clip) {
  gl_->enter();
  const Eigen::Matrix4f clip = to_clip.cast<float>();
  glUniformMatrix4fv(gl_->clip_place, 1, GL_FALSE, clip.data());
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, gl_->count, GL_UNSIGNED_INT, nullptr);
  glFinish();
  gl_->leave();
}

}  // namespace clench::bench
