#include "clench/script/bind/bind.h"

#include "clench/script/bind/library.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"

namespace clench {

static void add_entries(lua_State* L, const char* kind, std::span<const Entry> entries) {
  push_list_of(L, entries, [L](const Entry& entry) {
    push_list(L, 0, 4);
    set_field(L, "name", entry.name);
    lua_pushlightuserdata(L, const_cast<Entry*>(&entry));
    lua_setfield(L, -2, "id");
    set_field(L, "doc", entry.doc);
    set_field(L, "settable", entry.setter != nullptr);
  });
  lua_setfield(L, -2, kind);
}

static int entries(lua_State* L) {
  push_list(L, 0, 2);
  push_list_of(L, all_libraries(), [L](const Library* library) {
    push_list(L, 0, 4);
    set_field(L, "name", library->name);
    set_field(L, "doc", library->doc);
    add_entries(L, "functions", library->functions);
    add_entries(L, "fields", library->fields);
  });
  lua_setfield(L, -2, "libraries");
  push_list_of(L, all_classes(), [L](const Class* kind) {
    push_list(L, 0, 7);
    set_field(L, "name", kind->name);
    set_field(L, "variable", kind->variable);
    set_field(L, "doc", kind->doc);
    if (kind->parent) set_field(L, "parent", kind->parent->name);
    add_entries(L, "fields", kind->fields);
    add_entries(L, "methods", kind->methods);
    add_entries(L, "operators", kind->operators);
  });
  lua_setfield(L, -2, "classes");
  push_list_of(L, packed_files(), [L](const PackedFile& file) {
    push_list(L, 0, 2);
    set_field(L, "path", file.path);
    set_field(L, "text", file.text);
  });
  lua_setfield(L, -2, "files");
  return 1;
}

static const Entry entries_functions[] = {
    {"entries", guarded<entries>, R"(
The module about itself: each library and class with its functions, fields and methods, each with name, doc and `id`, the first upvalue of its function; and the files of the standard library. Documentation, completion and help are made from it.
@return {libraries: table[], classes: table[], files: table[]}
> clench.entries().libraries[1].name  --> clench)"},
};

const Library entries_library{.name = "clench", .doc = "", .functions = entries_functions};

}  // namespace clench
