// A file descriptor closed by its owner.
#pragma once
#include <unistd.h>

#include <functional>
#include <utility>

namespace clench {

/// Owns a descriptor; movable. A negative number: none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& from) noexcept
      : number_(std::exchange(from.number_, -1)),
        on_close_(std::exchange(from.on_close_, nullptr)) {}
  Descriptor& operator=(Descriptor&& from) noexcept {
    if (this == &from) return *this;
    close();
    number_ = std::exchange(from.number_, -1);
    on_close_ = std::exchange(from.on_close_, nullptr);
    return *this;
  }

  int number() const { return number_; }  ///< negative after it is closed
  bool is_open() const { return number_ >= 0; }
  /// Called with the descriptor before it is closed. It must not throw.
  void set_on_close(std::function<void(int)> on_close) { on_close_ = std::move(on_close); }

  void close() {
    if (!is_open()) return;
    if (on_close_) on_close_(number_);
    on_close_ = nullptr;
    ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
  std::function<void(int)> on_close_;
};

}  // namespace clench
