#include "clench/app/interrupt.h"

#include <csignal>

#include "clench/script/host/state.h"

namespace clench {

// a signal handler has no arguments: what it needs must lie outside
static State* volatile target = nullptr;
static volatile std::sig_atomic_t presses = 0, deadly_press = 0;

static void on_interrupt(int) {
  presses = presses + 1;
  if (!target) return;
  if (presses >= deadly_press) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
  target->interrupt();
}

void catch_interrupts() {
  // without SA_RESTART, so that a key that is being waited for gives up
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

bool take_interrupt() {
  const bool pressed = presses > 0;
  presses = 0;
  return pressed;
}

Interruptible::Interruptible(State& state, int deadly) {
  presses = 0;
  deadly_press = deadly;
  target = &state;
}

bool Interruptible::pressed() const { return presses > 0; }

Interruptible::~Interruptible() {
  target = nullptr;
  presses = 0;
}

}  // namespace clench
