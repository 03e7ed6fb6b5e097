#include "clench/base/diagnostic.h"

#include <doctest/doctest.h>

#include <vector>

#include "clench/base/placed_error.h"

namespace clench {

TEST_CASE("a place is written with its known parts") {
  CHECK(Place().text().empty());
  CHECK(Place("a.cfg").text() == "a.cfg");
  CHECK(Place("a.cfg", 31).text() == "a.cfg:31");
  CHECK(Place("a.cfg", 31).of("joint {}", 2).of("min").text() == "a.cfg:31: joint 2: min");
  CHECK(Place("", 0, "robot 'x'").text() == "robot 'x'");
  CHECK(Place("a.cfg", 31).before("no word") == "a.cfg:31: no word");
  CHECK(Place().before("no word") == "no word");
  CHECK(fmt::format("{}: no word", Place("a.cfg", 31)) == "a.cfg:31: no word");
  CHECK_FALSE(std::is_convertible_v<std::string, Place>);
}

TEST_CASE("a sink receives the parts of each diagnostic as values") {
  std::vector<Diagnostic> list;
  const Diagnostics sink([&](const Diagnostic& d) { list.push_back(d); });
  sink.warn(Place("a.cfg", 3).of("mass"), "{} words are not used", 2);
  sink.note(Place("a.cfg"), "no mass is given");
  sink.repaired(Place("a.cfg", 4), "-1 is negative; 1 is used");
  sink.suspected(Place("a.cfg", 5), "it is {} m large", 300);
  sink.lost("b.urdf", "the tendons");
  REQUIRE(list.size() == 5);
  CHECK(list[0].place == Place("a.cfg", 3, "mass"));
  CHECK(list[0].text == "2 words are not used");
  CHECK(list[0].sentence() == "a.cfg:3: mass: 2 words are not used");
  CHECK(list[4].place == Place("b.urdf"));
  CHECK(list[4].sentence() == "b.urdf does not hold the tendons");
  const About abouts[] = {About::ignored, About::inferred, About::repaired, About::suspicious,
                          About::none};
  for (size_t i = 0; i < list.size(); ++i) {
    CHECK(list[i].about == abouts[i]);
    CHECK(list[i].severity == (i == 1 ? Severity::note : Severity::warning));
  }
}

TEST_CASE("a sink without notes receives all other diagnostics, and one without a receiver none") {
  int heard = 0;
  const Diagnostics sink([&](const Diagnostic&) { ++heard; });
  sink.without_notes().note(Place(), "a note");
  CHECK(heard == 0);
  sink.without_notes().warn(Place(), "a warning");
  CHECK(heard == 1);
  CHECK_FALSE(static_cast<bool>(Diagnostics().without_notes()));
  Diagnostics().warn(Place(), "nobody listens");
}

TEST_CASE("equal problems are reported in one sentence with their number") {
  Diagnostic one(Place("a.cfg", 3), "it is negative");
  CHECK(one.sentence() == "a.cfg:3: it is negative");
  one.count = 3;
  CHECK(one.sentence() == "a.cfg:3: it is negative (2 more alike)");
}

TEST_CASE("an error contains its place and keeps its kind") {
  const PlacedError error(Place("a.cfg", 3), "no word");
  CHECK(std::string(error.what()) == "a.cfg:3: no word");
  CHECK(error.place() == Place("a.cfg", 3));
  const PlacedError of_file(error, ErrorKind::file);
  CHECK(of_file.kind() == ErrorKind::file);
  CHECK(of_file.place() == error.place());
  CHECK(std::string(of_file.what()) == "a.cfg:3: no word");
  CHECK_THROWS_WITH_AS(fail(Place("a.cfg", 4), "expected {}", 5), "a.cfg:4: expected 5",
                       PlacedError);
}

}  // namespace clench
