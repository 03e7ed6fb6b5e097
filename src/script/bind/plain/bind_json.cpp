#include <limits>

#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/json.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static int encode(lua_State* L) {
  Table t(L, 2);
  const int indent = t.integer("indent", 0);
  t.done();
  if (lua_isnone(L, 1)) fail_expected({L, {}, "value"}, "a value", 1);
  return push(L, write_json(L, 1, indent));
}

template <void (*Read)(lua_State*, std::string_view, size_t)>
static int parse(lua_State* L) {
  if (lua_type(L, 1) != LUA_TSTRING) fail_expected({L, {}, "text"}, "a string", 1);
  Table t(L, 2);
  const int max_values = t.integer("max_values", std::numeric_limits<int>::max());
  t.done();
  Read(L, string_at(L, 1), static_cast<size_t>(max_values));
  return 1;
}

static int null(lua_State* L) {
  push_json_null(L);
  return 1;
}

static const Entry json_functions[] = {
    {"encode", guarded<encode>, R"(
A value as JSON. Keys are sorted and numbers are preserved bit-exactly, so equal values give equal text; integers stay
integers. Poses and vectors are written too; functions, NaN and tables that contain themselves are rejected.
@param value any  plain data: nil, booleans, numbers, strings, lists and tables with names as keys
@param options? table  look
@option indent? integer [0 to 16] = 0  spaces per level; 0: all on one line
@return string
@effect reads
> clench.json.encode{name = "flask", mass = 0.3, size = {1, 2.0}}  --> {"mass":0.3,"name":"flask","size":[1,2.0]}
> clench.json.encode{at = clench.vec3(0, 0.5, 1)}  --> {"at":[0.0,0.5,1.0]}
> clench.json.encode{0 / 0}  --> error: value[1]: expected a finite number)"},
    {"decode", guarded<parse<read_json>>, R"(
The value of a JSON text. A null in a list is `clench.json.null`; in an object it is absent.
@param text string  JSON text
@param options? table  limits
@option max_values? integer [1 to 2147483647] = 2147483647  maximum number of values, at all levels
@return any
@effect reads
> clench.json.decode '{"links": [1, 2.5, null]}'.links  --> {1, 2.5, null}
> clench.json.decode '{"a": 1,}'  --> error: line 1, column 9: expected a name in double quotes, got '}'
> clench.json.decode('[1, [2, 3]]', {max_values = 4})  --> error: expected at most 4 values)"},
    {"split", guarded<parse<split_json>>, R"(
The items of a JSON list, or the values of an object by name, as JSON texts. Only strings and brackets in them are checked.
For long texts that are decoded in parts.
@param text string  JSON text
@param options? table  limits
@option max_values? integer [1 to 2147483647] = 2147483647  maximum number of items
@return table<any, string>
@effect reads
> parts = clench.json.split '{"id": null, "links": [1, "]"], "name": "a"}'
> parts.id, parts.links, parts.name  --> null, [1, "]"], "a"
> clench.json.split '[1, 2'  --> error: line 1, column 6: expected ',' or ']', got the end of the text)"},
};

static const Entry json_fields[] = {
    {"null", guarded<null>, R"(
The value that represents null in a list.
@type userdata
> clench.json.encode{1, clench.json.null}  --> [1,null])"},
};

const Library json_library{.name = "clench.json",
                           .doc = "Values as JSON text, and back.",
                           .functions = json_functions,
                           .fields = json_fields};

}  // namespace clench
