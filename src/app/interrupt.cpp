#include "clench/app/interrupt.h"

#include <csignal>

#include "clench/script/host/state.h"

namespace clench {

// a signal handler has no arguments: its data must be global
static State* volatile target = nullptr;
static volatile std::sig_atomic_t presses = 0, deadly_press = 0, first_signal = 0;

static void on_interrupt(int signal) {
  if (presses == 0) first_signal = signal;
  presses = presses + 1;
  if (deadly_press > 0 && presses >= deadly_press) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  if (target) target->interrupt();
}

// without SA_RESTART, so that waiting for a key is interrupted
static void catch_signal(int signal) {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

void catch_interrupts() { catch_signal(SIGINT); }

void catch_endings() {
  for (const int signal : {SIGTERM, SIGHUP}) {
    struct sigaction before;
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      catch_signal(signal);
  }
}

bool take_interrupt() {
  const bool pressed = presses > 0;
  presses = 0;
  return pressed;
}

Interruptible::Interruptible(State& state, int deadly) : Interruptible(deadly) { target = &state; }

Interruptible::Interruptible(int deadly) {
  presses = 0;
  deadly_press = deadly;
}

int Interruptible::signal() const { return presses > 0 ? first_signal : 0; }

Interruptible::~Interruptible() {
  target = nullptr;
  presses = 0;
  deadly_press = 0;
}

}  // namespace clench
