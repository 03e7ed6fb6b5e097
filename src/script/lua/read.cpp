#include "clench/script/lua/read.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>

#include "clench/base/text.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/values.h"

namespace clench {

std::string What::text() const {
  std::string out = subject.empty() ? clench::subject(L) : std::string(subject);
  if (!key.empty()) out += ": " + key;
  return out;
}

What What::named(std::string_view name) const {
  const std::string told = excerpt(name);
  return {L, subject, key.empty() ? told : key + '.' + told};
}

static std::string quoted(lua_State* L, int index) {
  const std::string_view text = string_at(L, index);
  if (text.empty()) return "''";
  return text.size() > 40 ? in_quotes(text.substr(0, 37)).insert(38, "...") : in_quotes(text);
}

static std::string class_name(lua_State* L, int index) {
  if (luaL_getmetafield(L, index, "__name") == LUA_TNIL) return "userdata";
  const std::string name(lua_type(L, -1) == LUA_TSTRING ? string_at(L, -1) : "userdata");
  lua_pop(L, 1);
  return name;
}

std::string with_article(std::string_view noun) {
  if (noun.ends_with('s')) return std::string(noun);
  const bool vowel = std::string_view("aeiou").find(noun.substr(0, 1)) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

std::string described(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNONE:
      return "nothing";
    case LUA_TNIL:
      return "nil";
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER:
      if (lua_isinteger(L, index)) return fmt::format("{}", lua_tointeger(L, index));
      // its sign depends on the computation
      if (std::isnan(lua_tonumber(L, index))) return "nan";
      return fmt::format("{}", lua_tonumber(L, index));
    case LUA_TSTRING:
      return quoted(L, index);
    case LUA_TTABLE: {
      const std::string name = class_name(L, index);
      if (name == "clench" || name.starts_with("clench."))
        return name + ", whose functions are called with '.' and not ':'";
      const auto size = lua_rawlen(L, index);
      if (size) return fmt::format("a table of {}", size);
      index = lua_absindex(L, index);
      lua_pushnil(L);
      if (!lua_next(L, index)) return "an empty table";
      lua_pop(L, 2);
      return "a table with names";
    }
    case LUA_TUSERDATA:
      return with_article(class_name(L, index));
    default:
      return std::string("a ") + luaL_typename(L, index);
  }
}

void fail_expected(const What& what, std::string_view expected, int index) {
  fail("{}: expected {}, got {}", what.text(), expected, described(what.L, index));
}

double read_number(lua_State* L, int i, const What& what) {
  if (lua_type(L, i) != LUA_TNUMBER) fail_expected(what, "a number", i);
  const double x = lua_tonumber(L, i);
  if (!std::isfinite(x)) fail_expected(what, "a finite number", i);
  return x;
}

int64_t read_integer(lua_State* L, int i, const What& what) {
  int whole = 0;
  const int64_t n = lua_tointegerx(L, i, &whole);
  if (lua_type(L, i) != LUA_TNUMBER || !whole) fail_expected(what, "an integer", i);
  return n;
}

int read_int(lua_State* L, int i, const What& what) {
  const int64_t n = read_integer(L, i, what);
  if (n < INT_MIN || n > INT_MAX) fail_expected(what, "an integer of 32 bits", i);
  return static_cast<int>(n);
}

bool read_boolean(lua_State* L, int i, const What& what) {
  if (lua_type(L, i) != LUA_TBOOLEAN) fail_expected(what, "true or false", i);
  return lua_toboolean(L, i);
}

std::string read_string(lua_State* L, int i, const What& what) {
  if (lua_type(L, i) != LUA_TSTRING) fail_expected(what, "a string", i);
  const std::string_view text = string_at(L, i);
  if (text.find('\0') != std::string_view::npos)
    fail_expected(what, "a string without zero bytes", i);
  return std::string(text);
}

// pushes the item of a list; metamethods are not called
static void push_item(lua_State* L, int list, int item) {
  if (!lua_checkstack(L, 4)) fail(ErrorKind::limit, "too many values on the stack");
  lua_rawgeti(L, list, item);
}

// the smallest, so that messages do not depend on the order of a hash table; "" if no text was kept yet
static void keep_least(std::string& least, std::string text) {
  if (least.empty() || text < least) least = std::move(text);
}

// a key of a table that is not in its list, the smallest name; "" if there is none
static std::string foreign_key(lua_State* L, int table, lua_Integer size, const char* extra) {
  std::string name, other;
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) {
    if (lua_isinteger(L, -2)) {
      const lua_Integer k = lua_tointeger(L, -2);
      if (k < 1 || k > size) keep_least(other, fmt::format("[{}]", k));
    } else if (lua_type(L, -2) != LUA_TSTRING) {
      keep_least(other, "[" + described(L, -2) + "]");
    } else if (!extra || string_at(L, -2) != extra) {
      keep_least(name, quoted(L, -2));
    }
  }
  return name.empty() ? other : name;
}

int read_list_size(lua_State* L, int i, const What& what, std::string_view expected,
                   const char* extra) {
  if (lua_type(L, i) != LUA_TTABLE) fail_expected(what, expected, i);
  i = lua_absindex(L, i);
  const auto size = lua_rawlen(L, i);
  if (size > INT_MAX) fail_expected(what, expected, i);
  if (!lua_checkstack(L, 4)) fail(ErrorKind::limit, "too many values on the stack");
  const std::string key = foreign_key(L, i, static_cast<lua_Integer>(size), extra);
  if (!key.empty())
    fail("{}: expected {}, got a table with the key {}", what.text(), expected, key);
  return static_cast<int>(size);
}

std::vector<std::string> read_keys(lua_State* L, int table, const What& what,
                                   std::string_view expected, std::vector<int>* numbers) {
  table = lua_absindex(L, table);
  std::vector<std::string> names;
  std::string other;
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) {
      names.emplace_back(string_at(L, -2));
    } else if (numbers && lua_isinteger(L, -2) && std::in_range<int>(lua_tointeger(L, -2))) {
      numbers->push_back(static_cast<int>(lua_tointeger(L, -2)));
    } else {
      keep_least(other, described(L, -2));
    }
  }
  if (!other.empty()) fail("{}: expected {} as keys, got {}", what.text(), expected, other);
  std::ranges::sort(names);
  if (numbers) std::ranges::sort(*numbers);
  return names;
}

std::vector<double> read_numbers(lua_State* L, int i, const What& what, int count) {
  i = lua_absindex(L, i);
  if (const auto* v = to<Eigen::Vector3d>(L, i); v && (count < 0 || count == 3))
    return {v->x(), v->y(), v->z()};
  const std::string expected =
      count < 0 ? "a list of numbers" : fmt::format("{} number{}", count, count == 1 ? "" : "s");
  // a number as an item would be mistaken for a count of numbers
  if (lua_type(L, i) != LUA_TTABLE && count >= 0) fail_expected(what, "a list of " + expected, i);
  const int size = read_list_size(L, i, what, expected);
  if (count >= 0 && size != count) fail("{}: expected {}, got {}", what.text(), expected, size);
  std::vector<double> numbers(static_cast<size_t>(size));
  for (int k = 1; k <= size; ++k) {
    push_item(L, i, k);
    // the item's name is created only if needed
    if (lua_type(L, -1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, -1)))
      read_number(L, -1, what.item(k));
    numbers[static_cast<size_t>(k - 1)] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  return numbers;
}

std::vector<std::vector<double>> read_rows(lua_State* L, int i, const What& what, int columns) {
  i = lua_absindex(L, i);
  const int size = read_list_size(L, i, what, "a list of lists of numbers");
  std::vector<std::vector<double>> rows;
  for (int k = 1; k <= size; ++k) {
    push_item(L, i, k);
    rows.push_back(read_numbers(L, -1, what.item(k), columns));
    lua_pop(L, 1);
  }
  return rows;
}

Eigen::VectorXd vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), std::ssize(numbers));
}

Eigen::Matrix<double, 6, Eigen::Dynamic> columns_of(const std::vector<std::vector<double>>& rows) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> columns(6, std::ssize(rows));
  for (Eigen::Index c = 0; c < columns.cols(); ++c)
    columns.col(c) = vector_of(rows[static_cast<size_t>(c)]);
  return columns;
}

Eigen::Matrix3d read_matrix3(lua_State* L, int i, const What& what) {
  const auto rows = read_rows(L, i, what, 3);
  if (rows.size() != 3) fail("{}: expected 3 rows, got {}", what.text(), rows.size());
  Eigen::Matrix3d out;
  for (int r = 0; r < 3; ++r) out.row(r) = Eigen::Vector3d(rows[r][0], rows[r][1], rows[r][2]);
  return out;
}

Eigen::Vector3d read_vec3(lua_State* L, int i, const What& what) {
  if (const auto* v = to<Eigen::Vector3d>(L, i)) return *v;
  if (lua_type(L, i) != LUA_TTABLE) fail_expected(what, "a vec3 or {x, y, z}", i);
  const auto v = read_numbers(L, i, what, 3);
  return {v[0], v[1], v[2]};
}

Pose read_pose(lua_State* L, int i, const What& what) {
  if (const auto* pose = to<Pose>(L, i)) return *pose;
  if (lua_type(L, i) != LUA_TTABLE) fail_expected(what, "a pose", i);
  return pose_from_table(L, i, what.text());
}

}  // namespace clench
