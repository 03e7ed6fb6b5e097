#include "clench/render/figure/gif.h"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "clench/base/error.h"
#include "clench/base/watched.h"

namespace clench {

namespace {

void check_done(bool done, const char* what) {
  if (!done) fail(ErrorKind::internal, "an animated GIF: {} failed", what);
}

int append_bytes(GifFileType* file, const GifByteType* bytes, int count) {
  static_cast<std::string*>(file->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<size_t>(count));
  return count;
}

using ColorMap = std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)>;
using Encoder = std::unique_ptr<GifFileType, void (*)(GifFileType*)>;

void close_gif(GifFileType* file) {
  int error = 0;
  EGifCloseFile(file, &error);
}

// colors are distinguished by five bits per channel
constexpr int bits = 5, shades = 1 << (3 * bits);
constexpr size_t max_colors = 256;

struct Shade {
  uint64_t count = 0;
  std::array<uint64_t, 3> sum = {};
};

int shade_of(const uint8_t* rgb) { return (rgb[0] >> 3) << 10 | (rgb[1] >> 3) << 5 | rgb[2] >> 3; }

int channel_of(int shade, int channel) { return shade >> (10 - 5 * channel) & 31; }

struct Palette {
  std::vector<std::array<uint8_t, 3>> colors;
  std::vector<uint8_t> index;  // indexed by shade
};

struct Part {
  std::vector<int> list;  // shades of this part
  uint64_t count = 0;
  int channel = 0, width = 0;  // the channel in which it is widest
};

Part part_of(std::vector<int> list, const std::vector<Shade>& all) {
  Part part{.list = std::move(list)};
  for (const int shade : part.list) part.count += all[shade].count;
  for (int c = 0; c < 3; ++c) {
    const auto [low, high] =
        std::ranges::minmax(part.list, {}, [c](int shade) { return channel_of(shade, c); });
    const int width = channel_of(high, c) - channel_of(low, c);
    if (width > part.width) part.channel = c, part.width = width;
  }
  return part;
}

// cuts a part into halves with about as many pixels each
std::array<Part, 2> cut(Part part, const std::vector<Shade>& all) {
  const int c = part.channel;
  std::ranges::sort(part.list, [c](int a, int b) {
    return std::pair(channel_of(a, c), a) < std::pair(channel_of(b, c), b);
  });
  uint64_t seen = 0;
  size_t at = 0;
  while (at + 1 < part.list.size() && (at == 0 || 2 * seen < part.count))
    seen += all[part.list[at++]].count;
  const auto middle = part.list.begin() + static_cast<std::ptrdiff_t>(at);
  return {part_of({part.list.begin(), middle}, all), part_of({middle, part.list.end()}, all)};
}

Palette find_palette(std::span<const Picture> frames) {
  std::vector<Shade> all(shades);
  for (const Picture& frame : frames) {
    check_stop();
    for (size_t i = 0; i < frame.pixels.size(); i += 3) {
      Shade& shade = all[shade_of(&frame.pixels[i])];
      ++shade.count;
      for (int c = 0; c < 3; ++c) shade.sum[c] += frame.pixels[i + c];
    }
  }
  std::vector<int> used;
  for (int shade = 0; shade < shades; ++shade)
    if (all[shade].count > 0) used.push_back(shade);
  std::vector<Part> parts = {part_of(std::move(used), all)};
  while (parts.size() < max_colors) {
    // the part with the largest product of pixel count and width
    const auto worst = std::ranges::max_element(
        parts, {}, [](const Part& p) { return p.count * static_cast<uint64_t>(p.width); });
    if (worst->width == 0) break;
    auto halves = cut(std::move(*worst), all);
    *worst = std::move(halves[0]);
    parts.push_back(std::move(halves[1]));
  }
  Palette out;
  out.index.resize(shades);
  for (size_t i = 0; i < parts.size(); ++i) {
    std::array<uint64_t, 3> sum = {};
    for (const int shade : parts[i].list) {
      out.index[shade] = static_cast<uint8_t>(i);
      for (int c = 0; c < 3; ++c) sum[c] += all[shade].sum[c];
    }
    auto& color = out.colors.emplace_back();
    for (int c = 0; c < 3; ++c)
      color[c] = static_cast<uint8_t>((sum[c] + parts[i].count / 2) / parts[i].count);
  }
  return out;
}

void check_frames(std::span<const Picture> frames, std::span<const int> delays) {
  if (frames.empty()) fail("an animated GIF: expected at least one picture, got none");
  const int width = frames[0].width, height = frames[0].height;
  if (width < 1 || height < 1 || width > 65535 || height > 65535)
    fail("an animated GIF: expected pictures of 1 to 65535 pixels per side, got {} x {}", width,
         height);
  for (size_t i = 0; i < frames.size(); ++i)
    if (frames[i].width != width || frames[i].height != height)
      fail("an animated GIF: picture {}: expected {} x {} pixels as in the first, got {} x {}",
           i + 1, width, height, frames[i].width, frames[i].height);
  if (delays.size() != frames.size())
    fail("an animated GIF: expected {} delays, got {}", frames.size(), delays.size());
}

void put_repeat_forever(GifFileType* file) {
  constexpr GifByteType endless[] = {1, 0, 0};
  check_done(EGifPutExtensionLeader(file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
                 EGifPutExtensionBlock(file, 11, "NETSCAPE2.0") == GIF_OK &&
                 EGifPutExtensionBlock(file, 3, endless) == GIF_OK &&
                 EGifPutExtensionTrailer(file) == GIF_OK,
             "writing");
}

}  // namespace

std::string gif_bytes(std::span<const Picture> frames, std::span<const int> delays) {
  check_frames(frames, delays);
  const int width = frames[0].width, height = frames[0].height;
  std::string out;
  int error = 0;
  Encoder file(EGifOpen(&out, append_bytes, &error), close_gif);
  check_done(file != nullptr, "opening");
  EGifSetGifVersion(file.get(), true);
  const Palette palette = find_palette(frames);
  const ColorMap map(GifMakeMapObject(max_colors, nullptr), GifFreeMapObject);
  check_done(map != nullptr, "a color map");
  for (size_t i = 0; i < palette.colors.size(); ++i)
    map->Colors[i] = {palette.colors[i][0], palette.colors[i][1], palette.colors[i][2]};
  check_done(EGifPutScreenDesc(file.get(), width, height, 8, 0, map.get()) == GIF_OK, "writing");
  put_repeat_forever(file.get());
  std::vector<GifByteType> row(static_cast<size_t>(width));
  for (size_t i = 0; i < frames.size(); ++i) {
    check_stop();
    const GraphicsControlBlock control{DISPOSE_DO_NOT, false, std::clamp(delays[i], 0, 65535),
                                       NO_TRANSPARENT_COLOR};
    GifByteType bytes[4];
    EGifGCBToExtension(&control, bytes);
    check_done(
        EGifPutExtension(file.get(), GRAPHICS_EXT_FUNC_CODE, sizeof bytes, bytes) == GIF_OK &&
            EGifPutImageDesc(file.get(), 0, 0, width, height, false, nullptr) == GIF_OK,
        "writing");
    const uint8_t* pixel = frames[i].pixels.data();
    for (int y = 0; y < height; ++y) {
      for (GifByteType& color : row) color = palette.index[shade_of(pixel)], pixel += 3;
      check_done(EGifPutLine(file.get(), row.data(), width) == GIF_OK, "writing");
    }
  }
  check_done(EGifCloseFile(file.release(), &error) == GIF_OK, "closing");
  return out;
}

}  // namespace clench
