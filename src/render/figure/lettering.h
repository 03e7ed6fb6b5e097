// Text in an outline font: its width, and its coverage of each pixel.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>

namespace clench {

/// A text on a picture: it begins at `at`, on its baseline, and runs along a unit vector. Pixels, x
/// to the right and y down.
struct TextLine {
  std::string_view text;  ///< UTF-8
  Eigen::Vector2f at = Eigen::Vector2f::Zero();
  float height = 9;  ///< height of capital letters, up to 1000 [pixels]
  Eigen::Vector2f along = Eigen::Vector2f::UnitX();
};

/// A font, opened for the pictures of one thread. It is not hinted, so that a text has the same
/// shape at every position and its width is the sum of the widths of its parts. A missing character
/// is drawn as a box. Without the font file texts have no width and cover nothing.
class Font {
 public:
  /// the font that CLENCH_FONT named when Clench was configured
  Font();
  explicit Font(const std::string& path);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// reason why there are no letters, with the name of the file; empty if there are
  const std::string& fault() const { return fault_; }

  /// width of a text [pixels]; `height` of capital letters [pixels]
  float width(std::string_view text, float height) const;
  /// the text, or its beginning and end around an ellipsis, so that it is at most this wide
  /// [pixels]; empty if even the ellipsis is too wide
  std::string shortened(std::string_view text, float height, float width) const;
  /// characters that the font lacks
  std::set<char32_t> missing(std::string_view text) const;

  /// receives a pixel and the covered fraction, in 0..1
  using Cover = std::function<void(int x, int y, float part)>;
  /// visits the pixels of a picture of this size that the letters cover, one letter after the other
  void cover(const TextLine& line, const Eigen::Vector2i& size, const Cover& cover) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;  // null if there is no font
  std::string fault_;
};

}  // namespace clench
