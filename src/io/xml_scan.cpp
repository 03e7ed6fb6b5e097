#include "io/xml_scan.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/text.h"

namespace clench {

int line_at(std::string_view text, size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + at, '\n'));
}

size_t skip_other(std::string_view text, size_t at) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}};
  for (const auto& [begin, end] : others) {
    if (!text.substr(at).starts_with(begin)) continue;
    const size_t found = text.find(end, at + begin.size());
    return found == std::string_view::npos ? text.size() : found + end.size();
  }
  return 0;
}

Tag scan_tag(std::string_view text, size_t at) {
  Tag tag;
  char quote = 0;
  for (tag.end = at + 1; tag.end < text.size(); ++tag.end) {
    const char c = text[tag.end];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '=') {
      ++tag.attributes;
    } else if (c == '>') {
      break;
    }
  }
  tag.closed = tag.end < text.size() && text[tag.end - 1] == '/';
  return tag;
}

namespace {

constexpr std::string_view blanks = " \t\r\n";

class FaultFinder {
 public:
  explicit FaultFinder(std::string_view text) : text_(text) {}
  std::optional<XmlFault> find();

 private:
  struct Open {
    std::string_view name;
    int line;
  };

  bool step();
  bool opening();
  bool closing();
  bool attribute(const Open& tag, std::vector<std::string_view>& names);
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
  std::string_view word(std::string_view stops);
  int line();
  /// what stands at at_, for a sentence
  std::string got();
  template <class... Args>
  bool fault(fmt::format_string<Args...> format, Args&&... args) {
    fault_ = {line(), fmt::format(format, std::forward<Args>(args)...)};
    return false;
  }

  std::string_view text_;
  size_t at_ = 0, counted_ = 0;
  int line_ = 1;  // of counted_
  std::vector<Open> open_;
  std::optional<XmlFault> fault_;
};

int FaultFinder::line() {
  // what is left blank behind a text is no line of it
  const size_t end = std::min(at_, text_.find_last_not_of(blanks) + 1);
  if (end > counted_) {
    line_ += static_cast<int>(std::count(text_.begin() + counted_, text_.begin() + end, '\n'));
    counted_ = end;
  }
  return line_;
}

std::string_view FaultFinder::word(std::string_view stops) {
  const size_t end = std::min(text_.find_first_of(stops, at_), text_.size());
  const auto found = text_.substr(at_, end - at_);
  at_ = end;
  return found;
}

std::string FaultFinder::got() {
  if (at_ >= text_.size()) return "the end of the file";
  const size_t end = std::min(text_.find_first_of(" \t\r\n>", at_ + 1), text_.size());
  return in_quotes(text_.substr(at_, end - at_));
}

bool FaultFinder::closing() {
  at_ += 2;
  const auto name = word(" \t\r\n>/<");
  skip_blanks();
  if (at_ >= text_.size() || text_[at_] != '>')
    return fault("expected '>' after </{}, got {}", excerpt(name), got());
  if (open_.empty()) return fault("</{}> closes nothing", excerpt(name));
  if (open_.back().name != name)
    return fault("expected </{}>, which closes the <{}> of line {}, got </{}>",
                 excerpt(open_.back().name), excerpt(open_.back().name), open_.back().line,
                 excerpt(name));
  open_.pop_back();
  ++at_;
  return true;
}

bool FaultFinder::attribute(const Open& tag, std::vector<std::string_view>& names) {
  const auto element = excerpt(tag.name);
  const auto name = word(" \t\r\n=>/<\"'");
  if (name.empty()) return fault("<{}>: expected an attribute or '>', got {}", element, got());
  const auto shown = excerpt(name);
  skip_blanks();
  if (at_ >= text_.size() || text_[at_] != '=')
    return fault("<{}>: expected '=' and a value after the attribute '{}', got {}", element, shown,
                 got());
  ++at_;
  skip_blanks();
  const char quote = at_ < text_.size() ? text_[at_] : 0;
  if (quote != '"' && quote != '\'')
    return fault("<{}>: attribute '{}': expected a value in quotes, got {}", element, shown, got());
  const size_t end = text_.find(quote, at_ + 1);
  if (end == std::string_view::npos)
    return fault("<{}>: attribute '{}': its value does not end", element, shown);
  if (std::ranges::count(names, name))
    return fault("<{}>: the attribute '{}' stands there twice", element, shown);
  names.push_back(name);
  at_ = end + 1;
  return true;
}

bool FaultFinder::opening() {
  const int begin = line();
  ++at_;
  const Open tag{word(" \t\r\n/><\"'="), begin};
  if (tag.name.empty()) return fault("expected the name of an element after '<', got {}", got());
  for (std::vector<std::string_view> names;;) {
    skip_blanks();
    if (at_ >= text_.size())
      return fault(
          "expected the end of the tag <{} that begins in line {}, got the end of the file",
          excerpt(tag.name), tag.line);
    if (text_[at_] == '>') break;
    if (text_.substr(at_).starts_with("/>")) {
      at_ += 2;
      return true;
    }
    if (!attribute(tag, names)) return false;
  }
  open_.push_back(tag);
  ++at_;
  return true;
}

bool FaultFinder::step() {
  if (const size_t next = skip_other(text_, at_)) {
    const auto other = text_.substr(at_, next - at_);
    at_ = next;
    // one that does not end is the parser's to tell
    return other.starts_with("<!--")        ? other.ends_with("-->")
           : other.starts_with("<![CDATA[") ? other.ends_with("]]>")
                                            : other.ends_with('>');
  }
  return text_.substr(at_).starts_with("</") ? closing() : opening();
}

std::optional<XmlFault> FaultFinder::find() {
  while (at_ < text_.size()) {
    at_ = std::min(text_.find('<', at_), text_.size());
    if (at_ < text_.size() && !step()) return fault_;
  }
  if (open_.empty()) return {};
  fault("expected </{}>, which closes the <{}> of line {}, got the end of the file",
        excerpt(open_.back().name), excerpt(open_.back().name), open_.back().line);
  return fault_;
}

}  // namespace

std::optional<XmlFault> find_xml_fault(std::string_view text) { return FaultFinder(text).find(); }

}  // namespace clench
