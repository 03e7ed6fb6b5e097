#include "clench/io/grasps/npz.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "clench/base/text.h"
#include "clench/io/grasps/zip.h"
#include "clench/io/text/byte_reader.h"
#include "clench/io/text/byte_writer.h"
#include "clench/io/text/memory_budget.h"

namespace clench {

static constexpr size_t max_indices = 32;  // limit of NumPy
static constexpr std::string_view npy_mark = "\x93NUMPY";

static std::string npy_bytes(const NpyArray& array) {
  std::string body, type = "<f8";
  if (array.is_text) {
    std::vector<std::u32string> words;
    size_t longest = 1;
    for (const auto& text : array.texts) {
      words.push_back(letters_of(text, true));
      longest = std::max(longest, words.back().size());
    }
    type = fmt::format("<U{}", longest);
    for (auto& word : words) {
      word.resize(longest, 0);
      for (const char32_t letter : word) append_little_endian(body, uint32_t{letter});
    }
  } else {
    for (const double x : array.numbers) append_little_endian(body, x);
  }
  std::string shape;
  for (const size_t n : array.shape) shape += fmt::format("{}, ", n);
  if (array.shape.size() > 1) shape.resize(shape.size() - 2);
  std::string head =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, trim(shape));
  head.append((64 - (10 + head.size() + 1) % 64) % 64, ' ');
  head += '\n';
  std::string out(npy_mark);
  out += {'\1', '\0'};
  append_little_endian(out, static_cast<uint16_t>(head.size()));
  return out + head + body;
}

std::string npz_bytes(const std::map<std::string, NpyArray>& arrays, bool compress) {
  std::map<std::string, std::string> files;
  for (const auto& [name, array] : arrays) files[name] = npy_bytes(array);
  return zip_bytes(files, compress);
}

// --- reading ---

template <class T>
static double next_number(ByteReader& reader) {
  return static_cast<double>(reader.next<T>());
}

/// source  IEEE 754-2019, table 3.5: binary16, with 5 bits of exponent and 10 of fraction
static double next_half(ByteReader& reader) {
  const auto bits = reader.next<uint16_t>();
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double size = exponent == 31  ? (fraction ? NAN : INFINITY)
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -size : size;
}

static double read_number(ByteReader& reader, char kind, size_t size) {
  if (kind == 'f' && size == 2) return next_half(reader);
  if (kind == 'f') return size == 4 ? next_number<float>(reader) : next_number<double>(reader);
  if (kind == 'b' || (kind == 'u' && size == 1)) return next_number<uint8_t>(reader);
  if (kind == 'i')
    return size == 1   ? next_number<int8_t>(reader)
           : size == 2 ? next_number<int16_t>(reader)
           : size == 4 ? next_number<int32_t>(reader)
                       : next_number<int64_t>(reader);
  return size == 2   ? next_number<uint16_t>(reader)
         : size == 4 ? next_number<uint32_t>(reader)
                     : next_number<uint64_t>(reader);
}

// value of 'key': in the header, up to the comma that ends it
static std::string_view head_value(std::string_view head, std::string_view key) {
  const size_t at = head.find(key);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = trim(head.substr(at + key.size()));
  const char open = rest.empty() ? '\0' : rest[0];
  const size_t end = open == '(' ? rest.find(')') : rest.find_first_of(",}");
  return end == std::string_view::npos ? std::string_view()
                                       : rest.substr(0, open == '(' ? end + 1 : end);
}

static std::vector<size_t> read_shape(const std::string& place, std::string_view shape) {
  std::vector<size_t> out;
  if (shape.size() < 2 || shape.front() != '(')
    fail("{}: expected a shape of whole numbers, got {}", place, in_quotes(shape));
  for (const auto word : split_words(shape.substr(1, shape.size() - 2), ",")) {
    const auto n = parse_integer(word);
    if (!n || *n < 0)
      fail("{}: expected a shape of whole numbers, got {}", place, in_quotes(shape));
    if (out.size() == max_indices)
      fail("{}: expected a shape of at most {} numbers, got {}", place, max_indices,
           in_quotes(shape));
    out.push_back(static_cast<size_t>(*n));
  }
  return out;
}

/// Number of elements of an array with this shape; `bytes` + 1 if there are more.
static size_t count_of(const std::vector<size_t>& shape, size_t bytes) {
  if (std::ranges::find(shape, size_t{0}) != shape.end()) return 0;
  size_t count = 1;
  for (const size_t n : shape) {
    if (count > bytes / n) return bytes + 1;
    count *= n;
  }
  return count;
}

/// Reorders an array stored in Fortran order, in which the first index varies fastest.
static void make_last_index_fastest(NpyArray& array, MemoryBudget& budget) {
  const size_t count = array.is_text ? array.texts.size() : array.numbers.size();
  if (count == 0 || array.shape.size() < 2) return;
  const size_t indices = array.shape.size();
  // distances in the file between neighbors along each index
  std::vector<size_t> strides(indices, 1), index(indices, 0);
  for (size_t k = 1; k < indices; ++k) strides[k] = strides[k - 1] * array.shape[k - 1];
  budget.take(count * (array.is_text ? sizeof(std::string) : sizeof(double)));
  NpyArray out{.shape = array.shape, .is_text = array.is_text};
  out.numbers.reserve(array.numbers.size());
  out.texts.reserve(array.texts.size());
  size_t from = 0;
  for (size_t i = 0; i < count; ++i) {
    if (array.is_text)
      out.texts.push_back(std::move(array.texts[from]));
    else
      out.numbers.push_back(array.numbers[from]);
    for (size_t k = indices; k-- > 0;) {
      from += strides[k];
      if (++index[k] < array.shape[k]) break;
      from -= strides[k] * index[k];
      index[k] = 0;
    }
  }
  array = std::move(out);
}

static NpyArray read_npy(const std::string& place, std::string_view bytes, MemoryBudget& budget) {
  if (bytes.size() < 12 || !bytes.starts_with(npy_mark))
    fail("{}: expected an array of NumPy, got other bytes", place);
  const int version = bytes[6];
  ByteReader lengths(bytes.substr(8));
  const size_t size = version == 1 ? lengths.next<uint16_t>() : lengths.next<uint32_t>();
  const size_t from = version == 1 ? 10 : 12;
  if (bytes.size() < from + size)
    fail("{}: expected a head of {} bytes, got {}", place, size, bytes.size() - from);
  const std::string_view head = bytes.substr(from, size);
  std::string_view type = head_value(head, "'descr':");
  const std::string_view order = head_value(head, "'fortran_order':"),
                         shape = head_value(head, "'shape':");
  if (type.size() < 5 || type.front() != '\'' || shape.empty())
    fail("{}: expected a head with type and shape, got {}", place, in_quotes(head));
  type = trim(type.substr(1, type.size() - 2));
  if (order != "False" && order != "True")
    fail("{}: expected a head with 'fortran_order' True or False, got {}", place, in_quotes(order));
  NpyArray out;
  out.shape = read_shape(place, shape);
  const size_t count = count_of(out.shape, bytes.size());
  const char kind = type.size() > 1 ? type[1] : '\0';
  const auto width = parse_integer(type.substr(std::min<size_t>(2, type.size())));
  const bool number = (kind == 'f' && width && (*width == 2 || *width == 4 || *width == 8)) ||
                      (kind == 'b' && width == 1) ||
                      ((kind == 'i' || kind == 'u') && width &&
                       (*width == 1 || *width == 2 || *width == 4 || *width == 8));
  if (!number && !(kind == 'U' && width && *width >= 0 && *width < 100000))
    fail("{}: expected numbers or texts, got the type {}", place, in_quotes(type));
  ByteReader reader(bytes.substr(from + size), type[0] == '>');
  const size_t each = kind == 'U' ? 4 * static_cast<size_t>(*width) : static_cast<size_t>(*width);
  if (each > 0 ? reader.left() / each < count : count > 0)
    fail("{}: the array ends before its shape {} does", place, excerpt(shape));
  out.is_text = kind == 'U';
  budget.take(count * (out.is_text ? sizeof(std::string) + each : sizeof(double)));
  if (out.is_text)
    out.texts.reserve(count);
  else
    out.numbers.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    if (!out.is_text) {
      out.numbers.push_back(read_number(reader, kind, each));
      continue;
    }
    std::string& text = out.texts.emplace_back();
    for (int k = 0; k < *width; ++k)
      if (const auto code = reader.next<uint32_t>(); code > 0 && code < 0x110000)
        text += text_of(std::u32string(1, code));
  }
  if (order == "True") make_last_index_fastest(out, budget);
  return out;
}

std::map<std::string, NpyArray> read_npz(const std::string& file, std::string_view bytes) {
  std::map<std::string, NpyArray> out;
  MemoryBudget budget(file, bytes.size());
  Unzipper unzip(budget);
  for (const ZipEntry& entry : zip_entries(file, bytes)) {
    const std::string where = fmt::format("{}: {}", file, excerpt(entry.name));
    if (!out.try_emplace(entry.name, read_npy(where, unzip.contents_of(entry, where), budget))
             .second)
      fail("{}: the archive holds two arrays of that name", where);
  }
  return out;
}

}  // namespace clench
