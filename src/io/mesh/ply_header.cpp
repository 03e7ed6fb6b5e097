#include "clench/io/mesh/ply_header.h"

#include <array>
#include <limits>
#include <utility>

namespace clench {

static NumberType read_type(WordReader& words) {
  static constexpr std::pair<const char*, NumberType> names[] = {
      {"char", NumberType::int8},      {"int8", NumberType::int8},
      {"uchar", NumberType::uint8},    {"uint8", NumberType::uint8},
      {"short", NumberType::int16},    {"int16", NumberType::int16},
      {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},
      {"int", NumberType::int32},      {"int32", NumberType::int32},
      {"uint", NumberType::uint32},    {"uint32", NumberType::uint32},
      {"float", NumberType::float32},  {"float32", NumberType::float32},
      {"double", NumberType::float64}, {"float64", NumberType::float64}};
  const auto word = words.word();
  for (const auto& [name, type] : names)
    if (word == name) return type;
  words.fail("expected a type of PLY such as float or uchar, got {}", in_quotes(word));
}

bool is_whole(NumberType type) {
  return type != NumberType::float32 && type != NumberType::float64;
}

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
