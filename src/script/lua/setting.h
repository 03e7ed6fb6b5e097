// Text settings of a Lua state, "" until they are set.
#pragma once
#include <string>

struct lua_State;

namespace clench {

enum class Setting {
  modules,      ///< the folder of the running script: require searches it for the user's modules
  confine,      ///< the folder below which files are read, unless a call names another
  worker_nice,  ///< niceness of threads for jobs and clench.parallel.map, 0 to 19
};

std::string get_setting(lua_State* L, Setting setting);
/// Pushes it.
void push_setting(lua_State* L, Setting setting);
void set_setting(lua_State* L, Setting setting, const std::string& text);

/// Replaces a setting during its lifetime.
class ScopedSetting {
 public:
  ScopedSetting(lua_State* L, Setting setting, const std::string& text);
  ~ScopedSetting() { set_setting(L_, setting_, before_); }
  ScopedSetting(const ScopedSetting&) = delete;
  ScopedSetting& operator=(const ScopedSetting&) = delete;

 private:
  lua_State* L_;
  Setting setting_;
  std::string before_;
};

}  // namespace clench
