#include "clench/port/socket.h"

#include <doctest/doctest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "clench/base/error.h"

using namespace clench;

namespace {

void wait_for(int descriptor, short event) {
  pollfd waited{descriptor, event, 0};
  REQUIRE(poll(&waited, 1, 5000) > 0);
}

Stream accept_one(Acceptor& acceptor) {
  wait_for(acceptor.descriptor(), POLLIN);
  auto client = acceptor.accept();
  REQUIRE(client.has_value());
  return std::move(*client);
}

std::string socket_path() { return "/tmp/clench_port_" + std::to_string(getpid()) + ".socket"; }

// a message and its answer
void check_talk(Acceptor& acceptor, Stream client) {
  Stream server = accept_one(acceptor);
  wait_for(client.descriptor(), POLLOUT);
  CHECK(client.connect_error() == 0);
  REQUIRE(client.write("ask") == 3);
  wait_for(server.descriptor(), POLLIN);
  CHECK(server.fill() == 3);
  CHECK(server.take(3) == "ask");
  REQUIRE(server.write("answer") == 6);
  server.close();
  while (client.end() == Stream::End::none) {
    wait_for(client.descriptor(), POLLIN);
    client.fill();
  }
  CHECK(client.take(100) == "answer");
  CHECK(client.end() == Stream::End::closed);
}

}  // namespace

TEST_CASE(
    "clients and servers communicate by TCP, of both address families, and by a Unix socket") {
  for (const HostAddress& host : {HostAddress{"127.0.0.1"}, HostAddress{"::1"}}) {
    if (host.address == "::1" && access("/proc/net/if_inet6", R_OK) != 0) continue;
    Acceptor acceptor = Acceptor::tcp(host, 0);
    CHECK(acceptor.port() > 0);
    CHECK(acceptor.name().ends_with(":" + std::to_string(acceptor.port())));
    CHECK(!acceptor.accept().has_value());
    check_talk(acceptor, begin_connect(host, acceptor.port()));
    check_talk(acceptor, begin_connect(host, acceptor.port()));
  }
  Acceptor acceptor = Acceptor::unix_socket(socket_path());
  check_talk(acceptor, begin_connect_unix(socket_path()));
  struct stat file {};
  REQUIRE(stat(socket_path().c_str(), &file) == 0);
  CHECK((file.st_mode & 0777) == 0600);
  acceptor.close();
  CHECK(access(socket_path().c_str(), F_OK) != 0);
  CHECK(!acceptor.accept().has_value());
}

TEST_CASE("a machine that has gone without a word is noticed within a minute, on both sides") {
  Acceptor acceptor = Acceptor::tcp({"127.0.0.1"}, 0);
  const Stream client = begin_connect({"127.0.0.1"}, acceptor.port());
  const Stream server = accept_one(acceptor);
  for (const Stream* side : {&client, &server}) {
    const auto option = [&](int level, int name) {
      int value = -1;
      socklen_t size = sizeof value;
      REQUIRE(getsockopt(side->descriptor(), level, name, &value, &size) == 0);
      return value;
    };
    CHECK(option(SOL_SOCKET, SO_KEEPALIVE) == 1);
    const int seconds = option(IPPROTO_TCP, TCP_KEEPIDLE) +
                        option(IPPROTO_TCP, TCP_KEEPINTVL) * option(IPPROTO_TCP, TCP_KEEPCNT);
    CHECK(seconds > 0);
    CHECK(seconds <= 60);
  }
}

TEST_CASE("a socket file is replaced if and only if no program listens to it") {
  const std::string path = socket_path();
  {
    Acceptor acceptor = Acceptor::unix_socket(path);
    CHECK_THROWS_WITH_AS(Acceptor::unix_socket(path), (path + ": Address already in use").c_str(),
                         Error);
    REQUIRE(link(path.c_str(), (path + ".kept").c_str()) == 0);
  }
  REQUIRE(rename((path + ".kept").c_str(), path.c_str()) == 0);  // as left by a killed program
  Acceptor::unix_socket(path).close();
  std::ofstream(path) << "a file";
  CHECK_THROWS_AS(Acceptor::unix_socket(path), Error);
  std::string text;
  std::getline(std::ifstream(path), text);
  CHECK(text == "a file");
  unlink(path.c_str());
  CHECK_THROWS_WITH_AS(begin_connect_unix(path), (path + ": No such file or directory").c_str(),
                       Error);
  CHECK_THROWS_AS(begin_connect_unix(std::string(200, 'x')), Error);
}

TEST_CASE("a connection that nobody accepts fails with the system's reason") {
  int port = 0;
  {
    Acceptor acceptor = Acceptor::tcp({"127.0.0.1"}, 0);
    port = acceptor.port();
    CHECK_THROWS_AS(Acceptor::tcp({"127.0.0.1"}, port), Error);
  }
  Stream client = begin_connect({"127.0.0.1"}, port);
  wait_for(client.descriptor(), POLLOUT);
  CHECK(client.connect_error() == ECONNREFUSED);
}

TEST_CASE("hosts are numeric addresses or names") {
  CHECK(resolve("127.0.0.1", true) == std::vector<HostAddress>{{"127.0.0.1"}});
  CHECK(resolve("::1", true) == std::vector<HostAddress>{{"::1"}});
  CHECK(resolve("localhost", true).front() == HostAddress{"127.0.0.1"});
  CHECK(resolve("no host", true).empty());
  CHECK(!resolve("localhost", false).empty());
  CHECK_THROWS_WITH_AS(begin_connect({"no host"}, 1), "no host: expected a numeric address", Error);
  CHECK_THROWS_WITH_AS(begin_connect({"127.0.0.1"}, 0), "127.0.0.1: port must be 1 to 65535, got 0",
                       Error);
  CHECK_THROWS_WITH_AS(Acceptor::tcp({"127.0.0.1"}, 65536),
                       "127.0.0.1: port must be 0 to 65535, got 65536", Error);
}
