// The terminal as it was found, for whatever ends the program while a line is edited.
#pragma once
#include <csignal>

namespace clench {

/// While it lives, a signal that ends or stops the program (SIGTERM, SIGHUP, SIGQUIT, SIGTSTP)
/// gives the terminal back first. A program that goes on has the line editor's again. Of these at
/// most one lives at a time.
class KeptTerminal {
 public:
  KeptTerminal();
  ~KeptTerminal();
  KeptTerminal(const KeptTerminal&) = delete;
  KeptTerminal& operator=(const KeptTerminal&) = delete;

 private:
  struct sigaction before_[4];
};

/// Asks the terminal to put marks around pasted text, or no longer to; what gives it back does so,
/// too.
void mark_pastes(bool on);

/// Signals that end the program wait as long as it lives: no file stays half-written.
class SignalsLater {
 public:
  SignalsLater();
  ~SignalsLater();
  SignalsLater(const SignalsLater&) = delete;
  SignalsLater& operator=(const SignalsLater&) = delete;

 private:
  sigset_t before_;
};

}  // namespace clench
