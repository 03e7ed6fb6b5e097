#include "render/lettering.h"

#include <algorithm>

#include "render/more_letters.h"

namespace clench {

static constexpr float small_top = 6;

// two digits a point, a bar between lines; in the order of ASCII, from the space on
static constexpr std::string_view letters[] = {
    "",                                                 // space
    "28 24|22",                                         // !
    "18 16|38 36",                                      // "
    "13 17|33 37|04 44|06 46",                          // #
    "47 07 05 45 43 03|28 22",                          // $
    "02 48|08|42",                                      // %
    "42 07 18 27 04 03 12 22 44",                       // &
    "28 26",                                            // '
    "38 26 24 32",                                      // (
    "18 26 24 12",                                      // )
    "14 36|16 34|23 27",                                // *
    "05 45|23 27",                                      // +
    "22 11",                                            // ,
    "15 35",                                            // -
    "22",                                               // .
    "02 48",                                            // /
    "12 03 07 18 38 47 43 32 12",                       // 0
    "17 28 22|12 32",                                   // 1
    "07 18 38 47 46 02 42",                             // 2
    "07 18 38 47 46 35 15|35 44 43 32 12 03",           // 3
    "32 38 04 44",                                      // 4
    "48 08 05 35 44 43 32 12 03",                       // 5
    "47 38 18 07 03 12 32 43 44 35 15 04",              // 6
    "08 48 12",                                         // 7
    "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35",  // 8
    "46 35 15 06 07 18 38 47 43 32 12 03",              // 9
    "22|25",                                            // :
    "22 11|25",                                         // ;
    "47 05 43",                                         // <
    "04 44|06 46",                                      // =
    "07 45 03",                                         // >
    "07 18 38 47 46 24|22",                             // ?
    "42 12 03 07 18 38 47 44 24 26 46",                 // @
    "02 28 42|14 34",                                   // A
    "05 35 46 47 38 08 02 32 43 44 35",                 // B
    "47 38 18 07 03 12 32 43",                          // C
    "08 28 46 44 22 02 08",                             // D
    "48 08 02 42|05 35",                                // E
    "48 08 02|05 35",                                   // F
    "47 38 18 07 03 12 32 43 45 25",                    // G
    "02 08|42 48|05 45",                                // H
    "12 32|22 28|18 38",                                // I
    "48 43 32 12 03",                                   // J
    "02 08|48 04|15 42",                                // K
    "08 02 42",                                         // L
    "02 08 25 48 42",                                   // M
    "02 08 42 48",                                      // N
    "12 03 07 18 38 47 43 32 12",                       // O
    "02 08 38 47 46 35 05",                             // P
    "12 03 07 18 38 47 43 32 12|24 42",                 // Q
    "02 08 38 47 46 35 05|25 42",                       // R
    "47 38 18 07 06 15 35 44 43 32 12 03",              // S
    "08 48|28 22",                                      // T
    "08 03 12 32 43 48",                                // U
    "08 22 48",                                         // V
    "08 12 26 32 48",                                   // W
    "02 48|08 42",                                      // X
    "08 25 48|25 22",                                   // Y
    "08 48 02 42",                                      // Z
    "38 18 12 32",                                      // [
    "08 42",                                            // backslash
    "18 38 32 12",                                      // ]
    "16 28 36",                                         // ^
    "01 41",                                            // _
    "18 26",                                            // `
    "16 36 45 42|44 14 03 12 32 43",                    // a
    "08 02|05 16 36 45 43 32 12 03",                    // b
    "45 36 16 05 03 12 32 43",                          // c
    "48 42|45 36 16 05 03 12 32 43",                    // d
    "04 44 45 36 16 05 03 12 32 43",                    // e
    "38 28 17 12|06 26",                                // f
    "46 41 30 10 01|45 36 16 05 03 12 32 43",           // g
    "08 02|05 16 36 45 42",                             // h
    "16 26 22|28",                                      // i
    "26 21 10|28",                                      // j
    "08 02|36 04|14 42",                                // k
    "18 28 22",                                         // l
    "02 06|05 16 25 22|25 36 45 42",                    // m
    "02 06|05 16 36 45 42",                             // n
    "12 03 05 16 36 45 43 32 12",                       // o
    "06 00|05 16 36 45 43 32 12 03",                    // p
    "46 40|45 36 16 05 03 12 32 43",                    // q
    "02 06|04 16 36",                                   // r
    "45 36 16 05 14 34 43 32 12 03",                    // s
    "18 13 22 32|06 36",                                // t
    "06 03 12 32 43|46 42",                             // u
    "06 22 46",                                         // v
    "06 12 25 32 46",                                   // w
    "02 46|06 42",                                      // x
    "06 22|46 10 00",                                   // y
    "06 46 02 42",                                      // z
    "38 27 26 15 24 23 32",                             // {
    "28 20",                                            // |
    "18 27 26 35 24 23 12",                             // }
    "05 16 25 34 45",                                   // ~
};
static constexpr std::string_view unknown = "02 08 48 42 02";
static constexpr char32_t no_letter = 0xFFFD;  // of bytes that are none

static void add_strokes(std::string_view text, Strokes& strokes) {
  for (size_t i = 0; i + 1 < text.size(); i += 3) {
    if (i == 0 || text[i - 1] == '|') strokes.emplace_back();
    strokes.back().emplace_back(static_cast<float>(text[i] - '0'),
                                static_cast<float>(text[i + 1] - '0'));
  }
}

// null when there are none
static const std::string_view* plain_strokes(char32_t letter) {
  const size_t at = letter - size_t{32};
  return at < std::size(letters) ? &letters[at] : more_strokes(letter);
}

// an accent above a capital takes its room from it
static Strokes accented_strokes(const AccentedLetter& letter) {
  Strokes strokes, accent;
  add_strokes(*plain_strokes(letter.base), strokes);
  add_strokes(*accent_strokes(letter.accent), accent);
  const auto top = [](const Strokes& of) {
    float highest = 0;
    for (const auto& stroke : of)
      for (const auto& p : stroke) highest = std::max(highest, p.y());
    return highest;
  };
  if (top(accent) > letter_baseline && top(strokes) > small_top) {
    for (auto& stroke : strokes)
      for (auto& p : stroke) p.y() = letter_baseline + (p.y() - letter_baseline) * 5 / 6;
    for (auto& stroke : accent)
      for (auto& p : stroke) p.y() += 1;
  }
  strokes.insert(strokes.end(), accent.begin(), accent.end());
  return strokes;
}

Strokes strokes_of(char32_t letter) {
  if (const AccentedLetter* accented = accented_letter(letter)) return accented_strokes(*accented);
  const std::string_view* text = plain_strokes(letter);
  Strokes strokes;
  add_strokes(text ? *text : unknown, strokes);
  return strokes;
}

// how many bytes a letter has that begins so; 0 when none does
static size_t letter_size(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  return first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

std::u32string letters_of(std::string_view text) {
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};  // of so many bytes
  std::u32string out;
  for (size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const size_t size = letter_size(first);
    char32_t letter = size > 1 ? first & (0x7F >> size) : first;
    size_t read = 1;
    for (; read < size && i + read < text.size() && (text[i + read] & 0xC0) == 0x80; ++read)
      letter = letter << 6 | (text[i + read] & 0x3F);
    const bool whole = size > 0 && read == size && letter >= least[size] && letter <= 0x10FFFF &&
                       (letter < 0xD800 || letter > 0xDFFF);
    out += whole ? letter : no_letter;
    i += whole ? size : 1;
  }
  return out;
}

std::string text_of(std::u32string_view word) {
  std::string out;
  for (const char32_t letter : word) {
    const int more = letter < 0x80 ? 0 : letter < 0x800 ? 1 : letter < 0x10000 ? 2 : 3;
    constexpr unsigned first[] = {0, 0xC0, 0xE0, 0xF0};
    out += static_cast<char>(first[more] | letter >> 6 * more);
    for (int i = more - 1; i >= 0; --i) out += static_cast<char>(0x80 | (letter >> 6 * i & 0x3F));
  }
  return out;
}

std::u32string unknown_letters(std::string_view text) {
  std::u32string out;
  for (const char32_t letter : letters_of(text))
    if (!accented_letter(letter) && !plain_strokes(letter) && out.find(letter) == out.npos)
      out += letter;
  return out;
}

}  // namespace clench
