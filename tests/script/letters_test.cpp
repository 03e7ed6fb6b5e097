#include "clench/script/bind/log.h"
#include "clench/script/bind/picture/pictures.h"
#include "script_state.h"

using namespace clench;

TEST_CASE("a missing font is reported once per state, by its name") {
  const Font missing("no/such/folder/font.ttf"), font;
  test::Script first, second;
  for (test::Script* script : {&first, &second}) {
    script->run(
        "told = {}; clench.log.sink(function(level, text) told[#told + 1] = level .. ': ' .. text "
        "end)");
    warn_without_letters(script->L, font);
    CHECK(script->text("#told") == "0");
    warn_without_letters(script->L, missing);
    warn_without_letters(script->L, missing);
    CHECK(script->text("table.concat(told, '|')") ==
          "warning: pictures have no letters: no such file: no/such/folder/font.ttf");
  }
}
