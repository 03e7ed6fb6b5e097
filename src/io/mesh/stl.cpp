#include "clench/io/mesh/mesh_readers.h"

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

/// Binary files may begin with "solid", too; then their size or what follows tells.
bool is_ascii(std::string_view bytes) {
  if (lower_case(trim(without_mark(bytes.substr(0, 200))).substr(0, 5)) != "solid") return false;
  if (bytes.size() >= header_bytes &&
      bytes.size() == header_bytes + facet_bytes * facet_count(bytes))
    return false;
  return bytes.substr(0, 1000).find('\0') == std::string_view::npos;
}

void add_facet(GeometryBuilder& builder, const std::array<Eigen::Vector3d, 3>& corners,
               int line = 0) {
  if (builder.triangle_count() >= max_mesh_triangles)
    fail("expected at most {} facets", max_mesh_triangles);
  builder.add(corners, Appearance().color, 0, line);
}

/// A word, wherever the next one stands.
std::string expect(WordReader& words, std::string_view expected) {
  std::string word = lower_case(words.word_anywhere());
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
    if (word == "endloop") words.fail("expected three vertices a facet, got {}", count);
    if (word != "vertex") words.fail("expected 'vertex' or 'endloop', got {}", in_quotes(word));
    if (count == 3) words.fail("expected three vertices a facet, got more");
    for (double& x : corners[count]) {
      const auto text = words.word_anywhere();
      const auto value = parse_number(text);
      if (!value) words.fail("expected three numbers after vertex, got {}", in_quotes(text));
      x = *value;
    }
  }
  add_facet(builder, corners, words.line());
}

void read_ascii(WordReader& words, GeometryBuilder& builder) {
  // one solid, or several
  for (bool first = true;; first = false) {
    const std::string word = lower_case(words.word_anywhere());
    if (word.empty() && !first) return;
    if (word != "solid") words.fail("expected 'solid', got {}", in_quotes(word));
    words.rest();  // its name
    for (;;) {
      const std::string next = expect(words, "facet or endsolid");
      if (next == "endsolid") break;
      if (next != "facet") words.fail("expected 'facet' or 'endsolid', got {}", in_quotes(next));
      // the normal, which some programs write as no number
      if (lower_case(words.word_anywhere()) != "normal")
        words.fail("expected 'normal' after facet");
      for (int i = 0; i < 3; ++i) expect(words, "a normal");
      expect_word(words, "outer");
      expect_word(words, "loop");
      read_loop(words, builder);
      expect_word(words, "endfacet");
    }
    words.rest();
  }
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
    input.warn(fmt::format("{}: the attribute words of {} facets are not used", file, attributes));
  if (reader.left() > 0)
    input.warn(fmt::format("{}: {} bytes after the last facet are not used", file, reader.left()));
}

}  // namespace

bool read_stl(const MeshInput& input, GeometryBuilder& builder) {
  if (is_ascii(input.bytes)) {
    builder.report.format = "ascii STL";
    const std::string text = plain_text(input.bytes);
    WordReader words(input.file(), text);
    read_ascii(words, builder);
  } else {
    builder.report.format = "binary STL";
    read_binary(input, builder);
  }
  return false;
}

}  // namespace clench
