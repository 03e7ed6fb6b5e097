// A non-blocking stream of bytes over a descriptor: a serial line, a socket, one side of a
// pseudo-terminal.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "clench/port/descriptor.h"

namespace clench {

class Stream {
 public:
  /// State of the receiving or the sending direction.
  enum class End {
    none,      ///< open: more may arrive
    closed,    ///< closed, on this side or the other
    unplugged  ///< the device or the connection was lost
  };

  /// Takes ownership of an open descriptor and makes it non-blocking.
  /// name    for messages: "/dev/ttyUSB0", "127.0.0.1:4765"
  /// throws  Error if the system rejects that
  Stream(Descriptor descriptor, std::string name);
  /// A stream of two descriptors, one for each direction, such as standard input and output.
  Stream(Descriptor input, Descriptor output, std::string name);

  const std::string& name() const { return name_; }
  /// Input descriptor, for polling; negative after it is closed.
  int descriptor() const { return descriptor_.number(); }
  /// Output descriptor, for polling.
  int write_descriptor() const { return output_.is_open() ? output_.number() : descriptor(); }
  End end() const { return end_; }
  /// State of the sending direction. A socket whose other side has stopped sending may still
  /// receive.
  End write_end() const { return write_end_; }

  /// Reads available bytes, at most 64 KB, and appends them to the buffer.
  /// returns  number of bytes; 0: none are available, or the stream has ended
  size_t fill();
  /// Buffered bytes, read but not yet taken.
  std::string_view received() const { return std::string_view(kept_).substr(taken_); }
  /// Takes the first `count` buffered bytes, or all if there are fewer.
  std::string take(size_t count);
  /// First position of a delimiter in the buffer, npos if there is none. Bytes already searched for
  /// the same delimiter are not searched again.
  size_t find(std::string_view delimiter);

  /// Sends as many bytes as the system accepts now.
  /// returns  number of bytes; 0: none, or the sending direction is closed
  size_t write(std::string_view bytes);

  /// Error of a connection that was started; 0: none.
  int connect_error() const;

  void close();

 private:
  Descriptor descriptor_, output_;  ///< not open if one descriptor is used for both directions
  std::string name_;
  std::string kept_;     ///< bytes that were read; the first `taken_` of them were taken
  std::string sought_;   ///< last delimiter
  size_t taken_ = 0;     ///< [bytes]
  size_t searched_ = 0;  ///< bytes after these that are known to be free of `sought_`
  bool is_socket_ = false;
  End end_ = End::none, write_end_ = End::none;
};

}  // namespace clench
