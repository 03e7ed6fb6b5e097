#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/inventor/inventor_parser.h"

namespace clench {

static constexpr size_t max_inventor_values = 10'000'000;

void InventorParser::field(InventorNode& node, const InventorField& field) {
  const InventorType& type = *node.type;
  if (type.kind == InventorKind::include && field.content == InventorField::text)
    node.line = tokens_.peek().line;
  const bool connected_only = tokens_.peek().is("=");
  InventorValue value = connected_only ? field.absent : this->value(type, field);
  skip_connection(type, field);
  if (field.content == InventorField::unused) return;
  if (field.content == InventorField::node && field.many) {
    for (const auto* child : std::get<std::vector<const InventorNode*>>(value))
      node.children.push_back(child);
    return;
  }
  for (auto& [given, old] : node.values)
    if (given == &field) {
      old = std::move(value);
      return;
    }
  node.values.emplace_back(&field, std::move(value));
}

/// Skips connections to engines or other fields: the value in the file is used.
void InventorParser::skip_connection(const InventorType& type, const InventorField& field) {
  if (tokens_.peek().is("~")) tokens_.next();
  const InventorToken sign = tokens_.peek();
  if (!sign.is("=")) return;
  tokens_.next();
  skip_node(word("a node after '='"));
  const InventorToken behind = tokens_.peek();
  if (behind.kind == InventorToken::word && behind.text.starts_with('.') &&
      tokens_.next().text == ".")
    word("a field after '.'");
  if (field.content != InventorField::unused)
    warn(sign.line, fmt::format("{}: {} is connected, which is not used", type.name, field.name));
}

void InventorParser::skip_node(const InventorToken& first) {
  if (first.is("USE")) {
    word("a name after USE");
    return;
  }
  InventorToken type = first;
  if (first.is("DEF")) {
    define(word("a name after DEF"), {});
    type = word("a node type after DEF and a name");
  }
  const InventorToken bracket = tokens_.peek();
  if (!bracket.opens('{'))
    tokens_.refuse(first.line, "expected '{{' after the node type, got {}", bracket.told());
  check_nested(type, bracket);
  skip_brackets();
}

// --- fields that a type does not have ---

static bool begins_number(const InventorToken& token) {
  return token.kind == InventorToken::word &&
         std::string_view("0123456789+-.").find(token.text[0]) != std::string_view::npos;
}

static bool begins_name(const InventorToken& token) {
  const char c = token.text.empty() ? ' ' : token.text[0];
  return token.kind == InventorToken::word &&
         ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_');
}

bool InventorParser::skip_unknown_value() {
  const InventorToken first = tokens_.peek();
  if (first.is("=") || first.is("~")) return true;
  if (first.kind == InventorToken::open) {
    skip_brackets();
    return true;
  }
  if (first.kind != InventorToken::word && first.kind != InventorToken::string) return false;
  if (begins_number(first)) {
    while (begins_number(tokens_.peek())) tokens_.next();
    return true;
  }
  tokens_.next();
  if (first.kind == InventorToken::string) return true;
  if (first.text.starts_with('(')) {
    // (SIDES | TOP)
    for (InventorToken last = first; !last.text.ends_with(')');) last = word("a word or ')'");
  } else if (first.is("IS")) {
    word("a name after IS");
  } else if (starts_node(first, tokens_.peek())) {
    skip_node(first);
  }
  return true;
}

void InventorParser::skip_unknown_field(const InventorType& type, const InventorToken& name) {
  std::vector<std::string> known;
  for (const auto& f : type.fields) known.emplace_back(f.name);
  const std::string sentence = fmt::format("{}: unknown field {}", type.name, in_quotes(name.text)),
                    meant = did_you_mean(name.text.substr(0, 40), known);
  if (!begins_name(name) || !skip_unknown_value())
    tokens_.refuse(name.line, "{}{}", sentence, meant);
  skip_connection(type, {});
  count_value();  // so that their number is limited, too
  warn(name.line, fmt::format("{} is skipped{}", sentence, meant));
}

InventorValue InventorParser::value(const InventorType& type, const InventorField& field) {
  if (tokens_.peek().is("IS")) return proto_value(type, field);
  InventorValue out = field.absent;
  switch (field.content) {
    case InventorField::unused: {
      const InventorToken first = tokens_.peek();
      if (starts_node(first, tokens_.peek_second()))
        node(tokens_.next());
      else
        skip_value([&](const InventorToken& token) {
          return field_of(type, token) || starts_node(token, tokens_.peek_second());
        });
      break;
    }
    case InventorField::number:
      numbers(type, field, std::get<0>(out));
      break;
    case InventorField::integer:
    case InventorField::color:
    case InventorField::flag:
      integers(type, field, std::get<1>(out));
      break;
    case InventorField::word:
    case InventorField::text:
      words(type, field, std::get<2>(out));
      break;
    case InventorField::node:
      nodes(field, std::get<3>(out));
      break;
  }
  return out;
}

template <class Take>
void InventorParser::list(const InventorField& field, Take take) {
  if (!field.many || !tokens_.peek().opens('[')) return take(tokens_.next());
  open(tokens_.next(), "");
  for (;;) {
    const InventorToken token = tokens_.next();
    if (token.kind == InventorToken::end) refuse_end();
    if (token.kind == InventorToken::close) return close(token);
    take(token);
  }
}

float InventorParser::number(const InventorType& type, const InventorField& field,
                             const InventorToken& token) const {
  std::string_view text = token.text;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (token.kind != InventorToken::word || code == std::errc::invalid_argument ||
      end != text.data() + text.size())
    tokens_.refuse(token.line, "{}: {}: expected a number, got {}", type.name, field.name,
                   token.told());
  // too small to be distinguished from zero, or too large
  if (code == std::errc::result_out_of_range)
    value = std::strtod(std::string(text).c_str(), nullptr);
  if (!std::isfinite(static_cast<float>(value)))
    tokens_.refuse(token.line, "{}: {}: expected a finite number that fits 32 bits, got {}",
                   type.name, field.name, token.told());
  return static_cast<float>(value);
}

void InventorParser::numbers(const InventorType& type, const InventorField& field,
                             std::vector<float>& out) {
  out.clear();
  list(field, [&](const InventorToken& first) {
    for (int i = 0; i < field.width; ++i) {
      if (i % 4 == 0) count_value();
      out.push_back(number(type, field, i == 0 ? first : tokens_.next()));
    }
  });
}

void InventorParser::integers(const InventorType& type, const InventorField& field,
                              std::vector<int32_t>& out) {
  const bool flag = field.content == InventorField::flag;
  const int64_t low = flag ? 0 : std::numeric_limits<int32_t>::min(),
                high = flag ? 1
                       : field.content == InventorField::color
                           ? 0xFFFFFFFF
                           : std::numeric_limits<int32_t>::max();
  out.clear();
  list(field, [&](const InventorToken& token) {
    count_value();
    std::string_view text = token.text;
    if (flag && token.is("TRUE")) text = "1";
    if (flag && token.is("FALSE")) text = "0";
    if (text.starts_with('+')) text.remove_prefix(1);
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    if (hex) text.remove_prefix(2);
    int64_t value = 0;
    const auto [end, code] =
        std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
    if (token.kind != InventorToken::word || code != std::errc() ||
        end != text.data() + text.size() || value < low || value > high)
      tokens_.refuse(
          token.line, "{}: {}: expected {}, got {}", type.name, field.name,
          flag ? "TRUE or FALSE" : fmt::format("a whole number from {} to {}", low, high),
          token.told());
    out.push_back(static_cast<int32_t>(value));
  });
}

void InventorParser::words(const InventorType& type, const InventorField& field,
                           std::vector<std::string>& out) {
  const bool names = field.content == InventorField::word;
  out.clear();
  const auto take = [&](const InventorToken& token, std::string_view text) {
    if (token.kind != InventorToken::word && (names || token.kind != InventorToken::string))
      tokens_.refuse(token.line, "{}: {}: expected a {}, got {}", type.name, field.name,
                     names ? "word" : "string", token.told());
    if (names && std::ranges::count(field.choices, text) == 0)
      tokens_.refuse(token.line, "{}: {}: expected one of {}, got {}", type.name, field.name,
                     fmt::join(field.choices, ", "), in_quotes(text));
    count_value();
    // each choice once, even if it is repeated in the file
    if (!names || std::ranges::count(out, text) == 0) out.emplace_back(text);
  };
  const InventorToken first = tokens_.peek();
  if (!names || !field.many || first.kind != InventorToken::word || !first.text.starts_with('(')) {
    list(field, [&](const InventorToken& token) { take(token, token.text); });
    return;
  }
  // (SIDES | TOP)
  for (bool done = false; !done;) {
    const InventorToken token = word("a word or ')'");
    for (const auto part : split_words(token.text, "(|)")) take(token, part);
    done = token.text.ends_with(')');
  }
}

void InventorParser::nodes(const InventorField& field, std::vector<const InventorNode*>& out) {
  list(field, [&](const InventorToken& token) {
    if (token.is("NULL")) return;
    if (token.kind != InventorToken::word)
      tokens_.refuse(token.line, "{}: expected a node, got {}", field.name, token.told());
    statement(token, out);
  });
}

void InventorParser::count_value() {
  if (++budget_.values > max_inventor_values)
    tokens_.refuse(tokens_.rest().line, "expected at most {} values of fields",
                   max_inventor_values);
}

}  // namespace clench
