// Values without a world: vectors, poses, random numbers, progress, files, the log.
#pragma once
#include <memory>
#include <string>

#include "clench/base/random.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"

namespace clench {

extern const Library units_library, vec3_library, pose_library, random_library, progress_library,
    log_library, json_library, catalog_library, convert_library, files_library, arrays_library;

// --- clench.random: random numbers, identical on all platforms. ---

extern const Class random_class;

template <>
inline constexpr const Class* script_class<Random> = &random_class;

// --- progress: a bar for a script's own loops. ---

class Bar;

/// A loop of a script whose progress is displayed.
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

template <>
inline constexpr const Class* script_class<ProgressHandle> = &progress_class;

}  // namespace clench
