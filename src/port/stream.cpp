#include "clench/port/stream.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "clench/base/error.h"
#include "clench/base/file.h"

namespace clench {

namespace {

bool would_wait(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

// ECONNRESET: the other side closed before it had read everything. EIO: a device is gone, or the
// other side of a pseudo-terminal
Stream::End end_of(int error) {
  return error == EPIPE || error == ECONNRESET ? Stream::End::closed : Stream::End::unplugged;
}

void make_non_blocking(int number, const std::string& name) {
  const int flags = fcntl(number, F_GETFL);
  if (flags < 0 || fcntl(number, F_SETFL, flags | O_NONBLOCK) < 0)
    fail(ErrorKind::file, "{}: {}", name, system_reason(errno));
}

constexpr size_t chunk = 64 * 1024;  // maximum read by one call [bytes]

}  // namespace

Stream::Stream(Descriptor descriptor, std::string name)
    : descriptor_(std::move(descriptor)), name_(std::move(name)) {
  make_non_blocking(descriptor_.number(), name_);
  int kind = 0;
  socklen_t size = sizeof kind;
  is_socket_ = getsockopt(descriptor_.number(), SOL_SOCKET, SO_TYPE, &kind, &size) == 0;
}

Stream::Stream(Descriptor input, Descriptor output, std::string name)
    : Stream(std::move(input), std::move(name)) {
  output_ = std::move(output);
  make_non_blocking(output_.number(), name_);
}

size_t Stream::fill() {
  if (end_ != End::none) return 0;
  if (taken_ > 0 && taken_ >= kept_.size() / 2) {  // each byte is moved once on average
    kept_.erase(0, taken_);
    taken_ = 0;
  }
  const size_t before = kept_.size();
  kept_.resize(before + chunk);
  const ssize_t count = ::read(descriptor_.number(), kept_.data() + before, chunk);
  const int error = errno;
  kept_.resize(before + static_cast<size_t>(std::max<ssize_t>(count, 0)));
  if (count == 0) end_ = is_socket_ || output_.is_open() ? End::closed : End::unplugged;
  if (count < 0 && !would_wait(error)) end_ = end_of(error);
  return kept_.size() - before;
}

std::string Stream::take(size_t count) {
  std::string bytes(received().substr(0, count));
  taken_ += bytes.size();
  searched_ -= std::min(searched_, bytes.size());
  if (taken_ == kept_.size()) {
    kept_.clear();
    taken_ = searched_ = 0;
  }
  return bytes;
}

size_t Stream::find(std::string_view delimiter) {
  if (delimiter.empty()) return std::string_view::npos;
  if (sought_ != delimiter) {
    sought_ = delimiter;
    searched_ = 0;
  }
  const std::string_view bytes = received();
  const size_t at = bytes.find(delimiter, searched_);
  // a delimiter may begin in the last bytes
  if (at == std::string_view::npos)
    searched_ = bytes.size() - std::min(bytes.size(), delimiter.size() - 1);
  return at;
}

size_t Stream::write(std::string_view bytes) {
  if (write_end_ != End::none || bytes.empty()) return 0;
  const int number = write_descriptor();
  const bool sends = is_socket_ && !output_.is_open();
  const ssize_t count = sends ? ::send(number, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                              : ::write(number, bytes.data(), bytes.size());
  if (count >= 0) return static_cast<size_t>(count);
  if (!would_wait(errno)) write_end_ = end_of(errno);
  return 0;
}

int Stream::connect_error() const {
  int error = 0;
  socklen_t size = sizeof error;
  if (getsockopt(descriptor_.number(), SOL_SOCKET, SO_ERROR, &error, &size) != 0) return errno;
  return error;
}

void Stream::close() {
  descriptor_.close();
  output_.close();
  if (end_ == End::none) end_ = End::closed;
  if (write_end_ == End::none) write_end_ = End::closed;
}

}  // namespace clench
