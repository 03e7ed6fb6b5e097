// Small files that request much memory or time.
#include <doctest/doctest.h>

#include <fstream>
#include <functional>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/io/grasp_files.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/text/memory_budget.h"
#include "clench/io/text/yaml.h"
#include "support/folder.h"

#if defined(__SANITIZE_ADDRESS__)
static constexpr bool counts_memory = false;  // the sanitizer keeps freed memory
#else
static constexpr bool counts_memory = true;
#endif

using namespace clench;
using namespace clench::test;

namespace {

/// kB in a row of /proc/self/status; 0: there is no such row.
size_t status_kb(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":")) return std::stoul(line.substr(name.size() + 1));
  return 0;
}

/// Peak memory of a call in excess of the memory before it [bytes].
size_t peak_of(const std::function<void()>& call) {
  { std::ofstream("/proc/self/clear_refs") << "5\n"; }  // resets the peak
  const size_t before = status_kb("VmRSS");
  call();
  const size_t peak = status_kb("VmHWM");
  return peak > before ? (peak - before) * 1024 : 0;
}

std::string times_over(const std::string& text, size_t times) {
  std::string out;
  for (size_t i = 0; i < times; ++i) out += text;
  return out;
}

template <class Item>
std::string joined_items(size_t count, const char* separator, Item item) {
  std::string out;
  for (size_t i = 0; i < count; ++i) out += (i ? separator : "") + item(i);
  return out;
}

const std::string list_head_line = "{\"format\":\"clench grasps\",\"version\":1}\n";
const std::string csv_pose = "x [m],y [m],z [m],qw,qx,qy,qz";

/// An archive whose directory lists one array many times.
std::string shared_arrays(size_t names, size_t size) {
  const std::string one =
      npz_bytes({{"a", {.shape = {size}, .numbers = std::vector<double>(size)}}});
  const size_t from = one.rfind("PK\x01\x02"), to = one.rfind("PK\x05\x06");
  const std::string entry = one.substr(from, to - from);
  std::string out = one.substr(0, from);
  for (size_t i = 0; i < names; ++i) {
    std::string named = entry;
    // another name of the same length
    named.replace(named.rfind("a.npy"), 1, 1, static_cast<char>('a' + i % 26));
    out += named;
  }
  std::string tail = one.substr(to);
  for (const size_t at : {8, 10}) {
    tail[at] = static_cast<char>(names & 255);
    tail[at + 1] = static_cast<char>(names >> 8);
  }
  const auto write = [&](size_t at, size_t x) {
    for (size_t k = 0; k < 4; ++k) tail[at + k] = static_cast<char>((x >> (8 * k)) & 255);
  };
  write(12, entry.size() * names);
  write(16, from);
  return out + tail;
}

struct Hostile {
  const char *what, *file;
  std::string bytes;
};

std::vector<Hostile> hostile_files() {
  const std::string map_of = R"({"gripper":"g","object_id":"o","pose":)";
  const auto key = [](size_t i) { return fmt::format("\"k{}\":\"\"", i); };
  const std::string long_name(2000, 'n');
  const std::string isaac = "format: isaac_grasp\nformat_version: 1.0\ngrasps:\n";
  return {
      {"lines: a list of empty objects", "a.jsonl",
       list_head_line + "{\"hand\":\"a\",\"object\":[" + times_over("{},", 200000) + "1]}"},
      {"lines: an object of many keys", "a.jsonl",
       list_head_line + "{\"labels\":{" + joined_items(50000, ",", key) + "}}"},
      {"lines: many values", "a.jsonl",
       list_head_line + "{\"dofs\":[" + times_over("0,", 400000) + "0]}"},
      {"lines: nested lists", "a.jsonl", list_head_line + times_over("[", 300000)},
      {"lines: many empty lines", "a.jsonl", list_head_line + times_over("\n", 600000) + "x"},
      {"lines: many lines of nothing", "a.jsonl", list_head_line + times_over("{}\n", 200000)},
      {"lines: a long string", "a.jsonl", list_head_line + "\"" + std::string(600000, 'a') + "\""},
      {"csv: many columns", "a.csv",
       csv_pose + "," + joined_items(100000, ",", [](size_t i) { return fmt::format("c{}", i); }) +
           "\n"},
      {"csv: many columns of DOFs", "a.csv",
       csv_pose + "," +
           joined_items(50000, ",", [](size_t i) { return fmt::format("dof {} [m]", i); }) + "\n" +
           times_over("0,", 50006) + "0\n"},
      {"csv: one column, many times", "a.csv", csv_pose + times_over(",a", 300000) + "\n"},
      {"csv: many empty cells", "a.csv", csv_pose + "\n" + times_over(",", 600000)},
      {"csv: long names in many rows", "a.csv",
       csv_pose + "," +
           joined_items(100, ",", [&](size_t i) { return fmt::format("dof {}{}", long_name, i); }) +
           "\n" + times_over("0,0,0,1,0,0,0" + times_over(",0", 100) + "\n", 1500)},
      {"csv: many rows without a grasp", "a.csv", csv_pose + "\n" + times_over(",,,,,,\n", 100000)},
      {"csv: a quote that is open", "a.csv", csv_pose + "\n\"" + times_over("\n", 600000)},
      {"npz: arrays that share their bytes", "a.npz", shared_arrays(2000, 60000)},
      {"npz: many arrays", "a.npz", shared_arrays(8000, 1)},
      {"json: a list of empty lists", "a.json", map_of + "[" + times_over("[],", 200000) + "[]]}"},
      {"json: a list of empty maps", "a.json", map_of + "[" + times_over("{},", 200000) + "{}]}"},
      {"json: a list of numbers", "a.json", map_of + "[" + times_over("0,", 300000) + "0]}"},
      {"json: many keys", "a.json", map_of + "[]," + joined_items(60000, ",", key) + "}"},
      {"json: many poses of few digits", "a.json",
       map_of + "[" + times_over("[0,0,0,1,0,0,0],", 40000) + "[0,0,0,1,0,0,0]]}"},
      {"json: matrices of few digits", "a.json",
       R"({"object":{"file":"o"},"grasps":{"transforms":[)" +
           times_over("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]],", 15000) +
           "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]]}}"},
      {"json: names of DOFs in every grasp", "a.json",
       map_of + "[" + times_over("[0,0,0,1,0,0,0],", 4000) + "[0,0,0,1,0,0,0]],\"dof_names\":[" +
           joined_items(100, ",", [&](size_t i) { return fmt::format("\"{}{}\"", long_name, i); }) +
           "],\"dofs\":[" + times_over("[" + times_over("0,", 99) + "0],", 4000) + "[" +
           times_over("0,", 99) + "0]]}"},
      {"json: nested lists", "a.json", times_over("[", 300000)},
      {"json: nested maps", "a.json", times_over("{\"a\":", 100000)},
      {"json: a long string", "a.json", "{\"a\":\"" + times_over("\\u0041", 100000) + "\"}"},
      {"yaml: a list in brackets on one line", "a.yaml", "a: [" + times_over("0,", 300000) + "0]"},
      {"yaml: lists in brackets", "a.yaml", "a: [" + times_over("[0],\n", 50000) + "0]"},
      {"yaml: maps in brackets", "a.yaml", "[" + times_over("{a: 0},", 30000) + "0]"},
      {"yaml: many keys", "a.yaml",
       isaac + joined_items(15000, "\n", [](size_t i) { return fmt::format("  g{}: {{}}", i); })},
      {"yaml: one key, many times", "a.yaml", times_over("a: 0\n", 30000)},
      {"yaml: many items", "a.yaml", "a:\n" + times_over("- 0\n", 30000)},
      {"yaml: nested items", "a.yaml", times_over("- ", 50000)},
      {"yaml: questions", "a.yaml", times_over("? ", 50000)},
      {"yaml: comments", "a.yaml", times_over("#\n", 50000) + "a: 1"},
      {"yaml: a long text", "a.yaml", "a: " + std::string(600000, 'a')},
      {"yaml: many tags", "a.yaml", times_over("!a ", 50000)},
      {"graspit: one grasp on each line", "a.txt", times_over("0 0 0 1 0 0 0 0 0\n", 20000)},
      {"graspit: a long line", "a.txt", times_over("0 ", 200000)},
  };
}

}  // namespace

TEST_CASE(
    "small files take no more memory than 20 times their size and a fixed part, and no time that "
    "grows with the square of it") {
  const TemporaryFolder folder;
  for (const Hostile& one : hostile_files()) {
    CAPTURE(one.what);
    const auto path = folder.write(one.file, one.bytes);
    std::string said = "a list";
    const size_t peak = peak_of([&] {
      try {
        read_grasp_file(path, {.add = [](GraspSpec&&) {}});
      } catch (const Error& error) {
        said = error.what();
      }
    });
    // heap headers and memory that the heap keeps
    const size_t slack = size_t{16} << 20;
    if (counts_memory)
      CHECK_MESSAGE(peak <= MemoryBudget::fixed + MemoryBudget::times * one.bytes.size() + slack,
                    one.what << ": " << (peak >> 20) << " MB: " << said);
    CHECK_MESSAGE(said.size() < 1000, said);
  }
}

TEST_CASE("a list that would take too much memory is refused in a sentence") {
  const TemporaryFolder folder;
  std::string names, row = "0,0,0,1,0,0,0";
  for (int i = 0; i < 200; ++i) {
    names += fmt::format(",dof {}{}", std::string(2000, 'n'), i);
    row += ",0";
  }
  const auto path = folder.write("a.csv", csv_pose + names + "\n" + times_over(row + "\n", 1000));
  CHECK_THROWS_WITH_AS(read_grasp_file(path),
                       "a.csv: its contents take more than 79 MB of memory: 20 times the file and "
                       "64 MB",
                       Error);
}

TEST_CASE("a small archive that would take much memory is refused before it does") {
  // 400 MB of zeros
  const std::string bytes = npz_bytes(
      {{"poses", {.shape = {50'000'000}, .numbers = std::vector<double>(50'000'000)}}}, true);
  CHECK(bytes.size() < 500'000);
  std::string said;
  const size_t peak = peak_of([&] {
    try {
      read_npz("a.npz", bytes);
    } catch (const Error& error) {
      said = error.what();
    }
  });
  CHECK(said.starts_with("a.npz: its contents take more than 7"));
  if (counts_memory) CHECK(peak < MemoryBudget::fixed + MemoryBudget::times * bytes.size());
}

TEST_CASE("a list of many grasps is read") {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "a.csv", csv_pose + "\n" + times_over("0.12345678901234567,0,0,1,0,0,0\n", 20000));
  CHECK(read_grasp_file(path).size() == 20000);
}

TEST_CASE("arrays that share bytes or names are refused") {
  const auto refuse = [](const std::string& bytes, const char* message) {
    CHECK_THROWS_WITH_AS(read_npz("a.npz", bytes), message, Error);
  };
  refuse(shared_arrays(2, 100), "a.npz: b: the array shares bytes of the archive with others");
  std::string two =
      npz_bytes({{"a", {.shape = {1}, .numbers = {1}}}, {"b", {.shape = {1}, .numbers = {1}}}});
  two[two.rfind("b.npy")] = 'a';
  refuse(two, "a.npz: a: the archive holds two arrays of that name");
}

TEST_CASE("JSON is read with the lines of its values, and syntax errors are named") {
  const ValueTree tree = parse_yaml(
      "a.json",
      " {\"a\": [1, -2.5e+3, true, null, \"x\\u00e9\\n\\ud83d\\ude00\"],\n\"b\": {}, \"c\":[]}");
  const ValueNode root = tree.root();
  REQUIRE(root.size() == 3);
  const ValueNode list = *root.find("a");
  REQUIRE(list.size() == 5);
  CHECK(list.item(1).text() == "-2.5e+3");
  CHECK(list.item(3).text().empty());
  CHECK(list.item(4).text() == "x\u00e9\n\U0001F600");
  CHECK(list.item(4).quoted());
  CHECK(root.find("b")->line() == 2);
  CHECK(root.find("b")->described() == "a map");
  CHECK(root.find("c")->described() == "a list of 0");
  CHECK(!root.find("d"));
  CHECK_THROWS_WITH_AS(parse_yaml("a.json", "{\"a\":1,\"a\":2}"), "a.json:1: key 'a' appears twice",
                       Error);
  // long texts must be JSON
  const std::string blanks(600000, ' ');
  const std::pair<const char*, const char*> faults[] = {
      {"[1,]", "expected a value, got ']'"},
      {"[1 2]", "expected ',' or ']', got '2'"},
      {"{\"a\" 1}", "expected ':', got '1'"},
      {"{a: 1}", "expected a key in double quotes, got 'a'"},
      {"[\"a]", "expected the end of a string, got the end of the file"},
      {"[\"\\x\"]", "expected one of \" \\ / b f n r t u after a backslash, got 'x'"},
      {"[\"\\ud800\"]", "expected the second half of a surrogate pair, got '\"'"},
      {"[-]", "expected a digit, got ']'"},
      {"[1] 2", "expected the end of the file, got '2'"},
      {"[1", "expected ',' or ']', got the end of the file"},
  };
  for (const auto& [text, message] : faults)
    CHECK_THROWS_WITH_AS(parse_yaml("a.json", text[0] + blanks + (text + 1)),
                         (std::string("a.json:1: ") + message).c_str(), Error);
}
