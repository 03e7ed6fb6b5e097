#include "clench/script/lua/table.h"

#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

Table::Table(lua_State* L, int index, std::string subject)
    : L_(L), index_(0), subject_(subject.empty() ? clench::subject(L) : std::move(subject)) {
  if (lua_isnoneornil(L, index)) return;
  if (lua_type(L, index) != LUA_TTABLE)
    fail_expected({L, subject_, ""}, "a table of options", index);
  index_ = lua_absindex(L, index);
}

int Table::push(const char* key) {
  if (!lua_checkstack(L_, 4)) fail(ErrorKind::limit, "{}: too many values on the stack", subject_);
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  if (!index_) {
    lua_pushnil(L_);
    return LUA_TNIL;
  }
  lua_pushstring(L_, key);
  return lua_rawget(L_, index_);
}

void Table::push_required(const char* key) {
  if (push(key) != LUA_TNIL || !index_) return;
  for (lua_pushnil(L_); lua_next(L_, index_); lua_pop(L_, 1))
    if (lua_type(L_, -2) == LUA_TSTRING && !did_you_mean(string_at(L_, -2), {key}).empty())
      refuse(lua_absindex(L_, -2));
}

bool Table::has(const char* key) {
  const bool there = push(key) != LUA_TNIL;
  lua_pop(L_, 1);
  return there;
}

double Table::number(const char* key) {
  push_required(key);
  const double x = read_number(L_, -1, what(key));
  lua_pop(L_, 1);
  return x;
}

double Table::number(const char* key, double fallback) { return has(key) ? number(key) : fallback; }

double Table::positive(const char* key, double fallback) {
  const double x = number(key, fallback);
  if (!(x > 0)) fail("{}: {} must be > 0, got {}", subject_, key, x);
  return x;
}

int Table::integer(const char* key) {
  push_required(key);
  const int n = read_int(L_, -1, what(key));
  lua_pop(L_, 1);
  return n;
}

int Table::integer(const char* key, int fallback) { return has(key) ? integer(key) : fallback; }

uint64_t Table::seed(const char* key, uint64_t fallback) {
  if (!has(key)) return fallback;
  push(key);
  const auto n = static_cast<uint64_t>(read_integer(L_, -1, what(key)));
  lua_pop(L_, 1);
  return n;
}

bool Table::boolean(const char* key, bool fallback) {
  if (!has(key)) return fallback;
  push(key);
  const bool b = read_boolean(L_, -1, what(key));
  lua_pop(L_, 1);
  return b;
}

std::string Table::string(const char* key) {
  push_required(key);
  std::string text = read_string(L_, -1, what(key));
  lua_pop(L_, 1);
  return text;
}

std::string Table::string(const char* key, const std::string& fallback) {
  return has(key) ? string(key) : fallback;
}

std::string Table::choice(const char* key, const std::vector<std::string>& names,
                          const std::string& fallback) {
  const std::string name = string(key, fallback);
  if (std::find(names.begin(), names.end(), name) == names.end())
    fail("{}: unknown {} {}, expected one of {}{}", subject_, key, in_quotes(name),
         name_list(names), did_you_mean(name, names));
  return name;
}

Eigen::Vector3d Table::vec3(const char* key) {
  push_required(key);
  const Eigen::Vector3d v = read_vec3(L_, -1, what(key));
  lua_pop(L_, 1);
  return v;
}

Eigen::Vector3d Table::vec3(const char* key, const Eigen::Vector3d& fallback) {
  return has(key) ? vec3(key) : fallback;
}

Pose Table::pose(const char* key) {
  push_required(key);
  const Pose pose = read_pose(L_, -1, what(key));
  lua_pop(L_, 1);
  return pose;
}

Pose Table::pose(const char* key, const Pose& fallback) { return has(key) ? pose(key) : fallback; }

std::vector<double> Table::numbers(const char* key, int count) {
  push(key);
  auto list = read_numbers(L_, -1, what(key), count);
  lua_pop(L_, 1);
  return list;
}

std::vector<std::vector<double>> Table::rows(const char* key, int columns) {
  push(key);
  auto list = read_rows(L_, -1, what(key), columns);
  lua_pop(L_, 1);
  return list;
}

bool Table::push_function(const char* key) {
  const int type = push(key);
  if (type != LUA_TNIL && type != LUA_TFUNCTION) fail_expected(what(key), "a function", -1);
  return type == LUA_TFUNCTION;
}

void Table::refuse(int key) const {
  if (lua_type(L_, key) != LUA_TSTRING) fail("{}: unknown key [{}]", subject_, described(L_, key));
  const std::string name(string_at(L_, key));
  fail("{}: unknown key {}{}", subject_, described(L_, key), instead_of(name, known_));
}

void Table::done() {
  if (!index_) return;
  // the least unknown name, so that the message does not hang on the order of a hash table
  std::string unknown;
  for (lua_pushnil(L_); lua_next(L_, index_); lua_pop(L_, 1)) {
    if (lua_type(L_, -2) != LUA_TSTRING) refuse(lua_absindex(L_, -2));
    const std::string name(string_at(L_, -2));
    if (std::find(known_.begin(), known_.end(), name) == known_.end() &&
        (unknown.empty() || name < unknown))
      unknown = name;
  }
  if (unknown.empty()) return;
  lua_pushlstring(L_, unknown.data(), unknown.size());
  refuse(lua_absindex(L_, -1));
}

}  // namespace clench
