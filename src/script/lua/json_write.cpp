#include <algorithm>
#include <cmath>
#include <vector>

#include "clench/base/printable.h"
#include "clench/base/text.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/json.h"
#include "clench/script/lua/read.h"
#include "clench/script/lua/stack.h"

namespace clench {

namespace {

class Writer {
 public:
  Writer(lua_State* L, int indent) : L_(L), indent_(indent) {}

  void value(int index, int depth) {
    if (!lua_checkstack(L_, 8)) refuse("fewer values on Lua's stack");
    switch (lua_type(L_, index)) {
      case LUA_TBOOLEAN:
        out += lua_toboolean(L_, index) ? "true" : "false";
        break;
      case LUA_TNUMBER:
        number(index);
        break;
      case LUA_TSTRING:
        string(string_at(L_, index));
        break;
      case LUA_TTABLE:
      case LUA_TUSERDATA:
      case LUA_TLIGHTUSERDATA:
        compound(lua_absindex(L_, index), depth);
        break;
      default:
        refuse("a number, string, boolean, table or clench value", index);
    }
  }

  std::string out;

 private:
  // ".links[2]": of the value that is being written
  std::string path() const {
    std::string text;
    for (const Step& step : steps_)
      text += step.item ? fmt::format("[{}]", step.item) : '.' + std::string(step.name);
    return text;
  }

  [[noreturn]] void refuse(const std::string& expected, int index = 0) const {
    fail("clench.json.encode: value{}: expected {}{}", path(), expected,
         index ? ", got " + described(L_, index) : "");
  }

  void number(int index) {
    if (lua_isinteger(L_, index)) {
      fmt::format_to(std::back_inserter(out), "{}", lua_tointeger(L_, index));
      return;
    }
    const double x = lua_tonumber(L_, index);
    if (!std::isfinite(x)) refuse("a finite number", index);
    // the shortest digits, at most 17, that read back bit-exactly; floats remain floats
    const size_t start = out.size();
    fmt::format_to(std::back_inserter(out), "{}", x);
    if (out.find_first_of(".e", start) == std::string::npos) out += ".0";
  }

  // number of letters at the beginning that are written as they are
  static size_t plain_size(std::string_view text) {
    const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7F && c != '"' && c != '\\'; };
    return static_cast<size_t>(std::ranges::find_if_not(text, is_plain) - text.begin());
  }

  void string(std::string_view text) {
    out += '"';
    for (size_t i = 0; i < text.size();) {
      const size_t plain = plain_size(text.substr(i));
      out += text.substr(i, plain);
      i += plain;
      if (i == text.size()) break;
      const size_t size = utf8_size(text, i);
      if (!size)
        refuse(fmt::format("text in UTF-8, got the byte {}", static_cast<unsigned char>(text[i])));
      const char c = text[i];
      const size_t short_form = std::string_view("\"\\\b\f\n\r\t").find(c);
      if (size == 1 && short_form != std::string_view::npos) {
        out += '\\';
        out += "\"\\bfnrt"[short_form];
      } else if (size == 1 && (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)) {
        out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
      } else if (control_size(text, i)) {
        out += fmt::format("\\u{:04x}", static_cast<uint32_t>(letters_of(text.substr(i, size))[0]));
      } else {
        out += text.substr(i, size);
      }
      i += size;
    }
    out += '"';
  }

  bool is_null(int index) {
    if (lua_type(L_, index) != LUA_TUSERDATA) return false;
    push_json_null(L_);
    const bool null = lua_rawequal(L_, -1, index);
    lua_pop(L_, 1);
    return null;
  }

  void compound(int index, int depth) {
    if (is_null(index)) {
      out += "null";
      return;
    }
    if (depth >= json_depth) refuse(fmt::format("at most {} levels of tables", json_depth));
    if (luaL_getmetafield(L_, index, "__json") != LUA_TNIL) {
      lua_pushvalue(L_, index);
      call_script(L_, 1, 1, fmt::format("clench.json.encode: value{}: __json", path()));
      if (++conversions_ > json_depth) refuse("a finite chain of __json values");
      value(-1, depth);
      --conversions_;
      lua_pop(L_, 1);
      return;
    }
    if (lua_type(L_, index) != LUA_TTABLE) refuse("a value that JSON can hold", index);
    const void* self = lua_topointer(L_, index);
    if (std::find(open_.begin(), open_.end(), self) != open_.end())
      refuse("no table within itself");
    open_.push_back(self);
    table(index, depth);
    open_.pop_back();
  }

  // keys must be either all names, or 1..n
  void table(int index, int depth) {
    std::vector<std::string> names;
    const auto size = static_cast<lua_Integer>(lua_rawlen(L_, index));
    lua_Integer items = 0;
    for (lua_pushnil(L_); lua_next(L_, index); lua_pop(L_, 1)) {
      if (lua_type(L_, -2) == LUA_TSTRING) {
        names.emplace_back(string_at(L_, -2));
      } else if (lua_isinteger(L_, -2) && lua_tointeger(L_, -2) >= 1 &&
                 lua_tointeger(L_, -2) <= size) {
        ++items;
      } else {
        refuse("names, or items 1..n without holes, got the key " + described(L_, -2));
      }
    }
    if (items && !names.empty())
      refuse(fmt::format("a list or names, got both: {} items and the name '{}'", items, names[0]));
    if (items != size) refuse("items 1..n without holes");
    if (items || (names.empty() && luaL_getmetafield(L_, index, "__object") == LUA_TNIL))
      return list(index, size, depth);
    if (names.empty()) lua_pop(L_, 1);
    object(index, names, depth);
  }

  void list(int index, lua_Integer size, int depth) {
    out += '[';
    for (lua_Integer i = 1; i <= size; ++i) {
      separate(i == 1, depth + 1);
      lua_rawgeti(L_, index, i);
      steps_.push_back({.item = i});
      value(-1, depth + 1);
      steps_.pop_back();
      lua_pop(L_, 1);
    }
    close(size > 0, depth, ']');
  }

  void object(int index, std::vector<std::string>& names, int depth) {
    std::sort(names.begin(), names.end());
    out += '{';
    for (size_t i = 0; i < names.size(); ++i) {
      separate(i == 0, depth + 1);
      steps_.push_back({.name = names[i]});
      string(names[i]);
      out += indent_ ? ": " : ":";
      lua_pushlstring(L_, names[i].data(), names[i].size());
      lua_rawget(L_, index);
      value(-1, depth + 1);
      steps_.pop_back();
      lua_pop(L_, 1);
    }
    close(!names.empty(), depth, '}');
  }

  void separate(bool first, int depth) {
    if (!first) out += ',';
    if (indent_) out += '\n' + std::string(static_cast<size_t>(indent_ * depth), ' ');
  }

  void close(bool any, int depth, char bracket) {
    if (any && indent_) out += '\n' + std::string(static_cast<size_t>(indent_ * depth), ' ');
    out += bracket;
  }

  // from a table to a value in it
  struct Step {
    lua_Integer item = 0;   // of a list; 0: the value has a name
    std::string_view name;  // valid while the object is written
  };

  lua_State* L_;
  int indent_;
  int conversions_ = 0;  // chain of values returned by __json
  std::vector<Step> steps_;
  std::vector<const void*> open_;
};

}  // namespace

std::string write_json(lua_State* L, int index, int indent) {
  Writer writer(L, indent);
  writer.value(lua_absindex(L, index), 0);
  return std::move(writer.out);
}

}  // namespace clench
