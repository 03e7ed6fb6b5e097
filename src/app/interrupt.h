// Ctrl-C: interrupts a running script, or a line that is being typed.
#pragma once

namespace clench {

class State;

/// From now on Ctrl-C ends no process, except pressed as often as an Interruptible allows while it
/// lives.
void catch_interrupts();

/// Was it pressed since the last time this was asked?
bool take_interrupt();

/// While it lives, Ctrl-C interrupts what the state runs.
class Interruptible {
 public:
  /// deadly  the press that ends the process
  Interruptible(State& state, int deadly);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  /// Was it pressed while this has lived?
  bool pressed() const;
};

}  // namespace clench
