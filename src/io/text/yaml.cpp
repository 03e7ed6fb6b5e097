#include "clench/io/text/yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <streambuf>

#include "clench/base/text.h"
#include "clench/io/text/json_tree.h"

namespace clench {

// of a text between two values: yaml-cpp stores all tokens of a list in brackets that may be a key,
// about 130 times the size of the text
static constexpr size_t max_silence = size_t{512} << 10;

namespace {

/// The text as a stream, in blocks. It ends early if the parser reads too much without a value.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) : text_(text) {}

  void heard() { heard_ = read_; }
  bool gave_up() const { return gave_up_; }

 protected:
  int_type underflow() override {
    if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
    gave_up_ = read_ - heard_ > max_silence;
    if (read_ == text_.size() || gave_up_) return traits_type::eof();
    const size_t size = std::min<size_t>(4096, text_.size() - read_);
    char* const begin = const_cast<char*>(text_.data()) + read_;
    setg(begin, begin, begin + size);
    read_ += size;
    return traits_type::to_int_type(*begin);
  }

 private:
  std::string_view text_;
  size_t read_ = 0, heard_ = 0;
  bool gave_up_ = false;
};

/// Adds the values that the parser reports to a tree.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& file, ValueTree& out, TextBuffer& buffer)
      : file_(file), out_(out), buffer_(buffer) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& at, YAML::anchor_t) override { scalar("", false, at); }
  void OnAlias(const YAML::Mark& at, YAML::anchor_t) override { refuse_anchor(at); }
  void OnScalar(const YAML::Mark& at, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    if (anchor) refuse_anchor(at);
    scalar(text, tag == "!", at);
  }
  void OnSequenceStart(const YAML::Mark& at, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(ValueKind::list, at, anchor);
  }
  void OnMapStart(const YAML::Mark& at, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(ValueKind::map, at, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

  /// A second document begins.
  void end() { is_over_ = true; }

 private:
  [[noreturn]] void refuse_anchor(const YAML::Mark& at) const {
    fail("{}:{}: anchors are not read", file_, at.line + 1);
  }
  void check_end(const YAML::Mark& at) const {
    if (is_over_)
      fail("{}:{}: expected the end of the file, got another document", file_, at.line + 1);
  }
  void scalar(std::string_view text, bool quoted, const YAML::Mark& at) {
    check_end(at);
    buffer_.heard();
    out_.scalar(text, quoted, at.line + 1);
  }
  void open(ValueKind kind, const YAML::Mark& at, YAML::anchor_t anchor) {
    check_end(at);
    if (anchor) refuse_anchor(at);
    buffer_.heard();
    out_.open(kind, at.line + 1);
  }
  void close() {
    buffer_.heard();
    out_.close();
  }

  const std::string& file_;
  ValueTree& out_;
  TextBuffer& buffer_;
  bool is_over_ = false;
};

ValueTree parse_yaml_text(const std::string& file, std::string_view text) {
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  ValueTree out(file);
  TreeBuilder builder(file, out, buffer);
  const auto refuse_long = [&](int line) {
    fail(ErrorKind::limit,
         "{}:{}: expected texts, comments and lists in brackets of at most {} kB, got a longer one",
         file, line, max_silence >> 10);
  };
  try {
    YAML::Parser parser(stream);
    const bool any = parser.HandleNextDocument(builder);
    if (buffer.gave_up()) refuse_long(1);
    if (!any || !out.complete()) fail("{}: expected a map or a list, got an empty file", file);
    builder.end();
    parser.HandleNextDocument(builder);
    if (buffer.gave_up()) refuse_long(1);
    out.finish();
    return out;
  } catch (const YAML::Exception& error) {
    if (buffer.gave_up()) refuse_long(error.mark.line + 1);
    const bool open_quote = error.msg == YAML::ErrorMsg::EOF_IN_SCALAR;
    fail("{}:{}: {}", file, error.mark.line + 1,
         open_quote ? "a quote that is not closed" : error.msg);
  }
}

}  // namespace

ValueTree parse_yaml(const std::string& file, std::string_view text) {
  // yaml-cpp treats a quote that is open at the end of a line as closed, unless the text ends there
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos || (text[begin] != '{' && text[begin] != '['))
    return parse_yaml_text(file, text);
  ValueTree out(file);
  const auto fault = read_json_tree(text, out);
  if (!fault) return out;
  // lists and maps in brackets may be YAML instead
  if (text.size() > max_silence) fail("{}:{}: {}", file, fault->line, fault->sentence);
  return parse_yaml_text(file, text);
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
