#include "clench/port/pty.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdlib>
#include <memory>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/port/serial.h"

namespace clench {

namespace {

[[noreturn]] void fail_pty() {
  fail(ErrorKind::limit, "no pseudo-terminal can be opened: {}", system_reason(errno));
}

}  // namespace

Pty open_pty() {
  Descriptor ours(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  char path[128];
  if (!ours.is_open() || grantpt(ours.number()) != 0 || unlockpt(ours.number()) != 0 ||
      ptsname_r(ours.number(), path, sizeof path) != 0)
    fail_pty();
  // holding this open prevents our side from ending whenever a program closes the other one
  auto other = std::make_shared<Descriptor>(::open(path, O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!other->is_open()) fail_pty();
  set_line(other->number(), {.path = path});
  ours.set_on_close([other](int) { other->close(); });
  return {Stream(std::move(ours), path), path};
}

}  // namespace clench
