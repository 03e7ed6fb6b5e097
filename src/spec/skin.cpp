#include "clench/spec/skin.h"

#include <algorithm>
#include <set>
#include <utility>

namespace clench {

size_t Skin::bytes() const {
  size_t sum = textures.size() * sizeof(Texture) + triangles.size() * sizeof(TexturedTriangle);
  std::set<const Image*> seen;
  for (const Texture& texture : textures)
    if (seen.insert(texture.image.get()).second) sum += texture.image->pixels.size();
  return sum;
}

static bool same_texture(const Texture& a, const Texture& b) {
  return a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v && a.tint == b.tint &&
         (a.image == b.image || *a.image == *b.image);
}

static bool same_triangle(const TexturedTriangle& a, const TexturedTriangle& b) {
  return a.texture == b.texture && a.uv == b.uv;
}

bool same_skin(const SkinPtr& a, const SkinPtr& b) {
  if (a == b || !a || !b) return a == b;
  return std::ranges::equal(a->triangles, b->triangles, same_triangle) &&
         std::ranges::equal(a->textures, b->textures, same_texture);
}

SkinPtr turned_over(const SkinPtr& skin) {
  if (!skin) return nullptr;
  auto out = std::make_shared<Skin>(*skin);
  for (TexturedTriangle& triangle : out->triangles) std::swap(triangle.uv[1], triangle.uv[2]);
  return out;
}

void append_skin(Skin& skin, const SkinPtr& part, size_t count) {
  if (!part) {
    skin.triangles.resize(skin.triangles.size() + count);
    return;
  }
  // two parts of one file have the same textures
  std::vector<int> number;
  for (const Texture& texture : part->textures) {
    const auto equal = [&](const Texture& other) {
      return other.image == texture.image && same_texture(other, texture);
    };
    const auto found = std::ranges::find_if(skin.textures, equal);
    number.push_back(static_cast<int>(found - skin.textures.begin()));
    if (found == skin.textures.end()) skin.textures.push_back(texture);
  }
  for (TexturedTriangle triangle : part->triangles) {
    if (triangle.texture >= 0) triangle.texture = number[static_cast<size_t>(triangle.texture)];
    skin.triangles.push_back(triangle);
  }
}

// where a side is odd, one row or column of pixels is the mean of three
static Image half_of(const Image& image) {
  Image out{std::max(1, image.width / 2), std::max(1, image.height / 2)};
  out.pixels.resize(size_t{3} * out.width * out.height);
  const auto first = [](int i, int from, int to) {
    return static_cast<int>(int64_t{i} * from / to);
  };
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int top = first(y, image.height, out.height), left = first(x, image.width, out.width),
                bottom = first(y + 1, image.height, out.height),
                right = first(x + 1, image.width, out.width);
      const int count = (bottom - top) * (right - left);
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int row = top; row < bottom; ++row)
          for (int column = left; column < right; ++column)
            sum += image.pixels[size_t{3} * (size_t(row) * image.width + column) + c];
        out.pixels[size_t{3} * (size_t(y) * out.width + x) + c] =
            static_cast<uint8_t>((sum + count / 2) / count);
      }
    }
  return out;
}

std::shared_ptr<const Image> image_within(std::shared_ptr<const Image> image, int largest) {
  while (std::max(image->width, image->height) > std::max(1, largest))
    image = std::make_shared<const Image>(half_of(*image));
  return image;
}

}  // namespace clench
