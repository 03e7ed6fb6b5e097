// An Error that knows where in a file it lies.
#pragma once
#include <utility>

#include "clench/base/error.h"
#include "clench/base/place.h"

namespace clench {

class PlacedError : public Error {
 public:
  /// what() is `text` after the place
  PlacedError(Place place, const std::string& text, ErrorKind kind = ErrorKind::input)
      : Error(place.before(text), kind), place_(std::move(place)) {}
  /// The same, of another kind.
  PlacedError(const PlacedError& other, ErrorKind kind)
      : Error(other.what(), kind), place_(other.place_) {}

  const Place& place() const { return place_; }

 private:
  Place place_;
};

/// throws PlacedError with a formatted sentence
template <class... Args>
[[noreturn]] void fail(const Place& place, fmt::format_string<Args...> format, Args&&... args) {
  throw PlacedError(place, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace clench
