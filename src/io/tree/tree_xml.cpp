#include "clench/io/tree/tree_xml.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

// limit of lengths and angles; squares and products of larger ones would overflow
static constexpr double largest_attribute = 1e15;

XmlValues::XmlValues(XmlElement own, const std::vector<XmlElement>& behind) : layers_{own} {
  layers_.insert(layers_.end(), behind.begin(), behind.end());
}

const XmlElement& XmlValues::giver(const char* name) const {
  for (const XmlElement& layer : layers_)
    if (layer && layer.attribute(name)) return layer;
  return layers_.front();
}

XmlValues XmlValues::nearest(std::span<const char* const> names) const {
  for (const XmlElement& layer : layers_)
    for (const char* name : names)
      if (layer && layer.attribute(name)) return XmlValues(layer);
  return XmlValues(element());
}

std::optional<std::string> XmlValues::find(const char* name) const {
  return giver(name).attribute(name);
}

Place XmlValues::subject(const char* name) const {
  const XmlElement& at = giver(name);
  return at.place().of(excerpt(at.name())).of(name);
}

void XmlValues::refuse(const char* name, const std::string& what) const {
  throw PlacedError(subject(name), what);
}

std::string XmlValues::text(const char* name) const {
  const auto value = find(name);
  if (!value)
    element().fail("{}: expected an attribute '{}', got none", excerpt(element().name()), name);
  if (value->empty()) fail(name, "expected a word, got nothing");
  return *value;
}

std::string XmlValues::text(const char* name, const std::string& fallback) const {
  return find(name).value_or(fallback);
}

double XmlValues::number(const char* name) const {
  if (!has(name))
    element().fail("{}: expected an attribute '{}', got none", excerpt(element().name()), name);
  return numbers(name, 1, 1).front();
}

double XmlValues::number(const char* name, double fallback) const {
  return has(name) ? number(name) : fallback;
}

double XmlValues::not_negative(const char* name, double fallback, Repairs& repairs) const {
  return has(name) ? repairs.magnitude(number(name), subject(name)) : fallback;
}

std::array<double, 2> XmlValues::range(const char* name, Repairs& repairs) const {
  const auto x = numbers(name, 2, 2);
  double low = x[0], high = x[1];
  repairs.order(low, high, subject(name));
  return {low, high};
}

std::vector<double> XmlValues::color(const char* name, int least, Repairs& repairs) const {
  auto shares = numbers(name, least, 4);
  for (double& share : shares) share = repairs.within(share, 0, 1, subject(name));
  return shares;
}

int XmlValues::integer(const char* name, int fallback) const {
  const auto text = find(name);
  if (!text) return fallback;
  constexpr int least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
  if (const auto fault = integer_fault(*text, least, most); !fault.empty()) fail(name, "{}", fault);
  return *parse_integer(*text);
}

bool XmlValues::boolean(const char* name, bool fallback) const {
  return word(name, {"true", "false"}, fallback ? "true" : "false") == "true";
}

std::vector<double> XmlValues::numbers(const char* name, int least, int most) const {
  const std::string text = find(name).value_or("");
  std::vector<double> out;
  for (const auto word : split_words(text)) {
    const auto value = parse_number(word);
    if (!value) fail(name, "expected a number, got {}", in_quotes(word));
    if (std::abs(*value) > largest_attribute)
      fail(name, "expected a number of at most {:g}, got {}", largest_attribute, in_quotes(word));
    out.push_back(*value);
  }
  const int count = static_cast<int>(out.size());
  if (count >= least && count <= most) return out;
  const std::string expected =
      least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  fail(name, "expected {} number{}, got {}", expected, most == 1 ? "" : "s", count);
}

std::vector<double> XmlValues::leading_numbers(const char* name, int most) const {
  std::vector<double> out;
  for (const XmlElement& layer : layers_) {
    if (!layer || !layer.attribute(name)) continue;
    const auto given = XmlValues(layer).numbers(name, 1, most);
    for (size_t i = out.size(); i < given.size(); ++i) out.push_back(given[i]);
  }
  return out;
}

Eigen::Vector3d XmlValues::vec3(const char* name, const Eigen::Vector3d& fallback) const {
  if (!has(name)) return fallback;
  const auto v = numbers(name, 3, 3);
  return {v[0], v[1], v[2]};
}

std::string XmlValues::word(const char* name, std::initializer_list<const char*> words,
                            const char* fallback) const {
  const std::string got = find(name).value_or(fallback);
  const std::vector<std::string> known(words.begin(), words.end());
  if (std::find(known.begin(), known.end(), got) != known.end()) return got;
  std::string list;
  for (size_t i = 0; i < known.size(); ++i)
    list += (i == 0 ? "" : i + 1 == known.size() ? " or " : ", ") + known[i];
  fail(name, "expected {}, got {}{}", list, in_quotes(got), did_you_mean(got, known));
}

void XmlValues::tell_unused(UnusedXml& unused, std::initializer_list<std::string_view> used) const {
  for (const XmlElement& layer : layers_) unused.attributes(layer, used);
}

// --- unused contents ---

UnusedXml::Kind& UnusedXml::kind_of(std::vector<Kind>& kinds, const XmlElement& element) {
  // further names are counted together
  constexpr size_t max_named = 100;
  for (Kind& kind : kinds)
    if (kind.name == element.name()) return kind;
  if (kinds.size() <= max_named) {
    const bool named = kinds.size() < max_named;
    kinds.push_back({named ? std::string(element.name()) : "", element.place(), 0, {}, {}});
  }
  return kinds.back();
}

void UnusedXml::element(const XmlElement& element) { ++kind_of(elements_, element).count; }

void UnusedXml::attributes(const XmlElement& element,
                           std::initializer_list<std::string_view> used) {
  for (const auto& name : element.attributes())
    if (std::find(used.begin(), used.end(), name) == used.end() &&
        !(is_accepted_ && is_accepted_(element, name)))
      ++kind_of(attributes_, element).attributes[name];
  if (std::string text = element ? element.loose_text() : ""; !text.empty())
    if (Kind& kind = kind_of(texts_, element); kind.text.empty()) kind.text = std::move(text);
}

std::vector<Diagnostic> UnusedXml::diagnostics() const {
  // long names in a hostile file are shortened
  const auto shown = [](const std::string& name) { return excerpt(name); };
  const auto element = [&](const Kind& kind) {
    return kind.name.empty() ? "elements of other names" : '<' + shown(kind.name) + '>';
  };
  std::vector<Diagnostic> out;
  for (const Kind& kind : elements_) {
    if (kind.name.empty())
      out.emplace_back(
          kind.place,
          fmt::format("from here on, {} elements of other names are not used", kind.count));
    else
      out.emplace_back(kind.place,
                       fmt::format("{} is not used{}", element(kind),
                                   kind.count > 2 ? fmt::format(", nor are {} more", kind.count - 1)
                                   : kind.count == 2 ? ", nor is another one"
                                                     : ""));
  }
  for (const Kind& kind : attributes_) {
    std::vector<std::string> names;
    for (const auto& entry : kind.attributes) names.push_back(shown(entry.first));
    out.emplace_back(kind.place,
                     fmt::format("attributes of {} that are not used, here and further on: {}",
                                 element(kind), name_list(names)));
  }
  for (const Kind& kind : texts_)
    out.emplace_back(
        kind.place, fmt::format("text in {} is not used: {}", element(kind), in_quotes(kind.text)));
  return out;
}

}  // namespace clench
