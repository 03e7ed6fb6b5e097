// Functions shared by the bindings of ui: the user interface of a call, its frame, colors and
// bodies of containers.
#pragma once
#include <string>
#include <vector>

#include "clench/script/bind/view/ui.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/table.h"
#include "clench/viewer/gui.h"

namespace clench {

inline Gui& open_gui(lua_State* L) {
  const UiHandle& handle = self<UiHandle>(L);
  if (!handle.gui) fail("{}: the screen was closed", subject(L));
  return *handle.gui;
}

// for functions that describe a frame
inline Gui& framed_gui(lua_State* L) {
  Gui& gui = open_gui(L);
  if (!self<UiHandle>(L).in_frame) fail("{}: expected a call within ui:frame", subject(L));
  gui.resume();
  return gui;
}

inline Rgba read_color(Table& options, const char* key, const Rgba& fallback) {
  if (!options.has(key)) return fallback;
  const std::vector<double> numbers = options.numbers(key);
  if (numbers.size() != 3 && numbers.size() != 4)
    fail("{}: {}: expected 3 or 4 numbers from 0 to 1, got {}", options.subject(), key,
         numbers.size());
  Rgba color{0, 0, 0, 1};
  for (size_t i = 0; i < numbers.size(); ++i) color[i] = static_cast<float>(numbers[i]);
  return color;
}

// The function that fills a container, which may draw frames of other interfaces, too.
class BodyOf {
 public:
  BodyOf(lua_State* L, int function) : L_(L), function_(function) {
    if (!lua_isfunction(L, function))
      fail("{}: expected a function, got {}", subject(L), described(L, function));
  }
  void operator()() const {
    struct Resumed {
      Gui& gui;
      ~Resumed() { gui.resume(); }
    } const resumed{open_gui(L_)};
    lua_pushvalue(L_, function_);
    lua_pushvalue(L_, 1);
    call_script(L_, 1, 0, "ui");
  }

 private:
  lua_State* L_;
  int function_;
};

inline std::vector<std::string> check_names(lua_State* L, int i, const char* name) {
  std::vector<std::string> names;
  each_item(L, i, {L, {}, name}, "a list of strings",
            [&](int k, const What& what) { names.push_back(read_string(L, k, what)); });
  return names;
}

}  // namespace clench
