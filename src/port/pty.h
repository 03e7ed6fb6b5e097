// Pseudo-terminals: a program on one side, what it believes to be a serial line on the other.
#pragma once
#include <string>

#include "clench/port/stream.h"

namespace clench {

struct Pty {
  Stream stream;     ///< our side
  std::string path;  ///< of the other side, which programs open as a serial line
};

/// Opens a pseudo-terminal for raw bytes. The path exists until our side is closed, however often
/// the other side is opened and closed meanwhile.
/// throws  Error when the system has none left
Pty open_pty();

}  // namespace clench
