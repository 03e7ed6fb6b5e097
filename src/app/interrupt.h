// Ctrl-C: interrupts a running script, or a line that is being typed.
#pragma once

namespace clench {

class State;

/// From now on Ctrl-C ends no process, except pressed three times while one call runs.
void catch_interrupts();

/// Was it pressed since the last time this was asked?
bool take_interrupt();

/// While it lives, Ctrl-C interrupts what the state runs.
class Interruptible {
 public:
  explicit Interruptible(State& state);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
};

}  // namespace clench
