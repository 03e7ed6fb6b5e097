// `clench plan`: its output, its files and its exit codes.
#include <algorithm>

#include "plan_command.h"
#include "support/cases.h"

using namespace clench::test;

TEST_CASE("plan lists the best grasps, writes them best first, and reports its work") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  const std::string sheet = folder / "a.png";
  const std::string table = folder / "a.tex";
  const auto result = run(barrett + "--count 2 -o " + out + " --sheet " + sheet +
                          " --size 100x80 --table " + table);
  // only the sheet requires OpenGL
  const bool drawn = fs::exists(sheet);
  CHECK(result.code == (drawn ? 0 : 1));
  CHECK(has(result.out, drawn ? "a.png: 2 pictures" : "OpenGL"));
  CHECK((!drawn || text_of(sheet).starts_with("\x89PNG")));
  if (drawn) {
    CHECK(has(result.out, "a.tex: 2 rows"));
    CHECK(has(text_of(table), "\\begin{tabular}{rrrrrrr}"));
    CHECK(has(text_of(table), "\\caption{barrett grasps flask}"));
  }
  CHECK(has(result.out, "#  epsilon  load  perturbed  contacts  azimuth  elevation\n1  0."));
  CHECK(has(result.out, "no force closure: "));
  CHECK(has(result.out, "plan.sample: 2 grasps"));
  const std::string list = epsilons(out);
  const double first = std::stod(list), second = std::stod(list.substr(list.find('\n')));
  CHECK(first >= second);
  CHECK(second > 0.01);
  CHECK(std::count(list.begin(), list.end(), '\n') == 2);
}

TEST_CASE("plan searches for fingertip grasps on request") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  const auto result = run(barrett + "--count 3 --contacts fingertip -o " + out);
  CHECK(result.code == 0);
  CHECK(has(result.out, "touched with links that may not touch: "));
  CHECK(text_of(out).find("barrett_base\"") == std::string::npos);
}

TEST_CASE("wrong options of plan are reported in one sentence, before the search") {
  const Folder folder;
  const auto said = [](const std::string& options, const std::string& sentence, int code = 2) {
    const auto result = run(barrett + options);
    CHECK(result.code == code);
    CHECK(has(result.out, sentence));
    CHECK(result.out.find("candidates") == std::string::npos);
  };
  said("--count 0", "--count: expected a whole number from 1 to 1000000, got '0'");
  said("--count 1e3", "--count: expected a whole number from 1 to 1000000, got '1e3'");
  said("--count abc", "--count: expected a whole number from 1 to 1000000, got 'abc'");
  said("--seconds -1", "--seconds");
  said("--seed x", "--seed: expected a whole number, got 'x'");
  said("--seed +-5", "got '+-5'");
  said("--seed 99999999999999999999", "--seed: expected a whole number, got '99999999999999999999'");
  said("--contacts finger", "--contacts: expected 'fingertip', 'power' or 'any', got 'finger'");
  said("--threads 0", "--threads: expected a whole number from 1 to 1024, got '0'");
  said("--mass none", "--mass: expected a mass in kg, got 'none'");
  said("--mass 1e20", "--mass: expected a number from 1e-12 to 1e+12 [kg], got 1e+20");
  said("--unit furlong", "--unit: unknown unit 'furlong', expected one of mm, cm, m, inch, foot");
  said("-o a.csv --format xlsx",
       "--format: unknown format 'xlsx', expected one of jsonl, csv, npz");
  said("-o " + (folder / "a.foo"),
       "-o: expected a name that ends in .jsonl, .csv, .npz, .yaml or .json, or a format, got "
       "'a.foo'");
  said("--pose 1,2",
       "--pose: expected X,Y,Z in meters, or X,Y,Z,ROLL,PITCH,YAW with degrees, got '1,2'");
  said("--pose 1,2,nan", "--pose: expected X,Y,Z in meters");
  said("--obstacle-pose 0,0,0", "--obstacle-pose is given 1 times, and --obstacle 0 times");
  said("--format csv", "--format requires -o FILE");
  said("-o " + (folder / "a.json"), "-o: a.json: .json may be several formats");
  said("-o " + (folder / "no/a.jsonl"), "no such folder", 1);
  said("--sheet a.jpg", "--sheet: expected a file .png, got 'a.jpg'");
  said("--table a.txt", "--table: expected a file .tex or .csv, got 'a.txt'");
  said("--quality paper", "--quality requires --sheet");
  said("--sheet a.png --size 10",
       "--size: expected WIDTHxHEIGHT, 16x16 to 8192x8192 pixels, got '10'");
  said("--sheet a.png --frame hand", "--frame: hand not in {");
  said("--report a.htm", "--report: expected a file .html, got 'a.htm'");
  said("--sheet " + (folder / "no/a.png"), "--sheet: " + (folder / "no/a.png"), 1);
  said("--obstacle no.iv", "no such file: no.iv", 1);
  said("--confine models/hands", "lies outside of ", 1);
  CHECK(run("plan models/hands/barrett/barrett.cfg").code == 2);
  CHECK(run("plan models/objects/flask.iv models/objects/flask.iv").code == 1);
  const auto help = run("plan --help");
  CHECK(help.code == 0);
  CHECK(has(help.out, "Examples:\n  clench plan "));
}

TEST_CASE("plan rejects an object without triangles") {
  const Folder folder;
  const auto empty = folder.file("empty.obj", "v 0 0 0\n");
  const auto result = run("plan models/hands/barrett/barrett.cfg " + empty);
  CHECK(result.code == 1);
  CHECK(has(result.out, "empty.obj"));
}

TEST_CASE("if nothing is found, plan exits with 1 and reports why") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  const auto object = folder.file("cube.obj", cube_of(1));
  const auto result = run("plan models/hands/parallel_jaw/parallel_jaw.cfg " + object +
                          " --unit m --seconds 0.5 -o " + out);
  CHECK(result.code == 1);
  CHECK(has(result.out, "plan.sample: 0 grasps"));
  CHECK(has(result.out,
            "\nwhy: cube is too wide for parallel_jaw: opposite points of its surface are at least "
            "1000 mm apart, and the pads open to 80 mm"));
  CHECK(epsilons(out).empty());
}

TEST_CASE("a signal ends a search with the grasps so far and the exit code of the signal") {
  const std::pair<const char*, int> signals[] = {{"INT", 130}, {"TERM", 143}, {"HUP", 129}};
  for (const auto& [signal, code] : signals) {
    const Folder folder;
    const std::string out = folder / "a.jsonl", sheet = folder / "a.png";
    const std::string text =
        end_by(signal, barrett + "--no-verify --seconds 60 -o " + out + " --sheet " + sheet, out);
    CAPTURE(text);
    CHECK(has(text, "barrett grasps flask: interrupted\n"));
    CHECK(has(text, "interrupted: the list has the grasps found until then"));
    CHECK(has(text, "a.jsonl: --resume continues this search\n"));
    CHECK(text.ends_with(fmt::format("code {}\n", code)));
    const std::string list = epsilons(out);
    CHECK(list.find("clench") == std::string::npos);
    CHECK(std::stod(list) >= std::stod(list.substr(list.find('\n'))));
    // plan writes no sheet without OpenGL
    CHECK((has(text, fs::exists(sheet) ? "a.png: " : "OpenGL")));
  }
}

TEST_CASE("a second signal ends a search at once") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  // while stopped, the process receives both signals together
  const std::string text = end_by("CONT", barrett + "--no-verify --seconds 60 -o " + out, out,
                                  "kill -STOP $pid\nkill -TERM $pid\nkill -INT $pid\n");
  CHECK((text.ends_with("code 143\n") || text.ends_with("code 130\n")));
  CHECK(text.find("barrett grasps flask") == std::string::npos);
  CHECK(std::stod(epsilons(out)) > 0);
}

TEST_CASE(
    "a killed search loses at most the grasps of its last second, and none that its file "
    "contains") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  const std::string text = end_by(
      "KILL", barrett + "--no-verify --seconds 60 --threads 1 -o " + out, out,
      "lines=$(wc -l < " + out + ")\nsleep 1\necho more $(( $(wc -l < " + out + ") - lines ))");
  CHECK(has(text, "code 137"));
  // more complete lines were written within that second; under the sanitizers a grasp takes longer
  if (clench::test::cases(8) == 8) CHECK(std::stoi(text.substr(text.rfind("more ") + 5)) > 0);
  const std::string list = epsilons(out), file = text_of(out);
  CHECK(list.find("clench") == std::string::npos);
  CHECK(file.ends_with("}\n"));
  CHECK(std::count(list.begin(), list.end(), '\n') ==
        std::count(file.begin(), file.end(), '\n') - 1);
}

TEST_CASE("SIGTERM and SIGHUP end a script as Ctrl-C does") {
  const std::pair<const char*, int> signals[] = {{"INT", 130}, {"TERM", 143}, {"HUP", 129}};
  for (const auto& [signal, code] : signals) {
    const Folder folder;
    const std::string out = folder / "out";
    const auto script = folder.file("a.lua", "clench.files.save_text('" + out + R"(', "\n\n\n")
local ok, problem = pcall(function() while true do end end)
print(problem.kind, problem.sentence)
)");
    const std::string text = end_by(signal, "-q run " + script, out);
    CAPTURE(text);
    CHECK(has(text, "stopped\tinterrupted\n"));
    CHECK(text.ends_with(fmt::format("code {}\n", code)));
  }
}

// under the sanitizers the time limit after Ctrl-C is too short for the remaining work of planners
#ifndef __SANITIZE_ADDRESS__
TEST_CASE(
    "Ctrl-C during any planner passes the grasps so far to the script, which exits with 130") {
  const Folder folder;
  const std::vector<std::string> planners = {"anneal",    "sample", "guided", "loop",
                                             "primitive", "random", "list",   "antipodal"};
  for (const std::string& planner : planners) {
    const std::string out = folder / planner;
    // an evaluated energy or a found grasp shows that the search has started
    const auto script =
        folder.file(planner + ".lua", "local planner, out = '" + planner + "', '" + out + R"('
local world = clench.load("worlds/barrett_mug.wld", {root = "."})
local hand, mug = world.robots[1], world.objects[1]
local lines, contact = io.open(out, "w"), clench.energy.contact {hand = hand, object = mug}
local function under_way() lines:write "\n" lines:flush() return 0 end
local o = {hand = hand, object = mug, on_grasp = under_way, count = 1000000}
if planner == "anneal" or planner == "loop" or planner == "guided" or planner == "list" then
  o.on_grasp, o.count = nil, nil
  o.energy = function() under_way() return contact() end
end
if planner == "primitive" then
  o.density, o.primitives = 100, {{kind = "cylinder", pose = clench.pose {}, radius = 0.04, height = 0.3}}
elseif planner == "list" then
  o.states = {}
  for i = 1, 100000 do o.states[i] = {pose = mug.pose:inverse() * hand.pose, dofs = hand.dofs} end
elseif o.energy then
  o.steps = 1000000000
else
  o.candidates = 1000000000
end
local run = clench.plan[planner](o)
print(planner .. " gave " .. #run.grasps, run.report.stopped)
while planner == "anneal" do end
)");
    const std::string text = end_by("INT", "-q run " + script, out);
    CAPTURE(text);
    CHECK(has(text, planner + " gave "));
    CHECK(has(text, "\ttrue\n"));
    CHECK(text.ends_with("code 130\n"));
  }
}

#endif

TEST_CASE("a killed plan search leaves its grasps in a readable list") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  CHECK(has(end_by("KILL", barrett + "--seconds 60 -o " + out, out), "code 137"));
  const std::string list = epsilons(out);
  CHECK(list.find("clench") == std::string::npos);
  CHECK(std::count(list.begin(), list.end(), '\n') >= 2);
}

TEST_CASE(
    "names that contain HTML or invalid UTF-8 are shown as text in the page and in the list") {
  const Folder folder;
  const auto object =
      folder.file("<script>alert(1)<\x2fscript><img src=x>\xE9'.obj", cube_of(0.05));
  const auto page = folder / "a.html", out = folder / "a.jsonl";
  const std::string quoted = "\"" + object + "\"";
  const auto result =
      run("plan models/hands/barrett/barrett.cfg " + quoted +
          " --unit m --count 1 --no-verify --report " + page + " -o " + out +
          " --pose 0,0,0.5,0,0,90 --obstacle models/obstacles/floor.iv --obstacle-pose -0.25,0,-1");
  CHECK(result.code <= 1);
  const std::string html = text_of(page);
  // without three.js no page is written
  if (result.out.find("three.js, which is not installed") != std::string::npos) return;
  CHECK(has(html, "&lt;img src=x&gt;\\xE9&#39;"));
  CHECK(html.find("<img src=x") == std::string::npos);
  CHECK(html.find("alert(1)</") == std::string::npos);
  CHECK(html.find('\xE9') == std::string::npos);
  // obstacle and object have the given poses
  CHECK(has(html, R"("kind":"obstacle","mesh")"));
  CHECK(has(html, R"("pose":[-0.25,0,-1.0,1.0,0,0,0])"));
  CHECK(has(html, R"("object_pose":[0,0,0.5,0.707107,0,0,0.707107])"));
}

TEST_CASE("--force-ratio limits the grip forces of verified grasps") {
  const std::string plan = "plan models/hands/barrett/barrett.cfg models/objects/mug.iv --count 1 ";
  const auto hard = run(plan + "--force-ratio 20");
  CAPTURE(hard.out);
  CHECK(hard.code == 0);
  // fewer of the same candidates are too weak
  const auto weak = [](const std::string& out) {
    const std::string words = "too weak against loads: ";
    return std::stoi("0" + out.substr(std::min(out.size(), out.find(words) + words.size())));
  };
  const auto soft = run(plan + "--force-ratio 10");
  CAPTURE(soft.out);
  CHECK(weak(soft.out) > weak(hard.out));
  for (const char* bad : {"0", "-1", "nan", "inf", "hard"}) {
    const auto refused = run(plan + "--force-ratio " + bad);
    CHECK(refused.code == 2);
    CHECK(has(refused.out,
              "--force-ratio: expected a number > 0, got '" + std::string(bad) + "'"));
  }
  const auto both = run(plan + "--force-ratio 20 --no-verify");
  CHECK(both.code == 2);
  CHECK(has(both.out,
            "--force-ratio applies to the verification of grasps, which --no-verify disables"));
}

// jaws that slide towards each other, 120 mm apart; actuators of the joints j1 and j2
static std::string jaws_mjcf(const std::string& actuators) {
  std::string text =
      R"(<mujoco model="jaws"><worldbody><body name="palm"><geom type="box" size="0.02 0.08 0.01"/>)";
  for (const int side : {1, 2})
    text += fmt::format(
        R"(<body name="f{0}" pos="0 {1} 0.06"><joint name="j{0}" type="slide" axis="0 {2} 0" range="0 0.04"/>
<geom type="box" size="0.01 0.005 0.05" mass="0.1"/></body>)",
        side, side == 1 ? -0.06 : 0.06, side == 1 ? 1 : -1);
  return text + "</body></worldbody>" + actuators + "</mujoco>";
}

TEST_CASE("a hand without motors has no verified grasps, and plan names its joints at once") {
  const Folder folder;
  const auto cube = folder.file("cube.obj", cube_of(0.05));
  const std::string dead = R"(<motor joint="j1" gear="0"/><position joint="j2" kp="0"/>)";
  for (const std::string& actuators : {std::string(), "<actuator>" + dead + "</actuator>"}) {
    const auto hand = folder.file("limp.xml", jaws_mjcf(actuators));
    const auto result =
        run("plan " + hand + " " + cube + " --unit m --mass 1e6 --count 1 --verify --max-effort 5");
    CHECK(result.code == 1);
    CHECK(has(result.out, "plan.sample: no grasp of"));
    CHECK(has(result.out, "can be verified, as it exerts no force: no motor drives j1, j2"));
    CHECK(has(result.out, "0 candidates"));
    CHECK(has(result.out, "\nwhy: no grasp of"));
  }
  const auto refused = run(barrett + "--max-effort 0");
  CHECK(refused.code == 2);
  CHECK(has(refused.out, "--max-effort: expected a number > 0, got '0'"));
  const auto unused = run(barrett + "--max-effort 5 --no-verify");
  CHECK(unused.code == 2);
  CHECK(has(unused.out,
            "--max-effort applies to the load margins of the verification, which --no-verify "
            "disables"));
}

TEST_CASE("--verify shakes the grasps, and --keep-lost marks lost grasps") {
  const auto survived = run(
      "plan models/hands/barrett/barrett.cfg models/objects/mug.iv --count 1 --verify --mass 0.1");
  CAPTURE(survived.out);
  CHECK(survived.code == 0);
  CHECK(has(survived.out, "shaken grasps held in all 6 directions"));
  CHECK(has(survived.out, "shaken: number of directions, of six, in which"));
  const auto both =
      run("plan models/hands/barrett/barrett.cfg models/objects/mug.iv --verify --no-verify");
  CHECK(both.code == 2);
  CHECK(has(both.out, "expected --verify or --no-verify, got both"));
  const auto alone = run("plan models/hands/barrett/barrett.cfg models/objects/mug.iv --keep-lost");
  CHECK(alone.code == 2);
  CHECK(has(alone.out, "--keep-lost requires --verify"));
}

TEST_CASE(
    "plan takes friction, material and closing velocities, and prints them with their source") {
  const auto by_material = run(barrett + "--count 1 --no-verify --material rubber");
  CHECK(has(by_material.out, "on rubber"));
  CHECK(has(by_material.out, "of the object: --material"));
  const auto plain = run(barrett + "--count 1 --no-verify --friction 0.5 --distance 0.2 --seed 4");
  CHECK(has(plain.out, "friction 0.5 between hand and object (--friction)"));
  CHECK(has(plain.out, "--count 1 --distance 0.2 --friction 0.5 --no-verify, seed 4, clench "));
  const auto closing =
      run(barrett + "--count 1 --no-verify --close 2,3,4 --approach 0,0,1,0,0,0.1");
  CHECK(closing.code == 0);
  CHECK(has(closing.out, "--approach 0,0,1,0,0,0.1 --close 2,3,4"));
}

TEST_CASE("plan reports faults of --friction, --close, --approach and --distance") {
  const auto said = [](const std::string& options, const std::string& sentence) {
    const auto result = run(barrett + options);
    CHECK(result.code != 0);
    CHECK(has(result.out, sentence));
    CHECK(result.out.find("candidates") == std::string::npos);
  };
  said("--friction -1", "--friction: expected a number above 0, got '-1'");
  said("--distance x", "--distance: expected a number >= 0, got 'x'");
  said("--close 1,,2", "--close: expected DOFs by number or name, as in 1,-2,thumb, got '1,,2'");
  said("--close thmb", "thmb");
  said("--approach 0,0", "--approach: expected DX,DY,DZ, or DX,DY,DZ,X,Y,Z with a point in meters");
  said("--material rbber --friction", "--friction");
}
