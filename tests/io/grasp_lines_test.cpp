#include "clench/io/grasp_lines.h"

#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/random.h"
#include "clench/io/text/file_kind.h"
#include "support/folder.h"
#include "support/listening.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

GraspSpec random_grasp(Random& random) {
  const auto vector = [&] {
    return Vector3d(random.normal(), random.normal() * 1e-9, random.normal() * 1e6);
  };
  GraspSpec g;
  g.hand_name = "hand \"quoted\"\n";
  g.object_name = "Gr\u00fc\u00dfe";
  g.hand_file = random.uniform() < 0.5 ? "" : "models/hands/a b.cfg";
  if (random.uniform() < 0.8) g.X_OH = random_pose(random, 3);
  for (int i = 0; i < 5; ++i) g.dofs.push_back(random.normal());
  for (int i = 0; i < 7; ++i) g.joints.push_back(random.normal());
  for (int i = 0; i < 3; ++i) {
    g.points.push_back({.p_O = vector(),
                        .n_O = vector().normalized(),
                        .mu = random.uniform(),
                        .torsion_radius = i == 1 ? random.uniform() : 0});
    g.links.push_back("link " + std::to_string(i));
  }
  g.com = vector();
  g.rho = random.uniform(1e-6, 1e6);
  g.largest_radius = random.uniform(0.1, 1);
  g.gyration_radius = random.uniform(0.1, 1);
  g.options = {.edges = random.uniform() < 0.5 ? round_edges : 12,
               .rho = g.rho,
               .soft = random.uniform() < 0.5,
               .normal_force = std::vector<double>{1, random.uniform(), 3},
               .modulus = random.uniform() < 0.5 ? ModulusRule::larger : ModulusRule::series};
  g.measures = {{"epsilon", random.uniform()}, {"volume", 1e-300}};
  g.info = {{"seed", 9007199254740992.0}, {"energy", -random.uniform()}};
  return g;
}

void check_equal(const GraspSpec& a, const GraspSpec& b) {
  CHECK(a.hand_name == b.hand_name);
  CHECK(a.object_name == b.object_name);
  CHECK(a.hand_file == b.hand_file);
  CHECK(a.object_file == b.object_file);
  CHECK(a.X_OH == b.X_OH);
  CHECK(a.dofs == b.dofs);
  CHECK(a.joints == b.joints);
  CHECK(a.links == b.links);
  REQUIRE(a.points.size() == b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    CHECK(a.points[i].p_O == b.points[i].p_O);
    CHECK(a.points[i].n_O == b.points[i].n_O);
    CHECK(a.points[i].mu == b.points[i].mu);
    CHECK(a.points[i].torsion_radius == b.points[i].torsion_radius);
  }
  CHECK(a.com == b.com);
  CHECK(a.rho == b.rho);
  CHECK(a.largest_radius == b.largest_radius);
  CHECK(a.gyration_radius == b.gyration_radius);
  CHECK(a.options.edges == b.options.edges);
  CHECK(a.options.soft == b.options.soft);
  CHECK(a.options.normal_force.values == b.options.normal_force.values);
  CHECK(a.options.modulus == b.options.modulus);
  CHECK(a.measures == b.measures);
  CHECK(a.info == b.info);
}

const std::string list_head = R"({"format":"clench grasps","version":1})";
// without its brackets, so that a test can change it
const std::string whole =
    R"("hand":"h","object":"o","pose":{"xyz":[0,0,0],"quat":[1,0,0,0]},"dofs":[],"joints":[],)"
    R"("points":[{"point":[0,0,1],"normal":[0,0,-1],"mu":0.5}],"com":[0,0,0],"rho":1,)"
    R"("largest_radius":1,"gyration_radius":1,"edges":8,"soft":true,"normal_force":[5],)"
    R"("modulus":"series","measures":{},"info":{})";

// a grasp with one text replaced by another
std::string with(const std::string& from, const std::string& to) {
  std::string line = "{" + whole + "}";
  const size_t at = line.find(from);
  REQUIRE(at != std::string::npos);
  return line.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("grasps that are written and read again are the same to the bit, and so is the file") {
  const TemporaryFolder folder;
  Random random(17);
  std::vector<GraspSpec> list;
  for (int i = 0; i < 40; ++i) list.push_back(random_grasp(random));
  const auto first = folder.path() / "a.jsonl", second = folder.path() / "b.jsonl";
  write_grasps(list, first);
  const auto back = read_grasps(first);
  REQUIRE(back.size() == list.size());
  for (size_t i = 0; i < list.size(); ++i) check_equal(back[i], list[i]);
  write_grasps(back, second);
  CHECK(read_bytes(first) == read_bytes(second));
  CHECK(file_kind(first) == FileKind::grasps);
  write_grasps({}, first);
  CHECK(read_grasps(first).empty());
}

TEST_CASE("a list that is cut anywhere in its last line keeps the others, with a warning") {
  const TemporaryFolder folder;
  Random random(3);
  const auto path = folder.path() / "a.jsonl";
  write_grasps({random_grasp(random), random_grasp(random), random_grasp(random)}, path);
  const std::string text = read_bytes(path);
  const size_t last = text.rfind('\n', text.size() - 2) + 1;
  std::string warned;
  const ReadOptions options{
      .diagnostics = Listening{.warn = [&](const std::string& sentence) { warned += sentence; }}};
  // all cuts near the ends of the line, and some between
  constexpr size_t step = 7;
  const auto is_tried = [&](size_t size) {
    return size < last + 20 || size + 20 > text.size() || size % step == 0;
  };
  for (size_t size = last; size <= text.size(); ++size) {
    if (!is_tried(size)) continue;
    CAPTURE(size);
    write_file(path, text.substr(0, size));
    warned.clear();
    const bool complete = size + 1 >= text.size();  // only the line end may be missing
    REQUIRE(read_grasps(path, options).size() == (complete ? 3 : 2));
    REQUIRE(warned.starts_with(
        complete || size == last ? ""
                                 : "a.jsonl:4: the last line is cut short and is skipped, got '{"));
    REQUIRE(warned.empty() == (complete || size == last));
  }
  write_file(path, text.substr(0, last + 20));
  CHECK_THROWS_WITH_AS(read_grasps(path, strict({})), doctest::Contains("is cut short"), Error);
  // in the middle it is an error
  write_file(path, text.substr(0, last + 20) + "\n" + text.substr(last));
  CHECK_THROWS_WITH_AS(read_grasps(path), doctest::Contains("a.jsonl:4: expected a line of JSON"),
                       Error);
}

TEST_CASE("notes of a list stand in its first line") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jsonl";
  write_grasps({}, path, R"({"search":{"seed":"1"}})");
  CHECK(read_bytes(path).find(R"("notes":{"search":{"seed":"1"}}})") != std::string::npos);
  CHECK(read_grasps(path).empty());
}

TEST_CASE("a measure that is infinite is left out") {
  const TemporaryFolder folder;
  GraspSpec grasp;
  grasp.measures = {{"a", INFINITY}, {"b", 2}, {"c", NAN}};
  write_grasps({grasp}, folder.path() / "a.jsonl");
  CHECK(read_grasps(folder.path() / "a.jsonl")[0].measures ==
        std::map<std::string, double>{{"b", 2}});
}

TEST_CASE("a list of grasps that is none is refused with its line, expected and got") {
  const TemporaryFolder folder;
  const std::pair<std::string, const char*> cases[] = {
      {"", "g.jsonl: expected a list of grasps, got an empty file"},
      {"\n\n", "g.jsonl: expected a list of grasps, got an empty file"},
      {"{}", R"(g.jsonl:1: expected a list of grasps, "format": "clench grasps", got {})"},
      {"[1]", "g.jsonl:1: expected a list of grasps"},
      {R"({"format":"clench grasps","version":2})", "g.jsonl:1: expected version 1, got 2"},
      {R"({"format":"clench grasps"})", "g.jsonl:1: expected version 1, got none"},
      {list_head + "\nx", "g.jsonl:2: expected a line of JSON, got 'x'"},
      {list_head + "\n{\"hand\":\"h\n", "g.jsonl:2: expected a line of JSON, got '{\"hand\":\"h'"},
      {list_head + "\n{\"hand\": oops}",
       "g.jsonl:2: expected a line of JSON, got '{\"hand\": oops}'"},
      {"{\"format\":\"cle", "g.jsonl:1: expected a line of JSON, got '{\"format\":\"cle'"},
      {list_head + "\n[]", "g.jsonl:2: expected an object, got []"},
      {list_head + "\n{}", "g.jsonl:2: expected a key 'hand', got none"},
      {list_head + "\n\n" + with(R"("h")", "3"), "g.jsonl:3: hand: expected a string, got 3"},
      {list_head + "\n" + with("[1,0,0,0]", "[1,0,0]"),
       "pose: quat: expected 4 numbers, got [1,0,0]"},
      {list_head + "\n" + with("[1,0,0,0]", "[2,0,0,0]"),
       "pose: quat: expected a quaternion of length 1, got [2,0,0,0]"},
      {list_head + "\n" + with("[0,0,-1]", "[0,0,-2]"),
       "points[1]: normal: expected a vector of length 1, got [0,0,-2]"},
      {list_head + "\n" + with("0.5", "-1"), "points[1]: mu: expected a number >= 0, got -1"},
      {list_head + "\n" + with("0.5", "null"), "points[1]: mu: expected a number >= 0, got null"},
      {list_head + "\n" + with("0.5", "1e999"), "g.jsonl:2: expected a line of JSON"},
      {list_head + "\n" + with("\"rho\":1", "\"rho\":0"), "rho: expected a number > 0, got 0"},
      {list_head + "\n" + with("\"edges\":8", "\"edges\":2"),
       "edges: expected a whole number from 3 to 1000, or \"exact\" or 0 for round cones, got 2"},
      {list_head + "\n" + with("\"edges\":8", "\"edges\":3.5"),
       "edges: expected a whole number from 3"},
      {list_head + "\n" + with("\"edges\":8", "\"edges\":\"exactly\""),
       "edges: expected a whole number from 3 to 1000, or \"exact\" or 0 for round cones, got "
       "\"exactly\""},
      {R"({"format":"clench grasps","version":1,"units":"mm, kg, s, deg, N"})",
       R"(g.jsonl:1: units: expected "m, kg, s, rad, N", got "mm, kg, s, deg, N")"},
      {list_head + "\n" + with(R"("dofs":[])", R"("dofs":[1,2],"dof_units":["rad","deg"])"),
       "g.jsonl:2: dof_units: expected the unit rad or m, got 'deg'"},
      {list_head + "\n" + with(R"("dofs":[])", R"("dofs":[1,2],"dof_names":["a","a"])"),
       "g.jsonl:2: dof_names: 'a' appears twice"},
      {list_head + "\n" + with(R"("joints":[])", R"("joints":1)"),
       "joints: expected a list of numbers, got 1"},
      {list_head + "\n" + with("true", "1"), "soft: expected true or false, got 1"},
      {list_head + "\n" + with("series", "serial"),
       "modulus: expected 'series' or 'larger', got \"serial\""},
      {list_head + "\n" + with(R"("measures":{})", R"("measures":{"a":"b"})"),
       "measures.a: expected a number, got \"b\""},
      {list_head + "\n" + with(R"("info":{})", R"("info":{},"infos":1)"),
       "g.jsonl:2: unknown key 'infos'; did you mean 'info'?"},
      {list_head + "\n" + std::string(100000, '['), "expected lists and objects at most 8 deep"},
  };
  for (const auto& [text, message] : cases) {
    std::string said = "nothing";
    try {
      read_grasps(folder.write("g.jsonl", text));
    } catch (const Error& error) {
      said = error.what();
      CHECK(error.kind() == ErrorKind::file);
    }
    CHECK_MESSAGE(said.find(message) != std::string::npos, said);
  }
  CHECK(read_grasps(folder.write("g.jsonl", list_head + "\r\n{" + whole + "}")).size() == 1);
}

TEST_CASE("control and bidirectional characters of names are escapes in a line") {
  GraspSpec grasp;
  grasp.hand_name =
      "a\u202Eb\u0085\x7F\u2066\u2028"
      "c";
  grasp.labels["planner"] = "\u00e9\t";
  const std::string line = grasp_line(grasp);
  CHECK(line.find("\"hand\":\"a\\u202eb\\u0085\\u007f\\u2066\\u2028c\"") != std::string::npos);
  CHECK(line.find("{\"planner\":\"\u00e9\\t\"}") != std::string::npos);
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jsonl";
  write_grasps({grasp}, path);
  CHECK(read_grasps(path).front().hand_name == grasp.hand_name);
}

TEST_CASE(
    "a grasp that is written by hand may leave out joints and names the edges as a script does") {
  const TemporaryFolder folder;
  const auto only = [&](const std::string& line) {
    return read_grasps(folder.write("g.jsonl", list_head + "\n" + line)).at(0);
  };
  const GraspSpec plain =
      only(with(R"("dofs":[],"joints":[],)", R"("dofs":[0.5],"dof_units":["rad"],)"));
  CHECK(plain.dofs == std::vector{0.5});
  CHECK(plain.joints.empty());
  CHECK(only(with("\"edges\":8", "\"edges\":\"exact\"")).options.edges == round_edges);
  CHECK(only(with("\"edges\":8", "\"edges\":0")).options.edges == round_edges);
}
