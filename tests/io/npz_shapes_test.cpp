// Arrays of NumPy of all shapes, types and orders.
#include <doctest/doctest.h>

#include <cstring>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/grasp_files.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/text/memory_budget.h"
#include "support/folder.h"

using namespace clench;
using namespace clench::test;

namespace {

/// An archive of one array with this head and these bytes.
std::string archive(const std::string& type, bool fortran, const std::string& shape,
                    const std::string& body, const std::string& name = "a") {
  std::string head = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}", type,
                                 fortran ? "True" : "False", shape);
  head.append((64 - (10 + head.size() + 1) % 64) % 64, ' ');
  head += '\n';
  std::string npy = "\x93NUMPY";
  npy += {'\1', '\0', static_cast<char>(head.size() & 255), static_cast<char>(head.size() >> 8)};
  npy += head + body;
  uint32_t crc = ~0U;
  for (const char c : npy) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xEDB88320U ^ (crc >> 1) : crc >> 1;
  }
  crc = ~crc;
  const auto number = [](uint64_t x, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i, x >>= 8) out += static_cast<char>(x & 255);
    return out;
  };
  const std::string fields = number(20, 2) + number(0, 8) + number(crc, 4) + number(npy.size(), 4) +
                             number(npy.size(), 4) + number(name.size() + 4, 2) + number(0, 2);
  const std::string local = number(0x04034b50, 4) + fields + name + ".npy" + npy;
  const std::string entry =
      number(0x02014b50, 4) + number(20, 2) + fields + number(0, 10) + number(0, 4) + name + ".npy";
  return local + entry + number(0x06054b50, 4) + number(0, 4) + number(1, 2) + number(1, 2) +
         number(entry.size(), 4) + number(local.size(), 4) + number(0, 2);
}

std::string shape_text(const std::vector<size_t>& shape) {
  std::string out;
  for (const size_t n : shape) out += fmt::format("{}, ", n);
  if (shape.size() > 1) out.resize(out.size() - 2);
  return "(" + std::string(trim(out)) + ")";
}

template <class T>
std::string bytes_of(const std::vector<double>& numbers, bool big_endian) {
  std::string out;
  for (const double x : numbers) {
    const T value = static_cast<T>(x);
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (size_t i = 0; i < sizeof(T); ++i) out += raw[big_endian ? sizeof(T) - 1 - i : i];
  }
  return out;
}

/// Shapes of up to four indices, each 0, 1 or 3.
std::vector<std::vector<size_t>> shapes() {
  std::vector<std::vector<size_t>> out = {{}};
  for (size_t i = 0; i < out.size(); ++i)
    for (const size_t n : {0, 1, 3})
      if (out[i].size() < 4) {
        auto more = out[i];
        more.push_back(n);
        out.push_back(std::move(more));
      }
  return out;
}

}  // namespace

TEST_CASE("arrays of up to four indices, some of them 0, come back in both orders of bytes") {
  for (const auto& shape : shapes()) {
    CAPTURE(shape_text(shape));
    size_t count = 1;
    for (const size_t n : shape) count *= n;
    std::vector<double> numbers;
    for (size_t i = 0; i < count; ++i) numbers.push_back(static_cast<double>(i + 1));
    const NpyArray written{.shape = shape, .numbers = numbers};
    const NpyArray same = read_npz("a.npz", npz_bytes({{"a", written}})).at("a");
    CHECK(same.shape == shape);
    CHECK(same.numbers == numbers);
    for (const bool big : {false, true}) {
      const std::string order = big ? ">" : "<";
      const auto read = [&](const std::string& type, const std::string& body) {
        const NpyArray array =
            read_npz("a.npz", archive(order + type, false, shape_text(shape), body)).at("a");
        CHECK(array.shape == shape);
        CHECK(array.numbers == numbers);
      };
      read("f8", bytes_of<double>(numbers, big));
      read("f4", bytes_of<float>(numbers, big));
      read("i2", bytes_of<int16_t>(numbers, big));
      read("u8", bytes_of<uint64_t>(numbers, big));
    }
  }
}

TEST_CASE("arrays in the order of Fortran are those in the order of C") {
  for (const auto& shape : shapes()) {
    CAPTURE(shape_text(shape));
    size_t count = 1;
    for (const size_t n : shape) count *= n;
    // each number tells its indices
    std::vector<double> in_c(count), in_fortran(count);
    for (size_t i = 0; i < count; ++i) {
      size_t rest = i, place = 0, stride = count;
      for (const size_t& n : shape) {
        stride /= n;
        const size_t index = rest / stride;
        rest %= stride;
        size_t before = 1;
        for (const size_t& m : shape) {
          if (&m == &n) break;
          before *= m;
        }
        place += index * before;
      }
      in_c[i] = in_fortran[place] = static_cast<double>(i);
    }
    const NpyArray array = read_npz("a.npz", archive("<f8", true, shape_text(shape),
                                                     bytes_of<double>(in_fortran, false)))
                               .at("a");
    CHECK(array.shape == shape);
    CHECK(array.numbers == in_c);
  }
  const std::string letters("a\0\0\0b\0\0\0c\0\0\0d\0\0\0", 16);
  CHECK(read_npz("a.npz", archive("<U1", true, "(2, 2)", letters)).at("a").texts ==
        std::vector<std::string>{"a", "c", "b", "d"});
}

TEST_CASE("shapes that are none, or whose rows take too much memory, are refused") {
  const auto refuse = [](const std::string& shape, const std::string& message) {
    CHECK_THROWS_WITH_AS(read_npz("a.npz", archive("<f8", false, shape, "")),
                         ("a.npz: a: " + message).c_str(), Error);
  };
  refuse("(3,)", "the array ends before its shape (3,) does");
  refuse("(3, x)", "expected a shape of whole numbers, got '(3, x)'");
  refuse("(-1, 0)", "expected a shape of whole numbers, got '(-1, 0)'");
  refuse("3", "expected a shape of whole numbers, got '3'");
  for (const char* shape : {"(2000000000, 0)", "(40000, 40000, 0)", "(2000000000, 2000000000, 0)"})
    CHECK_THROWS_WITH_AS(read_npz("a.npz", archive("<f8", false, shape, "")),
                         doctest::Contains(" rows without numbers, got "), Error);
  std::string many = "(";
  for (int i = 0; i < 33; ++i) many += "1,";
  refuse(many + ")", "expected a shape of at most 32 numbers, got '" + many + ")'");
}

TEST_CASE("a list of grasps without DOFs is written as arrays and read again") {
  const TemporaryFolder folder;
  std::vector<GraspSpec> grasps(1000);
  for (GraspSpec& g : grasps) g.X_OH = Pose{};
  const auto path = folder.path() / "g.npz";
  write_grasp_file(grasps, path);
  const auto same = read_grasp_file(path);
  REQUIRE(same.size() == 1000);
  CHECK(same[999].dofs.empty());
}

TEST_CASE("a list of float32 may take as much memory as the same one of float64") {
  // a grasp takes about a kilobyte, and 28 bytes in the file
  constexpr size_t count = 200'000;
  const std::string row = bytes_of<float>({0, 0, 0, 1, 0, 0, 0}, false);
  std::string body;
  for (size_t i = 0; i < count; ++i) body += row;
  size_t read = 0;
  const TemporaryFolder folder;
  read_grasp_file(
      folder.write("g.npz", archive("<f4", false, fmt::format("({}, 7)", count), body, "poses")),
      {.add = [&](GraspSpec&&) { ++read; }});
  CHECK(read == count);
}
