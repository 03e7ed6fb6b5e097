// NumPy arrays of all shapes, types and orders, stored and compressed.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/grasp_files.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/grasps/zip.h"
#include "clench/io/text/memory_budget.h"
#include "support/folder.h"

using namespace clench;
using namespace clench::test;

namespace {

/// An archive of one array with this header and these bytes.
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

// np.savez_compressed(poses=float16 of 2 x 7), as written by Python 3.11 with zipfile and zlib:
// force_zip64, sizes only in the directory
constexpr const char* packed_poses =
    "504b03042d0000000800000021008dbeaabdffffffffffffffff09001400706f7365732e6e7079010010009c"
    "000000000000005a000000000000009bec17ea1b10c9c850c650ad9e925a9c5ca46ea5a06e9366a4aea3a09e"
    "965f54529498179f5f94920a12774bcc294e058a17672416a402f91a463a0ae69a3a0ab50a64032e060b863d"
    "8c0c0c360c60f0bf3ad494a10128068600504b01022d032d0000000800000021008dbeaabd5a0000009c0000"
    "00090000000000000000000000800100000000706f7365732e6e7079504b0506000000000100010037000000"
    "950000000000";

std::string of_hex(std::string_view hex) {
  std::string out;
  for (size_t i = 0; i + 1 < hex.size(); i += 2)
    out += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return out;
}

size_t entry_of(const std::string& archive) { return archive.rfind("PK\x01\x02"); }

/// The archive with a number replaced in the directory's entry of its last file.
std::string with_field(std::string archive, size_t field, uint32_t x, int bytes = 4) {
  const size_t at = entry_of(archive) + field;
  for (int i = 0; i < bytes; ++i, x >>= 8) archive[at + i] = static_cast<char>(x & 255);
  return archive;
}

// offsets in an entry of the directory
constexpr size_t method_field = 10, flags_field = 8, checksum_field = 16, packed_field = 20,
                 size_field = 24;

NpyArray half_array(const std::vector<uint16_t>& bits) {
  std::string npy = "\x93NUMPY";
  std::string head =
      fmt::format("{{'descr': '<f2', 'fortran_order': False, 'shape': ({},), }}\n", bits.size());
  npy += {'\1', '\0', static_cast<char>(head.size() & 255), static_cast<char>(head.size() >> 8)};
  npy += head;
  for (const uint16_t x : bits) npy += {static_cast<char>(x & 255), static_cast<char>(x >> 8)};
  return read_npz("a.npz", zip_bytes({{"a", npy}}, false)).at("a");
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
    // each number encodes its indices
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

TEST_CASE("invalid shapes are refused, and one without numbers may have any number of rows") {
  const auto refuse = [](const std::string& shape, const std::string& message) {
    CHECK_THROWS_WITH_AS(read_npz("a.npz", archive("<f8", false, shape, "")),
                         ("a.npz: a: " + message).c_str(), Error);
  };
  refuse("(3,)", "the array ends before its shape (3,) does");
  refuse("(3, x)", "expected a shape of whole numbers, got '(3, x)'");
  refuse("(-1, 0)", "expected a shape of whole numbers, got '(-1, 0)'");
  refuse("3", "expected a shape of whole numbers, got '3'");
  const NpyArray none =
      read_npz("a.npz", archive("<f8", false, "(2000000000, 2000000000, 0)", "")).at("a");
  CHECK(none.shape == std::vector<size_t>{2'000'000'000, 2'000'000'000, 0});
  CHECK(none.numbers.empty());
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

TEST_CASE("a compressed archive that Python wrote is read") {
  const NpyArray poses = read_npz("a.npz", of_hex(packed_poses)).at("poses");
  CHECK(poses.shape == std::vector<size_t>{2, 7});
  CHECK(poses.numbers == std::vector<double>{0.5, -1, 0x1p-24, 1, 0, 0, 0, 65504, 0.333251953125,
                                             -0.0, 0.5, 0.5, 0.5, 0.5});
  const TemporaryFolder folder;
  const auto grasps = read_grasp_file(folder.write("g.npz", of_hex(packed_poses)));
  REQUIRE(grasps.size() == 2);
  CHECK(grasps[1].X_OH->position.x() == 65504);
}

TEST_CASE("numbers of 16 bits have the values of IEEE 754") {
  const auto known = half_array({0x3C00, 0xC000, 0x7BFF, 0x0400, 0x0001, 0x03FF, 0x3555, 0x8000});
  CHECK(known.numbers ==
        std::vector<double>{1, -2, 65504, 0x1p-14, 0x1p-24, 1023 * 0x1p-24, 0.333251953125, 0});
  CHECK(std::signbit(known.numbers[7]));
  // all finite values are in ascending order, and their negatives mirror them
  std::vector<uint16_t> up, down;
  for (uint16_t x = 0; x < 0x7C00; ++x) up.push_back(x), down.push_back(x | 0x8000);
  const auto rising = half_array(up).numbers, falling = half_array(down).numbers;
  for (size_t i = 1; i < rising.size(); ++i) {
    CHECK_MESSAGE(rising[i] > rising[i - 1], i);
    CHECK_MESSAGE(falling[i] == -rising[i], i);
  }
  const auto special = half_array({0x7C00, 0xFC00, 0x7E00, 0xFC01}).numbers;
  CHECK(special[0] == INFINITY);
  CHECK(special[1] == -INFINITY);
  CHECK((std::isnan(special[2]) && std::isnan(special[3])));
}

TEST_CASE("arrays come back from compressed archives to the bit, of any size") {
  Random random(5);
  for (const size_t count : {0, 1, 7, 1000, 400'000}) {
    NpyArray array{.shape = {count}};
    for (size_t i = 0; i < count; ++i)
      array.numbers.push_back(i % 3 ? random.normal() : static_cast<double>(i % 7));
    const std::map<std::string, NpyArray> arrays = {
        {"a", array}, {"\u00fcber", {.shape = {2}, .texts = {"x", "yy"}, .is_text = true}}};
    const std::string bytes = npz_bytes(arrays, true);
    CHECK(bytes == npz_bytes(arrays, true));
    CHECK(bytes.size() <= npz_bytes(arrays).size());
    const auto back = read_npz("a.npz", bytes);
    CHECK(back.at("a").numbers == array.numbers);
    CHECK(back.at("\u00fcber").texts == std::vector<std::string>{"x", "yy"});
  }
}

TEST_CASE("broken compressed arrays are refused in a sentence") {
  const std::string good = of_hex(packed_poses);
  const auto refuse = [](const std::string& bytes, const std::string& message) {
    CHECK_THROWS_WITH_AS(read_npz("a.npz", bytes), message.c_str(), Error);
  };
  const std::string wrong = "a.npz: poses: expected {} bytes of compressed data, got others";
  for (const int size : {0, 155, 157})
    refuse(with_field(good, size_field, static_cast<uint32_t>(size)),
           fmt::format(fmt::runtime(wrong), size));
  // the data ends early, or is followed by further bytes
  refuse(with_field(good, packed_field, 0x59), fmt::format(fmt::runtime(wrong), 156));
  refuse(with_field(good, packed_field, 0x5B), fmt::format(fmt::runtime(wrong), 156));
  refuse(with_field(good, checksum_field, 1), "a.npz: poses: the array's checksum is wrong");
  refuse(with_field(good, flags_field, 1, 2), "a.npz: poses: encrypted arrays are not read");
  refuse(with_field(good, method_field, 0, 2),
         "a.npz: poses: a stored array of 156 bytes fills 90");
  // any other change of a byte is detected
  const size_t from = good.find("poses.npy") + 9 + 20;
  for (size_t at = from; at < from + 90; ++at) {
    std::string spoilt = good;
    spoilt[at] ^= 4;
    CHECK_THROWS_AS(read_npz("a.npz", spoilt), Error);
  }
}

TEST_CASE("a compressed list of grasps may take as much memory as it would uncompressed") {
  std::vector<GraspSpec> grasps(20'000);
  Random random(3);
  for (GraspSpec& g : grasps) {
    g.hand_name = "a hand with a long name", g.object_name = "an object with a long name";
    g.X_OH = Pose{{1, 0, 0, 0}, {random.normal(), 0, 0}};
    g.hand_fingerprint = "0123456789abcdef";
  }
  const TemporaryFolder folder;
  const auto plain = folder.path() / "a.npz", packed = folder.path() / "b.npz";
  write_grasp_file(grasps, plain);
  write_grasp_file(grasps, packed, "", {.compress = true});
  CHECK(4 * std::filesystem::file_size(packed) < std::filesystem::file_size(plain));
  const auto back = read_grasp_file(packed);
  REQUIRE(back.size() == grasps.size());
  CHECK(back[19'999].X_OH->position == grasps[19'999].X_OH->position);
  CHECK(back[19'999].hand_fingerprint == grasps[0].hand_fingerprint);
}
