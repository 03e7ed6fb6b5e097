// A stream of bytes over a descriptor that never blocks: a serial line, a socket, one side of a
// pseudo-terminal.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "clench/port/descriptor.h"

namespace clench {

class Stream {
 public:
  /// Why nothing more arrives.
  enum class End {
    none,      ///< more may arrive
    closed,    ///< closed, on this side or the other
    unplugged  ///< the device or the connection was lost
  };

  /// Takes over an open descriptor and makes it non-blocking.
  /// name  for messages: "/dev/ttyUSB0", "127.0.0.1:4765"
  Stream(Descriptor descriptor, std::string name);
  /// Of two descriptors, one for each direction, such as standard input and output.
  Stream(Descriptor input, Descriptor output, std::string name);

  const std::string& name() const { return name_; }
  /// For polling; below 0 once it is closed.
  int descriptor() const { return descriptor_.number(); }
  /// The same for writing.
  int write_descriptor() const { return output_.is_open() ? output_.number() : descriptor(); }
  End end() const { return end_; }
  /// Why nothing more can be sent. A socket whose other side sends no more may still receive.
  End write_end() const { return write_end_; }

  /// Reads what has arrived, at most 64 KB, behind the bytes that are kept.
  /// returns  how many bytes; 0: none has arrived, or the stream has ended
  size_t fill();
  /// Bytes that were read and not yet taken.
  std::string_view received() const { return std::string_view(kept_).substr(taken_); }
  /// Takes the first `count` bytes, or as many as there are.
  std::string take(size_t count);
  /// The first place of a delimiter among the received bytes, npos if there is none. Bytes that were
  /// searched for it before are not searched again.
  size_t find(std::string_view delimiter);

  /// Sends as many bytes as the system takes now.
  /// returns  how many; 0: none, or nothing can be sent any more
  size_t write(std::string_view bytes);

  /// The error by which a connection that was begun has failed; 0: none.
  int connect_error() const;

  void close();

 private:
  Descriptor descriptor_, output_;  ///< output_ is not open if one does for both
  std::string name_, kept_, sought_;
  size_t taken_ = 0,
         searched_ = 0;  ///< of kept_: bytes taken, bytes without `sought_` behind these
  bool is_socket_ = false;
  End end_ = End::none, write_end_ = End::none;
};

}  // namespace clench
