// Adds kind and place to errors: any error caused by a file's contents becomes an error of that
// file.
#pragma once
#include <string>
#include <type_traits>

#include "clench/base/placed_error.h"

namespace clench {

/// Returns the result of `read`; converts its input errors to file errors.
template <class Read>
auto of_file(Read&& read) {
  try {
    return read();
  } catch (const PlacedError& error) {
    if (error.kind() != ErrorKind::input) throw;
    throw PlacedError(error, ErrorKind::file);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    throw Error(error.what(), ErrorKind::file);
  }
}

/// Returns the result of `read`; prepends `place` to its errors and keeps their kind.
/// place  Barrett.cfg:31; or a line, an element or a reader that has a place
template <class At, class Read>
auto errors_at(const At& place, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    if constexpr (std::is_same_v<At, Place>)
      throw PlacedError(place, error.what(), error.kind());
    else if constexpr (std::is_convertible_v<const At&, std::string>)
      fail(error.kind(), "{}: {}", place, error.what());
    else
      throw PlacedError(place.place(), error.what(), error.kind());
  }
}

}  // namespace clench
