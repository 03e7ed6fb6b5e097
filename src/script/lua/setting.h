// Texts that a state keeps for whoever runs it, "" until they are set.
#pragma once
#include <string>

struct lua_State;

namespace clench {

enum class Setting {
  modules,      ///< the folder of the script that runs: require looks in it for the user's modules
  confine,      ///< the folder below which files are read, where a call does not name another
  worker_nice,  ///< niceness of threads for jobs and clench.parallel.map, 0 to 19
};

std::string get_setting(lua_State* L, Setting setting);
/// Leaves it on the stack.
void push_setting(lua_State* L, Setting setting);
void set_setting(lua_State* L, Setting setting, const std::string& text);

/// Another text as long as it lives.
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
