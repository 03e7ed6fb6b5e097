// Runs the command as a user does, with and without a terminal.
#pragma once
#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/folder.h"

namespace clench::test {

namespace fs = std::filesystem;

/// A temporary folder whose paths are inserted into commands.
class Folder {
 public:
  /// writes a file, returns its path
  std::string file(const std::string& name, const std::string& text) const {
    return folder_.write(name, text).string();
  }
  std::string operator/(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  TemporaryFolder folder_;
};

inline bool has(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) MESSAGE("expected '", part, "' in: ", text.substr(0, 1000));
  return found;
}

struct Outcome {
  int code = -1;
  std::string out;  ///< stdout and stderr
};

/// Runs `<before> clench <arguments>` in a shell, with a text as its input.
inline Outcome run(const std::string& arguments, const std::string& input = "",
                   const std::string& before = "") {
  const Folder folder;
  const std::string in = folder.file("input", input);
  FILE* pipe =
      popen(fmt::format("{} {} {} 2>&1 < {}", before, CLENCH_COMMAND, arguments, in).c_str(), "r");
  Outcome outcome;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe))
    outcome.out.append(buffer, count);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  return outcome;
}

/// `clench <arguments>` on a terminal, with a temporary home folder.
class Terminal {
 public:
  explicit Terminal(const Folder& home, const std::string& verb = "repl") {
    pid_ = forkpty(&fd_, nullptr, nullptr, nullptr);
    if (pid_ != 0) return;
    if (chdir((home / ".").c_str()) != 0) _exit(127);
    setenv("HOME", (home / ".").c_str(), 1);
    setenv("TERM", "xterm", 1);
    unsetenv("XDG_STATE_HOME");
    execl(CLENCH_COMMAND, "clench", verb.c_str(), nullptr);
    _exit(127);
  }
  ~Terminal() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    close(fd_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& keys) {
    REQUIRE(write(fd_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
  }

  /// Types a line and waits until the terminal echoes its end: keys typed while a chunk runs may be
  /// lost.
  void enter(const std::string& line) {
    type(line + "\n");
    wait_for("\r\n");
  }

  /// Reads until the text appears, and discards the output up to its end.
  /// returns  the output before the text; fails the test if the text does not appear
  std::string wait_for(const std::string& text) {
    for (;;) {
      const size_t at = rest_.find(text);
      if (at != std::string::npos) {
        const std::string seen = rest_.substr(0, at + text.size());
        rest_.erase(0, at + text.size());
        return seen;
      }
      if (!read_some()) FAIL("waited for '", text, "', saw: ", rest_);
    }
  }

  /// Sends a signal, and waits until it has ended the process.
  struct End {
    int code;
    bool cooked;  ///< whether the terminal edits lines and echoes again, as before the start
  };
  End end_by(int signal) {
    // while open, it keeps its settings after the process has ended
    const int terminal = open(ptsname(fd_), O_RDWR | O_NOCTTY);
    kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    termios now = {};
    const bool known = tcgetattr(terminal, &now) == 0;
    close(terminal);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status),
            known && (now.c_lflag & ICANON) && (now.c_lflag & ECHO)};
  }
  pid_t process() const { return pid_; }
  bool is_raw() const {
    termios now = {};
    return tcgetattr(fd_, &now) == 0 && !(now.c_lflag & ICANON);
  }

  /// The exit code, once the process ends.
  int wait_for_end() {
    while (read_some()) {
    }
    int status = 0;
    kill(pid_, ended_ ? 0 : SIGKILL);
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

 private:
  // false if the process has ended or prints nothing for long
  bool read_some() {
    pollfd waiting{fd_, POLLIN, 0};
    if (poll(&waiting, 1, 20000) <= 0) return false;
    char buffer[1024];
    const ssize_t count = ::read(fd_, buffer, sizeof buffer);
    ended_ = count <= 0;
    if (!ended_) rest_.append(buffer, static_cast<size_t>(count));
    return !ended_;
  }

  int fd_ = -1;
  pid_t pid_ = -1;
  bool ended_ = false;
  std::string rest_;
};

}  // namespace clench::test
