#include "clench/port/serial.h"

// not termios.h, whose rates are a fixed list and whose types have the same names
#include <asm/termbits.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <cerrno>

#include "clench/base/error.h"
#include "clench/base/file.h"

namespace clench {

namespace {

void check_serial(const SerialOptions& o) {
  if (o.baud <= 0) fail("{}: baud must be > 0, got {}", o.path, o.baud);
  if (o.data_bits < 5 || o.data_bits > 8)
    fail("{}: data_bits must be 5 to 8, got {}", o.path, o.data_bits);
  if (o.stop_bits < 1 || o.stop_bits > 2)
    fail("{}: stop_bits must be 1 or 2, got {}", o.path, o.stop_bits);
}

termios2 settings_of(int descriptor, const std::string& path) {
  termios2 settings{};
  if (ioctl(descriptor, TCGETS2, &settings) != 0)
    fail(ErrorKind::file, "{}: expected a serial line: {}", path, system_reason(errno));
  return settings;
}

void make_raw(termios2& s, const SerialOptions& o) {
  constexpr tcflag_t sizes[] = {CS5, CS6, CS7, CS8};
  s.c_iflag = o.flow == FlowControl::software ? IXON | IXOFF : 0;
  if (o.parity != Parity::none) s.c_iflag |= INPCK;
  s.c_oflag = 0;
  s.c_lflag = 0;
  s.c_cflag = CREAD | CLOCAL | sizes[o.data_bits - 5] | BOTHER | (BOTHER << IBSHIFT);
  if (o.stop_bits == 2) s.c_cflag |= CSTOPB;
  if (o.parity != Parity::none) s.c_cflag |= PARENB;
  if (o.parity == Parity::odd) s.c_cflag |= PARODD;
  if (o.flow == FlowControl::hardware) s.c_cflag |= CRTSCTS;
  s.c_ispeed = s.c_ospeed = static_cast<speed_t>(o.baud);
  s.c_cc[VMIN] = 1;
  s.c_cc[VTIME] = 0;
}

}  // namespace

void set_line(int descriptor, const SerialOptions& options) {
  check_serial(options);
  termios2 settings = settings_of(descriptor, options.path);
  make_raw(settings, options);
  if (ioctl(descriptor, TCSETS2, &settings) != 0)
    fail(ErrorKind::file, "{}: {} baud is rejected: {}", options.path, options.baud,
         system_reason(errno));
}

int baud_of(int descriptor) {
  return static_cast<int>(settings_of(descriptor, "serial line").c_ospeed);
}

Stream open_serial(const SerialOptions& options) {
  check_serial(options);
  // without O_NONBLOCK a line that waits for its carrier would block here
  Descriptor line(::open(options.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!line.is_open()) fail(ErrorKind::file, "{}: {}", options.path, system_reason(errno));
  const termios2 before = settings_of(line.number(), options.path);
  if (flock(line.number(), LOCK_EX | LOCK_NB) != 0)
    fail(ErrorKind::file, "{}: another process uses this serial line", options.path);
  set_line(line.number(), options);
  ioctl(line.number(), TCFLSH, TCIFLUSH);
  line.set_on_close([before](int number) { ioctl(number, TCSETS2, &before); });
  return Stream(std::move(line), options.path);
}

}  // namespace clench
