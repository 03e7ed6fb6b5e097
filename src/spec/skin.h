// Images on the triangles of a mesh that is drawn: a value that bodies share, as they share meshes.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace clench {

/// RGB, 8 bits per channel, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels = {};

  bool operator==(const Image&) const = default;
};

/// Continuation of an image beyond its edges.
enum class Wrap : char { repeat, mirror, clamp };

/// An image as a material uses it.
struct Texture {
  std::shared_ptr<const Image> image = {};  ///< not null
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();  ///< factor of the image's colors, 0..1
};

/// Place of a triangle's corners in an image: u to the right, v down from the top, both 0..1 within
/// it.
struct TexturedTriangle {
  int texture = -1;  ///< number of a texture; -1: the triangle has its color alone
  std::array<Eigen::Vector2f, 3> uv = {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(),
                                       Eigen::Vector2f::Zero()};
};

/// Textures of a mesh.
struct Skin {
  std::vector<Texture> textures = {};
  std::vector<TexturedTriangle> triangles = {};  ///< one per triangle of the mesh

  /// of the pixels and coordinates, each image once
  size_t bytes() const;
};

using SkinPtr = std::shared_ptr<const Skin>;

/// Equal contents? Null equals null alone.
bool same_skin(const SkinPtr& a, const SkinPtr& b);

/// Of the same triangles with their second and third corners exchanged; null of null.
SkinPtr turned_over(const SkinPtr& skin);

/// Appends triangles of a mesh that is put behind others. `part`: null: `count` triangles without
/// images
void append_skin(Skin& skin, const SkinPtr& part, size_t count);

/// The image with its sides halved until none is longer than `largest`; each pixel is the mean of
/// those that it replaces.
std::shared_ptr<const Image> image_within(std::shared_ptr<const Image> image, int largest);

}  // namespace clench
