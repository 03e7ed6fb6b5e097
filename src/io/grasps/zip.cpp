#include "clench/io/grasps/zip.h"

#include <zlib.h>

#include <algorithm>

#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/io/text/byte_reader.h"
#include "clench/io/text/byte_writer.h"

namespace clench {

static constexpr uint32_t local_mark = 0x04034b50, entry_mark = 0x02014b50, end_mark = 0x06054b50;
static constexpr int stored = 0, deflated = 8;
static constexpr int raw_window = -15;  // raw deflate data, without header and checksum
static constexpr size_t piece_bytes = size_t{1} << 20;  // between two checks for a request to stop

static uint32_t crc32_of(std::string_view bytes) {
  uLong crc = crc32(0, nullptr, 0);
  for (size_t at = 0; at < bytes.size(); at += piece_bytes) {
    check_stop();
    const std::string_view piece = bytes.substr(at, piece_bytes);
    crc = crc32(crc, reinterpret_cast<const Bytef*>(piece.data()), static_cast<uInt>(piece.size()));
  }
  return static_cast<uint32_t>(crc);
}

namespace {

/// State of zlib, released by the destructor.
struct ZlibStream {
  explicit ZlibStream(int (*end)(z_stream*)) : release(end) {}
  ZlibStream(const ZlibStream&) = delete;
  ~ZlibStream() { release(&state); }

  // zlib does not write through this pointer
  void read_from(std::string_view bytes) {
    state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    state.avail_in = static_cast<uInt>(bytes.size());
  }

  z_stream state{};
  int (*release)(z_stream*);
};

}  // namespace

// --- writing ---

static std::string deflated_bytes(const std::string& contents) {
  ZlibStream stream(deflateEnd);
  constexpr int memory = 8;
  if (deflateInit2(&stream.state, Z_DEFAULT_COMPRESSION, Z_DEFLATED, raw_window, memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    fail("out of memory for compression");
  std::string out(deflateBound(&stream.state, static_cast<uLong>(contents.size())), '\0');
  stream.state.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.state.avail_out = static_cast<uInt>(out.size());
  for (size_t at = 0;; at += piece_bytes) {
    check_stop();
    const bool is_last = contents.size() - at <= piece_bytes;
    stream.read_from(std::string_view(contents).substr(at, piece_bytes));
    const int result = deflate(&stream.state, is_last ? Z_FINISH : Z_NO_FLUSH);
    if (result != (is_last ? Z_STREAM_END : Z_OK))
      fail("an array of {} bytes could not be compressed", contents.size());
    if (is_last) break;
  }
  out.resize(stream.state.total_out);
  return out;
}

/// Fields shared by the header of a file and its entry in the directory: from the version to the
/// lengths of name and extra fields.
static std::string shared_fields(const std::string& name, int method, uint32_t crc, size_t packed,
                                 size_t size) {
  const bool is_plain = std::ranges::all_of(name, [](unsigned char c) { return c < 128; });
  std::string out;
  // version 2.0, a name in UTF-8, January 1, 1980
  for (const int x : {20, is_plain ? 0 : 1 << 11, method, 0, 33})
    append_little_endian(out, static_cast<uint16_t>(x));
  append_little_endian(out, crc);
  for (const size_t x : {packed, size}) append_little_endian(out, static_cast<uint32_t>(x));
  append_little_endian(out, static_cast<uint16_t>(name.size()));
  append_little_endian(out, uint16_t{0});
  return out;
}

std::string zip_bytes(const std::map<std::string, std::string>& files, bool compress) {
  constexpr size_t max_files = 65'000, max_bytes = 0xF0000000U;
  if (files.size() > max_files)
    fail("an .npz holds at most {} arrays, got {}", max_files, files.size());
  std::string out, directory;
  for (const auto& [key, contents] : files) {
    const std::string name = key + ".npy";
    if (out.size() + contents.size() > max_bytes) fail("an .npz holds at most 4 GB of arrays");
    std::string smaller = compress ? deflated_bytes(contents) : "";
    const bool is_smaller = compress && smaller.size() < contents.size();
    const std::string& packed = is_smaller ? smaller : contents;
    const auto place = static_cast<uint32_t>(out.size());
    const std::string fields = shared_fields(name, is_smaller ? deflated : stored,
                                             crc32_of(contents), packed.size(), contents.size());
    append_little_endian(out, local_mark);
    out += fields + name;
    out += packed;
    append_little_endian(directory, entry_mark);
    append_little_endian(directory, uint16_t{20});
    directory += fields;
    for (int i = 0; i < 3; ++i) append_little_endian(directory, uint16_t{0});
    append_little_endian(directory, uint32_t{0});
    append_little_endian(directory, place);
    directory += name;
  }
  const auto start = static_cast<uint32_t>(out.size());
  out += directory;
  append_little_endian(out, end_mark);
  for (const size_t x : {size_t{0}, size_t{0}, files.size(), files.size()})
    append_little_endian(out, static_cast<uint16_t>(x));
  append_little_endian(out, static_cast<uint32_t>(directory.size()));
  append_little_endian(out, start);
  append_little_endian(out, uint16_t{0});
  return out;
}

// --- reading ---

// the end record of the directory: 22 bytes and an optional comment
static size_t end_of_directory(const std::string& archive, std::string_view bytes) {
  for (size_t back = 22; back <= std::min<size_t>(bytes.size(), 22 + 65535); ++back)
    if (ByteReader(bytes.substr(bytes.size() - back)).next<uint32_t>() == end_mark)
      return bytes.size() - back;
  fail("{}: expected a zip archive of arrays, got other bytes", archive);
}

/// The bytes of a file after its header at `place`.
static std::string_view bytes_at(std::string_view bytes, size_t place, size_t count,
                                 const std::string& archive, const std::string& name) {
  ByteReader local(bytes.substr(std::min(place, bytes.size())));
  if (local.left() < 30 || local.next<uint32_t>() != local_mark)
    fail("{}: the archive's directory is broken", archive);
  local.skip(22);
  const size_t skip = size_t{local.next<uint16_t>()} + local.next<uint16_t>();
  if (local.left() < skip || local.left() - skip < count)
    fail("{}: {}: the archive ends within the array", archive, excerpt(name));
  return bytes.substr(place + 30 + skip, count);
}

std::vector<ZipEntry> zip_entries(const std::string& archive, std::string_view bytes) {
  ByteReader tail(bytes.substr(end_of_directory(archive, bytes) + 10));
  const size_t count = tail.next<uint16_t>();
  tail.next<uint32_t>();
  const size_t start = tail.next<uint32_t>();
  std::vector<ZipEntry> out;
  size_t left = bytes.size();  // of the archive for the remaining files
  ByteReader entries(bytes.substr(std::min(start, bytes.size())));
  for (size_t i = 0; i < count; ++i) {
    if (entries.left() < 46 || entries.next<uint32_t>() != entry_mark)
      fail("{}: the archive's directory is broken", archive);
    entries.skip(4);
    const bool is_encrypted = entries.next<uint16_t>() & 1;
    const int method = entries.next<uint16_t>();
    entries.skip(4);
    ZipEntry& entry = out.emplace_back();
    entry.checksum = entries.next<uint32_t>();
    const size_t packed = entries.next<uint32_t>();
    entry.size = entries.next<uint32_t>();
    const size_t name_size = entries.next<uint16_t>(), extra = entries.next<uint16_t>(),
                 comment = entries.next<uint16_t>();
    entries.skip(8);
    const size_t place = entries.next<uint32_t>();
    if (entries.left() < name_size) fail("{}: the archive's directory is broken", archive);
    entry.name = bytes.substr(start + entries.position(), name_size);
    entries.skip(name_size + extra + comment);
    if (entry.name.ends_with(".npy")) entry.name.resize(entry.name.size() - 4);
    entry.is_deflated = method == deflated;
    const auto refuse = [&](const std::string& why) {
      fail("{}: {}: {}", archive, excerpt(entry.name), why);
    };
    if (is_encrypted) refuse("encrypted arrays are not read");
    if (method != stored && method != deflated)
      refuse(fmt::format("expected an array that is stored or deflated, got method {}", method));
    if (method == stored && packed != entry.size)
      refuse(fmt::format("a stored array of {} bytes fills {}", entry.size, packed));
    if (packed > left) refuse("the array shares bytes of the archive with others");
    left -= packed;
    entry.packed = bytes_at(bytes, place, packed, archive, entry.name);
  }
  return out;
}

/// Fills `out`, which is one byte longer, with the contents of a deflated file.
/// returns  true if the size is right and all bytes of the file were used
static bool inflate_into(std::string_view packed, std::string& out) {
  ZlibStream stream(inflateEnd);
  if (inflateInit2(&stream.state, raw_window) != Z_OK) fail("out of memory for compressed arrays");
  stream.read_from(packed);
  size_t done = 0;
  int result = Z_OK;
  while (result == Z_OK && done < out.size()) {
    check_stop();
    const size_t left = std::min(piece_bytes, out.size() - done);
    stream.state.next_out = reinterpret_cast<Bytef*>(out.data() + done);
    stream.state.avail_out = static_cast<uInt>(left);
    result = inflate(&stream.state, Z_NO_FLUSH);
    done += left - stream.state.avail_out;
  }
  return result == Z_STREAM_END && done + 1 == out.size() && stream.state.avail_in == 0;
}

std::string_view Unzipper::contents_of(const ZipEntry& entry, const std::string& place) {
  std::string_view out = entry.packed;
  if (entry.is_deflated) {
    // the buffer is reused for the next file
    if (entry.size > buffer_.capacity()) {
      budget_.take(entry.size - buffer_.capacity());
      std::string().swap(buffer_);
      buffer_.reserve(entry.size + 1);
    }
    buffer_.resize(entry.size + 1);
    if (!inflate_into(entry.packed, buffer_))
      fail("{}: expected {} bytes of compressed data, got others", place, entry.size);
    out = std::string_view(buffer_).substr(0, entry.size);
  }
  if (crc32_of(out) != entry.checksum) fail("{}: the array's checksum is wrong", place);
  return out;
}

}  // namespace clench
