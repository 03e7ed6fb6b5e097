#include "clench/io/mesh/mesh_readers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clench/io/text/byte_reader.h"
#include "clench/io/text/word_reader.h"

namespace clench {

namespace {

constexpr size_t header_bytes = 84, facet_bytes = 50;

size_t facet_count(std::string_view bytes) {
  ByteReader reader(bytes);
  reader.skip(header_bytes - 4);
  return reader.next<uint32_t>();
}

/// The text without trailing zero bytes and blanks, with which some programs fill a block.
std::string_view ascii_part(std::string_view bytes) {
  const size_t last = bytes.find_last_not_of(std::string_view("\0 \t\r\n\v\f\x1A", 8));
  return bytes.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

bool begins_solid(std::string_view word) { return word == "solid" || word == "facet"; }

/// True if a line near the start begins a solid; some programs write their names before it.
bool has_solid_line(std::string_view text) {
  constexpr size_t max_preface = 10'000;  // bytes
  text = without_mark(text).substr(0, max_preface);
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (begins_solid(lower_case(trim(text.substr(0, end)).substr(0, 5)))) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

/// Binary files may begin with "solid", too; then the file's size or zero bytes decide.
bool is_ascii(std::string_view bytes) {
  if (bytes.size() >= header_bytes &&
      bytes.size() == header_bytes + facet_bytes * facet_count(bytes))
    return false;
  const std::string_view text = ascii_part(bytes);
  return has_solid_line(text) && text.substr(0, 1000).find('\0') == std::string_view::npos;
}

void add_facet(GeometryBuilder& builder, const std::array<Eigen::Vector3d, 3>& corners,
               int line = 0) {
  if (builder.triangle_count() >= max_mesh_triangles)
    fail("expected at most {} facets", max_mesh_triangles);
  builder.add(corners, Appearance().color, 0, line);
}

/// The next word in lower case, after comments; empty at the end of the file.
std::string next_word(WordReader& words) {
  std::string_view word = words.word_anywhere();
  while (word.starts_with("//")) {
    words.rest();
    word = words.word_anywhere();
  }
  return lower_case(word);
}

std::string expect(WordReader& words, std::string_view expected) {
  std::string word = next_word(words);
  if (word.empty()) words.fail("expected {}, got the end of the file", expected);
  return word;
}

void expect_word(WordReader& words, std::string_view expected) {
  const std::string word = expect(words, expected);
  if (word != expected) words.fail("expected '{}', got {}", expected, in_quotes(word));
}

void read_loop(WordReader& words, GeometryBuilder& builder) {
  std::array<Eigen::Vector3d, 3> corners;
  for (int count = 0;; ++count) {
    const std::string word = expect(words, "vertex or endloop");
    if (word == "endloop" && count == 3) break;
    if (word == "endloop") words.fail("expected three vertices per facet, got {}", count);
    if (word != "vertex") words.fail("expected 'vertex' or 'endloop', got {}", in_quotes(word));
    if (count == 3) words.fail("expected three vertices per facet, got more");
    for (double& x : corners[count]) {
      const std::string text = next_word(words);
      const auto value = parse_number(text);
      if (!value) words.fail("expected three numbers after vertex, got {}", in_quotes(text));
      x = *value;
    }
  }
  add_facet(builder, corners, words.line());
}

/// Reads a facet from the normal on; some programs write normals that are not numbers.
void read_facet(WordReader& words, GeometryBuilder& builder) {
  for (int i = 0; i < 3; ++i) expect(words, "a normal");
  expect_word(words, "outer");
  expect_word(words, "loop");
  read_loop(words, builder);
  expect_word(words, "endfacet");
}

/// Skips the name of a solid up to the end of its line, or up to "facet normal" on that line.
/// returns  true if a facet begins there
bool skip_name(WordReader& words) {
  bool is_facet = false;
  for (std::string word; !(word = lower_case(words.word())).empty();) {
    if (is_facet && word == "normal") return true;
    is_facet = word == "facet";
  }
  return false;
}

/// Skips the lines before the first solid.
std::string first_solid(const MeshInput& input, WordReader& words) {
  std::string word = lower_case(words.word_anywhere());
  if (begins_solid(word) || word.empty()) return word;
  input.diagnostics().warn(words.place(), "the text before 'solid' is not used");
  while (!begins_solid(word) && !word.empty()) {
    words.rest();
    word = next_word(words);
  }
  return word;
}

/// One or several solids; the lines around their facets may be missing.
void read_ascii(const MeshInput& input, WordReader& words, GeometryBuilder& builder) {
  const auto repair = [&](const char* missing, const std::string& word, const char* done) {
    input.diagnostics().repaired(words.place(), "expected '{}', got {}; the solid {} here", missing,
                                 word.empty() ? "the end of the file" : in_quotes(word), done);
  };
  bool open = false;
  std::string word = first_solid(input, words);
  if (word == "facet") repair("solid", word, "begins"), open = true;
  for (; !word.empty(); word = next_word(words)) {
    bool begins_facet = false;
    if (word == "solid") {
      if (open) repair("endsolid", word, "ends");
      open = true;
      begins_facet = skip_name(words);
    } else if (word == "endsolid" && open) {
      // another solid may follow on the same line
      open = begins_facet = skip_name(words);
    } else if (word == "facet" && open) {
      if (next_word(words) != "normal") words.fail("expected 'normal' after facet");
      begins_facet = true;
    } else {
      words.fail("expected {}, got {}", open ? "'facet' or 'endsolid'" : "'solid'",
                 in_quotes(word));
    }
    if (begins_facet) read_facet(words, builder);
  }
  if (open) repair("endsolid", "", "ends");
}

void read_binary(const MeshInput& input, GeometryBuilder& builder) {
  const std::string_view bytes = input.bytes;
  const std::string file = input.file();
  const size_t count = bytes.size() < header_bytes ? 0 : facet_count(bytes),
               whole =
                   bytes.size() < header_bytes ? 0 : (bytes.size() - header_bytes) / facet_bytes;
  const bool text = bytes.substr(0, 1000).find('\0') == std::string_view::npos;
  if (bytes.size() < header_bytes || (text && whole < count / 2))
    fail("{}: expected an ASCII or binary STL file, got something else", file);
  if (whole < count)
    fail("{}: facet {} of {}: expected 50 bytes, got the end of the file", file, whole + 1, count);
  ByteReader reader(bytes);
  reader.skip(header_bytes);
  size_t attributes = 0;
  for (size_t i = 0; i < count; ++i) {
    reader.skip(12);  // the normal
    std::array<Eigen::Vector3d, 3> corners;
    for (auto& corner : corners)
      for (double& x : corner) {
        x = reader.next<float>();
        if (!std::isfinite(x))
          fail("{}: facet {} of {}: expected finite coordinates, got {}", file, i + 1, count, x);
      }
    attributes += reader.next<uint16_t>() != 0;
    add_facet(builder, corners);
  }
  if (attributes > 0)
    input.diagnostics().warn(Place(file), "the attribute words of {} facets are not used",
                             attributes);
  if (reader.left() > 0)
    input.diagnostics().warn(Place(file), "{} bytes after the last facet are not used",
                             reader.left());
}

}  // namespace

bool read_stl(const MeshInput& input, GeometryBuilder& builder) {
  if (is_ascii(input.bytes)) {
    builder.report.format = "ascii STL";
    const std::string text = plain_text(std::string(ascii_part(input.bytes)));
    WordReader words(input.file(), text);
    read_ascii(input, words, builder);
  } else {
    builder.report.format = "binary STL";
    read_binary(input, builder);
  }
  return false;
}

}  // namespace clench
