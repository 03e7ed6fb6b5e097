// Description of the engine for Lua: tables of name, function and doc.
//
// How to add a binding
//  1. A value or handle of scripts is a Class; functions belong to a Library. Each is one constant
//     in a bind_<noun>.cpp, in the folder of its kind, ends in tables of entries, is declared in
//     bind.h, and has one line in library.cpp. Several libraries may share a name: their entries
//     are merged.
//  2. A function is `static int f(lua_State* L)`, listed in its table as guarded<f> (guard.h). It
//     reads its arguments with check.h (positional) or a Table (options), calls the engine, and
//     returns push...(). Bad input throws clench::Error; guarded adds the script's line. Messages
//     begin with subject(L), "hand:autograsp", which is found automatically. Arguments beyond the
//     doc's `@param` lines have already been rejected. Values that one expression gets or sets use
//     getter<...> or setter<...> (getter.h).
//  3. A method begins with `auto& hand = self<RobotHandle>(L)` (object.h). script_class<T>
//     associates a C++ type with its Class; push(L, T{...}) creates a value of it, to<T> and
//     check_object<T> read one.
//  4. Nothing that can raise a Lua error may run while C++ objects with destructors are alive,
//     because a host's Lua may jump over them: no lua_error, luaL_check..., lua_gettable with
//     metamethods, lua_call. Use raw access, and protected_call (guard.h) for callbacks. (Pushing
//     raises errors only for lack of memory, and then leaks.)
//  5. The doc has one or two sentences for the reader, then LuaCATS lines, then running examples.
//     A field has `@type`; text after two spaces is prose, with the unit in brackets:
// clang-format off
//         Closes the fingers until contact stops them.
//         @param options? table  how it closes
//         @option speed? number [> 0] = 1  of all closing speeds
//         @return table result  `moved`, `stops`
//         > hand:autograsp().moved  --> true
// clang-format on
//     stdlib/signature/grammar.lua has the grammar of units, ranges, defaults and `@option` lines.
//     `> code` without an arrow prepares the next one. `--> error: text` expects an error that
//     contains text. Examples run with clench, world, hand (closed on the flask), flask, grasp and
//     patch (of a fingertip with the flask as rubber). The tests run every one of them; `clench
//     doc` writes docs/api from the same tables, and the REPL uses them for completion.
#pragma once
#include <lua.hpp>
#include <span>
#include <string>

namespace clench {

/// A function, method or field that scripts can use.
struct Entry {
  const char* name;
  lua_CFunction function;  ///< of a field: its getter, called with (self)
  const char* doc;
  lua_CFunction setter = nullptr;  ///< of a field that can be set: called with (self, value)
};

/// Functions and computed fields under a name, "clench" or "clench.json".
struct Library {
  const char* name;
  const char* doc;
  std::span<const Entry> functions;
  std::span<const Entry> fields = {};
};

/// Operations on userdata of one kind. Its address is its identity.
struct Class {
  const char* name;      ///< "robot"
  const char* variable;  ///< name in messages and examples: "hand"
  const char* doc;
  std::span<const Entry> fields = {};
  std::span<const Entry> methods = {};
  /// "__add", "__tostring"; "__index", "__newindex": keys that are no string
  std::span<const Entry> operators = {};
  const Class* parent = nullptr;  ///< class whose fields and methods are inherited
};

/// Upvalues of every closure of an entry: the entry, its class or library, and the number of
/// arguments that it takes; -1: any.
enum EntryUpvalue { at_entry = 1, at_class = 2, at_library = 3, at_max_arguments = 4 };

/// Number of `@param` lines of a function or method, self not included; -1 if one of them is `...`.
int max_arguments(const Entry& entry);

/// Name of the running entry, with which messages begin: "clench.rad", "hand:autograsp",
/// "hand.dofs".
std::string subject(lua_State* L);

/// The running method's class; null in a library's function.
const Class* running_class(lua_State* L);
const Entry* running_entry(lua_State* L);

}  // namespace clench
