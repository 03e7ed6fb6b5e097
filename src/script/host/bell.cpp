#include "clench/script/host/bell.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "clench/base/error.h"
#include "clench/script/lua/kept.h"

namespace clench {

Bell::Bell() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0)
    fail(ErrorKind::limit, "clench.job: out of descriptors: {}", std::strerror(errno));
}

Bell::~Bell() { ::close(descriptor_); }

void Bell::ring() {
  const uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof one);
}

void Bell::clear() {
  uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(descriptor_, &count, sizeof count);
}

namespace {

struct KeptBell {
  std::shared_ptr<Bell> bell = std::make_shared<Bell>();
};

}  // namespace

const std::shared_ptr<Bell>& bell_of(lua_State* L) { return kept<KeptBell>(L).bell; }

}  // namespace clench
