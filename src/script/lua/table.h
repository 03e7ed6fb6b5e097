// The options of a call: one Lua table, read key by key, where a key that nobody read is an error.
#pragma once
#include <string>
#include <vector>

#include "clench/script/lua/check.h"

namespace clench {

/// Messages: "hand:autograsp: speed: expected a number, got 'fast'",
/// "hand:autograsp: unknown key 'sped'; did you mean 'speed'?".
class Table {
 public:
  /// The table at the index, which must stay on the stack; nothing or nil is the empty table.
  /// subject  default: the entry that runs
  /// throws   Error "...: expected a table of options, got 3"
  Table(lua_State* L, int index, std::string subject = "");

  bool has(const char* key);
  double number(const char* key);
  double number(const char* key, double fallback);
  double positive(const char* key, double fallback);  ///< > 0
  int integer(const char* key);
  int integer(const char* key, int fallback);
  uint64_t seed(const char* key, uint64_t fallback);  ///< any Lua integer
  bool boolean(const char* key, bool fallback);
  std::string string(const char* key);
  std::string string(const char* key, const std::string& fallback);
  /// one of the names
  /// throws  Error "...: unknown norm 'L3'; did you mean 'L1'?"
  std::string choice(const char* key, const std::vector<std::string>& names,
                     const std::string& fallback);
  Eigen::Vector3d vec3(const char* key);
  Eigen::Vector3d vec3(const char* key, const Eigen::Vector3d& fallback);
  Pose pose(const char* key);
  Pose pose(const char* key, const Pose& fallback);
  std::vector<double> numbers(const char* key, int count = -1);
  std::vector<std::vector<double>> rows(const char* key, int columns = -1);
  /// a userdata, or null when the key is absent
  template <class T>
  T* object(const char* key);
  /// Leaves a function, or nil when absent, on the stack.
  /// returns  whether there is one
  bool push_function(const char* key);
  /// Leaves whatever the key holds on the stack, for what has no reader here.
  /// returns  its type
  int push(const char* key);

  lua_State* state() const { return L_; }
  What what(const char* key) const { return {L_, subject_, key}; }
  const std::string& subject() const { return subject_; }

  /// throws Error for a key that was not asked for; call it last
  void done();

 private:
  [[noreturn]] void refuse(int key) const;
  /// throws Error when the key is absent, and one that nobody asked for reads nearly like it
  void push_required(const char* key);

  lua_State* L_;
  int index_;  // 0: no table
  std::string subject_;
  std::vector<std::string> known_;
};

template <class T>
T* Table::object(const char* key) {
  T* found = nullptr;
  if (push(key) != LUA_TNIL) {
    found = to<T>(L_, -1);
    if (!found) fail_object(what(key), class_of<T>(), -1);
  }
  lua_pop(L_, 1);  // the table keeps it alive
  return found;
}

}  // namespace clench
