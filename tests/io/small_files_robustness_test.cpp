// Small files of hands and planners: bad ones are rejected with the message in the file next to
// them; files cut at any position or changed at random give values or Errors that name the file.
#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/graspit/inventor_primitives.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "support/mutate.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

struct Format {
  const char* folder;  // of tests/data/bad
  const char* ending;
  void (*read)(const fs::path&);
  std::string sound;  // a file in it
};

const std::string edge_lines = "2\n1 0 0 0 0 0\n0 0 0 0 0 1.64\n";
const std::string place = "1 2 3\n1 0 0 0\n1 2 3\n0 0 1\n0.5\n";

const Format formats[] = {
    {"egr", "egr", [](const fs::path& path) { read_eigengrasps(path); },
     "DIMENSIONS 3\nEG\n0.51\n1 0 0.5\nEG\n0.25\n0 1 0\nORIGIN\n0\n.1 .2 .3\nNORM\n0\n1 1 "
     "2\njunk\n"},
    {"egr", "xml", [](const fs::path& path) { read_eigengrasps(path); },
     "<EigenGrasps dimensions=\"2\"><EG><EigenValue value=\"0.5\"/><Limits min=\"-1\" max=\"1\"/>"
     "<DimVals d0=\"1\" d1=\"2\"/></EG><ORIGIN><DimVals d1=\"0.2\"/></ORIGIN></EigenGrasps>"},
    {"vgr", "vgr", [](const fs::path& path) { read_virtual_contacts(path); },
     "Hand\n2\n-1 0\n" + edge_lines + place + "0 1\n" + edge_lines + place},
    {"vgr", "xml", [](const fs::path& path) { read_virtual_contacts(path); },
     "<virtual_contacts><robot_name>H</robot_name><num_contacts>1</num_contacts><virtual_contact>"
     "<finger_number>0</finger_number><link_number>0</link_number><num_friction_edges>1"
     "</num_friction_edges><friction_edges><friction_edge>1 0 0 0 0 0</friction_edge>"
     "</friction_edges><location>1 2 3</location><rotation>1 0 0 0</rotation><translation>1 2 3"
     "</translation><normal>0 0 1</normal><sCof>0.5</sCof></virtual_contact></virtual_contacts>"},
    {"object_contacts", "con", [](const fs::path& path) { read_object_contacts(path); },
     "2\n" + edge_lines + "1 0 0 0\n1 2 3\n0 0 1\n0.5\n" + edge_lines +
         "1 0 0 0\n1 2 3\n0 0 1\n0.5\n"},
    {"primitives", "iv", [](const fs::path& path) { read_primitives(path); },
     "#Inventor V2.1 ascii\nSeparator { Transform { translation 1 2 3 } Cube { width 20 } }\nCone "
     "{ "
     "bottomRadius 3 }\n"},
    {"pregrasps", "lst", [](const fs::path& path) { read_pregrasps(path); },
     "[0 80 0][0 -1 0][1 0 0]60\n[1 2 3][0 0 1][0 1 0]90\n"},
    {"planned_grasps", "lst", [](const fs::path& path) { read_planned_grasps(path); },
     "0 0 0 0 0 0 0 0 -2\n1 2 3 1 0 0 0 60 0.25\n4 5 6 0 1 0 0 0 -1\n"},
    {"glove_calibration", "cal", [](const fs::path& path) { read_glove_calibration(path); },
     "2 3\n1 2 3\n4 5 6\n-1 -2\n"},
    {"glove_poses", "cal", [](const fs::path& path) { read_glove_poses(path); },
     "1\n3\n12.5\n1\n10 20 30\n1\n0 -1 2\n1\n0.1 0.2 0.3\n0 0 0 1\n1 2 3\n"},
};

/// the test fails if the message does not name the file
/// returns  true if it was rejected
bool refused_text(const TemporaryFolder& folder, const Format& format, const std::string& text) {
  const std::string name = std::string("a.") + format.ending;
  try {
    format.read(folder.write(name, text));
    return false;
  } catch (const Error& error) {
    CHECK_MESSAGE(std::string(error.what()).starts_with(name), error.what());
    return true;
  }
}

const test::Oddities odd_lines = {{"-1", "999999999", "-2147483648", "1e308", "nan",   "1e-320",
                                   "EG", "#",         "\n",          "[",     "]",     "<",
                                   ">",  "0 0 0 0",   "\"",          "d7=",   "</EG>", "inf",
                                   ",",  "Cube {",    "NORM",        "100",   "+",     ""}};

}  // namespace

TEST_CASE("malformed small files are told by file, line, expected and got") {
  int checked = 0;
  for (const Format& format : formats) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path("tests/data/bad") / format.folder)) {
      const fs::path& path = entry.path();
      const bool other = std::any_of(std::begin(formats), std::end(formats), [&](const Format& f) {
        return &f != &format && f.folder == std::string(format.folder) &&
               path.extension() == std::string(".") + f.ending;
      });
      if (path.extension() != ".txt" && !other) files.push_back(path);
    }
    std::sort(files.begin(), files.end());
    CHECK(files.size() >= 3);
    for (const auto& file : files) {
      const std::string sentence(trim(read_text(fs::path(file).replace_extension(".txt"))));
      INFO(file.string());
      CHECK_THROWS_WITH_AS(format.read(file), sentence.c_str(), Error);
      ++checked;
    }
  }
  CHECK(checked > 60);
}

TEST_CASE("a small file that does not exist, or is a folder, is told by its name") {
  for (const Format& format : formats) {
    if (format.folder == std::string("primitives")) continue;  // its ending is checked first
    CHECK_THROWS_WITH_AS(format.read("tests/none.egr"), "no such file: tests/none.egr", Error);
    CHECK_THROWS_WITH_AS(format.read("tests/data"), "tests/data: expected a file, got a folder",
                         Error);
  }
}

TEST_CASE("small files cut short anywhere are values or Errors that name the file") {
  TemporaryFolder folder;
  for (const Format& format : formats) {
    INFO(format.folder << " " << format.ending);
    CHECK_FALSE(refused_text(folder, format, format.sound));
    for (size_t n = 0; n < format.sound.size(); ++n)
      refused_text(folder, format, format.sound.substr(0, n));
  }
}

TEST_CASE("small files changed at random are values or Errors that name the file") {
  TemporaryFolder folder;
  for (const Format& format : formats)
    for (uint64_t i = 0; i < 150; ++i) {
      Random random(17, i);
      const std::string bad = test::mutated(format.sound, odd_lines, random);
      INFO(bad);
      refused_text(folder, format, bad);
    }
}

TEST_CASE("noise is an Error in every small format") {
  TemporaryFolder folder;
  for (const Format& format : formats)
    for (uint64_t i = 0; i < 20; ++i) {
      Random random(18, i);
      const std::string noise = 'x' + test::noise(random);
      CHECK(refused_text(folder, format, noise));
    }
}
