#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/text/memory_budget.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

// numbers, or rows of numbers of equal length
static NpyArray read_array(lua_State* L, int index, const std::string& subject) {
  if (!lua_istable(L, index))
    fail("{}: expected a list of numbers, or of rows of them, got {}", subject,
         described(L, index));
  NpyArray out;
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  out.shape = {static_cast<size_t>(count)};
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, index, i);
    if (lua_istable(L, -1)) {
      const size_t width = lua_rawlen(L, -1);
      if (i == 1) out.shape.push_back(width);
      if (out.shape.size() != 2 || width != out.shape[1])
        fail("{}[{}]: expected {}, got a row of {} numbers", subject, i,
             out.shape.size() == 2 ? fmt::format("a row of {} numbers", out.shape[1]) : "a number",
             width);
      for (size_t k = 1; k <= width; ++k) {
        lua_rawgeti(L, -1, static_cast<lua_Integer>(k));
        if (lua_type(L, -1) != LUA_TNUMBER)
          fail("{}[{}][{}]: expected a number, got {}", subject, i, k, described(L, -1));
        out.numbers.push_back(lua_tonumber(L, -1));
        lua_pop(L, 1);
      }
    } else {
      if (lua_type(L, -1) != LUA_TNUMBER || out.shape.size() != 1)
        fail("{}[{}]: expected {}, got {}", subject, i,
             out.shape.size() == 2 ? "a row of numbers" : "a number", described(L, -1));
      out.numbers.push_back(lua_tonumber(L, -1));
    }
    lua_pop(L, 1);
  }
  return out;
}

static int save_arrays(lua_State* L) {
  const std::string path = check_output(L, 1);
  if (!lua_istable(L, 2)) fail_expected({L, {}, "arrays"}, "a table of names and lists", 2);
  Table options(L, 3);
  const bool compress = options.boolean("compress", false);
  options.done();
  std::map<std::string, NpyArray> arrays;
  each_named(L, 2, {L, {}, "arrays"}, "names", [&](const std::string& name, int i, const What&) {
    // a name selects a file in an archive
    if (name.empty() || name.find_first_of(std::string_view("/\\\0", 3)) != name.npos)
      fail("{}: arrays: expected names without slashes, got {}", subject(L), in_quotes(name));
    arrays[name] = read_array(L, i, fmt::format("{}: {}", subject(L), excerpt(name)));
  });
  write_file(path, npz_bytes(arrays, compress));
  return 0;
}

static int arrays(lua_State* L) {
  const std::string path = check_string(L, 1, "path");
  Table options(L, 2);
  const ReadOptions reading = read_options(L, options);
  options.done();
  const std::string bytes = read_bytes(find_file(path, {}, reading));
  const auto found = read_npz(path, bytes);
  MemoryBudget budget(path, bytes.size());
  push_list(L, 0, static_cast<int>(found.size()));
  for (const auto& [name, array] : found) {
    push(L, name);
    const size_t count = array.shape.empty() ? 1 : array.shape[0];
    const size_t width =
        count > 0 ? (array.is_text ? array.texts.size() : array.numbers.size()) / count : 0;
    if (array.is_text) {
      push(L, array.texts);
    } else if (array.shape.size() < 2) {
      push(L, array.numbers);
    } else {
      // memory of a table: 56 bytes, and 16 per number, in separate blocks
      const size_t row = 120 + 16 * width;
      if (count > budget.left() / row)
        fail(ErrorKind::limit, "{}: {}: expected at most {} rows, got {}", path, excerpt(name),
             budget.left() / row, count);
      budget.take(count * row);
      push_list(L, static_cast<int>(count));
      for (size_t i = 0; i < count; ++i) {
        push(L, std::span(array.numbers).subspan(i * width, width));
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
      }
    }
    lua_rawset(L, -3);
  }
  return 1;
}

static const Entry arrays_functions[] = {
    {"save_arrays", guarded<save_arrays>, R"(
Writes lists of numbers, or of rows of numbers, as NumPy arrays, which `numpy.load` returns by their names.
@param path string  .npz
@param arrays table<string, number[]|number[][]>  arrays by name, of one or two dimensions
@param options? table  how it is written
@option compress? boolean = false  true: as numpy.savez_compressed
@effect files
> clench.files.save_arrays("build/arrays.npz", {time = {0, 0.5}, place = {{1, 2, 3}, {4, 5, 6}}})
> clench.files.save_arrays("build/arrays.npz", {time = {0, 0.5}}, {compress = true})
> clench.files.save_arrays("build/arrays.npz", {time = {0, "x"}})  --> error: time[2]: expected a number, got 'x')"},
    {"arrays", guarded<arrays>, R"(
The arrays of such a file: lists of numbers or texts, or lists of rows. All indices but the first are combined into one.
@param path string  .npz
@param options? table  how the file is read
@like clench.load  root, confine, strict, unit, mesh_scale
@return table<string, number[]|number[][]|string[]>
@effect files
> clench.files.save_arrays("build/arrays.npz", {time = {0, 0.5}, place = {{1, 2, 3}, {4, 5, 6}}})
> clench.files.arrays "build/arrays.npz".place[2][3]  --> 6.0
> clench.files.arrays "no.npz"  --> error: no such file: no.npz)"},
};

const Library arrays_library{.name = "clench.files", .doc = "", .functions = arrays_functions};

}  // namespace clench
