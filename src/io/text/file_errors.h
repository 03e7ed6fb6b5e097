// What is wrong with a file is an error of that kind, whoever finds it.
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

}  // namespace clench
