// What is wrong with a file is an error of that kind, told at its place, whoever finds it.
#pragma once
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

/// What `read` returns; its errors are told at `place`, a line, an element or a reader.
template <class Place, class Read>
auto errors_at(const Place& place, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    place.fail("{}", error.what());
  }
}

/// What `read` returns; its errors begin with `place`, "Barrett.cfg:31", and stay of their kind.
template <class Read>
auto errors_from(const std::string& place, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    fail(error.kind(), "{}: {}", place, error.what());
  }
}

}  // namespace clench
