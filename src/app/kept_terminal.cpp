#include "clench/app/kept_terminal.h"

#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>

namespace clench {

static constexpr int ending_signals[] = {SIGTERM, SIGHUP, SIGQUIT};

// a signal handler has no arguments: its data must be global
static termios found_terminal;
static volatile std::sig_atomic_t marks = 0;

// also called in a signal handler
static void write_mark(bool on) {
  if (!isatty(STDOUT_FILENO)) return;
  [[maybe_unused]] const auto written =
      ::write(STDOUT_FILENO, on ? "\x1b[?2004h" : "\x1b[?2004l", 8);
}

void mark_pastes(bool on) {
  marks = on;
  write_mark(on);
}

static void on_end(int number) {
  if (marks) write_mark(false);
  // not TCSADRAIN, which would wait for a terminal that may no longer exist
  tcsetattr(STDIN_FILENO, TCSANOW, &found_terminal);
  // the raised signal is delivered when this returns, and then ends the program as if it were not
  // caught
  std::signal(number, SIG_DFL);
  std::raise(number);
}

static void set_handler(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

static void on_stop(int number) {
  const int error = errno;
  termios now;
  const bool known = tcgetattr(STDIN_FILENO, &now) == 0;
  if (marks) write_mark(false);
  tcsetattr(STDIN_FILENO, TCSANOW, &found_terminal);
  set_handler(number, SIG_DFL);
  sigset_t only, before;
  sigemptyset(&only);
  sigaddset(&only, number);
  std::raise(number);
  sigprocmask(SIG_UNBLOCK, &only, &before);  // the process stops here until it is continued
  sigprocmask(SIG_SETMASK, &before, nullptr);
  set_handler(number, on_stop);
  if (known) tcsetattr(STDIN_FILENO, TCSANOW, &now);
  if (marks) write_mark(true);
  errno = error;
}

static void catch_signal(int number, void (*handler)(int), struct sigaction& before) {
  sigaction(number, nullptr, &before);
  // signals ignored by nohup or a shell stay ignored
  if (before.sa_handler != SIG_IGN) set_handler(number, handler);
}

KeptTerminal::KeptTerminal() {
  if (tcgetattr(STDIN_FILENO, &found_terminal) != 0) found_terminal = {};
  for (size_t i = 0; i < std::size(ending_signals); ++i)
    catch_signal(ending_signals[i], on_end, before_[i]);
  catch_signal(SIGTSTP, on_stop, before_[std::size(ending_signals)]);
}

KeptTerminal::~KeptTerminal() {
  for (size_t i = 0; i < std::size(ending_signals); ++i)
    sigaction(ending_signals[i], &before_[i], nullptr);
  sigaction(SIGTSTP, &before_[std::size(ending_signals)], nullptr);
}

SignalsLater::SignalsLater() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : ending_signals) sigaddset(&signals, number);
  sigprocmask(SIG_BLOCK, &signals, &before_);
}

SignalsLater::~SignalsLater() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace clench
