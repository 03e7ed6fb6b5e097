// A file descriptor closed by its owner.
#pragma once
#include <unistd.h>

#include <functional>
#include <utility>

namespace clench {

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& from) noexcept
      : number_(std::exchange(from.number_, -1)),
        farewell_(std::exchange(from.farewell_, nullptr)) {}
  Descriptor& operator=(Descriptor&& from) noexcept {
    if (this == &from) return *this;
    close();
    number_ = std::exchange(from.number_, -1);
    farewell_ = std::exchange(from.farewell_, nullptr);
    return *this;
  }

  int number() const { return number_; }  ///< negative after it is closed
  bool is_open() const { return number_ >= 0; }
  /// Called with the descriptor before it is closed. It must not throw.
  void set_farewell(std::function<void(int)> farewell) { farewell_ = std::move(farewell); }

  void close() {
    if (!is_open()) return;
    if (farewell_) farewell_(number_);
    farewell_ = nullptr;
    ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
  std::function<void(int)> farewell_;
};

}  // namespace clench
