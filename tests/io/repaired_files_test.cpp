// Every file of tests/data/repaired/ is read, and reports the messages in the file next to it, one
// per line; with strict options it is rejected with the first.
#include <doctest/doctest.h>

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/text/repairs.h"
#include "read_any.h"
#include "support/listening.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> repaired(const fs::path& path) {
  std::vector<std::string> out;
  ReadOptions options;
  options.diagnostics =
      test::Listening{.repair = [&](const std::string& sentence) { out.push_back(sentence); }};
  test::read_any(path, options);
  return out;
}

}  // namespace

TEST_CASE("what a file has wrong and can be put right is told by file and line, and read") {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator("tests/data/repaired"))
    if (fs::exists(fs::path(entry.path()).replace_extension(".txt")) &&
        entry.path().extension() != ".txt")
      files.push_back(entry.path());
  std::ranges::sort(files);
  CHECK(files.size() >= 30);
  for (const auto& file : files) {
    INFO(file.string());
    std::vector<std::string> expected;
    LineReader lines("", read_text(fs::path(file).replace_extension(".txt")));
    while (lines.skip_to_full()) expected.emplace_back(lines.next().text());
    CHECK(repaired(file) == expected);
    std::string thrown;
    try {
      ReadOptions options;
      options.diagnostics = test::Listening{.note = [](const std::string&) {}};
      test::read_any(file, strict(options));
    } catch (const Error& error) {
      thrown = error.what();
    }
    // messages about unused or suspicious contents may come before
    CHECK(!thrown.empty());
  }
}

TEST_CASE("files of the original's last distribution are repaired in one sentence each") {
  REQUIRE_SHARED();
  const fs::path robots = test::shared() / "data/graspit-xml/models/robots";
  const auto check = [&](const char* file, const std::string& sentence) {
    INFO(file);
    CHECK(repaired(robots / file) == std::vector{sentence});
  };
  check("M7tool/M7tool.xml",
        "M7tool.xml:44: joint 0: minValue 30 exceeds maxValue -4; they are exchanged");
  check("jaco_robot/jaco_robot.xml",
        "jaco_robot.xml:6: DOF 0: maxEffort: -1.5 is negative; 1.5 is used (2 more alike)");
  check("Robonaut/Robonaut.xml",
        "Robonaut.xml:304: flockOfBirds: number: expected a whole number from 0 on, got 't'; 0 is "
        "used");
  check("MicoGripper/MicoGripper.xml",
        "eigen.xml:2: 1 DOF is declared, and numbers of 4 are given; 4 are used");
  check(
      "harvardHand/harvardHandTwist3.xml",
      "harvardHandTwist3.xml:127: link 3: OverlappingPair without a targetChain; its own chain, 0, "
      "is used (3 more alike)");
}

TEST_CASE("what is wrong alike at many places is told once, with how many more there are") {
  std::vector<std::string> told;
  Repairs repairs(
      test::Listening{.repair = [&](const std::string& sentence) { told.push_back(sentence); }});
  double low = 3, high = 1;
  repairs.order(low, high, Place("a", 1, "x"));
  CHECK(low == 1);
  CHECK(high == 3);
  repairs.order(low, high, Place("a", 2, "x"));
  CHECK(repairs.magnitude(-2, Place("a", 3, "y")) == 2);
  CHECK(repairs.magnitude(-3, Place("a", 4, "y")) == 3);
  CHECK(repairs.magnitude(4, Place("a", 5, "y")) == 4);
  CHECK(repairs.within(2, 0, 1, Place("a", 6, "z")) == 1);
  CHECK(repairs.count("7", Place("a", 7, "n")) == 7);
  CHECK(repairs.count("1.5", Place("a", 8, "n")) == 0);
  CHECK(repairs.count("1e9", Place("a", 9, "n")) == 0);
  CHECK(told.empty());
  repairs.tell();
  CHECK(told ==
        std::vector<std::string>{"a:1: x: min 3 exceeds max 1; they are exchanged",
                                 "a:3: y: -2 is negative; 2 is used (1 more alike)",
                                 "a:6: z: 2 is not in 0..1; 1 is used",
                                 "a:8: n: expected a whole number from 0 on, got '1.5'; 0 is "
                                 "used (1 more alike)"});
  repairs.tell();
  CHECK(told.size() == 4);
}

TEST_CASE("a name that is taken gets the next number that is not") {
  const std::set<std::string> taken = {"a", "a_2"};
  CHECK(unused_name("a", taken) == "a_3");
}

TEST_CASE("who reads strictly is refused what others are warned of") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.write("a.xml", "<root>\n<mass>-3</mass></root>");
  std::vector<std::string> told;
  ReadOptions options;
  options.diagnostics =
      test::Listening{.warn = [&](const std::string& sentence) { told.push_back(sentence); }};
  CHECK(read_body(file, options).mass == doctest::Approx(0.003));
  REQUIRE(!told.empty());
  CHECK(told.front() == "a.xml:2: mass: -3 is negative; 3 is used");
  CHECK_THROWS_WITH_AS(read_body(file, strict(options)), told.front().c_str(), Error);
}
