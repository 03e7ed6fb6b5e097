// Limit on the memory that a reader uses for the contents of a file.
#pragma once
#include <string>

#include "clench/base/error.h"

namespace clench {

/// Limits the contents to 20 times the size of the file plus 64 MB, so that a small file cannot
/// exhaust the memory.
class MemoryBudget {
 public:
  static constexpr size_t fixed = size_t{64} << 20, times = 20;

  /// file   named in errors
  /// bytes  size of the file
  MemoryBudget(std::string file, size_t bytes)
      : file_(std::move(file)), limit_(fixed + times * bytes), left_(limit_) {}

  /// Call before the memory is allocated.
  /// throws  Error  "g.csv: its contents take more than 84 MB of memory: 20 times the file and 64
  ///         MB"
  void take(size_t bytes) {
    if (bytes > left_)
      fail(ErrorKind::limit,
           "{}: its contents take more than {} MB of memory: {} times the file and {} MB", file_,
           limit_ >> 20, times, fixed >> 20);
    left_ -= bytes;
  }
  size_t left() const { return left_; }

 private:
  std::string file_;
  size_t limit_, left_;
};

}  // namespace clench
