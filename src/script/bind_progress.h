// progress: a bar for a script's own loops.
#pragma once
#include <memory>
#include <string>

#include "script/check.h"

namespace clench {

class Bar;

/// A loop of a script that is being shown.
struct ProgressHandle {
  std::shared_ptr<Bar> bar;
  double total = 1, done = 0;
  std::string text;
  bool open = true;

  ProgressHandle(std::shared_ptr<Bar> on, double of, std::string what);
  ProgressHandle(ProgressHandle&& from) noexcept;
  ~ProgressHandle() { close(); }
  void close();
};

extern const Class progress_class;
extern const Library progress_library;

template <>
inline const Class& class_of<ProgressHandle>() {
  return progress_class;
}

}  // namespace clench
