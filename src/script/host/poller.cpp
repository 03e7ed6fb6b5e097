#include "clench/script/host/poller.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "clench/base/error.h"

namespace clench {

static int opened(int descriptor) {
  if (descriptor < 0)
    fail(ErrorKind::limit, "clench.loop: out of descriptors: {}", std::strerror(errno));
  return descriptor;
}

static void add(int set, int descriptor) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = descriptor;
  if (epoll_ctl(set, EPOLL_CTL_ADD, descriptor, &event) != 0)
    fail(ErrorKind::limit, "clench.loop: {}", std::strerror(errno));
}

Poller::Poller(std::shared_ptr<Bell> bell)
    : bell_(std::move(bell)),
      set_(opened(epoll_create1(EPOLL_CLOEXEC))),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
  if (timer_ < 0) {
    ::close(set_);
    opened(timer_);
  }
  add(set_, bell_->descriptor());
  add(set_, timer_);
}

Poller::~Poller() {
  ::close(timer_);
  ::close(set_);
}

void Poller::watch(int descriptor, bool readable, bool writable) {
  if (descriptor == timer_ || descriptor == bell_->descriptor() || descriptor == set_)
    fail("clench.loop: descriptor {} is the loop's own", descriptor);
  epoll_event event{};
  event.events = (readable ? EPOLLIN : 0u) | (writable ? EPOLLOUT : 0u);
  event.data.fd = descriptor;
  if (event.events == 0) {
    epoll_ctl(set_, EPOLL_CTL_DEL, descriptor, nullptr);  // it may already be closed
    return;
  }
  if (epoll_ctl(set_, EPOLL_CTL_MOD, descriptor, &event) == 0) return;
  if (errno == ENOENT && epoll_ctl(set_, EPOLL_CTL_ADD, descriptor, &event) == 0) return;
  const bool open = errno != EBADF;
  fail("clench.loop: descriptor {} {}", descriptor,
       open ? "is of a kind that cannot be waited for, such as a file" : "is not open");
}

void Poller::set_timer(double seconds) {
  itimerspec time{};
  if (seconds >= 0) {
    constexpr double longest = 1e9;
    const double at_least = std::clamp(seconds, 1e-9, longest);  // 0 would disarm it
    time.it_value.tv_sec = static_cast<time_t>(at_least);
    time.it_value.tv_nsec = std::max(
        1L, static_cast<long>(1e9 * (at_least - static_cast<double>(time.it_value.tv_sec))));
  }
  timerfd_settime(timer_, 0, &time, nullptr);
}

std::vector<Poller::Ready> Poller::wait(double seconds) {
  constexpr double longest = 1e6;  // [s]; in milliseconds it fits into an int
  epoll_event events[64];
  const int milliseconds =
      seconds < 0 ? -1 : static_cast<int>(std::ceil(1e3 * std::min(seconds, longest)));
  const int count = epoll_wait(set_, events, 64, milliseconds);
  std::vector<Ready> out;
  for (int i = 0; i < count; ++i) {
    const int descriptor = events[i].data.fd;
    const uint32_t flags = events[i].events;
    if (descriptor == bell_->descriptor()) {
      bell_->clear();
    } else if (descriptor == timer_) {
      uint64_t expirations = 0;
      [[maybe_unused]] const auto read = ::read(timer_, &expirations, sizeof expirations);
    } else {
      const bool broken = flags & (EPOLLHUP | EPOLLERR);
      if (broken || flags & (EPOLLIN | EPOLLRDHUP)) out.push_back({descriptor, Event::readable});
      if (broken || flags & EPOLLOUT) out.push_back({descriptor, Event::writable});
    }
  }
  return out;
}

}  // namespace clench
