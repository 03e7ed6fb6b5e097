#include "clench/port/serial.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "clench/base/error.h"
#include "clench/port/pty.h"

using namespace clench;

namespace {

std::string read_line_bytes(Stream& stream, size_t count) {
  while (stream.received().size() < count && stream.end() == Stream::End::none) {
    pollfd input{stream.descriptor(), POLLIN, 0};
    REQUIRE(poll(&input, 1, 5000) > 0);
    stream.fill();
  }
  return stream.take(count);
}

std::string every_byte() {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  return bytes;
}

}  // namespace

TEST_CASE("a serial line carries every byte unchanged, in both directions") {
  Pty pty = open_pty();
  Stream line = open_serial({.path = pty.path, .baud = 115200});
  REQUIRE(line.write(every_byte()) == 256);
  CHECK(read_line_bytes(pty.stream, 256) == every_byte());
  REQUIRE(pty.stream.write(every_byte()) == 256);
  CHECK(read_line_bytes(line, 256) == every_byte());
}

TEST_CASE("a serial line is set to any rate, and gets its own rate back") {
  Pty pty = open_pty();
  const Descriptor witness(::open(pty.path.c_str(), O_RDWR | O_NOCTTY));
  const int before = baud_of(witness.number());
  for (const int baud : {50, 9600, 38400, 57600, 123456, 1'000'000, 4'000'000}) {
    Stream line = open_serial({.path = pty.path, .baud = baud});
    CHECK(baud_of(witness.number()) == baud);
    line.close();
    CHECK(baud_of(witness.number()) == before);
  }
}

TEST_CASE("bytes that a line received before it was opened are dropped") {
  Pty pty = open_pty();
  REQUIRE(pty.stream.write("stale") == 5);
  Stream line = open_serial({.path = pty.path});
  REQUIRE(pty.stream.write("fresh") == 5);
  CHECK(read_line_bytes(line, 5) == "fresh");
}

TEST_CASE(
    "programs can reopen a pseudo-terminal repeatedly, and are disconnected once it is closed") {
  auto pty = std::make_unique<Pty>(open_pty());
  for (int i = 0; i < 3; ++i) {
    Stream line = open_serial({.path = pty->path});
    REQUIRE(line.write("hi") == 2);
    CHECK(read_line_bytes(pty->stream, 2) == "hi");
    line.close();
    CHECK(pty->stream.fill() == 0);
    CHECK(pty->stream.end() == Stream::End::none);
  }
  Stream line = open_serial({.path = pty->path});
  REQUIRE(pty->stream.write("bye") == 3);
  const std::string path = pty->path;
  pty.reset();
  while (line.end() == Stream::End::none) line.fill();
  CHECK(line.end() == Stream::End::unplugged);
  CHECK(line.write("x") == 0);
  CHECK(line.write_end() == Stream::End::unplugged);
  CHECK(!std::filesystem::exists(path));
}

TEST_CASE("faults of serial lines are reported") {
  Pty pty = open_pty();
  const auto fault = [](const SerialOptions& options) -> std::string {
    try {
      open_serial(options);
    } catch (const Error& e) {
      return e.what();
    }
    return "none";
  };
  CHECK(fault({.path = "/dev/no_such_line"}) == "/dev/no_such_line: No such file or directory");
  CHECK(fault({.path = "/dev/null"}).starts_with("/dev/null: expected a serial line: "));
  CHECK(fault({.path = "/dev"}).starts_with("/dev: "));
  CHECK(fault({.path = pty.path, .baud = 0}) == pty.path + ": baud must be > 0, got 0");
  CHECK(fault({.path = pty.path, .data_bits = 9}) ==
        pty.path + ": data_bits must be 5 to 8, got 9");
  CHECK(fault({.path = pty.path, .stop_bits = 3}) ==
        pty.path + ": stop_bits must be 1 or 2, got 3");
  const Stream line = open_serial({.path = pty.path});
  CHECK(fault({.path = pty.path}) == pty.path + ": another process uses this serial line");
  CHECK_THROWS_WITH_AS(baud_of(-1), "serial line: expected a serial line: Bad file descriptor",
                       Error);
}
