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

/// The addresses of a host, those preferred first. May block for seconds unless `numeric`.
/// numeric  finds only addresses, "localhost" and nothing that a server must be asked for
/// returns  none when the name is unknown, or is not numeric though it must be
std::vector<HostAddress> resolve(const std::string& host, bool numeric);

/// Begins a connection to a numeric address; it is ready, or has failed (`connect_error`), once the
/// stream can be written.
/// throws  Error when the system refuses it at once
Stream begin_connect(const HostAddress& host, int port);
Stream begin_connect_unix(const std::string& path);

/// Two streams, each of which receives what the other is given.
std::pair<Stream, Stream> open_pair();

/// A socket that accepts clients.
class Acceptor {
 public:
  /// port  0: the system chooses one
  /// throws  Error "127.0.0.1:4765: Address already in use"
  static Acceptor tcp(const HostAddress& host, int port);
  /// Only programs of the same user may connect. A socket file that no program listens to is
  /// replaced; `close` removes the file.
  static Acceptor unix_socket(const std::string& path);

  int descriptor() const { return descriptor_.number(); }
  int port() const { return port_; }  ///< of a Unix socket: 0
  const std::string& name() const { return name_; }

  /// The next client that waits; none if no one does.
  /// throws  Error when the system has no descriptor left
  std::optional<Stream> accept();
  void close() { descriptor_.close(); }

 private:
  Acceptor(Descriptor descriptor, std::string name);

  Descriptor descriptor_;
  std::string name_;
  int port_ = 0;
};

}  // namespace clench
