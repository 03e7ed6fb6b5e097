// Watches the long calls of a script: Ctrl-C and time limits stop them, and a terminal shows their
// progress.
#pragma once
#include <atomic>
#include <lua.hpp>
#include <mutex>
#include <optional>
#include <string_view>

#include "clench/base/progress.h"

namespace clench {

/// Shows a bar on stderr if that is a terminal, for work of more than half a second.
class Bar : public Watcher {
 public:
  Bar();
  /// Stores the progress of a script's own loop; meanwhile that of the engine is not displayed.
  void note_script(double fraction, std::string_view text);
  /// The progress of the script's own loop if there is one, otherwise that of the engine. May be
  /// called from any thread.
  State shown() const;
  /// Stops displaying; for states in other threads.
  void hide() { terminal_ = false; }

  /// Start and end of work: the end of the outermost work removes the bar.
  void begin();
  void end();
  void begin_script();
  void end_script();

  /// Requests a stop as Ctrl-C does. May be called in a signal handler.
  void interrupt() { interrupted_ = true, stop(); }
  /// Requests a stop at the end of a time limit. Any thread may call it.
  void end_time() { out_of_time_ = true, stop(); }
  /// Requests a stop that cannot be withdrawn. Any thread may call it.
  void stop_for_good() { stopped_for_good_ = true, stop(); }
  /// Withdraws a request of end_time(), and leaves those of the others.
  /// returns  true if there was one
  bool take_end_of_time();
  /// Withdraws all requests, except stop_for_good().
  /// returns  true if there was one
  bool take_all();

 private:
  void show(double fraction, std::string_view text) override;
  void draw(double fraction, std::string_view text);

  bool terminal_;
  int depth_ = 0, scripts_ = 0;
  double began_ = 0, last_ = 0;  // [s]
  bool drawn_ = false, in_script_ = false;
  mutable std::mutex mutex_;
  std::optional<State> script_;  // progress of the script's loops; guarded by mutex_
  std::atomic<bool> interrupted_ = false, out_of_time_ = false, stopped_for_good_ = false;
};

/// Writes lines to stderr, in place of a visible bar, which is drawn again below them. Any thread
/// may call it.
void write_above_bar(std::string_view lines);

/// The bar of the state, created on first use.
const std::shared_ptr<Bar>& bar_of(lua_State* L);

/// Watches a long call during its lifetime.
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
