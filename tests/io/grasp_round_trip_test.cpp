// Saved grasps read back; grasps that would not read back are not saved.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/random.h"
#include "clench/io/grasp_files.h"
#include "support/folder.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

namespace {

struct SavedFormat {
  const char *name, *file;
  bool names, dofs, notes;
};

constexpr SavedFormat saved_formats[] = {
    {"jsonl", "a.jsonl", true, true, true},      {"csv", "a.csv", true, true, true},
    {"npz", "a.npz", true, true, true},          {"isaac_grasp", "a.yaml", true, true, false},
    {"graspgen", "a.json", false, false, false}, {"multigripper", "b.json", true, true, false},
    {"graspit", "a.txt", false, false, false},
};

const std::string odd_grasp_texts[] = {"",
                                       " ",
                                       "a",
                                       "7",
                                       "true",
                                       "nan",
                                       "a,b",
                                       "a\"b",
                                       "a'b",
                                       "a\nb",
                                       "a\r\nb",
                                       "a\rb",
                                       "a\tb",
                                       "\xC3\xBC",
                                       "\xFF\xFE",
                                       "a/b",
                                       "a\\b",
                                       "#a",
                                       "- a",
                                       "a: b",
                                       "[a]",
                                       "{a}",
                                       "a [m]",
                                       "\u2028",
                                       "\x7F",
                                       "\xC2\x85",
                                       "~",
                                       "null",
                                       "x\x01y",
                                       "\U0001F600",
                                       "planner",
                                       "label",
                                       "*a",
                                       "&a",
                                       "!a",
                                       "%a",
                                       "@a",
                                       "a ",
                                       " a",
                                       "0x1F",
                                       "1e5",
                                       "+1",
                                       "-0",
                                       "\xEF\xBB\xBF",
                                       "\\u0041",
                                       "a b c d e",
                                       std::string(300, 'l'),
                                       std::string(1500, 'l'),
                                       std::string("a\0b", 3)};

const double odd_numbers[] = {0.0,      -0.0,
                              1,        0.1,
                              -1.0 / 3, 5e-324,
                              1e-300,   1.7976931348623157e308,
                              -1e22,    9007199254740993.0,
                              INFINITY, -INFINITY,
                              NAN};

template <class T, size_t n>
const T& pick_one(Random& random, const T (&list)[n]) {
  return list[(random.bits() % n)];
}

GraspSpec plain_grasp(Random& random) {
  GraspSpec g;
  g.hand_name = "hand";
  g.object_name = "mug";
  g.X_OH = random_pose(random, 0.3);
  g.dofs = {random.normal(), random.normal()};
  g.dof_names = {"a", "b"};
  g.dof_units = {"rad", "m"};
  g.measures["epsilon"] = random.uniform();
  return g;
}

/// Grasps with one unusual part each, or lists with one.
std::vector<GraspSpec> odd_list(Random& random) {
  std::vector<GraspSpec> list((random.bits() % 4));
  const bool same = (random.bits() % 2) == 0;
  const GraspSpec first = plain_grasp(random);
  for (GraspSpec& g : list) g = same ? first : plain_grasp(random);
  for (int k = 0; k < 2 && !list.empty(); ++k) {
    const size_t what = (random.bits() % 26);
    const std::string text = pick_one(random, odd_grasp_texts);
    const double x = pick_one(random, odd_numbers);
    const bool all = (random.bits() % 2) == 0;
    const auto dof = (random.bits() % 2);
    for (size_t i = 0; i < list.size(); ++i) {
      GraspSpec& g = list[i];
      if (!all && i + 1 < list.size()) continue;
      switch (what) {
        case 0:
          g.hand_name = text;
          break;
        case 1:
          g.object_name = text;
          break;
        case 2:
          g.hand_file = text;
          break;
        case 3:
          g.object_file = text;
          break;
        case 4:
          g.labels["note"] = text;
          break;
        case 5:
          g.labels[text] = "value";
          break;
        case 6:
          g.labels["planner"] = text;
          break;
        case 7:
          g.measures[text] = x;
          break;
        case 8:
          g.measures["epsilon"] = x;
          break;
        case 9:
          g.info[text] = x;
          break;
        case 10:
          g.info["seed"] = x;
          break;
        case 11:
          if (!g.dof_names.empty()) g.dof_names[dof] = text;
          break;
        case 12:
          g.dofs[dof] = x;
          break;
        case 13:
          g.dof_names.clear();
          break;
        case 14:
          g.dof_units.clear();
          break;
        case 15:
          g.dof_units = {"deg", text};
          break;
        case 16:
          if (g.dof_names.size() == 2) std::swap(g.dof_names[0], g.dof_names[1]);
          break;
        case 17:
          g.X_OH.reset();
          break;
        case 18:
          if (g.X_OH) g.X_OH->position.x() = x;
          break;
        case 19:
          g.pregrasp = PregraspState{random_pose(random, 1), {x, 0.5}};
          break;
        case 20:
          g.info["run"] = x;
          break;
        case 21:
          g.labels["name"] = text;
          break;
        case 22:
          g.joints = {x, 0.5};
          break;
        case 23:
          g.joints = {1, 0.5};
          g.joint_names = {text, "b"};
          break;
        case 24:
          g.squeeze = {x, 0.5};
          break;
        case 25:
          g.points = {{.p_O = {0, 0, 1}, .n_O = {0, 1, 0}, .mu = 0.5}};
          g.links = {text};
          break;
      }
    }
  }
  return list;
}

std::map<std::string, double> by_name(const GraspSpec& g) {
  std::map<std::string, double> out;
  for (size_t i = 0; i < g.dofs.size(); ++i)
    out[g.dof_names.empty() ? std::to_string(i) : g.dof_names[i]] = g.dofs[i];
  return out;
}

std::map<std::string, double> finite_only(std::map<std::string, double> named) {
  std::erase_if(named, [](const auto& one) { return !std::isfinite(one.second); });
  return named;
}

void check_back(const GraspSpec& a, const GraspSpec& b, const SavedFormat& format) {
  REQUIRE(a.X_OH.has_value() == b.X_OH.has_value());
  if (a.X_OH && !(*a.X_OH == *b.X_OH)) {
    const Pose off = a.X_OH->inverse() * *b.X_OH;
    CHECK(off.position.norm() <= 1e-9 * (1 + a.X_OH->position.norm()));
    CHECK(off.angle() < 1e-6);
  }
  if (format.names) {
    CHECK(a.hand_name == b.hand_name);
    CHECK(a.object_name == b.object_name);
  }
  if (format.dofs) {
    // isaac_grasp lists joints after the DOFs
    const auto ours = by_name(a), theirs = by_name(b);
    CHECK(std::ranges::includes(theirs, ours));
    if (a.joint_names.empty()) CHECK(ours == theirs);
    CHECK(a.dof_names.empty() == b.dof_names.empty());
  }
  if (!format.notes) return;
  // an array of texts contains an empty one if a grasp has no label
  auto labels = a.labels;
  if (std::string_view(format.name) == "npz")
    std::erase_if(labels, [](const auto& one) { return one.second.empty(); });
  CHECK(labels == b.labels);
  // hands with different joints do not fit into one table
  if (!b.joints.empty() || std::string_view(format.name) == "jsonl") CHECK(a.joints == b.joints);
  CHECK(a.squeeze == b.squeeze);
  CHECK(a.points.size() == b.points.size());
  CHECK(finite_only(a.measures) == finite_only(b.measures));
  CHECK(finite_only(a.info) == finite_only(b.info));
  CHECK(a.hand_file == b.hand_file);
}

}  // namespace

TEST_CASE("saved grasps read back in any format, or nothing is written") {
  const TemporaryFolder folder;
  Random random(49);
  std::map<std::string, int> saved, refused;
  for (int turn = 0; turn < 700; ++turn) {
    const auto list = odd_list(random);
    const SavedFormat& format = saved_formats[turn % std::size(saved_formats)];
    const auto path = folder.path() / format.file;
    std::filesystem::remove(path);
    try {
      write_grasp_file(list, path, format.name);
    } catch (const Error& error) {
      ++refused[format.name];
      CHECK(!std::filesystem::exists(path));
      continue;
    }
    ++saved[format.name];
    const auto back = read_grasp_file(path, format.name);
    CAPTURE(format.name);
    CAPTURE(read_bytes(path));
    REQUIRE(back.size() == list.size());
    for (size_t i = 0; i < list.size(); ++i) check_back(list[i], back[i], format);
  }
  for (const SavedFormat& format : saved_formats) {
    CHECK(saved[format.name] > 20);
    CHECK(refused[format.name] > 5);
  }
}

TEST_CASE("a list without grasps, and one without DOFs, are saved in every format") {
  const TemporaryFolder folder;
  Random random(1);
  GraspSpec bare = plain_grasp(random);
  for (auto* list : {&bare.dof_names, &bare.dof_units}) list->clear();
  bare.dofs.clear();
  for (const SavedFormat& format : saved_formats) {
    CAPTURE(format.name);
    const auto path = folder.path() / format.file;
    write_grasp_file({}, path, format.name);
    CHECK(read_grasp_file(path, format.name).empty());
    write_grasp_file({bare, bare}, path, format.name);
    CHECK(read_grasp_file(path, format.name).size() == 2);
  }
}

TEST_CASE("data that would not read back is named") {
  const TemporaryFolder folder;
  Random random(2);
  const auto refuse = [&](auto change, const char* file, const char* format, const char* message) {
    std::vector<GraspSpec> list(2, plain_grasp(random));
    change(list[1]);
    CHECK_THROWS_WITH_AS(write_grasp_file(list, folder.path() / file, format),
                         doctest::Contains(message), Error);
  };
  refuse([](GraspSpec& g) { g.labels["x"] = "\xFF"; }, "a.jsonl", "",
         "a.jsonl: grasps[2]: the label 'x' would change when read back, so nothing is saved");
  refuse([](GraspSpec& g) { g.dofs[0] = NAN; }, "a.jsonl", "",
         "a.jsonl: the list would not read back, so nothing is saved: a.jsonl:3: dofs: expected a "
         "list of numbers, got null");
  refuse([](GraspSpec& g) { g.dof_units[0] = "m"; }, "a.csv", "",
         "nothing is saved: a.csv:1: DOF: 'a' appears twice");
  refuse([](GraspSpec& g) { g.dof_units[0] = "m"; }, "a.npz", "",
         "a.npz: grasps[2]: expected DOFs in the units of the first grasp, rad, m, got m, m");
  refuse([](GraspSpec& g) { g.dof_names.clear(); }, "a.yaml", "",
         "a.yaml: grasps[2]: expected DOFs with names, which the format isaac_grasp needs, got 2");
  refuse([](GraspSpec& g) { g.info["scale"] = 2; }, "a.json", "graspgen",
         "a.json: grasps[2]: expected the scale of the first grasp, 1, got 2");
  refuse(
      [](GraspSpec& g) {
        g.dof_names = {"b", "a"};
      },
      "a.json", "multigripper",
      "a.json: grasps[2]: expected the DOFs of the first grasp, a, b, got b, a");
  refuse([](GraspSpec& g) { g.info["run"] = 1e9; }, "a.txt", "graspit",
         "a.txt: info.run: expected a number from 1 to 1000000, got 1000000000");
}

TEST_CASE(
    "DOFs without names stay without, the scale of an object and the names of grasps are kept") {
  const TemporaryFolder folder;
  Random random(3);
  GraspSpec g = plain_grasp(random);
  g.dof_names.clear();
  for (const char* file : {"a.jsonl", "a.csv", "a.npz"}) {
    write_grasp_file({g}, folder.path() / file);
    const auto back = read_grasp_file(folder.path() / file);
    CHECK(back[0].dof_names.empty());
    CHECK(back[0].dofs == g.dofs);
  }
  g = plain_grasp(random);
  g.info["scale"] = 0.5;
  g.labels["name"] = "from above";
  write_grasp_file({g}, folder.path() / "a.json", "graspgen");
  CHECK(read_grasp_file(folder.path() / "a.json")[0].info.at("scale") == 0.5);
  write_grasp_file({g}, folder.path() / "a.yaml");
  CHECK(read_grasp_file(folder.path() / "a.yaml")[0].labels.at("name") == "from above");
}
