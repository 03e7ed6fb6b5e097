#include "clench/app/verb_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasp_files.h"
#include "clench/script/host/state.h"
#include "clench/spec/valid.h"

namespace clench {

void add_confine(CLI::App& verb, std::string& folder) {
  verb.add_option("--confine", folder, "read models and worlds only below this folder")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory);
}

// a path, which is not empty
const CLI::Validator named(
    [](std::string& file) -> std::string {
      return file.empty() ? "expected the name of a file, got nothing" : "";
    },
    "");

static const CLI::Validator unit(
    [](std::string& text) -> std::string {
      static const std::vector<std::string> names = {"mm", "cm", "m", "inch", "foot"};
      if (std::ranges::find(names, text) != names.end()) return {};
      return fmt::format("unknown unit '{}'{}", text, instead_of(text, names));
    },
    "");

void add_world_reading(CLI::App& verb, ReadingOptions& reading) {
  verb.add_option("--root", reading.root, "folder that names in the files are relative to")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  verb.add_option("--unit", reading.unit, "unit of meshes: mm cm m inch foot")
      ->type_name("UNIT")
      ->check(unit);
  verb.add_flag("--strict", reading.strict, "treat warnings as errors");
}

void add_reading(CLI::App& verb, ReadingOptions& reading) {
  add_world_reading(verb, reading);
  verb.add_option("--folder", reading.folder,
                  "additional search folder for names in a robot's file")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  verb.add_option("--package", reading.package, "folder of the packages that a URDF names")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
}

// a finite number above 0
static const CLI::Validator positive(
    [](std::string& text) -> std::string {
      const auto x = parse_number(text);
      if (x && std::isfinite(*x) && *x > 0) return {};
      return fmt::format("expected a number above 0, got '{}'", text);
    },
    "POSITIVE");

static const CLI::Validator not_negative(
    [](std::string& text) -> std::string {
      const auto x = parse_number(text);
      if (x && std::isfinite(*x) && *x >= 0) return {};
      return fmt::format("expected a number >= 0, got '{}'", text);
    },
    "");

static const CLI::Validator mass(
    [](std::string& text) -> std::string {
      const auto x = parse_number(text);
      return x ? fault(mass_rule, *x) : fmt::format("expected a mass in kg, got '{}'", text);
    },
    "");

static CLI::Validator whole_number(int64_t low, int64_t high) {
  const auto look = [=](std::string& text) -> std::string {
    const char* end = text.data() + text.size();
    int64_t x = 0;
    const auto [at, code] = std::from_chars(text.data(), end, x);
    if (code == std::errc() && at == end && x >= low && x <= high) return {};
    return fmt::format("expected a whole number from {} to {}, got '{}'", low, high, text);
  };
  return {look, "INTEGER"};
}

static const CLI::Validator list_format(
    [](std::string& text) -> std::string {
      try {
        grasp_format(text);
      } catch (const Error& error) {
        return error.what();
      }
      return {};
    },
    "");

// returns a function that appends the name of an option and its value
static auto noted_as(const char* option, std::vector<std::string>& words) {
  std::string name = lower_case(option);
  name.erase(0, name.find_first_not_of('-'));
  return [&words, name](const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {name, value});
  };
}

namespace {

// adds options whose names and values become words; numbers are checked here and passed as typed
struct Adder {
  CLI::App& verb;
  std::vector<std::string>& words;

  CLI::Option* operator()(const char* name, const char* text) const {
    return verb.add_option_function<std::string>(name, noted_as(name, words), text);
  }
  CLI::Option* several(const char* name, const char* text) const {
    const auto note_all = [note = noted_as(name, words)](const std::vector<std::string>& values) {
      for (const std::string& value : values) note(value);
    };
    return verb.add_option_function<std::vector<std::string>>(name, note_all, text)
        ->allow_extra_args(false);
  }
  void flag(const char* name, const char* text) const {
    verb.add_flag_callback(
        name, [note = noted_as(name, words)] { note("yes"); }, text);
  }
};

void add_scene(const Adder& add) {
  add.several("--obstacle", "a body to be avoided; may be repeated")
      ->type_name("FILE")
      ->check(named);
  add("--pose", "pose of the object [m, degrees]; default: at 0,0,0")
      ->type_name("X,Y,Z[,ROLL,PITCH,YAW]");
  add.several("--obstacle-pose", "poses of the obstacles, in their order")->type_name("POSE");
}

void add_drawing(const Adder& add, const char* size, const char* quality) {
  add("--quality", quality)->type_name("NAME")->check(CLI::IsMember({"paper", "draft"}));
  add("--size", size)->type_name("WIDTHxHEIGHT");
  add("--frame", "part of the scene in pictures: contacts or all; default: contacts")
      ->type_name("NAME")
      ->check(CLI::IsMember({"contacts", "all"}));
}

// options of the planner: names, texts and checks come from its description
void add_planner(const Adder& add) {
  const auto state = std::make_shared<State>();
  const auto listed = state->call("host.plan_options", "list", {});
  if (!listed.ok) fail(ErrorKind::internal, "{}", listed.error);
  for (size_t i = 0; i + 2 < listed.values.size(); i += 3) {
    const std::string& name = listed.values[i];
    const auto fault = [state, name](const std::string& text) -> std::string {
      const auto found = state->call("host.plan_options", "fault", {name, text});
      return found.ok && !found.values.empty() ? found.values.front() : found.error;
    };
    add(name.c_str(), listed.values[i + 2].c_str())
        ->type_name(listed.values[i + 1])
        ->check(fault);
  }
}

}  // namespace

void add_plan_options(CLI::App& verb, std::vector<std::string>& words, bool plans) {
  const Adder add{verb, words};
  add("HAND", "a robot's file")->required()->check(named);
  add("OBJECT", "a body's file, or a mesh")->required()->check(named);
  add_scene(add);
  add("--mass", "mass of the object, instead of its file's [kg]")->type_name("KG")->check(mass);
  add("--friction",
      "coefficient of friction between hand and object; default: from their materials")
      ->type_name("MU")
      ->check(positive);
  add("--material", "material of the object, instead of its file's: rubber, wood, metal ...")
      ->type_name("NAME");
  add("--close", "DOFs that close the hand, by number or name, each with its sign: 1,-2,thumb")
      ->type_name("DOFS");
  add("--approach", "direction and point of approach, in the frame of the hand's base [m]")
      ->type_name("DX,DY,DZ[,X,Y,Z]");
  if (plans) add_planner(add);
  add.several("-o",
              "grasps: .jsonl (written while it runs), .csv, .npz, .yaml, .json; may be repeated")
      ->type_name("FILE")
      ->check(named);
  add("--format",
      "format of a single -o, or of those whose ending does not define it: graspgen ...")
      ->type_name("NAME")
      ->check(list_format);
  add("--report", "a page with a table, pictures and each grasp in 3-D")
      ->type_name("FILE.html")
      ->check(named);
  add("--sheet", "pictures of the best grasps, in one")->type_name("FILE.png")->check(named);
  add("--table", "the table of the grasps for a paper: .tex or .csv")
      ->type_name("FILE.tex")
      ->check(named);
  add_drawing(add, "size of each picture of --sheet [pixels]; default: 320x240",
              "quality of the pictures of --sheet: paper or draft; default: draft");
  add.flag("--resume", "continue the search of -o FILE.jsonl from its end");
  add.flag("--overwrite", "replace the list of -o, once there are grasps");
  add.flag("--verify", "also simulate each grasp under the object's weight along six directions");
  add.flag("--keep-lost", "with --verify: keep grasps that are lost, and mark them");
  add.flag("--no-verify", "keep all grasps in force closure, without checking loads and errors");
}

void add_render_options(CLI::App& verb, std::vector<std::string>& words) {
  const Adder add{verb, words};
  add("FILE", "a world, a robot, a body, a mesh or a list of grasps")->required()->check(named);
  add("-o", "the picture")->required()->type_name("FILE.png")->check(named);
  add("--pick", "grasps of the list, by number; default: the first 24")->type_name("N,N...");
  add("--hand", "hand of a list; default: the robot's file that it names")
      ->type_name("FILE")
      ->check(named);
  add("--object", "object of a list; default: the body's file that it names")
      ->type_name("FILE")
      ->check(named);
  add_scene(add);
  add_drawing(add, "size of each picture [pixels]; default: 1280x960, 320x240 for several",
              "paper or draft; default: paper, draft for several");
  add("--camera",
      "position, target and up direction [m]; default: computed; file: as in the world's "
      "file")
      ->type_name("X,Y,Z[,X,Y,Z[,X,Y,Z]]");
  add("--background", "studio, white or transparent; default: studio, white for several")
      ->type_name("NAME")
      ->check(CLI::IsMember({"studio", "white", "transparent"}));
  add("--outline", "width of lines around bodies [pixels]; default: 0")
      ->type_name("N")
      ->check(not_negative);
  add.flag("--orthographic", "parallel projection");
}

static void add_served(const Adder& add) {
  add("WORLD", "a world's file")->required()->check(named);
  add("--folder", "requests may read and write files below this folder; default: none")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory);
}

void add_serve_options(CLI::App& verb, std::vector<std::string>& words) {
  const Adder add{verb, words};
  add_served(add);
  add("--port", "TCP port; 0: the system chooses one; default: 4765")
      ->type_name("N")
      ->check(whole_number(0, 65535));
  add("--host", "address to listen on; default: 127.0.0.1, reachable only from this machine")
      ->type_name("ADDRESS");
  add("--socket", "a Unix socket instead of a TCP port")->type_name("PATH")->check(named);
  add.flag("--stdio", "JSON-RPC over standard input and output instead");
  add("--http", "port of a live page that shows the world in a browser; 0: the system chooses one")
      ->type_name("N")
      ->check(whole_number(0, 65535));
  add.flag("--control", "the live page has sliders that move DOFs, and takes all requests");
  add("--token-file", "file that stores the token; default: in the folder of the user's session")
      ->type_name("FILE")
      ->check(named);
  add.flag("--no-token", "any program of this machine may control the world");
}

void add_mcp_options(CLI::App& verb, std::vector<std::string>& words) {
  const Adder add{verb, words};
  add_served(add);
  add.flag("--control", "also offer tools that change the world; default: only those that do not");
}

void add_view_options(CLI::App& verb, std::vector<std::string>& words) {
  const Adder add{verb, words};
  add("FILE", "a world, robot or body")->check(named);
  add("--script", "a script of Lua to run first; session and view are defined")
      ->type_name("FILE")
      ->check(named);
  add("--screenshot", "writes a picture instead of opening a window")
      ->type_name("OUT.png")
      ->check(named);
  add("--size", "width and height in pixels, as in 1070x937")->type_name("WxH");
}

}  // namespace clench
