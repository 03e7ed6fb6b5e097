#include "clench/io/mesh/ply_header.h"

#include <array>
#include <limits>
#include <utility>

namespace clench {

static PlyType read_type(WordReader& words) {
  static constexpr std::pair<const char*, PlyType> names[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto word = words.word();
  for (const auto& [name, type] : names)
    if (word == name) return type;
  words.fail("expected a type of PLY such as float or uchar, got {}", in_quotes(word));
}

int ply_bytes(PlyType type) {
  static constexpr int bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<int>(type)];
}

bool is_whole(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

int PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

static PlyHeader::Format read_format(WordReader& words) {
  static constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const auto word = words.word();
  for (int i = 0; i < 3; ++i)
    if (word == names[i]) return static_cast<PlyHeader::Format>(i);
  words.fail("expected ascii, binary_little_endian or binary_big_endian, got {}", in_quotes(word));
}

static PlyProperty read_property(WordReader& words) {
  PlyProperty p;
  WordReader ahead = words;
  if (ahead.word() == "list") {
    words.word();
    p.list = true;
    p.count_type = read_type(words);
    if (!is_whole(p.count_type)) words.fail("expected a whole type for the count of a list");
  }
  p.type = read_type(words);
  p.name = words.word();
  if (p.name.empty()) words.fail("expected the name of a property, got nothing");
  return p;
}

PlyHeader read_ply_header(WordReader& words) {
  constexpr size_t max_elements = 100, max_properties = 1000;
  PlyHeader header;
  if (!words.next_line() || words.word() != "ply") words.fail("expected 'ply' in the first line");
  bool format = false;
  while (words.next_line()) {
    const auto keyword = words.word();
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") {
      if (!format) words.fail("expected a line 'format' before end_header");
      return header;
    }
    if (keyword == "format") {
      header.format = read_format(words);
      format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = words.word();
      element.count = words.integer(fmt::format("number of elements {}", in_quotes(element.name)),
                                    0, std::numeric_limits<int>::max());
      if (header.elements.size() == max_elements)
        words.fail("expected at most {} elements", max_elements);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) words.fail("expected an element before its properties");
      auto& properties = header.elements.back().properties;
      if (properties.size() == max_properties)
        words.fail("expected at most {} properties", max_properties);
      properties.push_back(read_property(words));
    } else {
      words.fail("expected a line of a PLY header, got {}", in_quotes(keyword));
    }
  }
  words.fail("expected end_header, got the end of the file");
}

}  // namespace clench
