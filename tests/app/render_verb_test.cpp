// `clench render`: pictures of files and of grasps of lists.
#include <cstdint>

#include "plan_command.h"

using namespace clench::test;

namespace {

// width and height in the head of a PNG file; {0, 0} for other files
std::pair<int, int> size_of_png(const std::string& path) {
  const std::string bytes = text_of(path);
  if (bytes.size() < 24 || !bytes.starts_with("\x89PNG")) return {0, 0};
  const auto number = [&](size_t at) {
    int value = 0;
    for (size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

// draws; without OpenGL it only checks that the message names OpenGL
bool drawn(const std::string& options, const std::string& path) {
  const auto result = run("render " + options + " -o " + path);
  if (result.code != 0) CHECK(has(result.out, "OpenGL"));
  return result.code == 0;
}

// a list of equal grasps of a hand that is closed on a flask
std::string list_of(const Folder& folder, int count) {
  const std::string path = folder / "list.jsonl";
  run("-q -e 'local w = clench.load(\"worlds/dlr_flask.wld\", {root = \".\"}) "
      "w.robots[1]:autograsp() "
      "local g, l = clench.grasp(w.robots[1], w.objects[1]), clench.grasps() g:quality \"epsilon\" "
      "for i = 1, " +
      std::to_string(count) + " do l:add(g) end l:save(\"" + path + "\")'");
  return path;
}

}  // namespace

TEST_CASE("render draws worlds, robots, bodies and grasps of lists, in the requested size") {
  const Folder folder;
  const std::string out = folder / "a.png";
  if (!drawn("worlds/dlr_flask.wld --root . --quality draft --size 64x48", out)) return;
  CHECK(size_of_png(out) == std::pair(64, 48));
  CHECK(drawn("models/hands/dlr/dlr.cfg --quality draft --size 32x24 --frame all", out));
  CHECK(
      drawn("models/objects/mug.iv --quality draft --size 32x24 --camera 0.3,0,0.2,0,0,0.05", out));
  CHECK(size_of_png(out) == std::pair(32, 24));

  const std::string list = list_of(folder, 5);
  CHECK(drawn(list + " --pick 2 --quality draft --size 64x48", out));
  CHECK(size_of_png(out) == std::pair(64, 48));
  // several grasps form a sheet: 3 columns, each with a caption, and notes below
  CHECK(drawn(list + " --pick 1,3,5 --size 64x48", out));
  const auto sheet = size_of_png(out);
  CHECK(sheet.first > 2 * 64);
  CHECK(sheet.second > 48 + 22);
  // byte-identical when drawn again
  const std::string before = text_of(out);
  CHECK(drawn(list + " --pick 1,3,5 --size 64x48", out));
  CHECK(text_of(out) == before);
}

TEST_CASE("wrong options of render are reported in one sentence") {
  const Folder folder;
  const std::string out = folder / "a.png", list = list_of(folder, 2);
  const auto said = [&](const std::string& options, const std::string& sentence, int code = 2) {
    const auto result = run("render " + options);
    CHECK(result.code == code);
    CHECK_MESSAGE(has(result.out, sentence), result.out);
    CHECK(!fs::exists(out));
  };
  const std::string world = "worlds/dlr_flask.wld -o " + out + " ";
  said("worlds/dlr_flask.wld", "-o is required");
  said("worlds/dlr_flask.wld -o a.jpg", "-o: expected a file .png, got 'a.jpg'");
  said("worlds/dlr_flask.wld -o no/such/a.png", "-o: no/such/a.png", 1);
  said(world + "--size 10x10",
       "--size: expected WIDTHxHEIGHT, 16x16 to 8192x8192 pixels, got '10x10'");
  said(world + "--quality fine", "--quality: fine not in {");
  said(world + "--camera 1,2", "--camera: expected X,Y,Z in meters, with a point to look at");
  said(world + "--pick 1",
       "--pick applies to lists of grasps, but worlds/dlr_flask.wld is a file of kind 'world'");
  said("no.wld -o " + out, "no such file: no.wld", 1);
  said("models/hands/dlr/dlr.egr -o " + out,
       "expected a world, a robot, a body or a list of grasps");
  said("models/objects/mug.iv --camera file -o " + out, "--camera file: the file gives no camera");
  said(list + " --pick 3 -o " + out, "--pick: expected numbers from 1 to 2, got 3");
  said(list + " --pick one -o " + out,
       "--pick: expected numbers of grasps, as in 1,4,7, got 'one'");
  said(list + " --hand no.cfg -o " + out, "no such file: no.cfg", 1);
}
