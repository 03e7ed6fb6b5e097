#include "io/inventor_scan.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/suggest.h"
#include "base/text.h"

namespace clench {

namespace {

constexpr size_t deepest = 250;  // nested brackets; the library reads by recursion

struct Token {
  enum Kind { word, string, open, close, end } kind = end;
  std::string_view text;  // with the quotes of a string
  size_t start = 0;
  int line = 0;
};

/// An open bracket.
struct Open {
  char bracket = '{';
  int line = 0;
  std::string type = {};  // node type before a '{', else empty
  std::string name = {};  // given by DEF
  size_t start = 0;       // where the node begins, DEF included
  bool cut = false;       // unknown, or not needed
  bool proto = false;     // body of a PROTO
  bool shape = false;
  bool direct = false;      // inside a shape, and no value of its fields
  size_t edits = 0;         // made before it
  std::string lifted = {};  // nodes that stand inside, as one line
};

bool ends_word(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\v' || c == '\f' || c == ',' || c == '{' ||
         c == '}' || c == '[' || c == ']' || c == '"' || c == '#';
}

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file, int first_line, bool vrml2,
          const std::function<NodeType(const std::string&)>& node_type)
      : text_(text),
        file_(file),
        line_(first_line),
        vrml2_(vrml2),
        node_type_(node_type),
        out_(text) {}

  void run();
  std::string take_text();
  std::vector<InventorInclude> includes;
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, int>> nodes;
  bool has_protos() const { return !protos_.empty(); }

 private:
  template <class... Args>
  [[noreturn]] void refuse(int line, fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(fmt::format("{}:{}: ", file_, line) +
                fmt::format(format, std::forward<Args>(args)...));
  }
  Token next();
  void on_word(const Token& token);
  void on_open(const Token& token);
  void on_close(const Token& token);
  void include_value(const Token& token, const std::string& node);
  /// Type of the node, File or Inline, of which the token names a file; "" when it is no such name.
  std::string including_node(const Token& token) const;
  /// Does a node behind that token stand inside a shape without a field's name?
  bool is_direct(const Token& before) const;
  /// takes the text from start on out, to stand before the shape around it
  void lift(size_t start);
  bool in_cut() const {
    return std::any_of(open_.begin(), open_.end(), [](const Open& o) { return o.cut; });
  }
  /// blanks the text from start to end, so that lines keep their numbers
  void cut(size_t start, size_t end);

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0;
  int line_;
  bool vrml2_;
  const std::function<NodeType(const std::string&)>& node_type_;
  std::string out_;
  std::vector<Open> open_;
  Token last_;                                    // the token before, when it was a word
  Token before_last_, third_last_, fourth_last_;  // for field DEF name type
  size_t route_ = 0;                              // where an open ROUTE begins, plus 1
  std::set<std::string> cut_names_, protos_;
  std::map<std::string, NodeType> types_;
  std::vector<std::pair<size_t, std::pair<size_t, std::string>>> edits_;  // start, length, text
};

Token Scanner::next() {
  // white space, commas and comments
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\n')
      ++line_, ++at_;
    else if (c == '#')
      at_ = std::min(text_.find('\n', at_), text_.size());
    else if (c == ' ' || c == '\t' || c == ',' || c == '\v' || c == '\f')
      ++at_;
    else
      break;
  }
  Token token{Token::end, {}, at_, line_};
  if (at_ >= text_.size()) return token;

  const char c = text_[at_];
  if (c == '\0')
    refuse(line_, "wanted text, got a byte of value 0; binary Inventor files are not read");
  if (c == '{' || c == '[' || c == '}' || c == ']') {
    token.kind = c == '{' || c == '[' ? Token::open : Token::close;
    token.text = text_.substr(at_++, 1);
  } else if (c == '"') {
    token.kind = Token::string;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      if (text_[at_] == '\n') ++line_;
    }
    if (at_ >= text_.size()) refuse(token.line, "a string has no closing quote");
    token.text = text_.substr(token.start, ++at_ - token.start);
  } else {
    token.kind = Token::word;
    while (at_ < text_.size() && !ends_word(text_[at_]) && text_[at_] != '\0') ++at_;
    token.text = text_.substr(token.start, at_ - token.start);
  }
  return token;
}

void Scanner::cut(size_t start, size_t end) {
  for (size_t i = start; i < end; ++i)
    if (out_[i] != '\n') out_[i] = ' ';
  // in VRML 2 a node that is the value of a field cannot just be missing
  const bool value = vrml2_ && !open_.empty() && open_.back().bracket == '{' && !open_.back().proto;
  if (value && end - start >= 4 &&
      std::string_view(out_).substr(start, 4).find('\n') == std::string_view::npos)
    out_.replace(start, 4, "NULL");
}

void Scanner::on_word(const Token& token) {
  if (token.text == "EXTERNPROTO")
    refuse(token.line, "EXTERNPROTO is not read; wanted nodes of the standard");
  if (last_.text == "PROTO") protos_.insert(std::string(token.text));
  if (last_.text == "TO" && route_ > 0) cut(route_ - 1, at_), route_ = 0;
  if (token.text == "ROUTE") route_ = token.start + 1;
  if (last_.text == "USE") {
    const std::string name(token.text);
    for (const auto& o : open_)
      if (o.name == name)
        refuse(token.line, "USE of '{}' inside itself, which line {} defines", name, o.line);
    if (cut_names_.contains(name) && !in_cut())
      cut(last_.start, at_);
    else if (is_direct(before_last_))
      lift(last_.start);
  }
}

void Scanner::on_open(const Token& token) {
  if (open_.size() >= deepest)
    refuse(token.line, "wanted brackets nested at most {} deep", deepest);
  Open open{.bracket = token.text[0], .line = token.line, .start = token.start};
  open.edits = edits_.size();
  if (open.bracket == '{' && last_.kind == Token::word) {
    open.type = last_.text;
    open.start = last_.start;
    const bool named = third_last_.text == "DEF";
    if (named) {
      open.name = before_last_.text;
      open.start = third_last_.start;
    }
    open.direct = is_direct(named ? fourth_last_ : before_last_);
    const bool nested_proto =
        protos_.contains(open.type) &&
        std::any_of(open_.begin(), open_.end(), [](const Open& o) { return o.proto; });
    if (nested_proto)
      refuse(token.line, "PROTO '{}' is used inside a PROTO, which is not read", open.type);
    auto type = types_.find(open.type);
    if (type == types_.end()) type = types_.emplace(open.type, node_type_(open.type)).first;
    open.shape = type->second == NodeType::shape && !vrml2_;
    open.cut = (type->second == NodeType::idle || type->second == NodeType::unknown) &&
               !protos_.contains(open.type);
    if (open.cut && type->second == NodeType::unknown && !in_cut())
      warnings.push_back(fmt::format("{}:{}: unknown node {} is skipped", file_, token.line,
                                     in_quotes(open.type)));
    if (!open.cut && !in_cut()) nodes.emplace_back(open.type, token.line);
  } else if (open.bracket == '{') {
    open.proto = last_.kind == Token::close && last_.text == "]" && vrml2_;
    if (!open.proto)
      refuse(token.line, "wanted a node type before '{{', got {}",
             last_.text.empty() ? "nothing" : in_quotes(last_.text));
  }
  open_.push_back(std::move(open));
}

void Scanner::on_close(const Token& token) {
  const char bracket = token.text[0] == '}' ? '{' : '[';
  if (open_.empty()) refuse(token.line, "'{}' closes nothing", token.text);
  const Open open = open_.back();
  if (open.bracket != bracket)
    refuse(token.line, "wanted '{}' for the '{}' of line {}, got '{}'",
           open.bracket == '{' ? '}' : ']', open.bracket, open.line, token.text);
  open_.pop_back();
  if (open.cut && !in_cut()) {
    cut(open.start, at_);
    if (!open.name.empty()) cut_names_.insert(open.name);
    return;
  }
  if (!open.name.empty()) cut_names_.erase(open.name);
  if (in_cut()) return;
  if (open.direct && edits_.size() > open.edits) {
    warnings.push_back(fmt::format("{}:{}: {} inside {} is skipped", file_, open.line, open.type,
                                   open_.back().type));
    edits_.resize(open.edits);
    if (!open.name.empty()) cut_names_.insert(open.name);
    cut(open.start, at_);
  } else if (open.direct) {
    lift(open.start);
  } else if (!open.lifted.empty()) {
    edits_.insert(edits_.begin() + open.edits,
                  {open.start, {0, "Separator { " + open.lifted + " "}});
    edits_.push_back({at_, {0, " }"}});
  }
}

bool Scanner::is_direct(const Token& before) const {
  // fields begin with a small letter, their values with none; engines stand behind '='
  const bool field = before.kind == Token::word &&
                     ((before.text[0] >= 'a' && before.text[0] <= 'z') || before.text == "=");
  return !open_.empty() && open_.back().shape && !in_cut() && !field;
}

void Scanner::lift(size_t start) {
  bool string = false, comment = false;
  std::string& lifted = open_.back().lifted;
  for (size_t i = start; i < at_; ++i) {
    const char c = out_[i];
    if (comment) {
      comment = c != '\n';
      continue;
    }
    if (c == '"') string = !string;
    comment = c == '#' && !string;
    lifted += c == '\n' || comment ? ' ' : c;
    if (string && c == '\\' && i + 1 < at_) lifted += out_[++i];
  }
  lifted += ' ';
  cut(start, at_);
}

std::string Scanner::including_node(const Token& token) const {
  if (open_.empty() || in_cut() || token.kind == Token::open || token.kind == Token::close)
    return "";
  const bool listed = open_.back().bracket == '[' && open_.size() > 1;
  const std::string& type = open_[open_.size() - (listed ? 2 : 1)].type;
  const bool named = last_.kind == Token::word && last_.text == "name",
             url = last_.kind == Token::word && last_.text == "url";
  if (type == "File" || type == "SoFile") return named && !listed ? type : "";
  if (type == "WWWInline" || type == "SoWWWInline") return named || listed ? type : "";
  const bool is_inline = type == "Inline" || type == "VRMLInline" || type == "SoVRMLInline";
  return is_inline && (url || listed) ? type : "";
}

// the library would read these files itself, and takes what is wrong with a name for a format
void Scanner::include_value(const Token& token, const std::string& node) {
  std::string name(token.text);
  if (token.kind == Token::string) name = name.substr(1, name.size() - 2);
  if (trim(name).empty()) refuse(token.line, "{}: wanted the name of a file, got nothing", node);
  if (includes.size() >= most_includes)
    refuse(token.line, "wanted at most {} included files, each counted as often as it is named",
           most_includes);
  edits_.push_back(
      {token.start,
       {token.text.size(), '"' + include_key(static_cast<int>(includes.size())) + '"'}});
  includes.push_back({name, token.line});
}

void Scanner::run() {
  for (Token token = next(); token.kind != Token::end; token = next()) {
    if (const std::string node = including_node(token); !node.empty())
      include_value(token, node);
    else if (token.kind == Token::word)
      on_word(token);
    else if (token.kind == Token::open)
      on_open(token);
    else if (token.kind == Token::close)
      on_close(token);
    fourth_last_ = third_last_;
    third_last_ = before_last_;
    before_last_ = last_;
    last_ = token;
  }
  if (!open_.empty()) {
    const Open& open = open_.back();
    refuse(line_, "wanted '{}' for the '{}' of line {}, got the end of the file",
           open.bracket == '{' ? '}' : ']',
           open.type.empty() ? std::string(1, open.bracket) : open.type + " {", open.line);
  }
}

std::string Scanner::take_text() {
  std::string out;
  size_t done = 0;
  for (const auto& [start, edit] : edits_) {
    out.append(out_, done, start - done) += edit.second;
    done = start + edit.first;
  }
  return out.append(out_, done);
}

constexpr std::array<std::string_view, 5> headers = {"#Inventor V2.1 ascii", "#Inventor V2.0 ascii",
                                                     "#Inventor V1.0 ascii", "#VRML V1.0 ascii",
                                                     "#VRML V2.0 utf8"};

/// The canonical header that a line means, or "".
std::string_view header_of(std::string_view line) {
  for (const auto header : headers)
    if (line.starts_with(header)) return header;
  return "";
}

}  // namespace

std::string include_key(int number) { return fmt::format("clench:include:{}:", number); }

InventorText scan_inventor(const std::string& text, const std::string& file,
                           const std::function<NodeType(const std::string&)>& node_type) {
  InventorText out;
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);

  // the header stands on the first line, or after comments
  std::string_view header, first;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = trim(rest.substr(0, end));
    if (first.empty()) first = line;
    header = header_of(line);
    if (!header.empty()) {
      rest.remove_prefix(end);
      break;
    }
    if (line.starts_with("#Inventor") && line.find("binary") != std::string_view::npos)
      fail("{}:{}: binary Inventor files are not read; wanted '#Inventor V2.1 ascii'", file,
           out.skipped_lines + 1);
    if (!line.empty() && line.front() != '#') break;
    ++out.skipped_lines;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (header.empty())
    fail("{}:1: wanted a header such as '#Inventor V2.1 ascii' or '#VRML V2.0 utf8', got {}", file,
         in_quotes(first));

  Scanner scanner(rest, file, out.skipped_lines + 1, header == "#VRML V2.0 utf8", node_type);
  scanner.run();
  out.includes = std::move(scanner.includes);
  out.warnings = std::move(scanner.warnings);
  if (!scanner.has_protos()) out.nodes = std::move(scanner.nodes);
  out.text = std::string(header) + scanner.take_text() + "\n";
  return out;
}

}  // namespace clench
