#include "clench/io/mesh/mesh_readers.h"

#include <cmath>
#include <optional>

#include "clench/base/convert.h"
#include "clench/io/mesh/ply_header.h"
#include "clench/io/text/file_errors.h"

namespace clench {

namespace {

/// The values after the header, read one by one in any encoding.
class Values {
 public:
  Values(WordReader words, std::string_view bytes, PlyHeader::Format format)
      : words_(std::move(words)),
        bytes_(bytes, format == PlyHeader::Format::big_endian),
        ascii_(format == PlyHeader::Format::ascii) {}

  /// Starts the next element of the header: errors found from here on concern the complete file.
  void begin_all() { element_ = nullptr; }
  /// `name` and `i` of `count`: the next element, for errors
  void begin(const std::string& name, int i, int count);
  void end();
  double next(NumberType type);
  void skip(NumberType type, int count);
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw PlacedError(place(), fmt::format(format, std::forward<Args>(args)...));
  }
  /// error at the end of the file, if any
  std::optional<Diagnostic> surplus();
  Place place() const;
  int line() const { return ascii_ ? words_.line() : 0; }

 private:
  void need(size_t bytes) const {
    if (bytes_.left() < bytes) fail("expected {} bytes, got the end of the file", bytes);
  }

  WordReader words_;
  ByteReader bytes_;
  bool ascii_, surplus_words_ = false;
  std::optional<Diagnostic> first_surplus_;
  const std::string* element_ = nullptr;
  int i_ = 0, count_ = 0;
};

Place Values::place() const {
  if (!element_) return Place(words_.file());
  if (ascii_) return words_.place();
  return Place(words_.file()).of("{} {} of {}", excerpt(*element_), i_ + 1, count_);
}

void Values::begin(const std::string& name, int i, int count) {
  element_ = &name;
  i_ = i;
  count_ = count;
  if (ascii_ && !words_.next_line())
    words_.fail("expected {} {} of {}, got the end of the file", excerpt(name), i + 1, count);
}

void Values::end() {
  if (!ascii_ || first_surplus_ || words_.words_left() == 0) return;
  first_surplus_ = {place(), fmt::format("text after the values of a {} is not used", *element_)};
}

double Values::next(NumberType type) {
  if (ascii_) {
    const auto word = words_.word();
    const auto value = parse_number(word);
    if (!value) words_.fail("expected a number, got {}", in_quotes(word));
    if (is_whole(type) && *value != std::floor(*value))
      words_.fail("expected a whole number, got {}", *value);
    return *value;
  }
  need(bytes_of(type));
  return bytes_.next(type);
}

void Values::skip(NumberType type, int count) {
  if (!ascii_) {
    const size_t bytes = static_cast<size_t>(count) * bytes_of(type);
    need(bytes);
    bytes_.skip(bytes);
    return;
  }
  for (int i = 0; i < count; ++i)
    if (words_.word().empty()) words_.fail("expected a number, got nothing");
}

std::optional<Diagnostic> Values::surplus() {
  if (first_surplus_) return first_surplus_;
  if (ascii_ && words_.next_line())
    return Diagnostic(place(), "text after the last element is not used");
  if (!ascii_ && bytes_.left() > 0)
    return Diagnostic(Place(words_.file()),
                      fmt::format("{} bytes after the last element are not used", bytes_.left()));
  return {};
}

class PlyReader {
 public:
  PlyReader(Values& values, GeometryBuilder& builder) : values_(values), builder_(builder) {}
  void read_vertices(const PlyElement& element);
  void read_faces(const PlyElement& element, bool strips);
  void step_over(const PlyElement& element);
  bool colored() const { return colored_; }

 private:
  int read_count(const PlyProperty& list);
  void read_indices(const PlyProperty& list);
  void skip(const PlyProperty& property);
  void add_strips(const Eigen::Vector3f& color);
  Eigen::Vector3f mean_color() const;

  Values& values_;
  GeometryBuilder& builder_;
  bool colored_ = false;
  std::vector<Eigen::Vector3f> colors_;  // of vertices, if they have any
  std::vector<int> indices_;             // of the current face
};

/// Index of the color channel (red, green, blue) that the property holds, or -1.
int channel(const PlyProperty& property) {
  static constexpr const char* names[] = {"red", "green", "blue"};
  for (int i = 0; i < 3; ++i)
    if (!property.list &&
        (property.name == names[i] || property.name == std::string("diffuse_") + names[i]))
      return i;
  return -1;
}

float channel_value(double value, NumberType type) {
  const double whole = type == NumberType::uint16 ? 65535 : 255;
  return static_cast<float>(std::clamp(is_whole(type) ? value / whole : value, 0.0, 1.0));
}

void PlyReader::skip(const PlyProperty& property) {
  values_.skip(property.type, property.list ? read_count(property) : 1);
}

int PlyReader::read_count(const PlyProperty& list) {
  const double count = values_.next(list.count_type);
  // every item of a list takes at least one byte, so the size of the file limits their number
  constexpr int most = 1 << 30;
  if (!(count >= 0))
    values_.fail("expected a count of {} from 0 on, got {}", excerpt(list.name), count);
  if (count > most)
    values_.fail("expected a count of {} up to {}, got {}", excerpt(list.name), most, count);
  return floor_int(count);
}

void PlyReader::read_vertices(const PlyElement& element) {
  std::vector<int> axis(element.properties.size(), -1), paint(element.properties.size(), -1);
  const int axes[3] = {element.find("x"), element.find("y"), element.find("z")};
  int channels = 0;
  for (int i = 0; i < 3; ++i) {
    if (axes[i] < 0 || element.properties[axes[i]].list)
      values_.fail("expected x, y and z of every vertex, got none of '{}'", "xyz"[i]);
    axis[axes[i]] = i;
  }
  for (size_t k = 0; k < paint.size(); ++k)
    channels += (paint[k] = channel(element.properties[k])) >= 0;
  if (channels == 3) colored_ = true;
  for (int i = 0; i < element.count; ++i) {
    values_.begin(element.name, i, element.count);
    Eigen::Vector3d p;
    Eigen::Vector3f color;
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (axis[k] >= 0) {
        const double x = p[axis[k]] = values_.next(property.type);
        if (!std::isfinite(x)) values_.fail("expected finite coordinates, got {}", x);
      } else if (channels == 3 && paint[k] >= 0) {
        color[paint[k]] = channel_value(values_.next(property.type), property.type);
      } else {
        skip(property);
      }
    }
    values_.end();
    builder_.add_vertex(p, values_.line());
    if (channels == 3) colors_.push_back(color);
  }
}

void PlyReader::read_indices(const PlyProperty& list) {
  indices_.clear();
  const int count = read_count(list), vertices = static_cast<int>(builder_.vertex_count());
  for (int k = 0; k < count; ++k) {
    const double v = values_.next(list.type);
    if (!(v >= -1 && v < vertices))
      values_.fail("expected a vertex from 0 to {}, got {}", vertices - 1, v);
    indices_.push_back(floor_int(v));
  }
}

Eigen::Vector3f PlyReader::mean_color() const {
  if (colors_.empty() || indices_.empty()) return Appearance().color;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const int v : indices_) sum += colors_[std::max(v, 0)];
  return sum / static_cast<float>(indices_.size());
}

/// Each vertex after the second makes a triangle with the two before; -1 starts a new strip.
void PlyReader::add_strips(const Eigen::Vector3f& color) {
  size_t start = 0;
  for (size_t i = 0; i < indices_.size(); ++i) {
    if (indices_[i] < 0) start = i + 1;
    if (i < start + 2) continue;
    std::array<int, 3> t = {indices_[i - 2], indices_[i - 1], indices_[i]};
    if ((i - start) % 2 == 1) std::swap(t[0], t[1]);
    builder_.add_face(t, color, 0);
  }
}

void PlyReader::read_faces(const PlyElement& element, bool strips) {
  int list = element.find("vertex_indices");
  if (list < 0) list = element.find("vertex_index");
  if (list < 0 || !element.properties[list].list)
    values_.fail("expected a list vertex_indices of every {}, got none", excerpt(element.name));
  std::vector<int> paint(element.properties.size(), -1);
  int channels = 0;
  for (size_t k = 0; k < paint.size(); ++k)
    channels += (paint[k] = channel(element.properties[k])) >= 0;
  if (channels == 3) colored_ = true;
  for (int i = 0; i < element.count; ++i) {
    values_.begin(element.name, i, element.count);
    Eigen::Vector3f color = Appearance().color;
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (static_cast<int>(k) == list)
        read_indices(property);
      else if (channels == 3 && paint[k] >= 0)
        color[paint[k]] = channel_value(values_.next(property.type), property.type);
      else
        skip(property);
    }
    values_.end();
    if (channels != 3) color = mean_color();
    for (const int v : indices_)
      if (v < 0 && !strips) values_.fail("expected a vertex from 0 on, got {}", v);
    errors_at(values_, [&] {
      if (strips)
        add_strips(color);
      else
        builder_.add_face(indices_, color, 0);
    });
  }
}

void PlyReader::step_over(const PlyElement& element) {
  // elements without properties take no bytes, whatever their count
  for (int i = 0; i < element.count && !element.properties.empty(); ++i) {
    values_.begin(element.name, i, element.count);
    for (const PlyProperty& property : element.properties) skip(property);
  }
}

/// Offset of the first value, after the line "end_header".
size_t header_size(std::string_view bytes) {
  size_t at = 0;
  const bool two = without_mark(bytes).starts_with("ply\r\n");
  while (at < bytes.size()) {
    const size_t end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
    const bool last = trim(bytes.substr(at, end - at)) == "end_header";
    at = std::min(end + (two ? 2 : 1), bytes.size());
    if (last) break;
  }
  return at;
}

}  // namespace

bool read_ply(const MeshInput& input, GeometryBuilder& builder) {
  const std::string& bytes = input.bytes;
  const std::string file = input.file();
  const size_t body = header_size(bytes);
  std::string text = plain_text(bytes.substr(0, body));
  WordReader words(file, text);
  const PlyHeader header = read_ply_header(words);
  const bool ascii = header.format == PlyHeader::Format::ascii;
  builder.report.format = ascii ? "ascii PLY" : "binary PLY";
  if (ascii) {
    // move to the same line of the complete text
    const int line = words.line();
    text = plain_text(bytes);
    words = WordReader(file, text);
    while (words.line() < line && words.next_line()) {
    }
  }
  Values values(words, std::string_view(bytes).substr(body), header.format);
  PlyReader reader(values, builder);
  bool vertices = false;
  for (const PlyElement& element : header.elements) {
    const bool faces = element.name == "face", strips = element.name == "tristrips";
    values.begin_all();
    if (element.name == "vertex") {
      if (vertices) values.fail("expected one element vertex, got two");
      reader.read_vertices(element);
      vertices = true;
    } else if (faces || strips) {
      if (!vertices) values.fail("expected the vertices before the faces");
      reader.read_faces(element, strips);
    } else {
      reader.step_over(element);
      if (element.count > 0)
        input.diagnostics().warn(Place(file), "its elements {} are not used",
                                 in_quotes(element.name));
    }
  }
  if (auto surplus = values.surplus()) input.diagnostics().warn(std::move(*surplus));
  return reader.colored();
}

}  // namespace clench
