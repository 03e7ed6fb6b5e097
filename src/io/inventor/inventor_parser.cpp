#include "clench/io/inventor/inventor_parser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

namespace {

constexpr size_t max_brackets = 250;  // nesting depth in one file; the parser is recursive
// nesting depth of nodes over all files; with sanitizers a level takes up to 9 kB of the stack
constexpr int max_inventor_depth = 500;
constexpr size_t max_inventor_nodes = 1'000'000;
constexpr size_t max_inventor_names = 1'000'000;
constexpr size_t max_proto_names = 100'000;
constexpr size_t max_proto_bytes = 20'000'000;
constexpr size_t max_suggested = 40;  // letters of a name, and number of names

}  // namespace

void InventorParser::open(const InventorToken& bracket, std::string_view type) {
  if (brackets_.size() >= max_brackets)
    tokens_.refuse(bracket.line, "expected brackets nested at most {} deep", max_brackets);
  brackets_.push_back({bracket.text[0], bracket.line, excerpt(type)});
}

void InventorParser::close(const InventorToken& bracket) {
  const Bracket& last = brackets_.back();
  const std::string_view expected = last.text == '{' ? "}" : "]";
  if (bracket.text != expected)
    tokens_.refuse(bracket.line, "expected '{}' for the '{}' of line {}, got '{}'", expected,
                   last.text, last.line, bracket.text);
  brackets_.pop_back();
}

void InventorParser::refuse_end() const {
  const Bracket& last = brackets_.back();
  tokens_.refuse(tokens_.rest().line,
                 "expected '{}' for the '{}' of line {}, got the end of the file",
                 last.text == '{' ? '}' : ']',
                 last.type.empty() ? std::string(1, last.text) : last.type + " {", last.line);
}

InventorToken InventorParser::word(std::string_view what) {
  const InventorToken token = tokens_.next();
  if (token.kind != InventorToken::word)
    tokens_.refuse(token.line, "expected {}, got {}", what, token.told());
  return token;
}

void InventorParser::skip_brackets() {
  const size_t before = brackets_.size();
  InventorToken last, type;
  do {
    const InventorToken token = tokens_.next();
    if (token.kind == InventorToken::end) refuse_end();
    if (token.kind == InventorToken::open) {
      check_nested(last, token);
      open(token, token.opens('{') ? last.text : "");
    } else if (token.kind == InventorToken::close) {
      close(token);
    } else if (last.is("DEF") && !in_proto_) {
      define(token, {});
    }
    last = token;
  } while (brackets_.size() > before);
}

InventorTokens::Part InventorParser::skip_value(
    const std::function<bool(const InventorToken&)>& ends) {
  Part part = tokens_.rest();
  InventorToken last;
  for (;;) {
    const InventorToken token = tokens_.peek();
    part.end = std::max(part.start, last.start + last.text.size());
    if (token.kind == InventorToken::open) {
      check_nested(last, token);
      skip_brackets();
      part.end = tokens_.rest().start;
      return part;
    }
    if (token.kind == InventorToken::close || token.kind == InventorToken::end || ends(token))
      return part;
    last = tokens_.next();
    if (token.kind == InventorToken::string) {
      part.end = tokens_.rest().start;
      return part;
    }
  }
}

InventorNode& InventorParser::add_node(const InventorType& type, int line) {
  if (graph_.nodes.size() >= max_inventor_nodes)
    tokens_.refuse(line, "expected at most {} nodes", max_inventor_nodes);
  return graph_.nodes.emplace_back(InventorNode{.type = &type, .file = file_, .line = line});
}

void InventorParser::finish(InventorNode& node) {
  for (const auto* child : node.children) node.height = std::max(node.height, child->height + 1);
  for (const auto& [field, value] : node.values)
    if (const auto* nodes = std::get_if<std::vector<const InventorNode*>>(&value))
      for (const auto* below : *nodes) node.height = std::max(node.height, below->height + 1);
  if (node.height > max_inventor_depth)
    tokens_.refuse(node.line, "expected nodes at most {} deep", max_inventor_depth);
}

const InventorNode* InventorParser::read() {
  InventorNode& root = add_node(inventor_type("Group", false), 1);
  int stray = 0, stray_line = 0;
  for (InventorToken token = tokens_.next(); token.kind != InventorToken::end;
       token = tokens_.next()) {
    if (token.kind == InventorToken::word) {
      statement(token, root.children);
      continue;
    }
    if (token.kind == InventorToken::open)
      tokens_.refuse(token.line, "expected a node type before '{}', got nothing", token.text);
    if (token.kind == InventorToken::string)
      tokens_.refuse(token.line, "expected a node, got {}", token.told());
    // a surplus brace closes nothing and can be ignored
    if (token.text != "}") tokens_.refuse(token.line, "'{}' closes nothing", token.text);
    if (++stray == 1) stray_line = token.line;
  }
  if (stray > 0) {
    Diagnostic stray_bracket(Place(graph_.files[file_], stray_line),
                             "'}' closes nothing; it is left out");
    stray_bracket.count = stray;
    graph_.repairs.add(graph_.files[file_], std::move(stray_bracket));
  }
  finish(root);
  return &root;
}

void InventorParser::statement(const InventorToken& token, std::vector<const InventorNode*>& out) {
  if (token.is("EXTERNPROTO"))
    tokens_.refuse(token.line, "EXTERNPROTO is not read; expected nodes of the standard");
  if (token.is("PROTO")) {
    proto(token.line);
  } else if (token.is("ROUTE")) {
    word("a field's name after ROUTE");
    if (!word("TO after ROUTE and a field's name").is("TO"))
      tokens_.refuse(token.line, "expected ROUTE, a field's name, TO and another's name");
    word("a field's name after TO");
  } else if (const InventorNode* found = node(token)) {
    out.push_back(found);
  }
}

const InventorNode* InventorParser::use(int line) {
  count_value();
  const std::string name(word("a name after USE").text);
  if (const auto found = names().find(name); found != names().end()) {
    if (const int at = found->second.open_line)
      tokens_.refuse(line, "USE of {} inside itself, which line {} defines", in_quotes(name), at);
    return found->second.node;
  }
  std::vector<std::string> known;
  for (const auto& [other, named] : names())
    if (other.size() <= max_suggested && known.size() < 1000) known.push_back(other);
  tokens_.refuse(line, "USE of {}, which nothing above defines{}", in_quotes(name),
                 did_you_mean(name.substr(0, max_suggested), known));
}

InventorParser::Named& InventorParser::define(const InventorToken& name, const Named& named) {
  if (++budget_.names > max_inventor_names)
    tokens_.refuse(name.line, "expected at most {} names", max_inventor_names);
  return names()[std::string(name.text)] = named;
}

void InventorParser::warn(int line, const std::string& sentence) {
  const std::string& file = graph_.files[file_];
  graph_.warnings.add(file, {Place(file, line), sentence});
}

const InventorNode* InventorParser::node(const InventorToken& first, const InventorType* around) {
  if (first.is("USE")) return use(first.line);
  InventorToken name, type_word = first;
  if (first.is("DEF")) {
    name = word("a name after DEF");
    type_word = word("a node type after DEF and a name");
  }
  const InventorToken bracket = tokens_.peek();
  if (type_word.kind != InventorToken::word)
    tokens_.refuse(first.line, "expected a node, got {}", first.told());
  if (!bracket.opens('{'))
    tokens_.refuse(bracket.line, "expected '{{' after {}, got {}", in_quotes(type_word.text),
                   bracket.told());
  if (++budget_.open_nodes > max_inventor_depth)
    tokens_.refuse(type_word.line, "expected nodes at most {} deep", max_inventor_depth);
  Named* named = nullptr;
  if (name.kind == InventorToken::word) named = &define(name, {.open_line = first.line});
  const InventorNode* made = nullptr;
  const InventorType& type = inventor_type(type_word.text, tokens_.vrml2());
  if (const auto found = protos_.find(type_word.text); found != protos_.end()) {
    made = instance(found->second, type_word);
  } else if (type.kind == InventorKind::include && around && around->is_shape()) {
    warn(type_word.line, fmt::format("{} inside {} is skipped", type.name, around->name));
    skip_brackets();
  } else if (type.kind <= InventorKind::odd && type.kind != InventorKind::value) {
    count_value();  // so that their number is limited, too
    if (type.kind != InventorKind::idle)
      warn(type_word.line,
           fmt::format("{} {} is skipped", type.kind == InventorKind::odd ? "node" : "unknown node",
                       in_quotes(type_word.text)));
    skip_brackets();
  } else {
    InventorNode& node = add_node(type, type_word.line);
    if (type.is_other_shape() && type.fields.empty()) {
      skip_brackets();
    } else {
      open(tokens_.next(), type_word.text);
      body(node);
    }
    if (type.kind == InventorKind::include) include(node);
    finish(node);
    made = &node;
  }
  if (named) *named = {.node = made};
  --budget_.open_nodes;
  return made;
}

void InventorParser::body(InventorNode& node) {
  const InventorType& type = *node.type;
  const bool takes_nodes = type.takes_children() || (type.is_shape() && !tokens_.vrml2());
  for (;;) {
    const InventorToken token = tokens_.next(), behind = tokens_.peek();
    if (token.kind == InventorToken::end) refuse_end();
    if (token.kind == InventorToken::close) {
      close(token);
      repair_values(node, graph_);
      break;
    }
    if (token.kind == InventorToken::open)
      tokens_.refuse(token.line, "expected a node type before '{}', got nothing", token.text);
    const InventorField* known = behind.opens('{') ? nullptr : field_of(type, token);
    if (known) {
      field(node, *known);
    } else if ((token.is("fields") || token.is("isA")) && behind.opens('[')) {
      skip_brackets();
    } else if (token.is("ROUTE") || token.is("PROTO") || token.is("EXTERNPROTO")) {
      statement(token, node.children);
    } else if (takes_nodes && starts_node(token, behind)) {
      if (const InventorNode* child = this->node(token, &type)) node.children.push_back(child);
    } else {
      skip_unknown_field(type, token);
    }
  }
}

void InventorParser::include(InventorNode& node) {
  const auto& names = node.words(node.type->fields[0].name);
  if (names.empty()) {
    warn(node.line, fmt::format("{} names no file", node.type->name));
    return;
  }
  if (trim(names[0]).empty())
    tokens_.refuse(node.line, "{}: expected the name of a file, got nothing", node.type->name);
  if (const InventorNode* root = include_(names[0], node.line)) node.children.push_back(root);
}

// --- PROTOs: text that is parsed again for each instance, with names in place of some values ---

void InventorParser::check_nested(const InventorToken& type, const InventorToken& bracket) const {
  if (in_proto_ && bracket.opens('{') && protos_.contains(type.text))
    tokens_.refuse(type.line, "PROTO {} is used inside a PROTO, which is not read",
                   in_quotes(type.text));
}

void InventorParser::count_proto_name() {
  if (++budget_.proto_names > max_proto_names)
    tokens_.refuse(tokens_.rest().line, "expected at most {} PROTOs and fields of PROTOs",
                   max_proto_names);
}

void InventorParser::proto(int line) {
  if (instance_) tokens_.refuse(line, "a PROTO inside a PROTO is not read");
  count_proto_name();
  const std::string name(word("a name after PROTO").text);
  // declared before its body, so that uses inside it are detected
  Proto& made = protos_[name] = {};
  in_proto_ = true;
  const auto is_access = [](const InventorToken& t) {
    return t.is("field") || t.is("exposedField") || t.is("eventIn") || t.is("eventOut");
  };
  InventorToken token = tokens_.next();
  if (!token.opens('['))
    tokens_.refuse(token.line, "expected '[' after PROTO {}, got {}", in_quotes(name),
                   token.told());
  open(token, "");
  for (token = tokens_.next(); token.kind != InventorToken::close; token = tokens_.next()) {
    if (token.kind == InventorToken::end) refuse_end();
    if (!is_access(token))
      tokens_.refuse(token.line, "expected field, exposedField, eventIn, eventOut or ']', got {}",
                     token.told());
    count_proto_name();
    word("the type of a field");
    auto& absent = made.fields[std::string(word("the name of a field").text)];
    if (token.text.ends_with("ield")) absent = skip_value(is_access);
  }
  close(token);
  token = tokens_.peek();
  if (!token.opens('{'))
    tokens_.refuse(token.line, "expected '{{' after PROTO {} and its fields, got {}",
                   in_quotes(name), token.told());
  made.body = {token.start + 1, 0, token.line};
  skip_brackets();
  made.body.end = tokens_.rest().start - 1;
  in_proto_ = false;
}

template <class Read>
auto InventorParser::read_part(const Part& part, Instance* scope, Read read) {
  budget_.proto_bytes += part.end - part.start;
  if (budget_.proto_bytes > max_proto_bytes)
    tokens_.refuse(tokens_.rest().line, "expected PROTOs that expand to at most {} bytes of text",
                   max_proto_bytes);
  const Part here = tokens_.rest();
  tokens_.read_only(part);
  Instance* around = std::exchange(instance_, scope);
  auto out = read();
  instance_ = around;
  tokens_.read_only(here);
  return out;
}

const InventorNode* InventorParser::instance(const Proto& proto, const InventorToken& name) {
  Instance scope{.proto = &proto};
  open(tokens_.next(), name.text);
  InventorToken token = tokens_.next();
  for (; token.kind != InventorToken::close; token = tokens_.next()) {
    if (token.kind == InventorToken::end) refuse_end();
    if (!proto.has_field(token))
      tokens_.refuse(token.line, "PROTO {} has no field {}", in_quotes(name.text), token.told());
    scope.values[std::string(token.text)] =
        skip_value([&](const InventorToken& t) { return proto.has_field(t); });
  }
  InventorNode& group = add_node(inventor_type("Group", false), name.line);
  read_part(proto.body, &scope, [&] {
    for (InventorToken t = tokens_.next(); t.kind != InventorToken::end; t = tokens_.next())
      statement(t, group.children);
    return 0;
  });
  close(token);
  finish(group);
  return group.children.size() == 1 ? group.children[0] : &group;
}

InventorValue InventorParser::proto_value(const InventorType& type, const InventorField& field) {
  tokens_.next();
  const InventorToken name = word("a name after IS");
  const auto* known = instance_ ? &instance_->proto->fields : nullptr;
  const auto absent =
      known ? known->find(name.text) : std::map<std::string, std::optional<Part>>::const_iterator();
  if (!known || absent == known->end())
    tokens_.refuse(name.line, "{}: {}: expected a field of a PROTO around it after IS, got {}",
                   type.name, field.name, in_quotes(name.text));
  const auto given = instance_->values.find(name.text);
  const auto part =
      given != instance_->values.end() ? std::optional(given->second) : absent->second;
  if (!part) return field.absent;
  // values are in the file itself, outside the PROTO
  return read_part(*part, nullptr, [&] { return value(type, field); });
}

}  // namespace clench
