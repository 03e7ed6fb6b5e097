// Files of tests/data/bad, each rejected with the message in the .txt file next to it.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "clench/base/error.h"
#include "clench/base/text.h"

namespace clench::test {

/// folder  below tests/data/bad
/// beginning  of the files' names
template <class Read>
void check_bad_files(const std::string& folder, const std::string& beginning,
                     const std::string& ending, size_t at_least, Read read) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path("tests/data/bad") / folder))
    if (entry.path().extension() == ending && entry.path().stem().string().starts_with(beginning) &&
        fs::exists(fs::path(entry.path()).replace_extension(".txt")))
      files.push_back(entry.path());
  std::ranges::sort(files);
  REQUIRE(files.size() >= at_least);
  for (const auto& file : files) {
    const std::string sentence(trim(read_text(fs::path(file).replace_extension(".txt"))));
    INFO(file.string());
    CHECK_THROWS_WITH_AS(read(file), sentence.c_str(), Error);
  }
}

}  // namespace clench::test
