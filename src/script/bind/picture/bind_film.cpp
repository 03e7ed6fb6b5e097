#include <cmath>

#include "clench/base/file.h"
#include "clench/render/figure/gif.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"

namespace clench {

static int save_gif(lua_State* L) {
  const std::string path = check_output(L, 1);
  if (!lua_istable(L, 2)) fail_expected({L, {}, "pictures"}, "a list of pictures", 2);
  std::vector<Picture> frames;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, 2)); ++i) {
    lua_rawgeti(L, 2, i);
    const auto* picture = to<Picture>(L, -1);
    if (!picture)
      fail("{}: pictures[{}]: expected a picture, got {}", subject(L), i, described(L, -1));
    frames.push_back(on_white(*picture));
    lua_pop(L, 1);
  }
  Table options(L, 3);
  std::vector<int> delays(frames.size(), 10);
  if (options.has("rate")) {
    const double rate = options.number("rate");
    // the rounding error of a delay is carried over to the next one
    int shown = 0;
    for (size_t i = 0; i < delays.size(); ++i) {
      const int stop =
          static_cast<int>(std::lround(std::min(100.0 * static_cast<double>(i + 1) / rate, 1e9)));
      delays[i] = stop - shown;
      shown = stop;
    }
  }
  if (options.has("delays")) {
    const auto given = options.numbers("delays", static_cast<int>(frames.size()));
    for (size_t i = 0; i < given.size(); ++i) {
      if (!(given[i] >= 0 && given[i] <= 65535))
        fail("{}: delays[{}]: expected 0 to 65535 hundredths of a second, got {}", subject(L),
             i + 1, given[i]);
      delays[i] = static_cast<int>(std::lround(given[i]));
    }
  }
  options.done();
  write_file(path, gif_bytes(frames, delays));
  return 0;
}

static const Entry film_functions[] = {
    {"save_gif", guarded<save_gif>, R"(
Writes pictures of one size as an animated GIF of up to 256 colors, which repeats forever.
@param path string  file to write
@param pictures picture[]  frames in order, all of one size
@param options? table  how long each picture is shown
@option rate? number [Hz, > 0] = 10  pictures per second
@option delays? number[] [0.01 s]  of each picture, 0 to 65535
@effect files
> small = clench.render(world, {size = {64, 48}, quality = "draft"})
> clench.files.save_gif("build/small.gif", {small, small}, {rate = 25})
> clench.files.save_gif("build/small.gif", {})  --> error: expected at least one picture, got none)"},
};

const Library film_library{.name = "clench.files", .doc = "", .functions = film_functions};

}  // namespace clench
