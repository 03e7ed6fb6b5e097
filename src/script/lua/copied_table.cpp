#include "clench/script/lua/copied_table.h"

#include <cctype>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "clench/base/error.h"
#include "clench/script/lua/stack.h"

namespace clench {

static const char texts_key = 0, lines_key = 0;  // their addresses are registry keys of tables

// pushes a registry table, created if missing: texts by chunk name, or lines by function, with weak
// keys
static void push_registered(lua_State* L, const char* key, const char* mode) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, key) == LUA_TTABLE) return;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_newtable(L);
  lua_pushstring(L, mode);
  lua_setfield(L, -2, "__mode");
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

void keep_chunk_text(lua_State* L, const char* text, size_t size, const char* name) {
  constexpr size_t longest = 100'000;  // longer texts are not typed by hand
  if (!name || name[0] != '=' || size > longest) return;
  push_registered(L, &texts_key, "");
  lua_pushlstring(L, text, size);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
}

static std::string chunk_text(lua_State* L, const lua_Debug& at) {
  constexpr std::streamsize longest = 10'000'000;
  if (at.source[0] == '@') {
    std::ifstream file(at.source + 1, std::ios::binary);
    std::string text(longest, '\0');
    file.read(text.data(), longest);
    text.resize(static_cast<size_t>(file.gcount()));
    return text;
  }
  if (at.source[0] != '=') return {at.source, at.srclen};
  push_registered(L, &texts_key, "");
  std::string text;
  if (lua_getfield(L, -1, at.source) == LUA_TSTRING) text = string_at(L, -1);
  lua_pop(L, 2);
  return text;
}

static size_t behind_blanks(std::string_view text, size_t i) {
  const size_t next = text.find_first_not_of(" \t", i);
  return next == std::string_view::npos ? text.size() : next;
}

static bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

// Is there an assignment, '=' and not '==', at i?
static bool assigns(std::string_view text, size_t i) {
  return i < text.size() && text[i] == '=' && text.substr(i, 2) != "==";
}

// Does a name or index that belongs to something end before i: ".name" or "]"?
static bool ends_part(std::string_view line, size_t i) {
  while (i > 0 && (line[i - 1] == ' ' || line[i - 1] == '\t')) --i;
  if (i > 0 && line[i - 1] == ']') return true;
  while (i > 0 && continues_name(line[i - 1])) --i;
  return i > 0 && line[i - 1] == '.';
}

// Does a line contain an assignment to a part of something?
static bool assigns_part(std::string_view line) {
  for (size_t i = line.find('='); i != std::string_view::npos; i = line.find('=', i + 2))
    if (assigns(line, i) && ends_part(line, i)) return true;
  return false;
}

// position after the bracket that closes the one at i
static size_t behind_bracket(std::string_view line, size_t i) {
  int depth = 0;
  for (; i < line.size(); ++i) {
    depth += (line[i] == '[') - (line[i] == ']');
    if (depth == 0) return i + 1;
  }
  return i;
}

// position after "[...]" or ".name" at i; i itself if there is neither
static size_t behind_index(std::string_view line, size_t i) {
  if (i < line.size() && line[i] == '[') return behind_bracket(line, i);
  if (i + 1 >= line.size() || line[i] != '.' || line[i + 1] == '.') return i;
  for (++i; i < line.size() && continues_name(line[i]);) ++i;
  return i;
}

// "world.robots[1]" of a line whose ".dofs" is at i
static std::string_view owner_before(std::string_view line, size_t i) {
  size_t first = i;
  const auto belongs = [](char c) { return continues_name(c) || std::strchr(".:[]", c); };
  while (first > 0 && belongs(line[first - 1])) --first;
  return line.substr(first, i - first);
}

// Number of indices between ".key" and an assignment: 1 in ".key[2] = 3"; 0 without an assignment,
// or if the line reads fields of that name of several owners.
static int indices_assigned(std::string_view line, std::string_view key) {
  line = line.substr(0, line.find("--"));
  int indices = 0;
  std::string_view owner;
  for (size_t i = line.find(key); i != std::string_view::npos; i = line.find(key, i + 1)) {
    size_t at = i + key.size();
    if (i == 0 || line[i - 1] != '.' || (at < line.size() && continues_name(line[at]))) continue;
    const std::string_view owner_here = owner_before(line, i);
    if (!owner.empty() && owner_here != owner) return 0;
    owner = owner_here;
    int count = 0;
    for (at = behind_blanks(line, at);; ++count) {
      const size_t next = behind_blanks(line, behind_index(line, at));
      if (next == at) break;
      at = next;
    }
    if (count > 0 && assigns(line, at)) indices = count;
  }
  return indices;
}

// Is the value on top a table of values, and, for several indices, one of such tables?
static bool is_plain(lua_State* L, int indices) {
  if (!lua_istable(L, -1)) return false;
  if (luaL_getmetafield(L, -1, "__index") != LUA_TNIL) return false;
  if (indices == 1) return true;
  lua_pushnil(L);
  return lua_next(L, -2) && is_plain(L, indices - 1);
}

// Pushes the lines of a function that assign to a part of a table, by number; false without any.
static void push_assignments(lua_State* L, const lua_Debug& at) {
  std::istringstream text(chunk_text(L, at));
  std::string line;
  lua_newtable(L);
  bool any = false;
  for (int number = 1; std::getline(text, line); ++number) {
    if (number < at.linedefined || !assigns_part(line)) continue;
    if (at.lastlinedefined > 0 && number > at.lastlinedefined) break;
    lua_pushlstring(L, line.data(), line.size());
    lua_rawseti(L, -2, number);
    any = true;
  }
  if (any) return;
  lua_pop(L, 1);
  lua_pushboolean(L, false);
}

// the same, computed once for each function of a file
static void push_known_assignments(lua_State* L, const lua_Debug& at, int function) {
  if (at.source[0] == '=') return push_assignments(L, at);
  push_registered(L, &lines_key, "k");
  lua_pushvalue(L, function);
  if (lua_rawget(L, -2) == LUA_TNIL) {
    lua_pop(L, 1);
    push_assignments(L, at);
    lua_pushvalue(L, function);
    lua_pushvalue(L, -2);
    lua_rawset(L, -4);
  }
  lua_remove(L, -2);
}

void check_part_not_assigned(lua_State* L, const char* owner, const char* key) {
  lua_Debug at;
  if (!lua_getstack(L, 1, &at)) return;
  const int top = lua_gettop(L);
  luaL_checkstack(L, 8, nullptr);
  lua_getinfo(L, "Slf", &at);
  if (at.currentline > 0) {
    push_known_assignments(L, at, top + 1);
    int count = 0;
    if (lua_istable(L, -1) && lua_rawgeti(L, -1, at.currentline) == LUA_TSTRING)
      count = indices_assigned(string_at(L, -1), key);
    lua_pushvalue(L, top);
    if (count > 0 && is_plain(L, count))
      fail(
          "{0}.{1} is a copy, and an assignment to a part of it has no effect; change the copy and "
          "assign the whole: local copy = {0}.{1}; copy[1] = ...; {0}.{1} = copy",
          owner, key);
  }
  lua_settop(L, top);
}

}  // namespace clench
