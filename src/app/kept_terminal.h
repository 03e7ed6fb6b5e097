// Restores the original terminal settings when the program ends while a line is edited.
#pragma once
#include <csignal>

namespace clench {

/// During its lifetime, a signal that ends or stops the program (SIGTERM, SIGHUP, SIGQUIT, SIGTSTP)
/// first restores the terminal; when the program continues, the settings of the line editor are set
/// again. At most one may exist at a time.
class KeptTerminal {
 public:
  KeptTerminal();
  ~KeptTerminal();
  KeptTerminal(const KeptTerminal&) = delete;
  KeptTerminal& operator=(const KeptTerminal&) = delete;

 private:
  struct sigaction before_[4];
};

/// Switches bracketed paste of the terminal on or off; restoring the terminal switches it off.
void mark_pastes(bool on);

/// Blocks signals that end the program during its lifetime, so that no file is left half-written.
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
