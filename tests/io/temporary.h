// Helpers for tests of readers: a folder for files, and options that store diagnostics.
#pragma once
#include <string>
#include <vector>

#include "clench/io/read/read.h"
#include "support/folder.h"
#include "support/listening.h"

namespace clench::test {

/// Options that store the warnings.
struct Warnings {
  std::vector<std::string> list;
  ReadOptions options() {
    ReadOptions o;
    o.diagnostics =
        Listening{.warn = [this](const std::string& sentence) { list.push_back(sentence); }};
    return o;
  }
};

}  // namespace clench::test
