#include "clench/io/text/xml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "clench/base/convert.h"
#include "clench/base/suggest.h"
#include "clench/base/watched.h"

namespace clench {

namespace {

// --- checks of the text before it is parsed, and partial parsing ---

constexpr int deepest_nesting = 64;   // the parser is recursive
constexpr int max_attributes = 1000;  // the parser compares all pairs

/// from 1
int line_at(std::string_view text, size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + at, '\n'));
}

/// End of the comment, CDATA section or declaration that begins at `at`; 0 if none does.
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

struct Tag {
  size_t end = 0;  // of its '>', or of the text
  int attributes = 0;
  bool closed = false;
};

/// The tag that begins at `at`.
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

/// Finds each '&' that does not begin an entity: after an entity, the parser would corrupt it.
/// throws Error for entities that the file declares, because the parser would leave "&name;" as
/// text
void check_entities(const std::string& file, std::string_view text, size_t from, size_t end,
                    std::vector<size_t>& alone) {
  constexpr std::string_view read[] = {"amp", "lt", "gt", "quot", "apos"};
  const auto is_letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
  };
  text = text.substr(0, end);
  for (size_t at = from; (at = text.find('&', at)) != text.npos; ++at) {
    const auto rest = text.substr(at + 1);
    if (rest.starts_with('#')) continue;
    const auto name = rest.substr(0, std::ranges::find_if_not(rest, is_letter) - rest.begin());
    if (name.empty() || !rest.substr(name.size()).starts_with(';'))
      alone.push_back(at);
    else if (!std::ranges::count(read, name))
      fail("{}:{}: the entity '&{};' is not read; expected &amp; &lt; &gt; &quot; or &apos;", file,
           line_at(text, at), excerpt(name));
  }
}

/// Rejects texts for which the parser would recurse too deeply or take time quadratic in their
/// length.
/// returns  positions of each '&' that does not begin an entity
std::vector<size_t> check_limits(const std::string& file, std::string_view text, size_t max_bytes) {
  if (text.size() > max_bytes)
    fail("{}: expected at most {} MB of XML, got {}", file, max_bytes >> 20, text.size() >> 20);
  if (const size_t zero = text.find('\0'); zero != std::string_view::npos)
    fail("{}:{}: expected text, got a zero byte", file, line_at(text, zero));
  std::vector<size_t> alone;
  int depth = 0;
  size_t at = 0, behind = 0;  // end of the last tag
  StopCheck check(1 << 10);
  while ((at = text.find('<', at)) != std::string_view::npos) {
    check();
    if (const size_t next = skip_other(text, at)) {
      check_entities(file, text, behind, at, alone);
      at = behind = next;
      continue;
    }
    const Tag tag = scan_tag(text, at);
    check_entities(file, text, behind, tag.end, alone);
    behind = tag.end;
    if (tag.attributes > max_attributes)
      fail("{}:{}: expected at most {} attributes, got {}", file, line_at(text, at), max_attributes,
           tag.attributes);
    if (text.substr(at).starts_with("</"))
      --depth;
    else if (!tag.closed)
      ++depth;
    // the parser would end here
    if (depth < 0)
      fail("{}:{}: {} closes nothing", file, line_at(text, at),
           in_quotes(text.substr(at, tag.end + 1 - at)));
    if (depth > deepest_nesting)
      fail("{}:{}: expected at most {} elements in each other", file, line_at(text, at),
           deepest_nesting);
    at = tag.end;
  }
  return alone;
}

/// The element named in the parser's message, "<mass>"; "a tag" if the message has no name.
std::string broken_element(const tinyxml2::XMLDocument& document) {
  constexpr std::string_view before = "XMLElement name=";
  const std::string_view told = document.ErrorStr();
  const size_t at = told.find(before);
  return at == told.npos ? "a tag" : fmt::format("<{}>", excerpt(told.substr(at + before.size())));
}

std::string broken_part(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return broken_element(document) + " without its closing tag";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return broken_element(document) + " that does not end, or has no name";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return broken_element(document) +
             " with an attribute that is repeated or has no value in quotes";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text outside all elements, or in one that does not end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "CDATA that does not end";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment that does not end";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "a declaration that does not end or comes too late";
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a '<!' that does not end";
    default:
      return "an element that does not end, or a '<' that begins no element";
  }
}

[[noreturn]] void fail_parse(const std::string& file, const tinyxml2::XMLDocument& document) {
  const int line = std::max(document.ErrorLineNum(), 1);
  if (document.ErrorID() == tinyxml2::XML_ERROR_EMPTY_DOCUMENT)
    fail("{}:{}: expected an XML element, got nothing", file, line);
  fail("{}:{}: expected well-formed XML, got {}", file, line, broken_part(document));
}

bool contains(const std::vector<std::string>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Text directly inside an element.
std::string own_text(const tinyxml2::XMLElement& element) {
  std::string out;
  for (const tinyxml2::XMLNode* n = element.FirstChild(); n; n = n->NextSibling())
    if (const tinyxml2::XMLText* text = n->ToText()) (out += text->Value()) += ' ';
  return std::string(trim(out));
}

}  // namespace

// --- elements ---

std::string_view XmlElement::name() const { return element_->Name(); }
int XmlElement::line() const {
  const auto* original = static_cast<const tinyxml2::XMLElement*>(element_->GetUserData());
  return (original ? original : element_)->GetLineNum();
}
Place XmlElement::place() const { return Place(*file_, line()); }

XmlElement XmlElement::child(std::string_view name) const {
  for (auto* e = element_->FirstChildElement(); e; e = e->NextSiblingElement())
    if (e->Name() == name) return {e, file_};
  return {};
}

XmlElement XmlElement::expected(std::string_view name) const {
  if (const XmlElement found = child(name)) return found;
  fail("{}: expected an element <{}>, got none", excerpt(this->name()), excerpt(name));
}

std::vector<XmlElement> XmlElement::children(std::string_view name) const {
  std::vector<XmlElement> out;
  for (auto* e = element_->FirstChildElement(); e; e = e->NextSiblingElement())
    if (name.empty() || e->Name() == name) out.push_back({e, file_});
  return out;
}

std::string XmlElement::loose_text() const { return own_text(*element_); }

std::string XmlElement::text() const {
  if (auto* inner = element_->FirstChildElement())
    fail("{}: expected text, got an element <{}>", excerpt(name()), excerpt(inner->Name()));
  return own_text(*element_);
}

double XmlElement::number() const {
  const std::string word = text();
  const auto value = parse_number(word);
  if (!value) fail("{}: expected a number, got {}", excerpt(name()), in_quotes(word));
  return *value;
}

static int whole(const XmlElement& element, std::string_view what, const std::string& word, int low,
                 int high) {
  const auto value = parse_number(word);
  if (!value || *value != std::floor(*value))
    element.fail("{}: expected a whole number, got {}", what, in_quotes(word));
  if (!(*value >= low && *value <= high)) {
    if (high == std::numeric_limits<int>::max())
      element.fail("{}: expected a whole number >= {}, got {}", what, low, in_quotes(word));
    element.fail("{}: expected a whole number from {} to {}, got {}", what, low, high,
                 in_quotes(word));
  }
  return floor_int(*value);
}

int XmlElement::integer(int low, int high) const {
  return whole(*this, excerpt(name()), text(), low, high);
}

std::vector<double> XmlElement::numbers() const {
  std::vector<double> out;
  const std::string all = text();
  StopCheck check(1 << 12);
  for (const auto word : split_words(all, ",")) {
    check();
    const auto value = parse_number(word);
    if (!value) fail("{}: expected a number, got {}", excerpt(name()), in_quotes(word));
    out.push_back(*value);
  }
  return out;
}

std::vector<double> XmlElement::numbers(int count) const {
  auto out = numbers();
  if (static_cast<int>(out.size()) != count)
    fail("{}: expected {} numbers, got {}", excerpt(name()), count, out.size());
  return out;
}

Eigen::Vector3d XmlElement::vector() const {
  const auto x = numbers(3);
  return {x[0], x[1], x[2]};
}

std::optional<std::string> XmlElement::attribute(std::string_view name) const {
  for (auto* a = element_->FirstAttribute(); a; a = a->Next())
    if (a->Name() == name) return std::string(trim(a->Value()));
  return {};
}

std::string XmlElement::expected_attribute(std::string_view name) const {
  if (auto value = attribute(name)) return *value;
  fail("{}: expected an attribute '{}', got none", excerpt(this->name()), excerpt(name));
}

std::vector<std::string> XmlElement::attributes() const {
  std::vector<std::string> names;
  for (auto* a = element_->FirstAttribute(); a; a = a->Next()) names.emplace_back(a->Name());
  return names;
}

double XmlElement::number_attribute(std::string_view name) const {
  const std::string word = expected_attribute(name);
  const auto value = parse_number(word);
  if (!value)
    fail("{}: {}: expected a number, got {}", excerpt(this->name()), name, in_quotes(word));
  return *value;
}

int XmlElement::integer_attribute(std::string_view name, int low, int high) const {
  return whole(*this, fmt::format("{}: {}", excerpt(this->name()), name), expected_attribute(name),
               low, high);
}

void XmlElement::check(const XmlKnown& known, const Diagnostics& diagnostics) const {
  if (!diagnostics) return;
  std::vector<std::string> names = known.once, seen;
  names.insert(names.end(), known.many.begin(), known.many.end());
  for (const XmlElement& e : children()) {
    const std::string child(e.name());
    if (!contains(names, child))
      diagnostics.warn(e.place(), "unknown element <{}> in <{}> is not used{}", excerpt(child),
                       excerpt(name()), did_you_mean(child, names));
    else if (contains(seen, child))
      diagnostics.warn(e.place(), "<{}> stands in <{}> again; the first one counts", excerpt(child),
                       excerpt(name()));
    if (contains(known.once, child)) seen.push_back(child);
  }
  for (const std::string& attribute : attributes())
    if (!contains(known.attributes, attribute))
      diagnostics.warn(place(), "unknown attribute '{}' of <{}> is not used{}", excerpt(attribute),
                       excerpt(name()), did_you_mean(attribute, known.attributes));
  if (const std::string own = own_text(*element_); !own.empty() && !names.empty())
    diagnostics.warn(place(), "text {} in <{}> is not used", in_quotes(own), excerpt(name()));
}

// --- copies ---

XmlCopies::XmlCopies() : document_(std::make_unique<tinyxml2::XMLDocument>()) {}
XmlCopies::~XmlCopies() = default;

XmlElement XmlCopies::make(const XmlElement& original, std::string_view name,
                           const Attributes& attributes) {
  tinyxml2::XMLElement* element = document_->NewElement(std::string(name).c_str());
  document_->InsertEndChild(element);
  for (const auto& [key, value] : attributes) element->SetAttribute(key.c_str(), value.c_str());
  const void* first = original.element_->GetUserData();
  element->SetUserData(const_cast<void*>(first ? first : original.element_));
  return {element, original.file_};
}

// --- files ---

XmlFile::XmlFile(const std::filesystem::path& path)
    : XmlFile(path.filename().string(), read_text(path)) {}

XmlFile::XmlFile(std::string file, const std::string& text, size_t max_bytes)
    : file_(std::move(file)), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  std::string whole;
  size_t from = 0;
  for (const size_t at : check_limits(file_, text, max_bytes)) {
    whole.append(text, from, at - from) += "&amp;";
    from = at + 1;
  }
  whole.append(text, from);
  document_->Parse(whole.data(), whole.size());
  if (document_->Error()) fail_parse(file_, *document_);
  const auto* root = document_->RootElement();
  if (!root) fail("{}: expected an XML element, got none", file_);
  if (const auto* second = root->NextSiblingElement())
    fail("{}:{}: expected one outermost element, got a second, <{}>", file_, second->GetLineNum(),
         excerpt(second->Name()));
}

XmlFile::~XmlFile() = default;

XmlElement XmlFile::root() const { return {document_->RootElement(), &file_}; }

std::string_view xml_root_name(std::string_view text) {
  size_t at = 0;
  while ((at = text.find('<', at)) != std::string_view::npos) {
    if (const size_t next = skip_other(text, at)) {
      at = next;
      continue;
    }
    const size_t end = std::min(text.find_first_of(" \t\r\n/>", at + 1), text.size());
    return text.substr(at + 1, end - at - 1);
  }
  return {};
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace clench
