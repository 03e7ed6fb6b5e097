#include <poll.h>
#include <unistd.h>

#include "script_state.h"

using clench::test::Script;

namespace {

struct Pipe {
  Pipe() { REQUIRE(pipe(ends) == 0); }
  ~Pipe() { close_reader(), close_writer(); }
  void close_reader() {
    if (ends[0] >= 0) close(ends[0]);
    ends[0] = -1;
  }
  void close_writer() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
  void write_byte() const { REQUIRE(write(ends[1], "x", 1) == 1); }
  void read_byte() const {
    char byte = 0;
    REQUIRE(read(ends[0], &byte, 1) == 1);
  }
  int ends[2] = {-1, -1};
};

bool is_readable(int descriptor, int milliseconds) {
  pollfd input{descriptor, POLLIN, 0};
  return poll(&input, 1, milliseconds) == 1;
}

}  // namespace

TEST_CASE("the loop calls functions of descriptors, and coroutines wait for them") {
  Script script;
  Pipe pipe;
  const std::string descriptor = std::to_string(pipe.ends[0]);
  CHECK(script.run("loop, calls = clench.loop, 0\n"
                   "watch = loop.on(" +
                   descriptor +
                   ", function() calls = calls + 1 end)\n"
                   "loop.run(0) return calls") == "0");
  pipe.write_byte();
  CHECK(script.run("loop.run(0) loop.run(0) return calls") == "2");
  pipe.read_byte();
  CHECK(script.run("loop.run(0) watch:remove() watch:remove() return calls") == "2");
  pipe.write_byte();
  CHECK(script.run("loop.run(0) return calls") == "2");
  CHECK(script.run("return loop.wait(" + descriptor + ", 1)") == "true");
  pipe.read_byte();
  CHECK(script.run("return loop.wait(" + descriptor + ", 0.01)") == "false");
  const std::string writer = std::to_string(pipe.ends[1]);
  CHECK(script.run("return loop.wait(" + writer + ", 1, 'writable')") == "true");
  CHECK(script.run("return loop.wait(" + writer + ", 0.01, 'readable')") == "false");
  // the end of the other side counts as ready
  CHECK(script.run("ended = false loop.on(" + descriptor + ", function() ended = true end)") == "");
  pipe.close_writer();
  CHECK(script.run("loop.run(0) return ended") == "true");
}

TEST_CASE("an error of a descriptor's function ends the run, and the watch stays") {
  Script script;
  Pipe pipe;
  pipe.write_byte();
  const std::string descriptor = std::to_string(pipe.ends[0]);
  const std::string message = script.run(
      "clench.loop.on(" + descriptor + ", function() error 'in the watch' end) clench.loop.run(1)");
  CHECK(message.find("in the watch") != std::string::npos);
  CHECK(script.run("clench.loop.run(1)").find("in the watch") != std::string::npos);
}

TEST_CASE("a host's own loop polls the descriptor of the script's loop") {
  Script script;
  const int loop = std::stoi(script.run("return clench.loop.descriptor()"));
  CHECK(!is_readable(loop, 0));
  CHECK(script.run("said = 'nothing' clench.loop.spawn(function() clench.loop.sleep(0.05) "
                   "said = 'late' end)") == "");
  CHECK(is_readable(loop, 1000));
  CHECK(script.run("clench.loop.run(0) return said") == "nothing");
  CHECK(!is_readable(loop, 0));
  CHECK(is_readable(loop, 5000));
  CHECK(script.run("clench.loop.run(0) return said") == "late");
  CHECK(!is_readable(loop, 0));
  CHECK(script.run("job = clench.job(function() return 1 end) clench.loop.spawn(function() "
                   "clench.loop.wait(job) said = 'job' end) clench.loop.run(0)") == "");
  for (int i = 0; i < 100 && script.run("return said") != "job"; ++i) {
    CHECK(is_readable(loop, 20000));
    script.run("clench.loop.run(0)");
  }
  CHECK(script.run("return said") == "job");
}
