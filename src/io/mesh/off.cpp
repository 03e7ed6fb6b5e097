#include "clench/io/mesh/mesh_readers.h"

#include <set>

#include "clench/io/text/file_errors.h"
#include "clench/io/text/word_reader.h"

namespace clench {

namespace {

class OffReader {
 public:
  OffReader(const MeshInput& input, const std::string& text, GeometryBuilder& builder)
      : input_(input), builder_(builder), words_(input.file(), text) {}
  bool read();

 private:
  void read_header();
  void read_kind(std::string_view kind);
  int read_count(std::string_view word, const char* what);
  void read_vertices();
  void read_faces();
  Eigen::Vector3f read_color(int count, float* transparency = nullptr);
  void to_line(const char* what, int i, int count);
  void warn_once(const std::string& sentence);

  const MeshInput& input_;
  GeometryBuilder& builder_;
  WordReader words_;
  int vertices_ = 0, faces_ = 0;
  bool normals_ = false, texture_ = false, vertex_colors_ = false, face_colors_ = false;
  std::vector<Eigen::Vector3f> colors_;  // of vertices
  std::set<std::string> warned_;
};

/// Letters before "OFF": ST texture coordinates, C colors, N normals of the vertices.
void OffReader::read_kind(std::string_view kind) {
  for (size_t i = 0; i < kind.size(); ++i) {
    if (kind.substr(i, 2) == "ST")
      texture_ = true, ++i;
    else if (kind[i] == 'C')
      vertex_colors_ = true;
    else if (kind[i] == 'N')
      normals_ = true;
    else
      words_.fail("expected OFF of three dimensions, got {}", in_quotes(std::string(kind) + "OFF"));
  }
}

/// The counts follow the keyword, which may be missing; "OFF8 6 12" is accepted, too.
void OffReader::read_header() {
  if (!words_.next_line()) words_.fail("expected 'OFF', got the end of the file");
  std::string_view word = words_.word();
  if (const size_t end = word.find("OFF"); end != std::string_view::npos) {
    read_kind(word.substr(0, end));
    word.remove_prefix(end + 3);
  } else if (!parse_integer(word)) {
    words_.fail("expected 'OFF', got {}", in_quotes(word));
  }
  if (word.empty()) word = words_.word_anywhere();
  if (lower_case(word) == "binary") words_.fail("expected OFF as text, got binary OFF");
  vertices_ = read_count(word, "number of vertices");
  faces_ = read_count(words_.word_anywhere(), "number of faces");
  words_.word();  // the number of edges is unused, and often wrong or missing
  if (words_.words_left() > 0) warn_once("text after the counts is not used");
}

int OffReader::read_count(std::string_view word, const char* what) {
  if (const auto fault = integer_fault(word, 0, std::numeric_limits<int>::max()); !fault.empty())
    words_.fail("{}: {}", what, fault);
  return *parse_integer(word);
}

void OffReader::to_line(const char* what, int i, int count) {
  if (!words_.next_line())
    words_.fail("expected {} {} of {}, got the end of the file", what, i + 1, count);
}

void OffReader::warn_once(const std::string& sentence) {
  if (warned_.insert(sentence).second) input_.diagnostics().warn(words_.place(), "{}", sentence);
}

/// Three or four remaining numbers of a line: within 0..1 if one is written as a decimal, otherwise
/// within 0..255. The fourth is the opacity.
Eigen::Vector3f OffReader::read_color(int count, float* transparency) {
  Eigen::Vector4d color(0, 0, 0, 1);
  bool whole = true;
  for (int i = 0; i < count; ++i) {
    const auto word = words_.word();
    const auto value = parse_number(word);
    if (!value) words_.fail("color: expected a number, got {}", in_quotes(word));
    whole = whole && word.find_first_of(".eE") == std::string_view::npos;
    color[i] = *value;
  }
  if (whole) color.head(count) /= 255;
  color = color.cwiseMax(0).cwiseMin(1);
  if (transparency) *transparency = static_cast<float>(1 - color[3]);
  return color.head<3>().cast<float>();
}

void OffReader::read_vertices() {
  for (int i = 0; i < vertices_; ++i) {
    to_line("vertex", i, vertices_);
    const double x = words_.number("x"), y = words_.number("y"), z = words_.number("z");
    builder_.add_vertex({x, y, z}, words_.line());
    for (int k = 0; normals_ && k < 3; ++k) words_.number("normal");
    if (vertex_colors_)
      colors_.push_back(read_color(3));  // opacity may follow
    else if (!texture_ && words_.words_left() > 0)
      warn_once("text after the numbers of a vertex is not used");
  }
}

void OffReader::read_faces() {
  std::vector<int> corners;
  for (int i = 0; i < faces_; ++i) {
    to_line("face", i, faces_);
    // every corner takes at least two characters, so the size of the text limits their number
    const int count = words_.integer("corners of a face", 0, static_cast<int>(max_mesh_vertices));
    corners.clear();
    for (int k = 0; k < count; ++k) {
      const auto word = words_.word();
      const auto vertex = parse_integer(word);
      if (!vertex || *vertex < 0 || *vertex >= vertices_)
        words_.fail("expected {} vertices from 0 to {}, got {}", count, vertices_ - 1,
                    in_quotes(word));
      corners.push_back(*vertex);
    }
    Eigen::Vector3f color = Appearance().color;
    float transparency = 0;
    if (!colors_.empty()) {
      color.setZero();
      for (const int v : corners) color += colors_[v] / static_cast<float>(count);
    }
    if (const int rest = words_.words_left(); rest == 3 || rest == 4) {
      color = read_color(rest, &transparency);
      face_colors_ = true;
    } else if (rest > 0) {
      warn_once("text after the vertices of a face is no color, and is not used");
    }
    if (count < 3) warn_once("a face of fewer than three vertices is not used");
    errors_at(words_, [&] { builder_.add_face(corners, color, transparency); });
  }
}

bool OffReader::read() {
  read_header();
  read_vertices();
  read_faces();
  if (words_.next_line()) warn_once("text after the last face is not used");
  return face_colors_ || vertex_colors_;
}

}  // namespace

bool read_off(const MeshInput& input, GeometryBuilder& builder) {
  const std::string text = plain_text(input.bytes);
  builder.report.format = "OFF";
  return OffReader(input, text, builder).read();
}

}  // namespace clench
