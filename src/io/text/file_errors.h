// What is wrong with a file is an error of that kind, told at its place, whoever finds it.
#pragma once
#include <string>
#include <type_traits>

#include "clench/base/error.h"

namespace clench {

/// What `read` returns; its errors of input become errors of the file.
template <class Read>
auto of_file(Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    throw Error(error.what(), ErrorKind::file);
  }
}

/// What `read` returns; its errors begin with `place`, and stay of their kind.
/// place  "Barrett.cfg:31", or a line, an element or a reader that knows it
template <class Place, class Read>
auto errors_at(const Place& place, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    if constexpr (std::is_convertible_v<const Place&, std::string>)
      fail(error.kind(), "{}: {}", place, error.what());
    else
      fail(error.kind(), "{}: {}", place.place(), error.what());
  }
}

}  // namespace clench
