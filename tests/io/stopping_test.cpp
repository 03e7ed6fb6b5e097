// Readers check often for requests to stop, and stop.
#include <fmt/format.h>

#include "clench/base/watched.h"
#include "clench/io/inventor/read_geometry.h"
#include "clench/io/text/csv.h"
#include "clench/io/text/xml.h"
#include "clench/io/text/yaml.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;

namespace {

constexpr int side = 120;  // of a grid of points

template <class Point, class Face>
std::string grid_text(std::string text, Point point, Face face) {
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) text += point(i * 0.01, j * 0.01);
  for (int i = 0; i + 1 < side; ++i)
    for (int j = 0; j + 1 < side; ++j) {
      const int at = i * side + j;
      text += face(at, at + 1, at + side);
      text += face(at + 1, at + side + 1, at + side);
    }
  return text;
}

std::string obj_text() {
  return grid_text(
      "", [](double x, double y) { return fmt::format("v {} {} 0\n", x, y); },
      [](int a, int b, int c) { return fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1); });
}

std::string listed_text(const char* head) {
  return grid_text(
      fmt::format(fmt::runtime(head), side * side, 2 * (side - 1) * (side - 1)),
      [](double x, double y) { return fmt::format("{} {} 0\n", x, y); },
      [](int a, int b, int c) { return fmt::format("3 {} {} {}\n", a, b, c); });
}

std::string inventor_text() {
  std::string text = "#Inventor V2.1 ascii\nSeparator { Coordinate3 { point [\n";
  for (int i = 0; i < side * side; ++i) text += fmt::format("{} {} 0,\n", i % side, i / side);
  text += "] } IndexedFaceSet { coordIndex [\n";
  for (int i = 0; i + side + 1 < side * side; ++i)
    if (i % side < side - 1) text += fmt::format("{}, {}, {}, -1,\n", i, i + 1, i + side);
  return text + "] } }\n";
}

// Stops the reading at the first, the middle and the last check.   returns  number of checks of a
// complete reading
template <class Read>
uint64_t checks_of(Read read) {
  uint64_t checks = 0;
  {
    const Watched watched{Progress()};
    read();
    checks = watched.checks();
  }
  for (const uint64_t at : {uint64_t{1}, checks / 2, checks}) {
    if (at == 0) continue;
    Watched watched{Progress()};
    watched.stop_at(at);
    CHECK_THROWS_AS(read(), Stopped);
  }
  return checks;
}

}  // namespace

TEST_CASE("readers of text check every few thousand words") {
  constexpr const char *ply =
                           "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty "
                           "float y\nproperty float z\nelement face {}\nproperty list uchar int "
                           "vertex_indices\nend_header\n",
                       *off = "OFF\n{} {} 0\n";
  const std::pair<const char*, std::string> files[] = {{"a.obj", obj_text()},
                                                       {"a.ply", listed_text(ply)},
                                                       {"a.off", listed_text(off)},
                                                       {"a.iv", inventor_text()}};
  for (const auto& [name, text] : files) {
    CAPTURE(name);
    const TemporaryFolder folder;
    const auto path = folder.write(name, text);
    // a word has about five letters
    CHECK(checks_of([&] { read_geometry(path, {}); }) >= text.size() / 5 / 8192);
  }
}

TEST_CASE("readers of XML, YAML and CSV check every few thousand elements") {
  std::string xml = "<a>", yaml, csv;
  for (int i = 0; i < 5000; ++i) {
    xml += fmt::format("<b x=\"{}\"/>", i);
    yaml += fmt::format("- {}\n", i);
    csv += fmt::format("{},1,2,3\n", i);
  }
  xml += "</a>";
  CHECK(checks_of([&] { XmlFile("a.xml", xml); }) >= 2);
  CHECK(checks_of([&] { parse_yaml("a.yaml", yaml); }) >= 2);
  CHECK(checks_of([&] {
          const std::string name = "a.csv";
          CsvReader reader(name, csv);
          for (CsvRecord record; reader.next(record);) continue;
        }) >= 2);
}
