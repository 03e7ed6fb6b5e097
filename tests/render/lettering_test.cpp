#include "clench/render/figure/lettering.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <thread>

#include "clench/base/text.h"
#include "clench/render/figure/chart.h"

using namespace clench;
using Eigen::Vector2f;
using Eigen::Vector2i;

namespace {

const std::string nowhere = "no/such/folder/font.ttf";

using Covered = std::map<std::pair<int, int>, float>;  // coverage of pixels by row and column

Covered covered_by(const TextLine& line, const Vector2i& size = {200, 100}) {
  Covered parts;
  Font().cover(line, size, [&](int x, int y, float part) {
    CHECK((x >= 0 && x < size.x() && y >= 0 && y < size.y()));
    CHECK((part > 0 && part <= 1));
    parts[{y, x}] += part;
  });
  return parts;
}

Covered covered_by(const std::string& text) { return covered_by({text, {20, 60}, 30}); }

double ink_of(const Covered& parts) {
  double sum = 0;
  for (const auto& [place, part] : parts) sum += part;
  return sum;
}

// from..to as UTF-8
std::vector<std::string> letters_between(char32_t from, char32_t to) {
  std::vector<std::string> out;
  for (char32_t letter = from; letter <= to; ++letter) out.push_back(text_of({&letter, 1}));
  return out;
}

}  // namespace

TEST_CASE("a text is as wide as its parts, and twice as wide at twice the height") {
  const Font font;
  REQUIRE(font.fault().empty());
  const std::string front = "AVATAR, ε = ", back = "0.21 größer\xFF";
  CHECK(font.width(front + back, 9) == doctest::Approx(font.width(front, 9) + font.width(back, 9)));
  CHECK(font.width(front, 18) == doctest::Approx(2 * font.width(front, 9)));
  CHECK(font.width("", 9) == 0);
  CHECK(font.width("i", 9) < font.width("m", 9));
  // digits are aligned in columns
  for (const char* digit : {"1", "2", "3", "4", "5", "6", "7", "8", "9"})
    CHECK(font.width(digit, 9) == font.width("0", 9));
}

TEST_CASE("letters of Latin and Greek stay within their width, between top and bottom") {
  const Font font;
  const float height = 30;
  auto letters = letters_between(U'!', U'~');
  for (const auto& more : {letters_between(U'¡', U'ÿ'), letters_between(U'α', U'ω')})
    letters.insert(letters.end(), more.begin(), more.end());
  const Covered box = covered_by("力");
  for (const std::string& letter : letters) {
    CAPTURE(letter);
    const Covered parts = covered_by({letter, {50, 60}, height});
    CHECK_FALSE(parts.empty());
    CHECK(covered_by(letter) != box);
    const float right = 50 + font.width(letter, height);
    for (const auto& [place, part] : parts) {
      // a few letters overlap their neighbors
      CHECK(static_cast<float>(place.second) > 50 - 0.2f * height);
      CHECK(static_cast<float>(place.second) < right + 0.1f * height);
      CHECK(static_cast<float>(place.first) > 60 - 1.35f * height);
      CHECK(static_cast<float>(place.first) < 60 + 0.35f * height);
    }
  }
  CHECK(covered_by(" \u00A0").empty());
}

TEST_CASE("capital letters have the given height, and stand on the baseline") {
  for (const float height : {9.0f, 13.0f, 40.0f}) {
    const Covered parts = covered_by({"H", {20, 80}, height});
    CHECK(parts.begin()->first.first == 80 - static_cast<int>(height));
    CHECK(parts.rbegin()->first.first == 79);
  }
}

TEST_CASE("the ink of a text does not depend on position and rotation") {
  const double ink = ink_of(covered_by({"epsilon µ", {20, 60}, 20}));
  for (const float shift : {0.25f, 0.5f, 0.81f})
    CHECK(ink_of(covered_by({"epsilon µ", Vector2f(20 + shift, 60 - shift), 20})) ==
          doctest::Approx(ink).epsilon(0.01));
  for (const Vector2f& along : {Vector2f(0, -1), Vector2f(0.6f, -0.8f)})
    CHECK(ink_of(covered_by({"epsilon µ", {60, 280}, 20, along}, {300, 300})) ==
          doctest::Approx(ink).epsilon(0.01));
}

TEST_CASE("parts outside the picture are clipped, and invalid sizes draw nothing") {
  const Covered whole = covered_by({"Größe", {20, 60}, 30});
  const Covered cut = covered_by({"Größe", {-20, 10}, 30}, {60, 15});
  CHECK_FALSE(cut.empty());
  for (const auto& [place, part] : cut)
    CHECK(whole.at({place.first + 50, place.second + 40}) == part);
  const float large = std::numeric_limits<float>::max(), none = NAN;
  for (const float height : {0.0f, -3.0f, 1001.0f, large, none})
    CHECK(covered_by({"x", {20, 60}, height}).empty());
  for (const Vector2f& at : {Vector2f(large, 9), Vector2f(-large, 9), Vector2f(9, none)})
    CHECK(covered_by({"x", at, 9}).empty());
  CHECK_FALSE(covered_by({"x", {-200, 600}, 1000}).empty());
}

TEST_CASE("invalid bytes are shown as U+FFFD, and letters that the font lacks as its box") {
  CHECK(covered_by("a\xFFz") == covered_by("a\uFFFDz"));
  CHECK(covered_by("\xFF") != covered_by("力"));
  CHECK(covered_by("漢") == covered_by("力"));
  CHECK_FALSE(covered_by("\n\x01").empty());
  const Font font;
  CHECK(font.missing("Größe µ ε τ ≤ 3 ° \xFF").empty());
  CHECK(font.missing("力 漢 力") == std::set{U'力', U'漢'});
  CHECK(font.missing("a\nb") == std::set{U'\n'});
}

TEST_CASE("a text that is too long loses its middle, and no more than necessary") {
  const Font font;
  const float height = 12;
  const std::string text = "the Größe of a grasp";
  CHECK(font.shortened(text, height, font.width(text, height)) == text);
  for (float width = 0; width < font.width(text, height); width += 3) {
    CAPTURE(width);
    const std::string kept = font.shortened(text, height, width);
    CHECK(font.width(kept, height) <= width);
    if (kept.empty()) {
      CHECK(font.width("…", height) > width);
      continue;
    }
    const std::u32string letters = letters_of(text), left = letters_of(kept);
    const size_t front = left.find(U'…'), back = left.size() - 1 - front;
    CHECK((front == back || front == back + 1));
    CHECK(letters.starts_with(left.substr(0, front)));
    CHECK(letters.ends_with(left.substr(front + 1)));
    // with one more letter it would be too wide
    const size_t next = front == back ? front : letters.size() - 1 - back;
    CHECK(font.width(kept + text_of(letters.substr(next, 1)), height) > width);
  }
}

TEST_CASE("without its font no letters are drawn, and a message names the file") {
  for (const std::string& path : {nowhere, std::string("README.md"), std::string("docs")}) {
    const Font font(path);
    CAPTURE(font.fault());
    CHECK(font.fault().starts_with("pictures have no letters: "));
    CHECK(font.fault().find(path) != std::string::npos);
    CHECK(font.width("Größe", 9) == 0);
    CHECK(font.shortened("Größe", 9, 1) == "Größe");
    CHECK(font.missing("力").empty());
    bool covers = false;
    font.cover({"Größe", {20, 60}}, {200, 100}, [&](int, int, float) { covers = true; });
    CHECK_FALSE(covers);
  }
  const Chart chart{.title = "a title", .series = {{"epsilon", {0.1, 0.2}}}};
  const Picture bare = paint(draw_chart(chart, {}, Font(nowhere)), Font(nowhere));
  CHECK(bare.width == 960);
  CHECK(bare.pixels != paint(draw_chart(chart), Font()).pixels);
}

TEST_CASE("threads that draw at the same time draw the same") {
  const Chart chart{.title = "Größe", .labels = {"µ", "力"}, .series = {{"ε", {0.1, 0.2}}}};
  const Picture expected = paint(draw_chart(chart), Font());
  std::vector<Picture> drawn(4);
  std::vector<std::jthread> threads;
  for (Picture& picture : drawn)
    threads.emplace_back([&] { picture = paint(draw_chart(chart), Font()); });
  threads.clear();
  for (const Picture& picture : drawn) CHECK(picture.pixels == expected.pixels);
}
