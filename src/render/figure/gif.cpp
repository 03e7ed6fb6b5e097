#include "clench/render/figure/gif.h"

#include <algorithm>
#include <array>

#include "clench/base/error.h"

namespace clench {

namespace {

// colours are told apart by five bits a channel
constexpr int bits = 5, shades = 1 << (3 * bits);

struct Shade {
  uint64_t count = 0;
  std::array<uint64_t, 3> sum = {};
};

int shade_of(const uint8_t* rgb) { return (rgb[0] >> 3) << 10 | (rgb[1] >> 3) << 5 | rgb[2] >> 3; }

int channel_of(int shade, int channel) { return shade >> (10 - 5 * channel) & 31; }

struct Palette {
  std::vector<std::array<uint8_t, 3>> colors;
  std::vector<uint8_t> index;  // by shade
};

struct Part {
  std::vector<int> list;  // of shades
  uint64_t count = 0;
  int channel = 0, width = 0;  // where it is widest
};

Part part_of(std::vector<int> list, const std::vector<Shade>& all) {
  Part part{.list = std::move(list)};
  for (const int shade : part.list) part.count += all[shade].count;
  for (int c = 0; c < 3; ++c) {
    const auto [low, high] = std::ranges::minmax(part.list, {}, [c](int shade) { return channel_of(shade, c); });
    const int width = channel_of(high, c) - channel_of(low, c);
    if (width > part.width) part.channel = c, part.width = width;
  }
  return part;
}

// of two halves with about as many pixels each
std::array<Part, 2> cut(Part part, const std::vector<Shade>& all) {
  const int c = part.channel;
  std::ranges::sort(part.list, [c](int a, int b) { return std::pair(channel_of(a, c), a) < std::pair(channel_of(b, c), b); });
  uint64_t seen = 0;
  size_t at = 0;
  while (at + 1 < part.list.size() && (at == 0 || 2 * seen < part.count)) seen += all[part.list[at++]].count;
  const auto middle = part.list.begin() + static_cast<std::ptrdiff_t>(at);
  return {part_of({part.list.begin(), middle}, all), part_of({middle, part.list.end()}, all)};
}

Palette find_palette(std::span<const Picture> frames) {
  std::vector<Shade> all(shades);
  for (const Picture& frame : frames)
    for (size_t i = 0; i < frame.pixels.size(); i += 3) {
      Shade& shade = all[shade_of(&frame.pixels[i])];
      ++shade.count;
      for (int c = 0; c < 3; ++c) shade.sum[c] += frame.pixels[i + c];
    }
  std::vector<int> used;
  for (int shade = 0; shade < shades; ++shade)
    if (all[shade].count > 0) used.push_back(shade);
  std::vector<Part> parts = {part_of(std::move(used), all)};
  while (parts.size() < 256) {
    // the part whose pixels are farthest off
    const auto worst = std::ranges::max_element(parts, {}, [](const Part& p) { return p.count * static_cast<uint64_t>(p.width); });
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
    for (int c = 0; c < 3; ++c) color[c] = static_cast<uint8_t>((sum[c] + parts[i].count / 2) / parts[i].count);
  }
  return out;
}

void put_16(std::string& out, int x) { out += {static_cast<char>(x & 255), static_cast<char>(x >> 8 & 255)}; }

// Codes of growing length, packed from the lowest bit, in blocks of at most 255 bytes.
class CodeWriter {
 public:
  explicit CodeWriter(std::string& out) : out_(out) {}
  void put(int code, int length) {
    buffer_ |= static_cast<uint32_t>(code) << filled_;
    for (filled_ += length; filled_ >= 8; filled_ -= 8, buffer_ >>= 8) put_byte(static_cast<char>(buffer_ & 255));
  }
  void finish() {
    if (filled_ > 0) put_byte(static_cast<char>(buffer_ & 255));
    if (!block_.empty()) flush();
    out_ += '\0';
  }

 private:
  void put_byte(char byte) {
    block_ += byte;
    if (block_.size() == 255) flush();
  }
  void flush() {
    out_ += static_cast<char>(block_.size());
    out_ += block_;
    block_.clear();
  }
  std::string& out_;
  std::string block_;
  uint32_t buffer_ = 0;
  int filled_ = 0;
};

// LZW as GIF has it: the table begins anew when it is full
void put_pixels(std::string& out, const Picture& frame, const Palette& palette, std::vector<uint16_t>& next) {
  constexpr int clear = 256, end = 257, most = 4096;
  out += 8;
  CodeWriter writer(out);
  int length = 9, used = end + 1, code = -1;
  const auto begin = [&] {
    writer.put(clear, length);
    std::ranges::fill(next, uint16_t{0});
    length = 9, used = end + 1;
  };
  begin();
  for (size_t i = 0; i < frame.pixels.size(); i += 3) {
    const int color = palette.index[shade_of(&frame.pixels[i])];
    if (code < 0) {
      code = color;
      continue;
    }
    uint16_t& longer = next[static_cast<size_t>(code) * 256 + color];
    if (longer != 0) {
      code = longer;
      continue;
    }
    writer.put(code, length);
    code = color;
    if (used < most) {
      longer = static_cast<uint16_t>(used);
      if (used++ == 1 << length) ++length;
    } else {
      begin();
    }
  }
  if (code >= 0) writer.put(code, length);
  writer.put(end, length);
  writer.finish();
}

}  // namespace

std::string gif_bytes(std::span<const Picture> frames, std::span<const int> delays) {
  if (frames.empty()) fail("an animated GIF: expected at least one picture, got none");
  const int width = frames[0].width, height = frames[0].height;
  if (width < 1 || height < 1 || width > 65535 || height > 65535)
    fail("an animated GIF: expected pictures of 1 to 65535 pixels a side, got {} x {}", width, height);
  for (size_t i = 0; i < frames.size(); ++i)
    if (frames[i].width != width || frames[i].height != height)
      fail("an animated GIF: picture {}: expected {} x {} pixels as the first, got {} x {}", i + 1, width, height,
           frames[i].width, frames[i].height);
  if (delays.size() != frames.size()) fail("an animated GIF: expected {} delays, got {}", frames.size(), delays.size());
  const Palette palette = find_palette(frames);

  std::string out = "GIF89a";
  put_16(out, width);
  put_16(out, height);
  out += {static_cast<char>(0xF7), 0, 0};  // a table of 256 colours for all
  for (size_t i = 0; i < 256; ++i)
    for (int c = 0; c < 3; ++c) out += static_cast<char>(i < palette.colors.size() ? palette.colors[i][c] : 0);
  out += std::string("\x21\xFF\x0BNETSCAPE2.0\x03\x01\0\0\0", 19);  // again and again
  std::vector<uint16_t> next(size_t{4096} * 256);
  for (size_t i = 0; i < frames.size(); ++i) {
    out += std::string("\x21\xF9\x04\0", 4);
    put_16(out, std::clamp(delays[i], 0, 65535));
    out += std::string("\0\0\x2C\0\0\0\0", 7);
    put_16(out, width);
    put_16(out, height);
    out += '\0';
    put_pixels(out, frames[i], palette, next);
  }
  return out + '\x3B';
}

}  // namespace clench
