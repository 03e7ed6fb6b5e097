// Header of a PLY file: its elements and properties, and the encoding of the values.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/byte_reader.h"
#include "clench/io/text/word_reader.h"

namespace clench {

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::float32;
  bool list = false;
  NumberType count_type = NumberType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  int count = 0;
  std::vector<PlyProperty> properties;
  int find(std::string_view property) const;  ///< -1: none
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian } format = Format::ascii;
  std::vector<PlyElement> elements;
};

bool is_whole(NumberType type);

/// Reads the lines from "ply" to "end_header".
/// throws Error  "part.ply:3: expected ascii, binary_little_endian or binary_big_endian, got 'x'"
PlyHeader read_ply_header(WordReader& words);

}  // namespace clench
