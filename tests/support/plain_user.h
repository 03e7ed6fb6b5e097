// Parts of a test in which permissions apply, also if root runs it.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

namespace clench::test {

/// While it exists, root acts as a user who owns no files. Other users are not affected.
class PlainUser {
 public:
  PlainUser() {
    if (::geteuid() == 0) root_ = ::seteuid(65534) == 0;
    REQUIRE(::geteuid() != 0);
  }
  ~PlainUser() {
    if (root_) CHECK(::seteuid(0) == 0);
  }
  PlainUser(const PlainUser&) = delete;
  PlainUser& operator=(const PlainUser&) = delete;

 private:
  bool root_ = false;
};

}  // namespace clench::test
