// Texture images on the graphics card.
#pragma once
#include <vector>

#include "clench/render/gl/gl_objects.h"
#include "clench/spec/skin.h"

namespace clench {

/// Must not outlive its GlContext.
class LoadedTextures {
 public:
  LoadedTextures() = default;
  /// Images that exceed the card's maximum size are reduced; an image that several textures use
  /// with the same wrapping is loaded once.
  explicit LoadedTextures(const std::vector<Texture>& textures);

  /// Binds the texture of that index for a program of Programs::on_image.
  void give(unsigned program, int number) const;
  size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    Texture texture;
    int object;  // index of its image
  };
  std::vector<Entry> entries_;
  std::vector<gl::Object> objects_;
  size_t bytes_ = 0;
};

}  // namespace clench
