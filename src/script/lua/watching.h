// Who watches the long calls of a script: Ctrl-C stops them, a terminal shows how far they are.
#pragma once
#include <lua.hpp>

#include "clench/base/progress.h"

namespace clench {

/// Shows a bar on stderr when that is a terminal, for work of more than half a second.
class Bar : public Watcher {
 public:
  Bar();
  /// Of the engine's work; not while a script shows its own.
  void show(double fraction, std::string_view text) override;
  void show_script(double fraction, std::string_view text) { draw(fraction, text); }

  /// Work begins, and ends: the outermost takes the bar away.
  void begin();
  void end();
  void begin_script() { begin(), ++scripts_; }
  void end_script() { --scripts_, end(); }

 private:
  void draw(double fraction, std::string_view text);

  bool terminal_;
  int depth_ = 0, scripts_ = 0;
  double began_ = 0, last_ = 0;  // [s]
  bool drawn_ = false;
};

/// The state's, made when it is first asked for.
const std::shared_ptr<Bar>& bar_of(lua_State* L);

/// What a call that may take long is watched by, as long as this lives.
class Watching {
 public:
  explicit Watching(lua_State* L);
  ~Watching() { bar_->end(); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;
  const Progress& progress() const { return progress_; }

 private:
  std::shared_ptr<Bar> bar_;
  Progress progress_;
};

}  // namespace clench
