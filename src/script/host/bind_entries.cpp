#include "clench/script/host/library_list.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"

namespace clench {

static int push(lua_State* L, const Entry& entry) {
  return push_record(L, {{"name", entry.name},
                         {"id", [&] { lua_pushlightuserdata(L, const_cast<Entry*>(&entry)); }},
                         {"doc", entry.doc},
                         {"settable", entry.setter != nullptr}});
}

static int push(lua_State* L, const Library* library) {
  return push_record(L, {{"name", library->name},
                         {"doc", library->doc},
                         {"functions", library->functions},
                         {"fields", library->fields}});
}

static int push(lua_State* L, const Class* kind) {
  push_record(L, {{"name", kind->name},
                  {"variable", kind->variable},
                  {"doc", kind->doc},
                  {"fields", kind->fields},
                  {"methods", kind->methods},
                  {"operators", kind->operators}});
  if (kind->parent) set_field(L, "parent", kind->parent->name);
  return 1;
}

static int push(lua_State* L, const PackedFile& file) {
  return push_record(L, {{"path", file.path}, {"text", file.text}});
}

static int entries(lua_State* L) {
  return push_record(
      L, {{"libraries", all_libraries()}, {"classes", all_classes()}, {"files", packed_files()}});
}

static const Entry entries_functions[] = {
    {"entries", guarded<entries>, R"(
The contents of the module: each library and class with its functions, fields and methods, each with name, doc and `id`, the first upvalue of its function; and the files of the standard library. Documentation, completion and help are generated from it.
@return {libraries: table[], classes: table[], files: table[]}
@effect reads
> clench.entries().libraries[1].name  --> clench)"},
};

const Library entries_library{.name = "clench", .doc = "", .functions = entries_functions};

}  // namespace clench
