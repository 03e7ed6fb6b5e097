// A part of a test in which permissions count, as they do not for root.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

namespace clench::test {

/// While it lives, root is a user whom no file belongs to. Anybody else stays who he is.
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
