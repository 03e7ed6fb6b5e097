// Textures, buffers and programs of OpenGL as values that clean up after themselves, without its
// types.
#pragma once
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace clench::gl {

/// The name of an object, deleted with this. Lives inside the life of a GlContext.
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

/// Nearest sampling, edges repeated; `data` are floats, red green blue alpha, or null.
Object make_texture(Format format, int width, int height, const void* data = nullptr);
/// An image of 8-bit RGB rows from the top, whose colors are read as light; smaller copies of it
/// stand for it at a distance. `mirror` and `clamp` of each direction: how it goes on beyond its
/// edges, else it is repeated.
struct Edge {
  bool mirror = false, clamp = false;
};
Object make_image_texture(int width, int height, const void* pixels, Edge u, Edge v);
/// of a texture, at least 1024 [pixels]
int max_texture_side();
/// Layers of depth that are compared when they are read: shares of neighbors that pass.
Object make_shadow_maps(int size, int layers);
/// Draws to textures of one size, in the order of a program's outputs; depth 0: none.
/// throws  Error when the driver cannot
Object make_framebuffer(const std::vector<unsigned>& colors, unsigned depth);
/// Both texts follow the version and `head`.
/// throws  Error with the driver's words
Object make_program(const std::string& head, const std::string& vertex,
                    const std::string& fragment);
/// Corners, or indices of the current vertex array.
Object make_buffer(const void* data, size_t bytes, bool indices = false);
Object make_vertex_array();

// uniforms of the program, which becomes the current one
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
/// The texture at this unit, and the sampler of that name reads it.
void bind(unsigned program, const char* sampler, int unit, unsigned texture, bool layers = false);

}  // namespace clench::gl
