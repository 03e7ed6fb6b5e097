// The command in the background.
#pragma once
#include "command.h"

namespace clench::test {

/// `clench <arguments>`, running, with its output. It is killed when the object ends.
class Background {
 public:
  explicit Background(const std::string& arguments) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], 1);
      dup2(ends[1], 2);
      close(ends[0]);
      execl("/bin/sh", "sh", "-c", fmt::format("exec {} {}", CLENCH_COMMAND, arguments).c_str(),
            nullptr);
      _exit(127);
    }
    close(ends[1]);
    output_ = ends[0];
    char byte = 0;
    while (read(output_, &byte, 1) == 1 && byte != '\n') line_ += byte;
  }
  ~Background() {
    if (process_ > 0) end(SIGKILL);
    close(output_);
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// The first line of the output.
  const std::string& line() const { return line_; }
  /// The number at its end, after a colon.
  int port() const { return std::atoi(line_.c_str() + line_.rfind(':') + 1); }

  /// The output after the first line, once the process ends.
  std::string rest() {
    std::string text;
    char buffer[4096];
    ssize_t count = 0;
    while ((count = read(output_, buffer, sizeof buffer)) > 0)
      text.append(buffer, static_cast<size_t>(count));
    return text;
  }

  /// The exit code after a signal, or minus the signal that ended it.
  int end(int signal) {
    kill(process_, signal);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t process_ = 0;
  int output_ = -1;
  std::string line_;
};

}  // namespace clench::test
