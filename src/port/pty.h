// Pseudo-terminals: one side belongs to us, programs open the other one as a serial line.
#pragma once
#include <string>

#include "clench/port/stream.h"

namespace clench {

struct Pty {
  Stream stream;     ///< our side
  std::string path;  ///< path of the other side, which programs open as a serial line
};

/// Opens a pseudo-terminal for raw bytes. The path exists until our side is closed, even if the
/// other side is opened and closed repeatedly.
/// throws  Error if the system has none left
Pty open_pty();

}  // namespace clench
