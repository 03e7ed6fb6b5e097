#include "clench/io/text/file_kind.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "clench/base/convert.h"
#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/text/xml.h"

namespace clench {

namespace {

using Format = GeometryFormat;

/// An ending, or the name of a root element.
struct Mark {
  std::string_view text;
  FileKind kind;
  Format format = Format::none;
};

// a Lua file may contain anything; one that is opened as a world must return a world
constexpr Mark known_endings[] = {
    {".wld", FileKind::world},
    {".lua", FileKind::world},
    {".cfg", FileKind::robot},
    {".urdf", FileKind::robot},
    {".xacro", FileKind::robot},
    {".mjcf", FileKind::robot},
    {".egr", FileKind::eigengrasps},
    {".vgr", FileKind::virtual_contacts},
    {".jsonl", FileKind::grasps},
    {".csv", FileKind::grasps},
    {".npz", FileKind::grasps},
    {".yaml", FileKind::grasps},
    {".yml", FileKind::grasps},
    {".json", FileKind::grasps},
    {".iv", FileKind::body, Format::inventor},
    {".wrl", FileKind::body, Format::inventor},
    {".vrml", FileKind::body, Format::inventor},
    {".off", FileKind::body, Format::off},
    {".ply", FileKind::body, Format::ply},
    {".obj", FileKind::body, Format::obj},
    {".stl", FileKind::body, Format::stl},
    {".gltf", FileKind::body, Format::gltf},
    {".glb", FileKind::body, Format::gltf},
    {".dae", FileKind::body, Format::collada},
};

// the root element of a body may have any name
constexpr Mark root_elements[] = {
    {"world", FileKind::world},
    {"robot", FileKind::robot},
    {"mujoco", FileKind::robot},
    {"EigenGrasps", FileKind::eigengrasps},
    {"virtual_contacts", FileKind::virtual_contacts},
};

const Mark* find(std::span<const Mark> marks, std::string_view text) {
  const auto found = std::ranges::find(marks, text, &Mark::text);
  return found == marks.end() ? nullptr : &*found;
}

constexpr size_t max_numbers = 10'000'000;  // limit for files that contain only numbers

/// Consumes numbers one by one; at the end, reads fail.
class Numbers {
 public:
  explicit Numbers(const std::vector<double>& numbers) : numbers_(numbers) {}

  /// A number that is a valid count; otherwise empty.
  std::optional<size_t> count() {
    if (at_ >= numbers_.size()) return {};
    const double x = numbers_[at_++];
    if (!(x >= 0 && x <= 1e6 && x == std::floor(x))) return {};
    return floor_between(x, size_t{0}, size_t{1} << 20);
  }
  void skip(size_t n) { at_ += n; }
  bool used_up() const { return at_ == numbers_.size(); }

 private:
  const std::vector<double>& numbers_;
  size_t at_ = 0;
};

bool is_calibration(Numbers x) {
  const auto dofs = x.count(), sensors = x.count();
  if (!dofs || !sensors || *dofs == 0 || *sensors == 0) return false;
  x.skip(*dofs * *sensors + *dofs);
  return x.used_up();
}

/// placed  true if each contact has a point
bool is_contacts(Numbers x, bool placed) {
  const auto count = x.count();
  for (size_t i = 0; count && i < *count; ++i) {
    const auto edges = x.count();
    if (!edges) return false;
    x.skip(6 * *edges + (placed ? 11 : 8));
  }
  return count && x.used_up();
}

bool is_glove_poses(Numbers x) {
  const auto count = x.count();
  for (size_t i = 0; count && i < *count; ++i) {
    const auto size = x.count();
    if (!size) return false;
    x.skip(1);
    for (int list = 0; list < 3; ++list) {
      const auto flag = x.count();
      if (!flag || *flag > 1) return false;
      x.skip(*flag * *size);
    }
    x.skip(7);
  }
  return count && x.used_up();
}

}  // namespace

std::optional<FileKind> kind_of_numbers(const std::string& text) {
  LineReader lines("", text);
  std::vector<double> numbers;
  std::vector<int> widths;  // count of numbers per line
  while (lines.skip_to_full()) {
    const Line line = lines.next().before('#');
    if (numbers.empty() && line.text().front() == '[')
      return split_words(line.text(), "[],", 7).size() > 6 ? std::optional(FileKind::pregrasps)
                                                           : std::nullopt;
    for (int i = 0; i < line.size(); ++i) {
      if (numbers.size() >= max_numbers) return {};
      const auto value = parse_number(line.word(i));
      // errors further down are left to the reader
      if (!value && widths.empty()) return {};
      numbers.push_back(value.value_or(0));
    }
    widths.push_back(line.size());
  }
  if (widths.empty()) return {};
  if (widths.front() >= 9) return FileKind::planned_grasps;
  if (is_calibration(Numbers(numbers))) return FileKind::glove_calibration;
  if (is_contacts(Numbers(numbers), true) || is_contacts(Numbers(numbers), false))
    return FileKind::object_contacts;
  if (is_glove_poses(Numbers(numbers))) return FileKind::glove_poses;
  // an incomplete list, or one with a surplus number, is recognized by its line lengths
  Numbers counts(numbers);
  if (widths[0] == 2 && widths.size() > 1 && counts.count() && counts.count())
    return FileKind::glove_calibration;
  if (widths[0] != 1 || widths.size() < 3) return {};
  return widths[2] == 6 ? FileKind::object_contacts : FileKind::glove_poses;
}

FileKind file_kind(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".xml") {
    const std::string text = read_text(path);
    const Mark* root = find(root_elements, xml_root_name(text));
    return root ? root->kind : FileKind::body;
  }
  if (const Mark* known = find(known_endings, ending)) return known->kind;
  // all of these lists are complete within this size
  const std::string start = plain_text(read_start(path, size_t{4} << 20));
  if (const auto kind = kind_of_numbers(start)) return *kind;
  // the first line of lists written by Clench, with any file name
  if (start.starts_with('{') &&
      start.substr(0, start.find('\n')).find("clench grasps") != start.npos)
    return FileKind::grasps;
  fail(ErrorKind::file, "{}: expected a model, a world, or a file that goes with one, got {}",
       path.filename().string(), in_quotes(ending));
}

const char* kind_name(FileKind kind) {
  static constexpr const char* names[] = {"body",
                                          "robot",
                                          "world",
                                          "eigengrasps",
                                          "virtual contacts",
                                          "object contacts",
                                          "pre-grasps",
                                          "planned grasps",
                                          "glove calibration",
                                          "glove poses",
                                          "grasps"};
  return names[static_cast<int>(kind)];
}

std::string ending_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

GeometryFormat geometry_format(std::string_view ending) {
  const Mark* known = find(known_endings, ending);
  return known ? known->format : Format::none;
}

bool is_inventor(const std::filesystem::path& path) {
  return geometry_format(ending_of(path)) == Format::inventor;
}

std::vector<std::string> geometry_endings() {
  std::vector<std::string> out;
  for (const Mark& e : known_endings)
    if (e.format != Format::none) out.emplace_back(e.text);
  return out;
}

std::vector<std::string> body_endings() {
  std::vector<std::string> out = geometry_endings();
  out.insert(out.begin(), ".xml");
  return out;
}

std::vector<std::string> endings_of(GeometryFormat format) {
  std::vector<std::string> out;
  for (const Mark& e : known_endings)
    if (e.format == format) out.emplace_back(e.text);
  return out;
}

std::string one_of(const std::vector<std::string>& endings) {
  std::string out;
  for (size_t i = 0; i < endings.size(); ++i)
    out += (i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ") + endings[i];
  return out;
}

}  // namespace clench
