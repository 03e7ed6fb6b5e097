#include "clench/render/view/label_layout.h"

#include <doctest/doctest.h>

#include "clench/base/random.h"
#include "clench/render/render.h"
#include "clench/scene/force_arrows.h"
#include "clench/scene/wrench_scene.h"
#include "letters.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector2f;
using Eigen::Vector3d;

namespace {

bool within(const PixelBox& box, const Vector2f& picture) {
  return (box.low.array() >= 0).all() && (box.high.array() <= picture.array() + 1e-3f).all();
}

void check_apart(const std::vector<PlacedText>& texts, const Vector2f& picture) {
  for (size_t i = 0; i < texts.size(); ++i) {
    CAPTURE(texts[i].text);
    CHECK(within(texts[i].box, picture));
    for (size_t k = 0; k < i; ++k) CHECK_FALSE(texts[i].box.overlaps(texts[k].box));
  }
}

bool is_written(const std::vector<PlacedText>& texts, const std::string& text) {
  return std::ranges::find(texts, text, &PlacedText::text) != texts.end();
}

}  // namespace

TEST_CASE("overlapping boxes are spread within the picture, and the first one stays") {
  Random random(3);
  const Vector2f picture(400, 300);
  std::vector<PixelBox> expected;
  for (int i = 0; i < 60; ++i) {
    const Vector2f at(static_cast<float>(random.uniform(100, 220)),
                      static_cast<float>(random.uniform(80, 160)));
    expected.push_back({at, at + Vector2f(40, 10)});
  }
  const PixelBox taken{{90, 150}, {300, 170}};
  const auto places = spread_boxes(expected, picture, {taken});
  REQUIRE(places.size() == expected.size());
  CHECK(places[0]->low == expected[0].low);
  int placed = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    ++placed;
    CHECK(within(*places[i], picture));
    CHECK_FALSE(places[i]->overlaps(taken));
    // four heights up and down, eight sideways
    CHECK((places[i]->low - expected[i].low).cwiseAbs().x() <= 80.01f);
    CHECK((places[i]->low - expected[i].low).cwiseAbs().y() <= 40.01f);
    for (size_t k = 0; k < i; ++k) CHECK_FALSE((places[k] && places[i]->overlaps(*places[k])));
  }
  CHECK(placed > 20);
}

TEST_CASE("a box at the edge is moved inside, and one without space is omitted") {
  const Vector2f picture(100, 50);
  const PixelBox edge{{90, -5}, {110, 5}};
  const auto moved = spread_boxes({{edge}}, picture);
  CHECK(moved[0]->low == Vector2f(80, 0));
  CHECK_FALSE(spread_boxes({{edge}}, picture, {{{0, 0}, {100, 50}}})[0]);
}

TEST_CASE("the labels of a wrench space do not overlap, from any viewpoint") {
  const Vector2f picture(640, 480);
  Scene scene = make_wrench_scene({.solid = Shape::make(box(2, 1, 1)),
                                   .axes = {"fx", "fy", "fz"},
                                   .ball = 0.1,
                                   .weakest = Vector3d(0.1, 0, 1),
                                   .title = "a wrench space",
                                   .epsilon = 0.1});
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    Eye eye = frame_all(scene, 640.0 / 480);
    if (i > 0) {
      const Vector3d away(random.normal(), random.normal(), random.normal());
      eye.eye = eye.target + 5 * away.normalized();
    }
    const auto texts = place_texts(scene, eye, picture, letters());
    check_apart(texts, picture);
    CHECK(is_written(texts, "a wrench space"));
    for (const char* word : {"fx", "fy", "fz", "weakest", "radius 0.1"}) {
      CAPTURE(word);
      CHECK(is_written(texts, word));
    }
  }
}

TEST_CASE("labels avoid arrows, and are next to the places that they describe") {
  const Vector2f picture(400, 400);
  Scene scene;
  const PlacedForce forces[] = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0.1}, {1, 0, 0}}};
  scene.arrows = force_arrows(forces, 1);
  scene.labels = force_labels(forces, 1);
  Eye eye;
  eye.eye = {0, -6, 0};
  const auto texts = place_texts(scene, eye, picture, letters());
  REQUIRE(texts.size() == 2);
  check_apart(texts, picture);
  // seen along y at 6 m: 400 pixels are 2 * 6 * tan(0.3) = 3.71 m, so the tails, 1 m to the left,
  // are 107.7 pixels from the center
  const PixelBox shaft{{200 - 107.7f, 199}, {200, 201}};
  for (const PlacedText& text : texts) {
    CHECK_FALSE(text.box.overlaps(shaft));
    CHECK(text.text == "1 N");
    CHECK(std::abs((text.box.low.x() + text.box.high.x()) / 2 - (200 - 1.15f * 107.7f)) < 75);
    CHECK(std::abs((text.box.low.y() + text.box.high.y()) / 2 - 200) < 50);
  }
}

TEST_CASE("labels behind the eye or outside the picture are omitted") {
  Scene scene;
  scene.labels = {{{0, 0, 0}, "before"}, {{0, -20, 0}, "behind"}, {{50, 0, 0}, "beside"}};
  Eye eye;
  eye.eye = {0, -6, 0};
  const auto texts = place_texts(scene, eye, {200, 200}, letters());
  REQUIRE(texts.size() == 1);
  CHECK(texts[0].text == "before");
}

TEST_CASE("a picture that is too small for labels has none") {
  Scene scene;
  scene.labels = {{{0, 0, 0}, "a label"}};
  scene.caption = {"a caption"};
  CHECK(place_texts(scene, {}, {120, 120}, letters()).size() == 2);
  CHECK(place_texts(scene, {}, {400, 119}, letters()).empty());
}

TEST_CASE("a line of a caption that is too wide is wrapped") {
  Scene scene;
  scene.caption = {"some words that are too many for one line", "last"};
  const Vector2f picture(200, 200);
  const auto texts = place_texts(scene, {}, picture, letters());
  check_apart(texts, picture);
  REQUIRE(texts.size() > 2);
  CHECK(texts[0].text == "last");
  std::string all = texts.back().text;
  for (size_t i = texts.size() - 1; --i > 0;) all += ' ' + texts[i].text;
  CHECK(all == scene.caption[0]);
}

TEST_CASE("a caption is in the lower left corner, with its lines from the top, none too wide") {
  Scene scene;
  scene.caption = {"first", std::string(200, 'x')};
  const Vector2f picture(300, 200);
  const auto texts = place_texts(scene, {}, picture, letters());
  REQUIRE(texts.size() == 2);
  check_apart(texts, picture);
  CHECK(texts[1].text == "first");
  CHECK(texts[1].box.high.y() < texts[0].box.low.y());
  CHECK(texts[0].text.find("…") != std::string::npos);
  CHECK(texts[0].box.high.y() > 180);
}
