// Compares epsilon in files of grasps with that of an independent program.
#include "command.h"
#include "support/cases.h"

using clench::test::Folder;
using clench::test::has;
using clench::test::Outcome;
using clench::test::run;

static Outcome recompute(const std::string& path) {
  Outcome result;
  FILE* pipe = popen((std::string(RECOMPUTE_EPSILON) + " " + path + " 2>&1").c_str(), "r");
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe))
    result.out.append(buffer, count);
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

TEST_CASE("epsilon of planned grasps equals that of an independent program, for three hands") {
  const Folder folder;
  const std::vector<std::string> hands = {"barrett/barrett.cfg", "dlr/dlr.cfg",
                                          "parallel_jaw/parallel_jaw.cfg"};
  for (int i = 0; i < clench::test::cases(3); ++i) {
    const std::string out = folder / std::to_string(i) + ".jsonl";
    const auto script = folder.file("plan.lua", R"(
local world = clench.world()
local hand = world:add_robot("models/hands/)" + hands[i] +
                                                    R"(")
local object = world:add_object("models/objects/banana.iv", {pose = {xyz = {0, 0, 2}}})
local run = clench.plan.random {hand = hand, object = object, count = 50, distance = 0, grasp = {soft = false}}
run.grasps:save(")" + out + R"("))");
    CHECK(run("-q run " + script).out == "");
    const Outcome result = recompute(out);
    CHECK(result.code == 0);
    CHECK(has(result.out, "50 grasps, 50 of them in force closure"));
  }
}

TEST_CASE("the comparison finds a grasp whose epsilon differs from that in its line") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  REQUIRE(run("plan models/hands/barrett/barrett.cfg models/objects/flask.iv --count 1 -o " + out)
              .code == 0);
  CHECK(recompute(out).code == 0);
  REQUIRE(std::system(("sed -i 's/\"epsilon\":0\\./\"epsilon\":1./' " + out).c_str()) == 0);
  const Outcome result = recompute(out);
  CHECK(result.code == 1);
  CHECK(has(result.out, "a.jsonl:2: epsilon is said to be 1."));
  CHECK(recompute(folder / "no.jsonl").code == 2);
}
