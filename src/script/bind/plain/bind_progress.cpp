#include <algorithm>
#include <cmath>

#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/watching.h"

namespace clench {

ProgressHandle::ProgressHandle(std::shared_ptr<Bar> on, double of, std::string what)
    : bar(std::move(on)), total(of), text(std::move(what)) {
  bar->begin_script();
}

ProgressHandle::ProgressHandle(ProgressHandle&& from) noexcept
    : bar(std::move(from.bar)),
      total(from.total),
      done(from.done),
      text(std::move(from.text)),
      open(std::exchange(from.open, false)) {}

void ProgressHandle::close() {
  if (std::exchange(open, false)) bar->end_script();
}

static void show(ProgressHandle& progress) {
  if (progress.open)
    progress.bar->note_script(progress.total > 0 ? progress.done / progress.total : -1,
                              progress.text);
}

static int new_progress(lua_State* L) {
  lua_settop(L, 2);
  const bool list = lua_istable(L, 1);
  const double total = list          ? static_cast<double>(lua_rawlen(L, 1))
                       : given(L, 1) ? check_number(L, 1, "total")
                                     : 0;
  if (!(total >= 0) || !std::isfinite(total))
    fail("{}: total: expected a number >= 0, got {}", subject(L), total);
  const std::string text = given(L, 2) ? check_string(L, 2, "text") : "";
  push_object(L, ProgressHandle(bar_of(L), total, text), 1);
  lua_pushvalue(L, 1);
  lua_setiuservalue(L, -2, 1);
  return 1;
}

static int progress_step(lua_State* L) {
  auto& progress = self<ProgressHandle>(L);
  const double by = given(L, 2) ? check_number(L, 2, "count") : 1;
  if (!(by >= 0)) fail("{}: count: expected a number >= 0, got {}", subject(L), by);
  if (given(L, 3)) progress.text = check_string(L, 3, "text");
  progress.done = std::min(progress.done + by, progress.total > 0 ? progress.total : INFINITY);
  show(progress);
  return 0;
}

// as the iterator of a loop: (self, nil, previous item)
static int next(lua_State* L) {
  auto& progress = self<ProgressHandle>(L);
  const lua_Integer i = (lua_isinteger(L, 3) ? lua_tointeger(L, 3) : 0) + 1;
  progress.done = static_cast<double>(i - 1);
  show(progress);
  if (static_cast<double>(i) > progress.total) {
    progress.close();
    return 0;
  }
  lua_pushinteger(L, i);
  if (lua_getiuservalue(L, 1, 1) != LUA_TTABLE) {
    lua_pop(L, 1);
    return 1;
  }
  lua_rawgeti(L, -1, i);
  lua_remove(L, -2);
  return 2;
}

static std::string progress_text(const ProgressHandle& progress) {
  return fmt::format("progress: {:.15g} of {:.15g}", progress.done, progress.total);
}

static const Entry progress_functions[] = {
    {"progress", guarded<new_progress>, R"(
Shows the progress of a loop: a bar with the remaining time on a terminal; nothing in a pipe or a file. Over a number or a list
it is the loop itself, `for i, item in clench.progress(list)`; elsewhere call `step`. It disappears at the loop's end,
or by `close`.
@param total? integer|any[]  how many steps, or what to go through; without, only the text is shown
@param text? string  what is in progress, shown before the bar
@return progress
@effect reads
> sum = 0
> for i, word in clench.progress({"a", "bb"}, "counting") do sum = sum + i * #word end
> for i in clench.progress(3) do sum = sum + i end
> sum  --> 11
> clench.progress(-1)  --> error: expected a number >= 0)"},
};

static const Entry progress_methods[] = {
    {"step", guarded<progress_step>, R"(
Counts the given number of steps as done.
@param count? number  default 1
@param text? string  shown beside the bar from now on
@effect edits
> p = clench.progress(10, "closing")
> p:step(4, "opening")
> p:close()
> p.done, p.total  --> 4.0, 10.0)"},
    {"close", method<[](ProgressHandle& x) { x.close(); }>, R"(
Removes the bar; a variable declared <close> does so automatically.
@effect edits
> p = clench.progress(10)
> p:close()
> p  --> progress: 0 of 10)"},
};

static const Entry progress_fields[] = {
    {"done", getter<[](const ProgressHandle& x) { return x.done; }>, R"(
Number of steps that are done.
@type number
> clench.progress(10).done  --> 0.0)"},
    {"total", getter<[](const ProgressHandle& x) { return x.total; }>, R"(
Total number of steps; 0 if unknown.
@type number
> clench.progress(10).total  --> 10.0)"},
};

static const Entry progress_operators[] = {{"__tostring", method<progress_text>, ""},
                                           {"__call", guarded<next>, ""}};

const Library progress_library{.name = "clench", .doc = "", .functions = progress_functions};

const Class progress_class{.name = "progress",
                           .variable = "progress",
                           .doc = "Progress of a script's loop, as shown by `clench.progress`.",
                           .fields = progress_fields,
                           .methods = progress_methods,
                           .operators = progress_operators};

}  // namespace clench
