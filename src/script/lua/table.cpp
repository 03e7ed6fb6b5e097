#include "clench/script/lua/table.h"

#include <algorithm>
#include <cmath>

#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

// Rejects numbers beyond the range of their option.
static void check_ranges(lua_State* L, int index, std::span<const DescribedOption> options,
                         const std::string& subject) {
  for (const DescribedOption& option : options) {
    if (!option.min && !option.max) continue;
    lua_pushstring(L, option.name.c_str());
    lua_rawget(L, index);
    const bool is_number = lua_type(L, -1) == LUA_TNUMBER;
    const double x = is_number ? lua_tonumber(L, -1) : 0;
    lua_pop(L, 1);
    // what is not finite is refused by its reader
    if (is_number && std::isfinite(x) && !option.holds(x))
      fail("{}: {} must be {}, got {}", subject, option.name, option.range(), x);
  }
}

Table::Table(lua_State* L, int index, std::string subject)
    : L_(L), index_(0), subject_(subject.empty() ? clench::subject(L) : std::move(subject)) {
  if (lua_isnoneornil(L, index)) return;
  if (lua_type(L, index) != LUA_TTABLE)
    fail_expected({L, subject_, ""}, "a table of options", index);
  if (!lua_checkstack(L_, 4)) fail(ErrorKind::limit, "{}: too many values on the stack", subject_);
  index_ = lua_absindex(L, index);
  described_ = described_options(L, index_, subject_);
  check_ranges(L, index_, described_, subject_);
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

int Table::type(const char* key) {
  const int type = push(key);
  lua_pop(L_, 1);
  return type;
}

bool Table::has(const char* key) { return type(key) != LUA_TNIL; }

template <class T>
T Table::required(const char* key) {
  push_required(key);
  T value = read_as<T>(L_, -1, what(key));
  lua_pop(L_, 1);
  return value;
}

double Table::number(const char* key) { return required<double>(key); }
double Table::number(const char* key, double fallback) { return has(key) ? number(key) : fallback; }

int Table::integer(const char* key) { return required<int>(key); }
int Table::integer(const char* key, int fallback) { return has(key) ? integer(key) : fallback; }

uint64_t Table::seed(const char* key, uint64_t fallback) {
  if (!has(key)) return fallback;
  push(key);
  const auto n = static_cast<uint64_t>(read_integer(L_, -1, what(key)));
  lua_pop(L_, 1);
  return n;
}

bool Table::boolean(const char* key, bool fallback) {
  return has(key) ? required<bool>(key) : fallback;
}

std::string Table::string(const char* key) { return required<std::string>(key); }
std::string Table::string(const char* key, const std::string& fallback) {
  return has(key) ? string(key) : fallback;
}

size_t Table::place_of_word(const char* key, const std::vector<std::string>& words) {
  const std::string name = string(key);
  const auto found = std::find(words.begin(), words.end(), name);
  if (found == words.end())
    fail("{}: unknown {} {}, expected one of {}{}", subject_, key, in_quotes(name),
         name_list(words), did_you_mean(name, words));
  return static_cast<size_t>(found - words.begin());
}

Eigen::Vector3d Table::vec3(const char* key) { return required<Eigen::Vector3d>(key); }
Eigen::Vector3d Table::vec3(const char* key, const Eigen::Vector3d& fallback) {
  return has(key) ? vec3(key) : fallback;
}

Pose Table::pose(const char* key) { return required<Pose>(key); }
Pose Table::pose(const char* key, const Pose& fallback) { return has(key) ? pose(key) : fallback; }

std::vector<double> Table::numbers(const char* key, int count) {
  push(key);
  auto list = read_numbers(L_, -1, what(key), count);
  lua_pop(L_, 1);
  return list;
}

Eigen::VectorXd Table::vector(const char* key, int count) { return vector_of(numbers(key, count)); }

Eigen::Matrix<double, 6, Eigen::Dynamic> Table::wrenches(const char* key) {
  return columns_of(rows(key, 6));
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

// An option that the doc does not describe is a mistake in the doc.
void Table::check_description() const {
  if (described_.empty()) return;
  for (const std::string& name : known_)
    if (std::ranges::find(described_, name, &DescribedOption::name) == described_.end())
      fail(ErrorKind::internal, "{}: option '{}' is not described", subject_, name);
}

void Table::done() {
  if (!index_) return;
  check_description();
  // the smallest unknown name, so that the message does not depend on the order of a hash table
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
