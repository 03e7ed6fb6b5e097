#include "clench/dynamics/ode/ode_library.h"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>

#include "clench/base/error.h"

namespace clench {

static thread_local int warnings = 0;

// ODE terminates the program if this returns
[[noreturn]] static void throw_fault(int, const char* message, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, message, arguments);
  fail(ErrorKind::internal, "dynamics: ODE: {}", text);
}

static void count_warning(int, const char*, va_list) { ++warnings; }

void start_ode() {
  static const bool started = [] {
    if (dInitODE2(0) == 0) return false;
    // a host that uses ODE itself may have its own handlers
    if (!dGetErrorHandler()) dSetErrorHandler(throw_fault);
    if (!dGetDebugHandler()) dSetDebugHandler(throw_fault);
    if (!dGetMessageHandler()) dSetMessageHandler(count_warning);
    return true;
  }();
  if (!started || dAllocateODEDataForThread(dAllocateFlagBasicData) == 0)
    fail(ErrorKind::internal, "dynamics: ODE cannot start: out of memory");
}

int take_ode_warnings() {
  const int count = warnings;
  warnings = 0;
  return count;
}

}  // namespace clench
