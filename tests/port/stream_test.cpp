#include "clench/port/stream.h"

#include <doctest/doctest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "clench/port/socket.h"

using namespace clench;

namespace {

// fills until the stream contains the given number of bytes, or has ended
void fill_to(Stream& stream, size_t count) {
  while (stream.received().size() < count && stream.end() == Stream::End::none) {
    pollfd input{stream.descriptor(), POLLIN, 0};
    REQUIRE(poll(&input, 1, 5000) > 0);
    stream.fill();
  }
}

}  // namespace

TEST_CASE("a stream returns the bytes in order for any sizes of reads") {
  auto [a, b] = open_pair();
  std::string sent, got;
  uint32_t seed = 1;
  for (int round = 0; round < 200; ++round) {
    std::string piece;
    for (uint32_t i = 0; i < seed % 500; ++i) piece += static_cast<char>(seed >> (i % 24));
    seed = seed * 1664525 + 1013904223;
    size_t done = 0;
    while (done < piece.size()) done += a.write(std::string_view(piece).substr(done));
    sent += piece;
    fill_to(b, std::min<size_t>(1, piece.size()));
    got += b.take(seed % 700);
  }
  a.close();
  while (b.end() == Stream::End::none) b.fill();
  got += b.take(std::string::npos);
  CHECK(got == sent);
  CHECK(b.end() == Stream::End::closed);
  CHECK(b.fill() == 0);
}

TEST_CASE("a delimiter is found across the pieces in which it arrives") {
  auto [a, b] = open_pair();
  std::string sent;
  for (const char* piece : {"=>", " a", "=", "> b=", ">", "=", "> "}) {
    sent += piece;
    REQUIRE(a.write(piece) == std::string_view(piece).size());
    fill_to(b, sent.size());
    CHECK(b.find("=> ") == std::string_view(sent).find("=> "));
    CHECK(b.find(" a") == std::string_view(sent).find(" a"));  // another one in between
    CHECK(b.find("=> b=>=> ") == std::string_view(sent).find("=> b=>=> "));
  }
  CHECK(b.take(3) == "=> ");
  CHECK(b.find("=> ") == 1);
  CHECK(b.find("") == std::string_view::npos);
  CHECK(b.find("zz") == std::string_view::npos);
}

TEST_CASE("a search is linear in the bytes that arrive") {
  auto [a, b] = open_pair();
  const std::string piece(1000, 'x');
  for (int i = 0; i < 2000; ++i) {  // 2 MB: seconds if each search started again from the beginning
    REQUIRE(a.write(piece) == piece.size());
    fill_to(b, 1000 * static_cast<size_t>(i + 1));
    REQUIRE(b.find("\n") == std::string_view::npos);
  }
  CHECK(b.take(2'000'000).size() == 2'000'000);
}

TEST_CASE("a full stream accepts bytes up to its limit and continues after they are read") {
  auto [a, b] = open_pair();
  const std::string bytes(10'000'000, 'y');
  size_t done = a.write(bytes);
  CHECK(done > 0);
  CHECK(done < bytes.size());
  CHECK(a.write(bytes) == 0);
  CHECK(a.end() == Stream::End::none);
  size_t got = 0;
  while (done < bytes.size()) {
    fill_to(b, 1);
    got += b.take(std::string::npos).size();
    done += a.write(std::string_view(bytes).substr(done));
  }
  while (got < bytes.size()) {
    fill_to(b, 1);
    got += b.take(std::string::npos).size();
  }
  CHECK(got == bytes.size());
}

TEST_CASE(
    "bytes that the other side sent before it closed can be read even after a write has failed") {
  auto [a, b] = open_pair();
  REQUIRE(a.write("last words") == 10);
  a.close();
  CHECK(a.end() == Stream::End::closed);
  CHECK(a.descriptor() < 0);
  CHECK(a.write("x") == 0);
  while (b.write_end() == Stream::End::none) b.write("to nobody");
  CHECK(b.write_end() == Stream::End::closed);
  while (b.end() == Stream::End::none) b.fill();
  CHECK(b.take(100) == "last words");
}

TEST_CASE("a side that has ended its output still receives") {
  auto [a, b] = open_pair();
  REQUIRE(a.write("question") == 8);
  REQUIRE(shutdown(a.descriptor(), SHUT_WR) == 0);
  while (b.end() == Stream::End::none) b.fill();
  CHECK(b.take(100) == "question");
  CHECK(b.write_end() == Stream::End::none);
  CHECK(b.write("answer") == 6);
  b.close();
  while (a.end() == Stream::End::none) a.fill();
  CHECK(a.take(100) == "answer");
}
