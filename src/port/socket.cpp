#include "clench/port/socket.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "clench/base/error.h"
#include "clench/base/file.h"

namespace clench {

namespace {

using AddressList = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

AddressList addresses_of(const std::string& host, int port, int flags) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) found = nullptr;
  return {found, [](addrinfo* list) {
            if (list) freeaddrinfo(list);
          }};
}

std::string name_of(const std::string& address, int port) {
  if (address.find(':') != std::string::npos) return fmt::format("[{}]:{}", address, port);
  return fmt::format("{}:{}", address, port);
}

void check_port_number(const std::string& host, int port, int min) {
  if (port < min || port > 65535) fail("{}: port must be {} to 65535, got {}", host, min, port);
}

Descriptor new_socket(int family, const std::string& name) {
  Descriptor made(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!made.is_open()) fail(ErrorKind::limit, "{}: {}", name, system_reason(errno));
  return made;
}

// TCP options: sends small messages immediately, and detects within a minute that the other machine
// is gone
void set_tcp_options(int number) {
  const int on = 1, idle = 30, interval = 10, count = 3;  // [s]
  setsockopt(number, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  setsockopt(number, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  setsockopt(number, IPPROTO_TCP, TCP_KEEPIDLE, &idle, sizeof idle);
  setsockopt(number, IPPROTO_TCP, TCP_KEEPINTVL, &interval, sizeof interval);
  setsockopt(number, IPPROTO_TCP, TCP_KEEPCNT, &count, sizeof count);
}

Stream connected(Descriptor made, const sockaddr* address, socklen_t size,
                 const std::string& name) {
  if (::connect(made.number(), address, size) != 0 && errno != EINPROGRESS && errno != EINTR)
    fail(ErrorKind::file, "{}: {}", name, system_reason(errno));
  return Stream(std::move(made), name);
}

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path)
    fail("'{}': the path of a Unix socket must have 1 to {} bytes", path,
         sizeof address.sun_path - 1);
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

// removes a socket file without a listening program
void remove_stale(const std::string& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0 || !S_ISSOCK(found.st_mode)) return;
  const Descriptor probe = new_socket(AF_UNIX, path);
  const int result =
      ::connect(probe.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  if (result != 0 && errno == ECONNREFUSED) ::unlink(path.c_str());
}

int port_of(int number) {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  getsockname(number, reinterpret_cast<sockaddr*>(&own), &size);
  if (own.ss_family == AF_INET) return ntohs(reinterpret_cast<sockaddr_in&>(own).sin_port);
  if (own.ss_family == AF_INET6) return ntohs(reinterpret_cast<sockaddr_in6&>(own).sin6_port);
  return 0;
}

}  // namespace

std::vector<HostAddress> resolve(const std::string& host, bool numeric) {
  if (numeric && host == "localhost") return {{"127.0.0.1"}, {"::1"}};
  const AddressList list = addresses_of(host, 0, numeric ? AI_NUMERICHOST : AI_ADDRCONFIG);
  std::vector<HostAddress> found;
  for (const addrinfo* one = list.get(); one; one = one->ai_next) {
    char text[NI_MAXHOST];
    if (getnameinfo(one->ai_addr, one->ai_addrlen, text, sizeof text, nullptr, 0, NI_NUMERICHOST) !=
        0)
      continue;
    if (std::ranges::find(found, HostAddress{text}) == found.end()) found.push_back({text});
  }
  return found;
}

Stream begin_connect(const HostAddress& host, int port) {
  check_port_number(host.address, port, 1);
  const std::string name = name_of(host.address, port);
  const AddressList list = addresses_of(host.address, port, AI_NUMERICHOST);
  if (!list) fail("{}: expected a numeric address", host.address);
  Descriptor made = new_socket(list->ai_family, name);
  set_tcp_options(made.number());
  return connected(std::move(made), list->ai_addr, list->ai_addrlen, name);
}

Stream begin_connect_unix(const std::string& path) {
  const sockaddr_un address = unix_address(path);
  return connected(new_socket(AF_UNIX, path), reinterpret_cast<const sockaddr*>(&address),
                   sizeof address, path);
}

std::pair<Stream, Stream> open_pair() {
  int both[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, both) != 0)
    fail(ErrorKind::limit, "no pair of streams can be opened: {}", system_reason(errno));
  Descriptor a(both[0]), b(both[1]);
  return {Stream(std::move(a), "pair"), Stream(std::move(b), "pair")};
}

Acceptor::Acceptor(Descriptor descriptor, std::string name)
    : descriptor_(std::move(descriptor)), name_(std::move(name)) {
  constexpr int waiting = 128;  // maximum number of connected clients that are not yet accepted
  if (::listen(descriptor_.number(), waiting) != 0)
    fail(ErrorKind::file, "{}: {}", name_, system_reason(errno));
  port_ = port_of(descriptor_.number());
}

Acceptor Acceptor::tcp(const HostAddress& host, int port) {
  check_port_number(host.address, port, 0);
  const std::string name = name_of(host.address, port);
  const AddressList list = addresses_of(host.address, port, AI_NUMERICHOST);
  if (!list) fail("{}: expected a numeric address", host.address);
  Descriptor made = new_socket(list->ai_family, name);
  const int on = 1;  // the port is free immediately after an earlier server has ended
  setsockopt(made.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(made.number(), list->ai_addr, list->ai_addrlen) != 0)
    fail(ErrorKind::file, "{}: {}", name, system_reason(errno));
  const int chosen = port_of(made.number());
  return Acceptor(std::move(made), name_of(host.address, chosen));
}

Acceptor Acceptor::unix_socket(const std::string& path) {
  const sockaddr_un address = unix_address(path);
  remove_stale(path, address);
  Descriptor made = new_socket(AF_UNIX, path);
  // sets the permissions of the file at its creation
  if (::fchmod(made.number(), S_IRUSR | S_IWUSR) != 0 ||
      ::bind(made.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    fail(ErrorKind::file, "{}: {}", path, system_reason(errno));
  made.set_on_close([path](int) { ::unlink(path.c_str()); });
  return Acceptor(std::move(made), path);
}

std::optional<Stream> Acceptor::accept() {
  if (!descriptor_.is_open()) return std::nullopt;
  sockaddr_storage other{};
  socklen_t size = sizeof other;
  Descriptor made(::accept4(descriptor_.number(), reinterpret_cast<sockaddr*>(&other), &size,
                            SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!made.is_open()) {
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
      fail(ErrorKind::limit, "{}: no more clients can be accepted: {}", name_,
           system_reason(errno));
    return std::nullopt;  // no client waits, or it has disconnected
  }
  if (other.ss_family == AF_UNIX) return Stream(std::move(made), name_);
  set_tcp_options(made.number());
  char host[NI_MAXHOST] = "", port[NI_MAXSERV] = "0";
  getnameinfo(reinterpret_cast<sockaddr*>(&other), size, host, sizeof host, port, sizeof port,
              NI_NUMERICHOST | NI_NUMERICSERV);
  return Stream(std::move(made), name_of(host, std::atoi(port)));
}

}  // namespace clench
