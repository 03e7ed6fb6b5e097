// Serial lines.
#pragma once
#include <string>

#include "clench/port/stream.h"

namespace clench {

enum class Parity { none, even, odd };
enum class FlowControl { none, hardware, software };

struct SerialOptions {
  std::string path;   ///< "/dev/ttyUSB0"
  int baud = 9600;    ///< any rate supported by the device, > 0 [bit/s]
  int data_bits = 8;  ///< 5 to 8
  int stop_bits = 1;  ///< 1 or 2
  Parity parity = Parity::none;
  FlowControl flow = FlowControl::none;
};

/// Opens a serial line for raw bytes, exclusively for this process, and discards earlier input.
/// Closing restores its settings.
/// throws  Error if it is not a serial line, is used by another process, or rejects the settings
Stream open_serial(const SerialOptions& options);

/// Sets a terminal to raw bytes with these settings.
/// throws  Error as open_serial
void set_line(int descriptor, const SerialOptions& options);

/// Present baud rate of a terminal [bit/s].
/// throws  Error if the descriptor is not a terminal
int baud_of(int descriptor);

}  // namespace clench
