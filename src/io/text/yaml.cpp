#include "clench/io/text/yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <streambuf>

#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

static constexpr size_t max_depth = 16;

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[size_t(found - keys.begin())];
}

std::string YamlNode::described() const {
  if (kind == Kind::list) return fmt::format("a list of {}", items.size());
  return kind == Kind::map ? "a map" : in_quotes(text);
}

namespace {

using Kind = YamlNode::Kind;

// what the parser meets, as a tree
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& file) : file_(file) {}
  YamlNode root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& at, YAML::anchor_t) override { take({.line = at.line + 1}); }
  void OnAlias(const YAML::Mark& at, YAML::anchor_t) override { refuse_anchor(at); }
  void OnScalar(const YAML::Mark& at, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    if (anchor) refuse_anchor(at);
    take({.text = text, .quoted = tag == "!", .line = at.line + 1});
  }
  void OnSequenceStart(const YAML::Mark& at, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(at, anchor, Kind::list);
  }
  void OnMapStart(const YAML::Mark& at, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(at, anchor, Kind::map);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode node;
    bool has_key = false;
  };

  [[noreturn]] void refuse_anchor(const YAML::Mark& at) const {
    fail("{}:{}: anchors are not read", file_, at.line + 1);
  }
  void open(const YAML::Mark& at, YAML::anchor_t anchor, Kind kind) {
    if (anchor) refuse_anchor(at);
    if (open_.size() == max_depth)
      fail("{}:{}: expected lists and maps at most {} deep, got more", file_, at.line + 1,
           max_depth);
    open_.push_back({{.kind = kind, .line = at.line + 1}});
  }
  void close() {
    YamlNode done = std::move(open_.back().node);
    open_.pop_back();
    take(std::move(done));
  }
  void take(YamlNode value) {
    check_();
    if (open_.empty()) {
      root = std::move(value);
      return;
    }
    auto& [node, has_key] = open_.back();
    if (node.kind == Kind::list || has_key) {
      node.items.push_back(std::move(value));
      has_key = false;
      return;
    }
    if (value.kind != Kind::scalar)
      fail("{}:{}: expected a key, got {}", file_, value.line, value.described());
    // long maps are lists of grasps: names are compared only where they are few
    if (node.keys.size() < 1000 && node.find(value.text))
      fail("{}:{}: key {} stands there twice", file_, value.line, in_quotes(value.text));
    node.keys.push_back(std::move(value.text));
    has_key = true;
  }

  const std::string& file_;
  std::vector<Open> open_;
  StopCheck check_{64};  // of nodes
};

// a text as a stream, not copied
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());
    setg(begin, begin, begin + text.size());
  }
};

}  // namespace

YamlNode parse_yaml(const std::string& file, std::string_view text) {
  // yaml-cpp takes a quote that is open where lines end for one that is closed, unless the text
  // ends there
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  TreeBuilder builder(file);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder) || builder.root.line == 0)
      fail("{}: expected a map or a list, got an empty file", file);
    YamlNode out = std::move(builder.root);
    if (parser.HandleNextDocument(builder))
      fail("{}:{}: expected the end of the file, got another document", file, builder.root.line);
    return out;
  } catch (const YAML::Exception& error) {
    const bool open_quote = error.msg == YAML::ErrorMsg::EOF_IN_SCALAR;
    fail("{}:{}: {}", file, error.mark.line + 1,
         open_quote ? "a quote that is not closed" : error.msg);
  }
}

std::string yaml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", int(c));
    else
      out += c;
  }
  return out + '"';
}

}  // namespace clench
