// Signals that request the end of a program, such as Ctrl-C: they interrupt a running script, or
// the line that is being typed.
#pragma once

namespace clench {

class State;

/// From now on Ctrl-C does not end the process, unless it is pressed as often as an Interruptible
/// permits during its lifetime.
void catch_interrupts();
/// The same for SIGTERM and SIGHUP, unless they are ignored, as under nohup.
void catch_endings();

/// Was it pressed since the last call?
bool take_interrupt();

/// During its lifetime, these signals interrupt the running code of the state.
class Interruptible {
 public:
  /// deadly  number of the signal that ends the process: 1 is the first
  Interruptible(State& state, int deadly);
  /// Interrupts nothing: the signals are only counted.
  explicit Interruptible(int deadly);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  /// Has a signal arrived during its lifetime?
  bool pressed() const { return signal() != 0; }
  /// The first signal that arrived during its lifetime; 0: none.
  int signal() const;
};

}  // namespace clench
