#include "clench/io/grasp_files.h"

#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/base/file.h"
#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/grasp_lines.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/text/yaml.h"
#include "support/folder.h"
#include "support/listening.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

namespace {

std::vector<GraspSpec> some_grasps() {
  Random random(3);
  std::vector<GraspSpec> list(12);
  for (size_t i = 0; i < list.size(); ++i) {
    GraspSpec& g = list[i];
    g.hand_name = "panda \"hand\"";
    g.object_name = "7";
    g.object_file = "objects/7.obj";
    g.X_OH = random_pose(random, 0.3);
    g.dofs = {random.normal(), 1.0, 1e-7};
    g.dof_names = {"finger, left", "\u00fcber", "z"};
    g.dof_units = {"m", "rad", "rad"};
    g.measures = {{"epsilon", random.uniform()}, {"volume", 2}};
    g.info = {{"energy", random.normal()}, {"seed", double(i)}};
    g.labels = {{"planner", "anneal"}};
    if (i % 2) g.collision_free = i % 3 == 0;
    g.points = {{.p_O = {0, 0, 0}, .n_O = {0, 0, 1}, .mu = 1}};
    g.pregrasp = PregraspState{random_pose(random, 0.3), {0.5, 0, 0}};
    g.hand_file = "hands/panda.urdf";
    g.hand_fingerprint = "00000000000000e5";  // a number if it were not quoted
    g.object_fingerprint = i % 3 ? "0123456789abcdef" : "";
    g.settings_fingerprint = fmt::format("{:016x}", i);
    g.engine_version = "0.10";
    g.joints = {g.dofs[0], 1.0, 1e-7, 0.25, random.normal()};
    g.joint_names = {"finger, left", "\u00fcber", "z", "follower", "other"};
    g.joint_units = {"m", "rad", "rad", "rad", "m"};
    g.squeeze = {random.normal(), 1.5, 2e-7};
    g.points.push_back(
        {.p_O = {random.normal(), 1, 2}, .n_O = {1, 0, 0}, .mu = 0.3, .torsion_radius = 0.002});
    g.links = {"finger, \"left\"", "palm"};
    g.com = {0.1, random.normal(), -1e-9};
    g.rho = 0.07, g.largest_radius = 0.08, g.gyration_radius = 0.03;
    g.options.rho = g.rho;
    g.options.edges = i % 2 ? 12 : 0;
    g.options.normal_force = i % 3 ? PerContact(2.5) : PerContact(std::vector{1.0, 0.5});
    g.options.modulus = i % 4 ? ModulusRule::series : ModulusRule::larger;
    g.info["load_margin"] = random.uniform();
    if (i % 2) g.info["survived"] = 1;
    g.labels["script"] = "a, \"b\"";
  }
  return list;
}

}  // namespace

TEST_CASE(
    "each format gives back what it holds, the same bytes twice, and tells what it does not hold") {
  const TemporaryFolder folder;
  const auto list = some_grasps();
  struct Case {
    const char *file, *format, *lost;
    bool exact_pose, dofs, epsilon, notes;
  };
  const Case cases[] = {
      {"a.csv", "", "", true, true, true, true},
      {"a.npz", "", "", true, true, true, true},
      {"a.yaml", "",
       "isaac_grasp does not hold contacts, poses of pregrasps, squeeze postures, other measures, "
       "notes "
       "and labels",
       true, true, false, false},
      {"a.json", "graspgen", "graspgen does not hold DOFs, joint positions, contacts", false, false,
       false, false},
      {"b.json", "multigripper", "multigripper does not hold contacts", true, true, false, false},
  };
  for (const Case& c : cases) {
    CAPTURE(c.file);
    const auto path = folder.path() / c.file;
    std::string said;
    write_grasp_file(
        list, path, c.format,
        {.diagnostics = Listening{.warn = [&](const std::string& text) { said = text; }}});
    CHECK_MESSAGE((*c.lost ? said.find(c.lost) != std::string::npos : said.empty()), said);
    const std::string bytes = read_bytes(path);
    write_grasp_file(list, path, c.format);
    CHECK(read_bytes(path) == bytes);
    const auto back = read_grasp_file(path);
    REQUIRE(back.size() == list.size());
    for (size_t i = 0; i < list.size(); ++i) {
      const GraspSpec &a = list[i], &b = back[i];
      const Pose off = a.X_OH->inverse() * *b.X_OH;
      CHECK(off.position.norm() < 1e-12);
      CHECK(off.angle() < 1e-7);
      if (c.exact_pose) CHECK(a.X_OH->position == b.X_OH->position);
      CHECK(b.object_name == "7");
      if (c.dofs) {
        CHECK(a.hand_name == b.hand_name);
        // followed by joints that are not DOFs
        CHECK(std::equal(a.dofs.begin(), a.dofs.end(), b.dofs.begin()));
        CHECK(std::equal(a.dof_names.begin(), a.dof_names.end(), b.dof_names.begin()));
      }
      if (c.epsilon) CHECK(a.measures.at("epsilon") == b.measures.at("epsilon"));
      if (c.notes) {
        CHECK(a.info == b.info);
        CHECK(a.labels == b.labels);
        CHECK(a.collision_free == b.collision_free);
        CHECK(a.dof_units == b.dof_units);
        // all that JSON lines hold
        CHECK(grasp_line(a) == grasp_line(b));
      }
    }
  }
  const auto isaac = read_grasp_file(folder.path() / "a.yaml");
  CHECK(isaac[0].info.at("confidence") == list[0].measures.at("epsilon"));
  CHECK(isaac[0].dof_names ==
        std::vector<std::string>{"finger, left", "\u00fcber", "z", "follower", "other"});
  CHECK(isaac[0].dofs.back() == list[0].joints.back());
  CHECK(std::equal(list[0].pregrasp->dofs.begin(), list[0].pregrasp->dofs.end(),
                   isaac[0].pregrasp->dofs.begin()));
  CHECK(read_grasp_file(folder.path() / "a.json")[1].info.at("object_in_gripper") == 0);
}

TEST_CASE("files that other programs wrote are read") {
  const TemporaryFolder folder;
  // in the style of common YAML writers, and as in the format's documentation
  const auto isaac = read_grasp_file(folder.write("g.yaml", R"(format: isaac_grasp
format_version: 1.0
# frames
object_frame: /World/mug
gripper_frame: /World/panda_hand
grasps:
  "grasp_0":
    confidence: 1.0
    position: [-0.04, 0.06, 0.19]
    orientation: {w: 1.0, xyz: [0, 0, 0]}
    cspace_position:
      panda_finger_joint1: 0.009
    pregrasp_cspace_position:
      panda_finger_joint1: 0.04
  grasp_1:
    position:
    - 1
    - 2
    - 3.5e-1
    orientation:
      w: 0
      xyz:
      - 1.0
      - 0.0
      - 0.0
    cspace_position: {}
)"));
  REQUIRE(isaac.size() == 2);
  CHECK(isaac[0].hand_name == "panda_hand");
  CHECK(isaac[0].object_name == "mug");
  CHECK(isaac[0].dofs == std::vector<double>{0.009});
  CHECK(isaac[0].pregrasp->dofs == std::vector<double>{0.04});
  CHECK(isaac[1].X_OH->position == Eigen::Vector3d(1, 2, 0.35));
  CHECK(isaac[1].X_OH->rotation.x() == 1);

  std::string said;
  const auto gen = read_grasp_file(
      folder.write(
          "g.json",
          R"({"object":{"file":"a/mug.obj","scale":0.5},"grasps":{"transforms":)"
          R"([[[1,0,0,0.1],[0,1,0,0.2],[0,0,1,0.3],[0,0,0,1]]],"object_in_gripper":[true]}})"),
      "", {.diagnostics = Listening{.warn = [&](const std::string& text) { said = text; }}});
  CHECK(gen[0].X_OH->position == Eigen::Vector3d(0.1, 0.2, 0.3));
  CHECK(gen[0].info.at("object_in_gripper") == 1);
  CHECK(said == "g.json: the object has to be loaded at scale 0.5, at which these grasps hold it");
  const auto multi = read_grasp_file(folder.write(
      "m.json",
      R"({"gripper":"Allegro","object_ID":"mug","pose":[[0,0,1,1,0,0,0]],"dofs":[[1,2]],"fall_time":[3]})"));
  CHECK(multi[0].hand_name == "Allegro");
  CHECK(multi[0].dofs == std::vector<double>{1, 2});
  CHECK(multi[0].info.at("fall_time") == 3);
  const auto planned = read_grasp_file(folder.write("r.txt", "10 0 0 1 0 0 0 90 0.5\n"));
  CHECK(planned[0].X_OH->position.x() == doctest::Approx(0.01));
  CHECK(planned[0].measures.at("quality") == 0.5);
}

TEST_CASE("lists of grasps in other formats that are none are refused in a sentence") {
  const TemporaryFolder folder;
  const std::string csv_head = "x [m],y [m],z [m],qw,qx,qy,qz,dof a [rad]\n";
  const std::string isaac =
      "format: isaac_grasp\nformat_version: 1.0\ngrasps:\n  g:\n    position: [1, 2, 3]\n";
  const auto gen = [](const std::string& matrix) {
    return R"({"object":{"file":"m"},"grasps":{"transforms":[)" + matrix + "]}}";
  };
  const std::string good_npz =
      npz_bytes({{"poses", {.shape = {1, 7}, .numbers = {0, 0, 0, 1, 0, 0, 0}}}});
  std::string packed = good_npz, spoilt = good_npz;
  packed[packed.rfind("PK\x01\x02") + 10] = 12;
  spoilt[spoilt.find("NUMPY") + 125] ^= 1;
  const std::tuple<std::string, std::string, const char*> cases[] = {
      {"a.csv", "", "a.csv: expected names of columns, got an empty file"},
      {"a.csv", "x\n", "a.csv:1: expected a column 'x [m]', got none"},
      {"a.csv", csv_head + "1,2\n", "a.csv:2: expected 8 cells, got 2"},
      {"a.csv", csv_head + "1,2,3,a,0,0,0,1\n", "a.csv:2: qw: expected a number, got 'a'"},
      {"a.csv", csv_head + "1,2,3,,0,0,0,1\n", "a.csv:2: qw: expected a number, got nothing"},
      {"a.csv", csv_head + "1,2,3,0,0,0,0,1\n", "a.csv:2: expected a quaternion of length 1"},
      {"a.csv", csv_head + "\"1", "a.csv:2: a quote that is not closed"},
      {"a.csv", csv_head + "\"1\"2",
       "a.csv:2: expected a separator or the line's end behind the quote, got '2'"},
      {"a.csv", "qw,qw," + csv_head, "a.csv:1: column 'qw' appears twice"},
      {"a.csv", "collision_free," + csv_head + "maybe,1,2,3,1,0,0,0,1\n",
       "collision_free: expected true or false, got 'maybe'"},
      {"a.csv", "x [m],y [m],z [m],qw,qx,qy,qz,dof a b [deg]\n",
       "a.csv:1: dof a b [deg]: expected the unit rad or m, got 'deg'"},
      {"a.csv", "dof a [m]," + csv_head, "a.csv:1: DOF: 'a' appears twice"},
      {"a.npz",
       npz_bytes({{"poses", {.shape = {0, 7}}},
                  {"dofs", {.shape = {0, 1}}},
                  {"dof_units", {.shape = {1}, .texts = {"deg"}, .is_text = true}}}),
       "a.npz: dof_units: expected the unit rad or m, got 'deg'"},
      {"a.npz",
       npz_bytes({{"poses", {.shape = {0, 7}}},
                  {"dofs", {.shape = {0, 2}}},
                  {"dof_names", {.shape = {2}, .texts = {"a", "a"}, .is_text = true}}}),
       "a.npz: dof_names: 'a' appears twice"},
      {"a.json", R"({"gripper":"g","object_id":"o","pose":[],"dof_names":["a","a"]})",
       "a.json:1: dof_names: 'a' appears twice"},
      {"a.npz", "hello", "a.npz: expected a zip archive of arrays, got other bytes"},
      {"a.npz", packed,
       "a.npz: poses: expected an array that is stored or deflated, got method 12"},
      {"a.npz", spoilt, "a.npz: poses: the array's checksum is wrong"},
      {"a.npz", npz_bytes({{"p", {.shape = {0}}}}), "a.npz: expected an array 'poses', got none"},
      {"a.npz", npz_bytes({{"poses", {.shape = {1, 2}, .numbers = {1, 2}}}}),
       "poses: expected n x 7 or n x 4 x 4 numbers, got 1 x 2"},
      {"a.npz", npz_bytes({{"poses", {.shape = {1, 7}, .numbers = {0, 0, 0, 0, 0, 0, 0}}}}),
       "poses[0]: expected a quaternion of length 1"},
      {"a.npz",
       npz_bytes({{"poses", {.shape = {0, 7}}}, {"epsilon", {.shape = {1}, .numbers = {1}}}}),
       "epsilon: expected 0 numbers, got 1"},
      {"a.yaml", "", "a.yaml: expected a map or a list, got an empty file"},
      {"a.yaml", "format: other\n", "a.yaml:1: format: expected 'isaac_grasp', got 'other'"},
      {"a.yaml", "format: isaac_grasp\nformat_version: 2.0\n",
       "a.yaml:2: format_version: expected version 1.0, got '2.0'"},
      {"a.yaml", isaac, "a.yaml:5: grasps.g: expected a key 'orientation', got none"},
      {"a.yaml", isaac + "    orientation: {w: 1, xyz: [0, 0]}\n",
       "grasps.g.orientation.xyz: expected 3 numbers, got a list of 2"},
      {"a.yaml", isaac + "    orientation: {w: x, xyz: [0, 0, 0]}\n",
       "grasps.g.orientation.w: expected a number, got 'x'"},
      {"a.yaml", isaac + "   orientation: 1\n", "a.yaml:6: end of map not found"},
      {"a.yaml", "a: [1, 2\n", "a.yaml:1: end of sequence flow not found"},
      {"a.yaml", "a: [1, 2}\n", "a.yaml:1: illegal flow end"},
      {"a.yaml", "a: \"b", "a.yaml:1: a quote that is not closed"},
      {"a.yaml", "a: \"b\n", "a.yaml:1: a quote that is not closed"},
      {"a.yaml", "a: 1\nb: !t 'b\n  c\n\n \n", "a.yaml:3: a quote that is not closed"},
      {"a.yaml", "a: 1\n\"b\\\n", "a.yaml:2: unknown escape character"},
      {"a.yaml", "[\"a\", 'it''s\n", "a.yaml:1: a quote that is not closed"},
      {"a.yaml", "a: &b 1\n", "a.yaml:1: anchors are not read"},
      {"a.yaml", "a: 1\nb: *a\n", "a.yaml:2: "},
      {"a.yaml", "a: 1\n---\nb: 1\n",
       "a.yaml:3: expected the end of the file, got another document"},
      {"a.yaml", "? [1]\n: 2\n", "a.yaml:1: expected a key, got a list of 1"},
      {"a.yaml", "a: 1\na: 2\n", "a.yaml:2: key 'a' appears twice"},
      {"a.yaml", "a: " + std::string(100000, '['),
       "expected lists and maps at most 16 deep, got more"},
      {"a.json", R"({"a": 1})",
       "a.json: expected the keys of GraspGen (object, grasps) or of MultiGripperGrasp"},
      {"a.json", gen("1"), "a.json:1: grasps.transforms[0]: expected 4 rows of 4 numbers, got '1'"},
      {"a.json", gen("[[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"),
       "grasps.transforms[0]: expected a homogeneous matrix"},
      {"a.json", R"({"gripper":"a","object_id":"b","pose":[[1,2]]})",
       "a.json:1: pose[0]: expected 7 numbers, got a list of 2"},
  };
  for (const auto& [name, text, message] : cases) {
    std::string said = "nothing";
    try {
      read_grasp_file(folder.write(name, text));
    } catch (const Error& error) {
      said = error.what();
      CHECK(error.kind() == ErrorKind::file);
    }
    CHECK_MESSAGE(said.find(message) != std::string::npos, said << " | " << message);
  }
  const auto refuse = [&](std::vector<GraspSpec> list, const char* file, const char* format,
                          const char* message) {
    CHECK_THROWS_WITH_AS(write_grasp_file(list, folder.path() / file, format),
                         doctest::Contains(message), Error);
  };
  auto list = some_grasps();
  refuse(list, "a.json", "", "a.json: .json may be several formats");
  refuse(
      list, "a.foo", "",
      "expected a name that ends in .jsonl, .csv, .npz, .yaml or .json, or a format, got 'a.foo'");
  CHECK_THROWS_WITH_AS(write_grasp_file(list, folder.path() / "a.csv", "", {.compress = true}),
                       "a.csv: compress: only .npz is compressed, got csv", Error);
  refuse(list, "a.json", "graspgem", "unknown format 'graspgem'");
  list[1].object_name = "other";
  refuse(list, "a.yaml", "",
         "a.yaml: grasps[2]: expected one object for the whole file, '7', got 'other'");
  list[1].hand_name = "other";
  refuse(list, "a.yaml", "", "grasps[2]: expected one hand for the whole file");
  list[1].dof_names.clear();
  refuse(list, "a.npz", "", "a.npz: grasps[2]: expected the DOFs of the first grasp");
  list[0].X_OH.reset();
  refuse(list, "a.npz", "", "a.npz: grasps[1]: expected a pose, got none");
}

TEST_CASE("a table that is cut anywhere in its last row keeps the others, with a warning") {
  const TemporaryFolder folder;
  const std::string head = "hand,x [m],y [m],z [m],qw,qx,qy,qz,epsilon\n";
  const std::string row = "\"a hand, cut\",0.5,0,0,1,0,0,0,0.25e-1\n";
  const std::string first = head + row;
  for (size_t end = first.size() + 1; end < first.size() + row.size(); ++end) {
    const std::string text = (first + row).substr(0, end);
    CAPTURE(text);
    std::vector<std::string> warnings;
    ReadOptions options;
    options.diagnostics = Listening{.warn = [&](const std::string& s) { warnings.push_back(s); }};
    const auto grasps = read_grasp_file(folder.write("a.csv", text), "", options);
    // a row with all cells, the last empty or a number, may be complete
    const size_t last_cell = first.size() + row.rfind(',') + 1;
    const bool complete = text.size() >= last_cell && text.back() != 'e' && text.back() != '-';
    CHECK(grasps.size() == (complete ? 2 : 1));
    REQUIRE(warnings.size() == 1);
    const std::string last = text.substr(std::min(last_cell, text.size()));
    CHECK(warnings[0].starts_with(
        complete ? "a.csv:3: the last line has no end and may be cut short; its last cell is " +
                       in_quotes(last)
                 : "a.csv:3: the last line is cut short and is skipped, got "));
  }
  // an error if the list has no complete row, or the row has a line end
  for (const std::string& text : {head + "\"a", head + "a,0.5", first + "a,0.5\n", first + "\"a\n"})
    CHECK_THROWS_AS(read_grasp_file(folder.write("a.csv", text)), Error);
}

TEST_CASE("broken archives and texts end in a sentence, never in a crash") {
  Random random(9);
  const std::string npz =
      npz_bytes({{"poses", {.shape = {1, 7}, .numbers = {0, 0, 0, 1, 0, 0, 0}}},
                 {"n", {.shape = {2}, .texts = {"a", "\u00fc"}, .is_text = true}}});
  CHECK(read_npz("a", npz).at("n").texts == std::vector<std::string>{"a", "\u00fc"});
  const std::string yaml = "a: {b: [1, \"\\u00e9\"], c: 'd'}\ne:\n- f: 1\n  g: 2\n- h\n";
  CHECK(parse_yaml("y", yaml).root().find("e")->item(0).find("g")->text() == "2");
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = i % 2 ? npz : yaml;
    for (int k = 0; k < 3; ++k)
      bytes[size_t(random.uniform() * double(bytes.size()))] =
          static_cast<char>(random.bits() & 0xff);
    if (i % 5 == 0) bytes.resize(size_t(random.uniform() * double(bytes.size())));
    try {
      if (i % 2)
        read_npz("a", bytes);
      else
        parse_yaml("y", bytes);
    } catch (const Error&) {
    }
  }
}

TEST_CASE("lists give joints the values that the hand's own file counts") {
  const TemporaryFolder folder;
  GraspSpec g;
  g.X_OH = Pose{};
  g.dofs = {0.5};
  g.dof_names = {"a"};
  g.dof_units = {"rad"};
  g.joints = {0.5, -0.25};
  g.joint_names = {"a", "b"};
  g.joint_offsets = {0, 0.125};
  for (const char* file : {"a.jsonl", "a.csv", "a.npz"}) {
    write_grasp_file({g}, folder.path() / file);
    const GraspSpec back = read_grasp_file(folder.path() / file)[0];
    CHECK(back.joints == g.joints);
    CHECK(back.joint_offsets == g.joint_offsets);
    CHECK(back.joint_value(1) == -0.125);
  }
  CHECK(read_bytes(folder.path() / "a.csv").find("-0.125") != std::string::npos);
  write_grasp_file({g}, folder.path() / "a.yaml");
  CHECK(read_grasp_file(folder.path() / "a.yaml")[0].dofs == std::vector{0.5, -0.125});
}

TEST_CASE("faulty joints, postures and contacts of tables and arrays are named") {
  const TemporaryFolder folder;
  const std::string head = "x [m],y [m],z [m],qw,qx,qy,qz,", row = "0,0,0,1,0,0,0,";
  const auto refuse = [&](const std::string& columns, const std::string& cells,
                          const char* message) {
    const auto path = folder.write("a.csv", head + columns + "\n" + row + cells + "\n");
    CHECK_THROWS_WITH_AS(read_grasp_file(path), doctest::Contains(message), Error);
  };
  refuse("joint a [deg]", "1", "a.csv:1: joint a [deg]: expected the unit rad or m, got 'deg'");
  refuse("joint a [rad],joint_2 [rad]", "1,2", "expected joints with names or with numbers");
  refuse("joint a [rad],joint_offset b [rad],joint_offset c [rad]", "1,2,3",
         "a.csv:2: expected as many offsets as joints, 1, got 2");
  refuse("dof a [rad],squeeze dof a [rad],squeeze dof b [rad]", "1,2,3",
         "expected as many values of each posture as DOFs, 1, got 2");
  refuse("pregrasp qw", "1", "a.csv:2: pregrasp: expected 7 numbers, got 1");
  refuse("rho [m]", "-1", "a.csv:2: rho [m]: expected a number > 0, got '-1'");
  refuse("edges", "2", "a.csv:2: edges: expected 0, or a whole number from 3 to 1000, got '2'");
  refuse("soft", "yes", "a.csv:2: soft: expected true or false, got 'yes'");
  refuse("modulus", "none", "a.csv:2: modulus: expected series or larger, got 'none'");
  refuse("normal_force [N]", "1 -1", "normal_force [N]: expected numbers >= 0, got '-1'");
  refuse("contacts", "[1", "a.csv:2: contacts: ");
  refuse("contacts", "[{}]", "contacts: expected a key 'normal' in each contact, got none");
  refuse("contacts", "\"[{\"\"point\"\": [0, 0, 0], \"\"normal\"\": [0, 0, 2], \"\"mu\"\": 1}]\"",
         "contacts: expected a normal of length 1");
  const auto refuse_array = [&](const char* name, NpyArray array, const char* message) {
    const std::map<std::string, NpyArray> arrays = {
        {"poses", {.shape = {1, 7}, .numbers = {0, 0, 0, 1, 0, 0, 0}}}, {name, std::move(array)}};
    const auto path = folder.write("a.npz", npz_bytes(arrays));
    CHECK_THROWS_WITH_AS(read_grasp_file(path), doctest::Contains(message), Error);
  };
  refuse_array("joints", {.shape = {2, 1}, .numbers = {1, 2}},
               "a.npz: joints: expected 1 x j numbers, got 2 x 1");
  refuse_array("info_load_margin", {.shape = {2}, .numbers = {1, 2}},
               "a.npz: info_load_margin: expected 1 numbers, got 2");
  refuse_array("label_a", {.shape = {1}, .numbers = {1}},
               "a.npz: label_a: expected 1 texts, got 1");
  refuse_array("contact_grasps", {.shape = {1}, .numbers = {0}},
               "a.npz: expected an array 'contact_points', got none");
  refuse_array("rho", {.shape = {1}, .numbers = {0}},
               "a.npz: rho[0]: expected a number > 0, got 0");
  refuse_array("pregrasp_poses", {.shape = {1, 7}, .numbers = {0, 0, 0, 2, 0, 0, 0}},
               "a.npz: pregrasp_poses[0]: expected a quaternion of length 1");
}
