// XML tools of the readers of robot trees: attributes as typed values with defaults from other
// elements, and a record of unused contents.
#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clench/io/text/repairs.h"
#include "clench/io/text/xml.h"

namespace clench {

class UnusedXml;

/// The keys of a map, for suggestions in messages.
template <class Map>
std::vector<std::string> names_in(const Map& map) {
  std::vector<std::string> out;
  for (const auto& [name, entry] : map) out.push_back(name);
  return out;
}

/// Attributes of an element, with defaults from a list of other elements: the first element that
/// has an attribute gives its value. All functions throw Error with place, element, attribute,
/// expected and got.
class XmlValues {
 public:
  XmlValues() = default;
  XmlValues(XmlElement own, const std::vector<XmlElement>& behind = {});

  const XmlElement& element() const { return layers_.front(); }
  /// Only the first element that has one of the attributes; this one if none has.
  XmlValues nearest(std::span<const char* const> names) const;
  bool has(const char* name) const { return find(name).has_value(); }
  std::string text(const char* name) const;  ///< required, not empty
  std::string text(const char* name, const std::string& fallback) const;
  double number(const char* name) const;  ///< required
  double number(const char* name, double fallback) const;
  double not_negative(const char* name, double fallback, Repairs& repairs) const;
  /// lower and upper bound, exchanged if in the wrong order   throws as numbers
  std::array<double, 2> range(const char* name, Repairs& repairs) const;
  /// three or four color components in 0..1
  std::vector<double> color(const char* name, int least, Repairs& repairs) const;
  Place subject(const char* name) const;  ///< hand.xml:31: joint: range
  int integer(const char* name, int fallback) const;
  bool boolean(const char* name, bool fallback) const;
  /// between `least` and `most` numbers, each of at most 1e15
  std::vector<double> numbers(const char* name, int least, int most) const;
  /// Up to `most` numbers; if an element gives fewer, the others are taken from the next element.
  std::vector<double> leading_numbers(const char* name, int most) const;
  Eigen::Vector3d vec3(const char* name, const Eigen::Vector3d& fallback) const;
  /// one of the words
  std::string word(const char* name, std::initializer_list<const char*> words,
                   const char* fallback) const;
  /// Records the attributes of all these elements except those that are used.
  void tell_unused(UnusedXml& unused, std::initializer_list<std::string_view> used) const;
  /// throws Error  "hand.xml:31: joint: range: ..." at the element that gives the attribute
  template <class... Args>
  [[noreturn]] void fail(const char* name, fmt::format_string<Args...> format,
                         Args&&... args) const {
    refuse(name, fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  const XmlElement& giver(const char* name) const;
  std::optional<std::string> find(const char* name) const;
  [[noreturn]] void refuse(const char* name, const std::string& what) const;
  std::vector<XmlElement> layers_;
};

/// Contents of a file that are not used; reported once for each element name.
class UnusedXml {
 public:
  void element(const XmlElement& element);
  /// all attributes except these, and text inside the element
  void attributes(const XmlElement& element, std::initializer_list<std::string_view> used);
  /// Attributes for which `is_accepted` returns true are never reported.
  void accept(std::function<bool(const XmlElement&, const std::string& name)> is_accepted) {
    is_accepted_ = std::move(is_accepted);
  }
  /// hand.urdf:31: "<gazebo> is not used, nor are 11 more"
  std::vector<Diagnostic> diagnostics() const;

 private:
  struct Kind {
    std::string name;  // empty: collects all names after the first hundred
    Place place;       // of the first
    int count = 0;
    std::map<std::string, int> attributes;
    std::string text;
  };
  static Kind& kind_of(std::vector<Kind>& kinds, const XmlElement& element);
  std::vector<Kind> elements_, attributes_, texts_;
  std::function<bool(const XmlElement&, const std::string&)> is_accepted_;
};

}  // namespace clench
