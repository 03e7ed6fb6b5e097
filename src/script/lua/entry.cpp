#include "clench/script/lua/entry.h"

#include <cstring>
#include <string_view>

namespace clench {

int max_arguments(const Entry& entry) {
  constexpr std::string_view mark = "\n@param ";
  const std::string_view doc = entry.doc;
  int count = 0;
  for (size_t at = doc.find(mark); at != doc.npos; at = doc.find(mark, at + 1), ++count)
    if (doc.substr(at + mark.size()).starts_with("...")) return -1;
  return count;
}

const Entry* running_entry(lua_State* L) {
  return static_cast<const Entry*>(lua_touserdata(L, lua_upvalueindex(at_entry)));
}

const Class* running_class(lua_State* L) {
  return static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(at_class)));
}

static bool is_field(const Class* kind, const Entry* entry) {
  for (; kind; kind = kind->parent)
    for (const Entry& field : kind->fields)
      if (&field == entry) return true;
  return false;
}

std::string subject(lua_State* L) {
  const Entry* entry = running_entry(L);
  if (!entry) return "clench";
  if (const Class* kind = running_class(L)) {
    if (!std::strncmp(entry->name, "__", 2)) return kind->name;
    return std::string(kind->variable) + (is_field(kind, entry) ? "." : ":") + entry->name;
  }
  const auto* library =
      static_cast<const Library*>(lua_touserdata(L, lua_upvalueindex(at_library)));
  return library ? std::string(library->name) + "." + entry->name : entry->name;
}

}  // namespace clench
