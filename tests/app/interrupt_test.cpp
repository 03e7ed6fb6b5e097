// Ctrl-C during one long call of each kind ends the command with code 130.
#include <chrono>
#include <fstream>
#include <sstream>

#include "command.h"
#include "support/cases.h"

using clench::test::Folder;
using clench::test::has;

namespace {

// `clench <arguments>`, interrupted after it has worked for a while
class Interrupted {
 public:
  explicit Interrupted(const std::vector<std::string>& arguments) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO), dup2(ends[1], STDERR_FILENO);
      close(ends[0]), close(ends[1]);
      std::vector<char*> words = {const_cast<char*>("clench")};
      for (const auto& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
      words.push_back(nullptr);
      execv(CLENCH_COMMAND, words.data());
      _exit(127);
    }
    close(ends[1]);
    out_ = ends[0];
  }
  ~Interrupted() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    close(out_);
  }
  Interrupted(const Interrupted&) = delete;
  Interrupted& operator=(const Interrupted&) = delete;

  /// Waits until the output contains a word; returns at once for an empty word.
  void wait_for(const std::string& word) {
    while (text_.find(word) == std::string::npos) REQUIRE_MESSAGE(read_some(patience), text_);
  }
  /// Waits until the process has used this much more processor time [s].
  void let_work(double seconds) {
    const double begin = used();
    const auto end = std::chrono::steady_clock::now() + patience;
    while (used() < begin + seconds && std::chrono::steady_clock::now() < end)
      if (!read_some(std::chrono::milliseconds(5)) && ended_) return;
  }
  /// returns  the exit code, once the process has ended; -1 if it does not end
  int interrupt() {
    kill(pid_, SIGINT);
    while (!ended_)
      if (!read_some(patience)) break;
    if (!ended_) return -1;
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  const std::string& text() const { return text_; }

 private:
  static constexpr std::chrono::milliseconds patience{20000};

  // false if no output came in this time, or the process has ended
  bool read_some(std::chrono::milliseconds time) {
    pollfd waiting{out_, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(time.count())) <= 0) return false;
    char buffer[4096];
    const ssize_t count = ::read(out_, buffer, sizeof buffer);
    if (count <= 0) return ended_ = true, false;
    text_.append(buffer, static_cast<size_t>(count));
    return true;
  }
  // user and system time of the process [s]
  double used() const {
    std::ifstream file(fmt::format("/proc/{}/stat", pid_));
    std::string line;
    std::getline(file, line);
    std::istringstream rest(line.substr(std::min(line.rfind(')') + 1, line.size())));
    std::string skipped;
    for (int i = 0; i < 11; ++i) rest >> skipped;
    double user = 0, system = 0;
    rest >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  pid_t pid_ = -1;
  int out_ = -1;
  std::string text_;
  bool ended_ = false;
};

void ends_by_interrupt(const std::vector<std::string>& arguments, const std::string& word = "") {
  Interrupted command(arguments);
  command.wait_for(word);
  command.let_work(0.2);
  const int code = command.interrupt();
  CHECK_MESSAGE(code == 130, "code ", code, ": ", command.text());
}

// a script that prepares a call, prints a line and makes the call
void call_ends_by_interrupt(const std::string& preparation, const std::string& call) {
  ends_by_interrupt(
      {"-q", "-e", preparation + " io.stdout:write('ready') io.stdout:flush() " + call}, "ready");
}

const std::string crowd =
    "local S, w = clench.shapes, clench.world() "
    "w:add_obstacle(S.box {4, 4, 0.1}, {pose = {xyz = {0, 0, -0.05}}}) "
    "for i = 0, 14 do for j = 0, 14 do w:add_object(S.box {0.1, 0.1, 0.1}, {mass = 1, "
    "name = ('b%d %d'):format(i, j), pose = {xyz = {i * 0.10005 - 0.7, j * 0.10005 - 0.7, "
    "0.05005}}}) "
    "end end ";

}  // namespace

TEST_CASE("Ctrl-C ends a step with many contacts") { call_ends_by_interrupt(crowd, "w:run(1000)"); }

TEST_CASE("Ctrl-C ends a step with friction pyramids") {
  call_ends_by_interrupt(crowd + "w.dynamics = {cone = 'pyramid'} ", "w:run(0.02)");
}

TEST_CASE("Ctrl-C ends the measures of a grasp with many contacts") {
  call_ends_by_interrupt(
      "local points = {} for i = 1, 500 do local z = 2 * (i - 0.5) / 500 - 1 "
      "local a, r = 2.4 * i, math.sqrt(1 - z * z) "
      "points[i] = {mu = 0.5, point = {r * math.cos(a), r * math.sin(a), z}, "
      "normal = {-r * math.cos(a), -r * math.sin(a), -z}} end "
      "local space = clench.wrench_space {contacts = points, edges = 150} ",
      "space:epsilon()");
}

TEST_CASE("Ctrl-C ends the contact search of large meshes that lie on each other") {
  call_ends_by_interrupt(
      "local S, w = clench.shapes, clench.world() local ball = S.sphere {0.1, subdivisions = 5} "
      "ball.round = nil "
      "local a = w:add_object(ball) local b = w:add_object(ball, {pose = {xyz = {0, 0, 1e-5}}}) ",
      "for _ = 1, 1000 do w:contacts(a, b) end");
}

TEST_CASE("Ctrl-C ends parallel work") {
  call_ends_by_interrupt(
      "", "clench.parallel.map(function() while true do end end, {1, 2}, {threads = 2})");
}

TEST_CASE("Ctrl-C ends a run of tests") {
  const Folder folder;
  const auto file =
      folder.file("long_test.lua",
                  "require('test')('a long one', function() io.stdout:write('ready\\n') "
                  "io.stdout:flush() while true do end end)\n");
  ends_by_interrupt({"test", file}, "ready");
}

TEST_CASE("Ctrl-C ends the preparation of a search for a hand with many links") {
  const Folder folder;
  std::string text =
      "<robot name=\"r\"><link name=\"l0\"><collision><geometry><box size=\"0.05 0.05 0.05\"/>"
      "</geometry></collision></link>";
  for (int i = 1; i <= 120; ++i)
    text += fmt::format(
        "<link name=\"l{}\"><collision><origin xyz=\"0 0 0.01\"/><geometry><box size=\"0.01 0.01 "
        "0.015\"/></geometry></collision></link><joint name=\"j{}\" type=\"revolute\"><parent "
        "link=\"l{}\"/><child link=\"l{}\"/><origin xyz=\"{} 0 0.02\"/><axis xyz=\"0 1 0\"/>"
        "<limit lower=\"-0.5\" upper=\"0.5\" effort=\"1\" velocity=\"1\"/></joint>",
        i, i, i % 30 == 1 ? 0 : i - 1, i, i % 30 == 1 ? 0.02 * (i / 30) : 0);
  const auto hand = folder.file("hand.urdf", text + "</robot>");
  ends_by_interrupt({"-q", "plan", hand, "models/objects/flask.iv", "--no-verify"});
}
