// RAII wrappers of OpenGL textures, buffers and programs, without OpenGL types in the interface.
#pragma once
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace clench::gl {

/// Name of an OpenGL object, deleted by the destructor. Must not outlive its GlContext.
class Object {
 public:
  using Delete = void (*)(unsigned);
  Object() = default;
  Object(unsigned name, Delete remove) : name_(name), remove_(remove) {}
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)), remove_(other.remove_) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_), std::swap(remove_, other.remove_);
    return *this;
  }
  ~Object() {
    if (name_) remove_(name_);
  }
  operator unsigned() const { return name_; }

 private:
  unsigned name_ = 0;
  Delete remove_ = nullptr;
};

enum class Format { rgba8, rgba16f, rgba32f, depth };

/// Nearest sampling, clamped to the edge; `data` holds floats, red green blue alpha, or is null.
Object make_texture(Format format, int width, int height, const void* data = nullptr);
/// An image of 8-bit sRGB rows from the top, sampled as linear light, with mipmaps. `mirror` and
/// `clamp` set how it continues beyond its edges in each direction; the default is to repeat.
struct Edge {
  bool mirror = false, clamp = false;
};
Object make_image_texture(int width, int height, const void* pixels, Edge u, Edge v);
/// maximum size of a texture, at least 1024 [pixels]
int max_texture_side();
/// Layers of depth with comparison on reading: returns the filtered fraction of texels that pass.
Object make_shadow_maps(int size, int layers);
/// Framebuffer of textures of one size, in the order of a program's outputs; depth 0: none.
/// throws  Error if the driver does not support it
Object make_framebuffer(const std::vector<unsigned>& colors, unsigned depth);
/// Both sources are preceded by the version and `head`.
/// throws  Error with the driver's message
Object make_program(const std::string& head, const std::string& vertex,
                    const std::string& fragment);
/// Buffers of corners, or of indices of the current vertex array.
Object make_buffer(const void* data, size_t bytes, bool indices = false);
Object make_vertex_array();

// sets uniforms of the program, which becomes the current one
void use(unsigned program);
void set(unsigned program, const char* name, int value);
void set(unsigned program, const char* name, float value);
void set(unsigned program, const char* name, const Eigen::Vector2f& value);
void set(unsigned program, const char* name, const Eigen::Vector3f& value);
void set(unsigned program, const char* name, const Eigen::Vector4f& value);
void set(unsigned program, const char* name, const Eigen::Matrix4f& value);
void set(unsigned program, const char* name, const std::vector<float>& values);
void set(unsigned program, const char* name, const std::vector<Eigen::Vector3f>& values);
void set(unsigned program, const char* name, const std::vector<Eigen::Matrix3f>& values);
/// Binds the texture to this unit, and the sampler of that name to the unit.
void bind(unsigned program, const char* sampler, int unit, unsigned texture, bool layers = false);

}  // namespace clench::gl
