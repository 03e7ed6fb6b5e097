#include "clench/base/text.h"

#include <malloc.h>

#include <filesystem>
#include <fstream>

#include "clench/base/random.h"

using namespace clench;

TEST_CASE("a number is decimal, finite and has no other text around it") {
  CHECK(parse_number("5.0e+9") == 5e9);
  CHECK(parse_number("+0.25") == 0.25);
  CHECK(parse_number("-.5") == -0.5);
  CHECK(parse_number("3.") == 3.0);
  CHECK(parse_number("1e-400") == 0.0);
  for (const auto* bad : {"", "+", "-", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "12abc",
                          "1 2", "+-3", "e5", "--1"})
    CHECK_MESSAGE(!parse_number(bad), bad);
}

TEST_CASE("an integer has no decimal point and fits an int") {
  CHECK(parse_integer("42") == 42);
  CHECK(parse_integer("+0") == 0);
  CHECK(parse_integer("-7") == -7);
  for (const auto* bad : {"", "1.0", "99999999999", "1e3", "+-1", "x"})
    CHECK_MESSAGE(!parse_integer(bad), bad);
}

TEST_CASE("words are separated by white space and separators") {
  CHECK(split_words(" a\tb  c ") == std::vector<std::string_view>{"a", "b", "c"});
  CHECK(split_words("(1 2)[3,4]", "()[],") == std::vector<std::string_view>{"1", "2", "3", "4"});
  CHECK(split_words(" \t").empty());
  CHECK(trim(" \t x y \r\n") == "x y");
  CHECK(lower_case("ReVolute") == "revolute");
}

TEST_CASE("a word in a message is short and printable") {
  CHECK(in_quotes("abc") == "'abc'");
  CHECK(in_quotes("") == "nothing");
  CHECK(in_quotes("a\tb\x01") == "'a?b?'");
  CHECK(in_quotes(std::string(1000, 'x')) == "'" + std::string(max_excerpt, 'x') + "...'");
}

TEST_CASE("a reader skips blank lines and comments and keeps track of its place") {
  LineReader lines("a.cfg", "# head\n\n  one two # three\n\t\nlast");
  const Line line = lines.next_full("a line");
  CHECK(line.place().text() == "a.cfg:3");
  CHECK(line.size() == 4);
  CHECK(line.before('#').size() == 2);
  CHECK(line.word(1) == "two");
  CHECK(line.word(9).empty());
  CHECK(lines.peek().blank());
  CHECK(lines.next_full("a line").text() == "last");
  CHECK(lines.done());
  CHECK_THROWS_WITH_AS(lines.next_full("more"), "a.cfg:5: expected more, got the end of the file",
                       Error);
}

TEST_CASE("an empty text has no lines, and its place is the first line") {
  LineReader lines("a.cfg", "");
  CHECK(lines.done());
  CHECK(lines.peek().place().text() == "a.cfg:1");
  CHECK(lines.next().blank());
}

TEST_CASE("a wrong number is reported with place, subject, expected and got") {
  LineReader lines("a.cfg", "x 3 2.5");
  const Line line = lines.next();
  CHECK(line.number(1, "a") == 3);
  CHECK(line.integer(1, "a", 0, 3) == 3);
  CHECK_THROWS_WITH_AS(line.number(0, "mass"), "a.cfg:1: mass: expected a number, got 'x'", Error);
  CHECK_THROWS_WITH_AS(line.number(3, "mass"), "a.cfg:1: mass: expected a number, got nothing",
                       Error);
  CHECK_THROWS_WITH_AS(line.integer(2, "n"), "a.cfg:1: n: expected a whole number, got '2.5'",
                       Error);
  CHECK_THROWS_WITH_AS(line.integer(1, "n", 4, 9),
                       "a.cfg:1: n: expected a whole number from 4 to 9, got 3", Error);
  CHECK_THROWS_WITH_AS(line.integer(1, "n", 4),
                       "a.cfg:1: n: expected a whole number from 4 on, got 3", Error);
  CHECK_THROWS_WITH_AS(line.integer(0, "n", 0, 9), "a.cfg:1: n: expected a whole number, got 'x'",
                       Error);
  CHECK_THROWS_WITH_AS(line.fail("min {} exceeds max {}", 2, 1), "a.cfg:1: min 2 exceeds max 1",
                       Error);
}

TEST_CASE("an integer out of range is reported with the range") {
  constexpr int most = std::numeric_limits<int>::max(), least = std::numeric_limits<int>::min();
  CHECK(integer_fault("3000000000", least, most) ==
        "expected a whole number from -2147483648 to 2147483647, got '3000000000'");
  CHECK(integer_fault("+99999999999999999999", 0, most) ==
        "expected a whole number from 0 to 2147483647, got '+99999999999999999999'");
  CHECK(integer_fault("-3000000000", 0, most) ==
        "expected a whole number from 0 on, got '-3000000000'");
  CHECK(integer_fault("3000000000", 1, 9) ==
        "expected a whole number from 1 to 9, got '3000000000'");
  for (const char* bad : {"", "-", "+", "1.0", "0x1", "1e3", "+-1", "--1"})
    CHECK_MESSAGE(integer_fault(bad, least, most).starts_with("expected a whole number, got "),
                  bad);
  for (const char* good : {"0", "-0", "+7", "-2147483648", "2147483647"})
    CHECK_MESSAGE(integer_fault(good, least, most).empty(), good);
}

TEST_CASE("a byte order mark is skipped, at the beginning of a text only") {
  CHECK(plain_text("\xEF\xBB\xBF"
                   "a\r\n") == "a\n");
  CHECK(plain_text("a\xEF\xBB\xBF") == "a\xEF\xBB\xBF");
  CHECK(plain_text("\xEF\xBB") == "\xEF\xBB");
  CHECK(plain_text("\xEF\xBB\xBF").empty());
}

TEST_CASE("every kind of line end reads as one") {
  const auto path = std::filesystem::temp_directory_path() / "clench_text_test.txt";
  std::ofstream(path, std::ios::binary) << "a\r\nb\rc\nd";
  CHECK(read_text(path) == "a\nb\nc\nd");
  std::filesystem::remove(path);
  CHECK_THROWS_WITH_AS(read_text(path), ("no such file: " + path.generic_string()).c_str(), Error);
  CHECK_THROWS_WITH_AS(read_text("/"), "/: expected a file, got a folder", Error);
}

TEST_CASE("a list in a message ends after 300 characters with the number of omitted entries") {
  CHECK(clench::name_list(std::vector<std::string>{}) == "");
  CHECK(clench::name_list(std::vector<std::string>{"a", "b"}) == "a, b");
  CHECK(clench::name_list(std::vector<int>{3, 40}) == "3, 40");
  const std::string text = clench::name_list(std::vector<std::string>(100, "finger"));
  CHECK(text.size() < 320);
  CHECK(text.ends_with("finger, finger and 63 more"));
  CHECK(clench::name_list(std::vector<std::string>(3, std::string(10000, 'x'))).size() < 400);
}

TEST_CASE("the message of an error is complete although its text has zero bytes") {
  CHECK(std::string(clench::Error(std::string("a\0b", 3) + " is no name").what()) ==
        "a\\0b is no name");
}

TEST_CASE("a line of millions of words is read without memory for the words") {
  const auto taken = [] {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  std::string text = "# first";
  for (int i = 0; i < 1'000'000; ++i) text += " a";
  text += " last # tail";
  const size_t before = taken();
  const Line line(nullptr, 1, text);
  CHECK(line.word(1) == "first");
  CHECK(line.size() == 1'000'005);
  CHECK(line.word(1'000'002) == "last");
  CHECK(line.word(1'000'004) == "tail");
  CHECK(line.word(1'000'005).empty());
  CHECK(line.word(0) == "#");
  CHECK(line.before('l').size() == 1'000'002);
  CHECK(taken() <= before + 100'000);
  CHECK(split_words(text, "", 3).size() == 3);
}

TEST_CASE("lines without a mark are skipped, and the others keep their numbers") {
  Random random(3);
  for (int n = 0; n < 300; ++n) {
    std::string text;
    for (int i = static_cast<int>(random.uniform(0, 40)); i > 0; --i)
      text += "ab# \n"[static_cast<int>(random.uniform(0, 5))];
    // brute-force reference: every line
    std::vector<std::pair<int, bool>> expected, got;
    LineReader all("f", text);
    while (!all.done()) {
      const bool begins = all.begins_with('#');
      const Line line = all.next();
      if (line.text().find('#') != std::string_view::npos)
        expected.emplace_back(line.number(), begins);
    }
    LineReader some("f", text);
    while (some.skip_to('#')) {
      const bool begins = some.begins_with('#');
      got.emplace_back(some.next().number(), begins);
    }
    CHECK(got == expected);
    CHECK(some.done());
    CHECK(some.peek().place() == all.peek().place());
  }
}

TEST_CASE("every kind of line end becomes a line feed, as in a character-wise reference") {
  Random random(4);
  for (int n = 0; n < 500; ++n) {
    std::string raw;
    for (int i = static_cast<int>(random.uniform(0, 20)); i > 0; --i)
      raw += "a\r\n\r"[static_cast<int>(random.uniform(0, 4))];
    std::string expected;
    for (size_t i = 0; i < raw.size(); ++i)
      if (raw[i] != '\r')
        expected += raw[i];
      else if (i + 1 == raw.size() || raw[i + 1] != '\n')
        expected += '\n';
    CHECK(plain_text(raw) == expected);
  }
}

TEST_CASE(
    "UTF-8 is decoded letter by letter, and each invalid byte becomes one replacement character") {
  CHECK(letters_of("Größe µ") == U"Größe µ");
  CHECK(letters_of("a\xE2\x82\xAC\xF0\x9F\x98\x80z") == U"a€\U0001F600z");
  const char32_t none = 0xFFFD;
  // a lone byte, a truncated letter, an overlong encoding, half of a surrogate pair, a code point
  // out of range
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

TEST_CASE("a byte that is not UTF-8 may be read as a letter of Latin-1") {
  CHECK(letters_of("\xe9x\xe2\x82", true) == U"\u00e9x\u00e2\u0082");
}
