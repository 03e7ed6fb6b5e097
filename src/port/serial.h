// Serial lines.
#pragma once
#include <string>

#include "clench/port/stream.h"

namespace clench {

enum class Parity { none, even, odd };
enum class FlowControl { none, hardware, software };

struct SerialOptions {
  std::string path;   ///< "/dev/ttyUSB0"
  int baud = 9600;    ///< any rate that the device accepts, > 0 [bit/s]
  int data_bits = 8;  ///< 5 to 8
  int stop_bits = 1;  ///< 1 or 2
  Parity parity = Parity::none;
  FlowControl flow = FlowControl::none;
};

/// Opens a serial line for raw bytes, for this process only, and drops what it received before.
/// Closing restores its settings.
/// throws  Error when it is no serial line, is used by another process, or refuses the settings
Stream open_serial(const SerialOptions& options);

/// Sets a terminal to raw bytes at these settings.   throws  Error as open_serial
void set_line(int descriptor, const SerialOptions& options);

/// The rate that a terminal is set to [bit/s].   throws  Error when it is none
int baud_of(int descriptor);

}  // namespace clench
