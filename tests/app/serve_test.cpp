// `clench serve`: a port, a socket, and the signals that end it.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "background.h"
#include "command.h"

using namespace clench::test;

namespace {

// replies to some lines, read until the server has sent the given number
std::string ask_port(int port, const std::string& text, int lines) {
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  REQUIRE(write(client, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  std::string reply;
  char byte = 0;
  while (lines > 0 && read(client, &byte, 1) == 1) {
    reply += byte;
    if (byte == '\n') --lines;
  }
  close(client);
  return reply;
}

}  // namespace

TEST_CASE("a world is served until a signal ends it") {
  for (const int signal : {SIGTERM, SIGINT}) {
    Background server("serve worlds/barrett_mug.wld --root . --port 0");
    CHECK(has(server.line(), "worlds/barrett_mug.wld is served at 127.0.0.1:"));
    CHECK(ask_port(server.port(), "getRobotName ALL\n", 2) == "1\nbarrett\n");
    CHECK(server.end(signal) == 0);
  }
}

TEST_CASE("the token of a server is kept in a file of its user while it runs") {
  const Folder folder;
  const std::string file = folder / "token";
  Background server("serve worlds/barrett_mug.wld --root . --port 0 --token-file " + file);
  struct stat found {};
  for (int i = 0; i < 500 && stat(file.c_str(), &found) != 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(stat(file.c_str(), &found) == 0);
  CHECK((found.st_mode & 0777) == 0600);
  std::string token;
  std::getline(std::ifstream(file) >> std::ws, token);
  CHECK(token.size() == 48);
  const auto hello = [&](const std::string& with) {
    const char* form = R"({{"jsonrpc":"2.0","id":1,"method":"hello","params":{{"token":"{}"}}}})";
    return ask_port(server.port(), fmt::format(fmt::runtime(form), with) + "\n", 1);
  };
  CHECK(has(hello(token), "\"result\""));
  CHECK(has(hello(std::string(48, '0')), "\"error\""));
  CHECK(server.end(SIGTERM) == 0);
  CHECK(stat(file.c_str(), &found) != 0);
}

TEST_CASE("clench serve reports faults of its options") {
  CHECK(run("serve").code == 2);
  CHECK(run("serve worlds/barrett_mug.wld --port 70000").code == 2);
  const Outcome missing = run("serve no_such.wld --port 0");
  CHECK(missing.code == 1);
  CHECK(has(missing.out, "clench serve: "));
  CHECK(has(missing.out, "no such file"));
  Background server("serve worlds/barrett_mug.wld --root . --port 0");
  const Outcome second =
      run(fmt::format("serve worlds/barrett_mug.wld --root . --port {}", server.port()));
  CHECK(second.code == 1);
  CHECK(has(second.out, "Address already in use"));
}

TEST_CASE("a program that starts a server may use it through standard input and output") {
  const std::string requests =
      "{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"world.hash\"}\n"
      "{\"jsonrpc\":\"2.0\",\"id\":2,\"method\":\"hello\"}\n"
      "{\"jsonrpc\":\"2.0\",\"id\":3,\"method\":\"get\",\"params\":{\"fields\":[\"time\"]}}\n"
      "getRobotName ALL\n";
  const Folder folder;
  const std::string file = folder.file("requests", requests);
  const std::string command = fmt::format(
      "cat {} | {} serve worlds/barrett_mug.wld --root . --stdio", file, CLENCH_COMMAND);
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string out;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, count);
  CHECK(pclose(pipe) == 0);
  std::vector<std::string> lines;
  for (size_t at = 0, end = 0; (end = out.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(out.substr(at, end - at));
  REQUIRE(lines.size() == 4);
  CHECK(has(lines[0], "\"code\":-32001"));
  CHECK(has(lines[1], "\"protocol\":1"));
  CHECK(has(lines[2], "\"result\":{\"time\":0.0}"));
  CHECK(has(lines[3], "\"code\":-32700"));
}
