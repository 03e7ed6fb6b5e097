// Randomly changed texts, to test that a reader accepts or rejects any file without crashing.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "clench/base/random.h"

namespace clench::test {

/// Odd pieces of a format, and the characters that end its words.
struct Oddities {
  std::vector<std::string> pieces;
  std::string_view ends = " \n[],";
};

/// One change: a byte, a word or a line exchanged, dropped or doubled, or an odd piece inserted.
inline void mutate_once(std::string& s, const Oddities& odd, Random& random) {
  const size_t at = random.bits() % s.size();
  const std::string& piece = odd.pieces[random.bits() % odd.pieces.size()];
  // the word and the line at this position
  const size_t before = s.find_last_of(odd.ends, at), first = before == s.npos ? 0 : before + 1;
  const size_t end = std::max(first, std::min(s.find_first_of(odd.ends, at), s.size()));
  const size_t line = at == 0 ? 0 : s.find_last_of('\n', at - 1) + 1;
  const std::string row = s.substr(line, std::min(s.find('\n', at), s.size() - 1) + 1 - line);
  switch (random.bits() % 8) {
    case 0:
      s[at] = static_cast<char>(random.bits());
      break;
    case 1:
      s.erase(at, random.bits() % 16);
      break;
    case 2:
      s.insert(at, piece);
      break;
    case 3:
      s.replace(first, end - first, piece);
      break;
    case 4:
      s.replace(at, std::min(piece.size(), s.size() - at), piece);
      break;
    case 5:
      s.erase(first, end - first);
      break;
    case 6:
      random.bits() % 2 ? s.insert(line, row) : s.erase(line, row.size());
      break;
    default: {
      const std::string part = s.substr(random.bits() % s.size(), random.bits() % 60);
      s.insert(at, part);
    }
  }
}

/// The text after one to three changes.
inline std::string mutated(std::string s, const Oddities& odd, Random& random) {
  const int changes = 1 + static_cast<int>(random.bits() % 3);
  for (int i = 0; i < changes && !s.empty(); ++i) mutate_once(s, odd, random);
  return s;
}

/// Random bytes, fewer than 300.
inline std::string noise(Random& random) {
  std::string out(random.bits() % 300, '\0');
  for (char& c : out) c = static_cast<char>(random.bits());
  return out;
}

}  // namespace clench::test
