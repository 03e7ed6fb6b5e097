#include "clench/render/paint/loaded_textures.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {

static constexpr int skin_unit = 5;  // unit that no other texture of a program uses

static gl::Edge edge_of(Wrap wrap) {
  return {.mirror = wrap == Wrap::mirror, .clamp = wrap == Wrap::clamp};
}

LoadedTextures::LoadedTextures(const std::vector<Texture>& textures) {
  for (const Texture& texture : textures) {
    check_stop();
    const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
      return entry.texture.image == texture.image && entry.texture.wrap_u == texture.wrap_u &&
             entry.texture.wrap_v == texture.wrap_v;
    });
    if (found != entries_.end()) {
      entries_.push_back({texture, found->object});
      continue;
    }
    const auto image = image_within(texture.image, gl::max_texture_side());
    entries_.push_back({texture, static_cast<int>(objects_.size())});
    objects_.push_back(gl::make_image_texture(image->width, image->height, image->pixels.data(),
                                              edge_of(texture.wrap_u), edge_of(texture.wrap_v)));
    bytes_ += image->pixels.size() / 3 * 4 * 4 / 3;  // four bytes per pixel, and mipmaps
  }
}

void LoadedTextures::give(unsigned program, int number) const {
  const Entry& entry = entries_[static_cast<size_t>(number)];
  gl::bind(program, "skin", skin_unit, objects_[static_cast<size_t>(entry.object)]);
  // component as linear light, as in linear_rgb
  const Eigen::Vector3f tint = entry.texture.tint.unaryExpr(
      [](float x) { return std::pow(std::clamp(x, 0.0f, 1.0f), 2.2f); });
  gl::set(program, "tint", tint);
}

}  // namespace clench
