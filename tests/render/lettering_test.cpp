#include "render/lettering.h"

#include <doctest/doctest.h>

#include "render/canvas.h"

using namespace clench;

namespace {

// U+FFFD: bytes that are no letter
const Strokes box_letter = strokes_of(0xFFFD);

bool above(const Strokes& strokes, float y) {
  for (const auto& stroke : strokes)
    for (const auto& p : stroke)
      if (p.y() > y) return true;
  return false;
}

}  // namespace

TEST_CASE("every letter of Latin-1 and of Greek has strokes, and few share them") {
  const auto check_letter = [](char32_t letter) {
    CAPTURE(static_cast<uint32_t>(letter));
    const Strokes strokes = strokes_of(letter);
    CHECK_FALSE(strokes.empty());
    CHECK(strokes != box_letter);
    for (const auto& stroke : strokes)
      for (const auto& p : stroke) {
        CHECK((p.x() >= 0 && p.x() <= 4));
        CHECK((p.y() >= 0 && p.y() <= 10));
      }
  };
  for (char32_t letter = 0xA1; letter <= 0xFF; ++letter) {
    check_letter(letter);
    for (char32_t other = 0xC0; other < letter && letter >= 0xC0; ++other)
      CHECK(strokes_of(other) != strokes_of(letter));
  }
  for (char32_t letter = U'Α'; letter <= U'Ω'; ++letter)
    if (letter != 0x3A2) check_letter(letter);
  for (char32_t letter = U'α'; letter <= U'ω'; ++letter) check_letter(letter);
  CHECK(strokes_of(U'µ') == strokes_of(U'μ'));
  CHECK(strokes_of(0xA0).empty());  // a space that does not break
}

TEST_CASE("an accented letter is its base and an accent, which does not enlarge a capital") {
  const Strokes plain = strokes_of(U'o'), umlaut = strokes_of(U'ö');
  REQUIRE(umlaut.size() == plain.size() + 2);
  CHECK(std::equal(plain.begin(), plain.end(), umlaut.begin()));
  CHECK(above(strokes_of(U'O'), 7.5f));
  const Strokes capital = strokes_of(U'Ö');
  CHECK_FALSE(above({capital[0]}, 7));
  CHECK(above(capital, 8.5f));
}

TEST_CASE("UTF-8 is read letter by letter, and each byte that is none is one mark") {
  CHECK(letters_of("Größe µ") == U"Größe µ");
  CHECK(letters_of("a\xE2\x82\xAC\xF0\x9F\x98\x80z") == U"a€\U0001F600z");
  const char32_t none = 0xFFFD;
  // a lone byte, a letter cut short, a letter too long for what it says, half of a pair, too large
  CHECK(letters_of("\xFFx") == std::u32string{none, U'x'});
  CHECK(letters_of("\xE2\x82") == std::u32string{none, none});
  CHECK(letters_of("\xC0\xAF") == std::u32string{none, none});
  CHECK(letters_of("\xE0\x80\xAF").front() == none);
  CHECK(letters_of("\xED\xA0\x80").front() == none);
  CHECK(letters_of("\xF5\x80\x80\x80").front() == none);
  CHECK(letters_of("").empty());
  for (const char* text : {"Größe µ", "a€\U0001F600z", "", "ASCII"})
    CHECK(text_of(letters_of(text)) == text);
}

TEST_CASE("letters that are drawn as boxes are told, each once") {
  CHECK(unknown_letters("Größe µ ε τ ≤ 3 °").empty());
  CHECK(unknown_letters("Ж 漢 Ж") == U"Ж漢");
  CHECK(unknown_letters("a\nb") == U"\n");
}

TEST_CASE("what is too long loses its middle, and no more than it must") {
  const float height = 12, letter = Canvas::text_width("x", height);
  CHECK(Canvas::text_width("µµµ", height) == 3 * letter);
  CHECK(Canvas::shortened("abcdefgh", height, 8 * letter) == "abcdefgh");
  CHECK(Canvas::shortened("abcdefgh", height, 7.5f * letter) == "abc…fgh");
  CHECK(Canvas::shortened("abcdefgh", height, 6 * letter) == "abc…gh");
  CHECK(Canvas::shortened("äöüäöüäöü", height, 5 * letter) == "äö…öü");
  CHECK(Canvas::shortened("abcdefgh", height, letter) == "…");
  CHECK(Canvas::shortened("abcdefgh", height, 0.5f * letter).empty());
}
