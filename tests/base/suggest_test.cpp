#include "clench/base/suggest.h"

using namespace clench;

TEST_CASE("edits count inserted, deleted, replaced and swapped letters") {
  CHECK(edit_distance("flask", "flask") == 0);
  CHECK(edit_distance("flsk", "flask") == 1);
  CHECK(edit_distance("flaask", "flask") == 1);
  CHECK(edit_distance("flusk", "flask") == 1);
  CHECK(edit_distance("flaks", "flask") == 1);
  CHECK(edit_distance("FLASK", "flask") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("abc", "") == 3);
}

TEST_CASE("the number of edits is a metric") {
  const std::vector<std::string> words = {"", "a", "mug", "mugs", "gum", "glass", "flask"};
  for (const auto& a : words)
    for (const auto& b : words) {
      CHECK(edit_distance(a, b) == edit_distance(b, a));
      CHECK((edit_distance(a, b) == 0) == (a == b));
    }
}

TEST_CASE("a very long name gets no suggestion, without delay") {
  const std::string name(10'000'000, 'a');
  CHECK(did_you_mean(name, {name + "b", "flask"}).empty());
  CHECK(did_you_mean("flask.iv", {name}).empty());
}

TEST_CASE("only a near name is suggested") {
  CHECK(did_you_mean("flsk.iv", {"mug.iv", "flask.iv"}) == "; did you mean 'flask.iv'?");
  CHECK(did_you_mean("wod", {"wood", "rubber"}) == "; did you mean 'wood'?");
  CHECK(did_you_mean("table", {"wood", "rubber"}).empty());
  CHECK(did_you_mean("x", {}).empty());
  CHECK(did_you_mean("ab", {"abc", "a", "b"}).empty());
  CHECK(did_you_mean("zero", {"zero"}).empty());
  CHECK(did_you_mean("zero", {"zero", "hero"}) == "; did you mean 'hero'?");
}

TEST_CASE("words of other simulators lead to suggestions of Clench's words") {
  CHECK(did_you_mean("qpos", {"name", "dofs"}) == "; did you mean 'dofs'?");
  CHECK(did_you_mean("step", {"time_step", "run"}) == "; did you mean 'run'?");
  CHECK(did_you_mean("step", {"steps", "duration"}) == "; did you mean 'steps'?");
  CHECK(did_you_mean("position", {"name", "dofs"}).empty());
  // among several, the first known name
  CHECK(did_you_mean("position", {"point", "pose"}) == "; did you mean 'pose'?");
  CHECK(did_you_mean("position", {"point", "normal"}) == "; did you mean 'point'?");
  CHECK(did_you_mean("xyz", {"position", "quat"}) == "; did you mean 'position'?");
  CHECK(did_you_mean("height", {"quality", "size"}) == "; did you mean 'size'?");
  CHECK(did_you_mean("scale", {"mesh_scale"}) == "; did you mean 'mesh_scale'?");
  CHECK(did_you_mean("friction", {"material", "mass"}) == "; did you mean 'material'?");
}
