// Messages quote only the beginning of any text in a file, for any kind of error.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/text/file_kind.h"
#include "read_any.h"
#include "support/listening.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

/// A text in which no sequence of 41 characters occurs twice.
std::string long_word(const std::string& letters) {
  std::string out;
  for (size_t i = 0; out.size() < 120; ++i) out += letters[(i * i / 3 + i) % letters.size()];
  return out;
}

bool quotes_too_much(const std::string& message, const std::string& word) {
  for (size_t i = 0; i + max_excerpt < word.size(); ++i)
    if (message.find(word.substr(i, max_excerpt + 1)) != std::string::npos) return true;
  return false;
}

/// All messages of reading the file.
std::vector<std::string> told(const fs::path& file, const fs::path& folder) {
  std::vector<std::string> list;
  ReadOptions options;
  options.root = options.folder = folder;
  options.packages[""] = folder;
  options.diagnostics =
      Listening{.warn = [&](const std::string& sentence) { list.push_back(sentence); },
                .note = [&](const std::string& sentence) { list.push_back(sentence); }};
  try {
    read_any(file, options);
  } catch (const Error& error) {
    list.emplace_back(error.what());
  }
  return list;
}

/// Beginnings and ends of words, names and values.
std::vector<std::pair<size_t, size_t>> words_of(const std::string& text) {
  constexpr const char* between = " \t\r\n<>=\"'/,:;[]{}()";
  std::vector<std::pair<size_t, size_t>> out;
  for (size_t end = 0;;) {
    const size_t begin = text.find_first_not_of(between, end);
    if (begin == std::string::npos) return out;
    end = std::min(text.find_first_of(between, begin), text.size());
    out.emplace_back(begin, end);
  }
}

}  // namespace

TEST_CASE("no message quotes more of a word than its beginning, wherever it stands in a file") {
  const TemporaryFolder folder;
  const std::string words[] = {long_word("abcdefghijklmnopqrstuvwxyz"), long_word("1234567890")};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator("tests/data"))
    if (entry.is_regular_file() && entry.file_size() < 1500) files.push_back(entry.path());
  std::ranges::sort(files);
  std::set<std::string> leaks;
  int changed = 0;
  for (const fs::path& file : files) {
    const std::string ending = ending_of(file), text = read_bytes(file);
    if (ending == ".lua" || ending == ".txt") continue;
    const auto places = words_of(text);
    // a sample of the positions
    for (size_t i = files.size() % 3; i < places.size(); i += 1 + places.size() / 3) {
      const std::string& word = words[changed++ % 2];
      std::string spoilt = text;
      spoilt.replace(places[i].first, places[i].second - places[i].first, word);
      const fs::path copy = folder.write("copy" + ending, spoilt);
      for (const std::string& message : told(copy, file.parent_path()))
        if (quotes_too_much(message, word)) leaks.insert(file.string() + " | " + message);
    }
  }
  CHECK(changed > 200);
  for (const std::string& leak : leaks) CHECK_MESSAGE(false, leak);
}
