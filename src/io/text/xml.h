// Reads XML files: elements, their contents, and validated numbers. Every error gives the place
// "file:line", the expected and the actual contents.
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/base/diagnostic.h"
#include "clench/base/text.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace clench {

/// Contents of an element that a reader uses; others are reported as warnings.
struct XmlKnown {
  std::vector<std::string> once = {};  ///< children of which only the first is used
  std::vector<std::string> many = {};  ///< children of which all are used
  std::vector<std::string> attributes = {};
};

/// An element with its place; owned by the XmlFile that returned it. May be null.
class XmlElement {
 public:
  XmlElement() = default;
  XmlElement(const tinyxml2::XMLElement* element, const std::string* file)
      : element_(element), file_(file) {}

  /// Name of the file that contains it. Its address identifies the XmlFile.
  const std::string* file() const { return file_; }

  explicit operator bool() const { return element_; }
  std::string_view name() const;
  int line() const;     ///< from 1; for a copy, the line of its original
  Place place() const;  ///< Barrett.xml:31
  /// its text as a line with its place, for the readers of text formats
  Line as_line(std::string_view text) const { return Line(file_, line(), text); }

  /// The first child of that name, or a null element.
  XmlElement child(std::string_view name) const;
  /// throws Error  "Barrett.xml:3: robot: expected an element <palm>, got none"
  XmlElement expected(std::string_view name) const;
  /// All children in order, or those of one name.
  std::vector<XmlElement> children(std::string_view name = {}) const;

  /// The text between its tags, without comments and surrounding blanks.
  /// throws Error if it contains elements
  std::string text() const;
  /// throws Error  "Barrett.xml:31: Kp: expected a number, got 'x'", as do the following functions
  double number() const;
  int integer(int low = std::numeric_limits<int>::min(),
              int high = std::numeric_limits<int>::max()) const;  ///< accepts 1.0, too
  std::vector<double> numbers() const;
  std::vector<double> numbers(int count) const;
  Eigen::Vector3d vector() const;  ///< three numbers

  /// The text inside it that is outside of its child elements; empty if there is none.
  std::string loose_text() const;

  std::optional<std::string> attribute(std::string_view name) const;
  /// throws Error  "Barrett.xml:3: dof: expected an attribute 'type', got none"
  std::string expected_attribute(std::string_view name) const;
  std::vector<std::string> attributes() const;  ///< their names, in order
  double number_attribute(std::string_view name) const;
  int integer_attribute(std::string_view name, int low = std::numeric_limits<int>::min(),
                        int high = std::numeric_limits<int>::max()) const;

  /// Warns of unknown children, attributes and text, and of children that appear twice.
  void check(const XmlKnown& known, const Diagnostics& diagnostics) const;

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw PlacedError(place(), fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  friend class XmlCopies;
  const tinyxml2::XMLElement* element_ = nullptr;
  const std::string* file_ = nullptr;
};

/// Elements generated from others: they have separate attributes, no children, and the place of
/// their originals. Their lifetime is that of this object.
class XmlCopies {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  XmlCopies();
  ~XmlCopies();
  XmlCopies(const XmlCopies&) = delete;
  XmlCopies& operator=(const XmlCopies&) = delete;

  XmlElement make(const XmlElement& original, std::string_view name, const Attributes& attributes);

 private:
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

/// A complete file in memory.
class XmlFile {
 public:
  /// throws Error if it cannot be read, is not well-formed XML, or exceeds these limits:
  /// 16 MB, nesting depth 64, 1000 attributes of one element
  explicit XmlFile(const std::filesystem::path& path);
  /// `file` is the name shown in errors; `max_bytes`: limit instead of 16 MB
  XmlFile(std::string file, const std::string& text, size_t max_bytes = size_t{16} << 20);
  ~XmlFile();
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  const std::string& file() const { return file_; }
  XmlElement root() const;

 private:
  std::string file_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

/// Name of the root element of a text that may be XML; empty if there is none. Parses only up to
/// that element.
std::string_view xml_root_name(std::string_view text);

/// A text with & < > and quotes replaced by XML entities.
std::string xml_escaped(std::string_view text);

}  // namespace clench
