// TCP and Unix sockets.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clench/port/stream.h"

namespace clench {

/// A numeric address of a host.
struct HostAddress {
  std::string address;  ///< "127.0.0.1", "::1"
  bool operator==(const HostAddress&) const = default;
};

/// Addresses of a host, in order of preference. May block for seconds unless `numeric`.
/// numeric  accepts only addresses and "localhost", and asks no name server
/// returns  empty if the name is unknown, or is not numeric although it must be
std::vector<HostAddress> resolve(const std::string& host, bool numeric);

/// Starts a connection to a numeric address; it is ready, or has failed (`connect_error`), as soon
/// as the stream is writable.
/// throws  Error if the system rejects it immediately
Stream begin_connect(const HostAddress& host, int port);
Stream begin_connect_unix(const std::string& path);

/// Two connected streams: each receives the bytes sent by the other.
std::pair<Stream, Stream> open_pair();

/// A socket that accepts clients.
class Acceptor {
 public:
  /// port  0: the system chooses one
  /// throws  Error "127.0.0.1:4765: Address already in use"
  static Acceptor tcp(const HostAddress& host, int port);
  /// Only programs of the same user may connect. A socket file without a listening program is
  /// replaced; `close` removes the file.
  static Acceptor unix_socket(const std::string& path);

  int descriptor() const { return descriptor_.number(); }
  int port() const { return port_; }  ///< 0 for a Unix socket
  const std::string& name() const { return name_; }

  /// The next waiting client; empty if there is none.
  /// throws  Error if the system has no descriptor left
  std::optional<Stream> accept();
  void close() { descriptor_.close(); }

 private:
  Acceptor(Descriptor descriptor, std::string name);

  Descriptor descriptor_;
  std::string name_;
  int port_ = 0;
};

}  // namespace clench
