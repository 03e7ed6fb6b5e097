// XML files taken apart: elements, what stands in them, and numbers that are numbers. Whatever is
// wrong is told with the place "file:line", what was expected and what was got.
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

/// What a reader understands of an element; the rest is warned of.
struct XmlKnown {
  std::vector<std::string> once = {};  ///< children of which the first counts
  std::vector<std::string> many = {};  ///< children of which all count
  std::vector<std::string> attributes = {};
};

/// An element and where it stands; it belongs to the XmlFile that gave it. May be none.
class XmlElement {
 public:
  XmlElement() = default;
  XmlElement(const tinyxml2::XMLElement* element, const std::string* file)
      : element_(element), file_(file) {}

  /// Name of the file that it stands in. Its address identifies the XmlFile.
  const std::string* file() const { return file_; }

  explicit operator bool() const { return element_; }
  std::string_view name() const;
  int line() const;     ///< from 1; of a copy, that of its original
  Place place() const;  ///< Barrett.xml:31
  /// its text as a line at its place, for the readers of text formats
  Line as_line(std::string_view text) const { return Line(file_, line(), text); }

  /// The first child of that name, or none.
  XmlElement child(std::string_view name) const;
  /// throws Error  "Barrett.xml:3: robot: expected an element <palm>, got none"
  XmlElement expected(std::string_view name) const;
  /// All children in their order, or those of one name.
  std::vector<XmlElement> children(std::string_view name = {}) const;

  /// What stands between its tags, without comments and blanks at the ends.
  /// throws Error when elements stand in it
  std::string text() const;
  /// throws Error  "Barrett.xml:31: Kp: expected a number, got 'x'", as the next ones do
  double number() const;
  int integer(int low = std::numeric_limits<int>::min(),
              int high = std::numeric_limits<int>::max()) const;  ///< 1.0 is one, too
  std::vector<double> numbers() const;
  std::vector<double> numbers(int count) const;
  Eigen::Vector3d vector() const;  ///< three numbers

  /// The text that stands in it beside its elements; empty when there is none.
  std::string loose_text() const;

  std::optional<std::string> attribute(std::string_view name) const;
  /// throws Error  "Barrett.xml:3: dof: expected an attribute 'type', got none"
  std::string expected_attribute(std::string_view name) const;
  std::vector<std::string> attributes() const;  ///< their names, in order
  double number_attribute(std::string_view name) const;
  int integer_attribute(std::string_view name, int low = std::numeric_limits<int>::min(),
                        int high = std::numeric_limits<int>::max()) const;

  /// Warns of children, attributes and text that are not known, and of children that stand twice.
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

/// Elements generated from others: they have attributes of their own, no children, and the place of
/// their originals. They live as long as this.
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

/// A whole file in memory.
class XmlFile {
 public:
  /// throws Error when it cannot be read, is no well-formed XML, or is beyond what any model needs:
  /// 16 MB, 64 elements in each other, 1000 attributes of one element
  explicit XmlFile(const std::filesystem::path& path);
  /// `file` is the name shown in errors; `max_bytes`: what to allow instead of 16 MB
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

/// Name of the outermost element of a text that may be XML; empty when there is none. Reads no
/// further.
std::string_view xml_root_name(std::string_view text);

/// A text as XML writes it: & < > and quotes by their names.
std::string xml_escaped(std::string_view text);

}  // namespace clench
