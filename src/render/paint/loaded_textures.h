// Images of textures on the graphics card.
#pragma once
#include <vector>

#include "clench/render/gl/gl_objects.h"
#include "clench/spec/skin.h"

namespace clench {

/// Lives inside the life of a GlContext.
class LoadedTextures {
 public:
  LoadedTextures() = default;
  /// Images larger than the card takes are reduced; an image that several textures name and wrap
  /// alike is loaded once.
  explicit LoadedTextures(const std::vector<Texture>& textures);

  /// The texture of that number, for a program of Programs::on_image.
  void give(unsigned program, int number) const;
  size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    Texture texture;
    int object;  // number of its image
  };
  std::vector<Entry> entries_;
  std::vector<gl::Object> objects_;
  size_t bytes_ = 0;
};

}  // namespace clench
