// Reading that is confined to a folder: no file outside is read, whatever path names it, and
// messages do not reveal which files exist outside.
#include "clench/io/text/confine.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/graspit/inventor_primitives.h"
#include "clench/io/write/write_world.h"
#include "read_any.h"
#include "support/meshes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;
namespace fs = std::filesystem;

namespace {

const std::string triangle_off = "OFF\n3 1 0\n0 0 0\n0.1 0 0\n0 0.1 0\n3 0 1 2\n";
const std::string triangle_iv =
    "#Inventor V2.1 ascii\nCoordinate3 { point [0 0 0, 100 0 0, 0 100 0] }\n"
    "IndexedFaceSet { coordIndex [0, 1, 2, -1] }\n";

/// A folder `inside` to which reading is confined, a folder `outside` with readable files, and
/// paths and links from the one to the other.
struct Fences {
  Fences() {
    for (const std::string side : {"inside/", "outside/"})
      for (const std::string ending : {"off", "iv", "wrl", "mtl", "egr", "vgr", "xml"})
        folder.write(side + "part." + ending, ending == "off" ? triangle_off : triangle_iv);
    folder.write("outside/part.off", triangle_off);
    fs::create_directory(inside() / "sub");
    fs::create_symlink("../outside", inside() / "link");
    fs::create_symlink("../link", inside() / "sub/link");
    for (const std::string ending : {"off", "iv", "wrl", "mtl", "egr", "vgr", "xml"})
      fs::create_symlink("../outside/part." + ending, inside() / ("linked." + ending));
    fs::create_symlink("circle.off", inside() / "circle.off");
    fs::create_symlink("part.off", inside() / "alias.off");
    fs::create_symlink("../outside/no.off", inside() / "dangling.off");
    options.confine = inside();
  }
  fs::path inside() const { return folder.path() / "inside"; }
  fs::path outside() const { return folder.path() / "outside"; }

  TemporaryFolder folder;
  ReadOptions options;
};

/// The error that reading a file throws; empty if it throws none.
template <class Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool says_outside(const std::string& sentence) {
  const bool says = sentence.find("lies outside of ") != std::string::npos &&
                    sentence.ends_with(", to which reading is confined");
  if (!says) MESSAGE("got: ", sentence);
  return says;
}

/// A file that names another as "%", with its kind: body, robot or world.
struct Referrer {
  const char* file;
  const char* ending;  ///< kind of the file that it names
  const char* text;
  bool deeper = false;  ///< true if names are relative to folders that may be missing
};

constexpr Referrer referrers[] = {
    {"w.wld", "off", "#GraspIt! version 2.0\nGraspableBody\n%\nT (1 0 0 0)[0 0 0]\n"},
    {"w.xml", "off",
     "<world><obstacle><filename>%</filename><transform><fullTransform>(1 0 0 0)[0 0 "
     "0]</fullTransform></transform></obstacle></world>"},
    {"b.xml", "off", "<root><mass>1</mass><geometryFile type=\"off\">%</geometryFile></root>"},
    {"h.cfg", "iv", "Hand\n%\n1\nr 1 1e9 1e9 1e7 20\n0\n", true},
    {"h.xml", "iv", "<robot type=\"Hand\"><palm>%</palm></robot>", true},
    {"h.urdf", "off",
     "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh filename=\"%\"/>"
     "</geometry></collision></link></robot>"},
    {"f.urdf", "off",
     "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh filename=\"file://%\"/>"
     "</geometry></collision></link></robot>"},
    {"p.urdf", "off",
     "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh "
     "filename=\"package://sub/%\"/></geometry></collision></link></robot>",
     true},
    {"i.mjcf", "xml", "<mujoco><include file=\"%\"/></mujoco>"},
    {"m.mjcf", "off",
     "<mujoco><asset><mesh name=\"m\" file=\"%\"/></asset><worldbody><body><geom type=\"mesh\" "
     "mesh=\"m\"/></body></worldbody></mujoco>"},
    {"b.gltf", "off",
     "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"mesh\": 0}], \"meshes\": "
     "[{\"primitives\": [{\"attributes\": {\"POSITION\": 0}}]}], \"accessors\": [{\"bufferView\": "
     "0, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\"}], \"bufferViews\": "
     "[{\"buffer\": 0, \"byteLength\": 36}], \"buffers\": [{\"byteLength\": 36, \"uri\": \"%\"}]}"},
    {"b.iv", "iv", "#Inventor V2.1 ascii\nSeparator { File { name \"%\" } }\n"},
    {"b.wrl", "wrl", "#VRML V2.0 utf8\nInline { url \"%\" }\n"},
};

}  // namespace

TEST_CASE("a path lies within a folder when it leads there, by links and dots, or would") {
  const Fences fences;
  const fs::path in = fences.inside();
  CHECK(lies_within(in / "part.off", in));
  CHECK(lies_within(in / "nothing/at/all", in));
  CHECK(lies_within(in, in));
  CHECK(lies_within(in / "sub/../part.off", in / ""));
  CHECK(lies_within(in / "alias.off", in));
  CHECK(lies_within(in / "link/../inside/part.off", in));
  CHECK(lies_within("anywhere", ""));
  for (const fs::path& out :
       {in / "..", in / "../outside", in / "link", in / "link/nothing", in / "sub/link/part.off",
        in / "linked.off", in / "dangling.off", in / "circle.off", in / "nothing/../../outside",
        fs::path(in.string() + "side"), fs::path("/"), fs::path("/etc/passwd"), fs::path("")}) {
    CAPTURE(out);
    CHECK_FALSE(lies_within(out, in));
  }
  // nothing lies within a folder that cannot be resolved
  CHECK_FALSE(lies_within(in / "part.off", in / "circle.off"));
  // the path of the folder may itself contain a link
  fs::create_symlink(in, fences.folder.path() / "name");
  CHECK(lies_within(fences.folder.path() / "name/part.off", in));
  CHECK(lies_within(in / "part.off", fences.folder.path() / "name"));
}

TEST_CASE(
    "no format that names files reads one outside, by dots, from the root, or through links") {
  const Fences fences;
  for (const Referrer& referrer : referrers) {
    const std::string part = std::string("part.") + referrer.ending;
    for (const std::string& name :
         {"../../outside/" + part, (fences.outside() / part).string(), "../link/" + part,
          "link/" + part, "../linked." + std::string(referrer.ending),
          std::string("../../../../../../../../etc/passwd"),
          "../../outside/no_such." + std::string(referrer.ending)}) {
      std::string text = referrer.text;
      text.replace(text.find('%'), 1, name);
      const fs::path file = fences.folder.write(std::string("inside/sub/") + referrer.file, text);
      CAPTURE(text);
      const std::string sentence = refusal([&] { read_any(file, fences.options); });
      if (referrer.deeper && sentence.find("no such file") != std::string::npos)
        // no path outside is accessible from there
        CHECK(sentence.find(excerpt(name)) != std::string::npos);
      else
        CHECK(says_outside(sentence));
      fs::remove(file);
    }
    // files inside are found as usual: no message mentions the outside
    std::string text = referrer.text;
    text.replace(text.find('%'), 1, "../" + part);
    const fs::path file = fences.folder.write(std::string("inside/sub/") + referrer.file, text);
    const std::string sentence = refusal([&] { read_any(file, fences.options); });
    CAPTURE(sentence);
    CHECK(sentence.find("lies outside") == std::string::npos);
  }
}

TEST_CASE("what is there outside makes no difference to any sentence") {
  const Fences fences;
  const fs::path referrer = fences.inside() / "w.wld";
  const auto told = [&](const std::string& name) {
    std::string sentence = refusal([&] { find_file(name, referrer, fences.options); });
    const size_t at = sentence.find(name);
    return at == std::string::npos ? sentence : sentence.replace(at, name.size(), "NAME");
  };
  CHECK(says_outside(told("../outside/part.off")));
  CHECK(told("../outside/part.off") == told("../outside/none.off"));
  CHECK(told("link/part.off") == told("link/none.off"));
  CHECK(told("linked.off") == told("dangling.off"));
  CHECK(told("../outside") == told("../nowhere"));
  // similar names, and names in other case, are searched only inside
  CHECK(told("../outside/prat.off") == told("../outside/qqqqqqqq"));
  CHECK(told("../OUTSIDE/part.off") == told("../NOWHERE/part.off"));
  CHECK(told("prat.off") == "no such file: NAME; did you mean 'part.off'?");
  CHECK(find_file("PART.off", referrer, fences.options) == fences.inside() / "part.off");
  // a link found by case alone is followed, too
  CHECK(told("LINKED.off") == "no such file: NAME; did you mean 'linked.off'?");
}

TEST_CASE("the user's own names, folders and chosen files are confined, too") {
  const Fences fences;
  ReadOptions options = fences.options;
  CHECK(refusal([&] { read_body(fences.outside() / "part.off", options); }) ==
        "'" + (fences.outside() / "part.off").string() + "' lies outside of " +
            fences.inside().string() + ", to which reading is confined");
  CHECK(refusal([&] { read_body(fences.inside() / "part.off", options); }).empty());
  options.root = options.folder = fences.outside();
  CHECK(refusal([&] { find_file("only.off", fences.inside() / "x", options); }) ==
        "no such file: only.off");
  fences.folder.write("outside/pack/mesh.off", triangle_off);
  options.packages[""] = fences.outside();
  const fs::path urdf = fences.folder.write(
      "inside/sub/r.urdf",
      "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh "
      "filename=\"package://pack/mesh.off\"/></geometry></collision></link></robot>");
  CHECK(says_outside(refusal([&] { read_robot(urdf, options); })));

  // a hand's eigengrasps outside are skipped with a warning, like missing ones
  Warnings warnings;
  options = warnings.options();
  options.confine = fences.inside();
  const fs::path hand = fences.folder.write(
      "inside/sub/hand.cfg",
      "Hand\n../part.iv\n1\nr 1 1e9 1e9 1e7 20\n1\n1\n1\nt 0 0 0\nd0 0 10 0 -10 90\nRevolute\n"
      "../part.iv 0\nEigenGrasps\n../../outside/part.egr\n");
  CHECK(refusal([&] { read_robot(hand, options); }).empty());
  CHECK(std::ranges::any_of(warnings.list, [](const std::string& sentence) {
    return sentence.find("lies outside of ") != std::string::npos;
  }));
  options.eigengrasps = (fences.outside() / "part.egr").string();
  CHECK(says_outside(refusal([&] { read_robot(hand, options); })));
}

TEST_CASE("primitives beside an object are not taken through a link") {
  const Fences fences;
  fences.folder.write("outside/primitives/mug.iv", "#Inventor V2.1 ascii\nCube { }\n");
  const fs::path mug = fences.folder.write("inside/mug.iv", "#Inventor V2.1 ascii\nSphere { }\n");
  fs::create_symlink("../outside/primitives", fences.inside() / "primitives");
  CHECK(read_primitives(mug, {}).front().kind == PrimitiveKind::box);
  CHECK(read_primitives(mug, fences.options).front().kind == PrimitiveKind::sphere);
}

TEST_CASE("pipes, devices and folders are never opened") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe.off";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const std::string name : {"pipe.off", "/dev/zero", "/dev/stdin"}) {
    const std::string text =
        "#GraspIt! version 2.0\nGraspableBody\n" + name + "\nT (1 0 0 0)[0 0 0]\n";
    const std::string sentence = refusal([&] { read_world(folder.write("w.wld", text), {}); });
    CHECK_MESSAGE(sentence.starts_with("w.wld:3: "), sentence);
  }
  CHECK(refusal([&] { read_body(pipe, {}); }) ==
        "expected a file, got a special file: " + pipe.string());
  CHECK_THROWS_AS(read_body("/proc/self/mem", {}), Error);
}

TEST_CASE("what is read again to be saved is confined as it was") {
  const Fences fences;
  fences.folder.write("inside/hand.cfg",
                      "Hand\npart.iv\n1\nr 1 1e9 1e9 1e7 20\n1\n1\n1\nt 0 0 0\nd0 0 10 0 -10 90\n"
                      "Revolute\npart.iv 0\nEigenGrasps\n../outside/part.egr\n");
  WorldSpec world;
  world.robots.emplace_back().robot = read_robot(fences.inside() / "hand.cfg", fences.options);
  world.order = {{WorldEntry::Kind::robot, 0}};
  for (const char* file : {"w.xml", "w.lua"}) {
    WriteOptions options;
    // the eigengrasps outside have other contents
    CHECK(refusal([&] {
            write_world(world, fences.folder.path() / file, options);
          }).find("part.egr:") != std::string::npos);
    options.confine = fences.inside();
    CHECK(refusal([&] { write_world(world, fences.folder.path() / file, options); }).empty());
    CHECK(fs::exists(fences.folder.path() / file));
  }
}
