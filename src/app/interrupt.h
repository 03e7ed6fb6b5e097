// Signals that ask a program to end, Ctrl-C first of all: they interrupt a running script, or a
// line that is being typed.
#pragma once

namespace clench {

class State;

/// From now on Ctrl-C ends no process, except pressed as often as an Interruptible allows while it
/// lives.
void catch_interrupts();
/// The same of SIGTERM and SIGHUP, unless they are ignored, as under nohup.
void catch_endings();

/// Was it pressed since the last time this was asked?
bool take_interrupt();

/// While it lives, these signals interrupt what the state runs.
class Interruptible {
 public:
  /// deadly  the signal that ends the process: 1 is the first
  Interruptible(State& state, int deadly);
  /// Interrupts nothing: the signals are only counted.
  explicit Interruptible(int deadly);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  /// Did a signal come while this has lived?
  bool pressed() const { return signal() != 0; }
  /// The first that came while this has lived; 0: none.
  int signal() const;
};

}  // namespace clench
