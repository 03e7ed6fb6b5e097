// A Lua of one's own, with clench in it: what the command runs scripts in. Every call is protected;
// a script can neither end the process by an error nor take all of the machine's memory.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct lua_Debug;
struct lua_State;

namespace clench {

class Bar;

class State {
 public:
  struct Result {
    bool ok = true;
    std::string error;                ///< message and traceback
    std::vector<std::string> values;  ///< what was returned, as text
  };
  enum class Line { done, incomplete, failed };

  /// memory  that its scripts may have [bytes]; 0: three quarters of the machine's
  /// throws  Error when there is no memory
  explicit State(size_t memory = 0);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// From now on require looks for the user's modules in the folder of this file first; until then
  /// in none.
  void set_script(const std::string& path);
  /// Runs a file, "-" for stdin, as the script, with the global `arg` and `...` as the command's
  /// arguments.
  Result run_file(const std::string& path, const std::vector<std::string>& arguments);
  /// Runs a chunk that messages call by its name.
  Result run_code(const std::string& code, const std::string& name);
  /// Runs a console's input: an expression, "=expression" or statements; prints the results to
  /// stdout and errors to stderr. incomplete: it is the beginning of something.
  /// line: what messages call the first of its lines
  Line evaluate(const std::string& text, int line = 1);
  /// Calls a function of the packed standard library, in its module's table, with strings.
  Result call(const std::string& module, const std::string& function,
              const std::vector<std::string>& arguments);

  /// From now on os.exit ends nothing but is an error. The first sentence of these is put into
  /// `asked`, which outlives the state, for a script may hide the error.
  void refuse_exit(std::string& asked);
  /// From now on files are read only below this folder, unless a call names another.
  /// throws Error when it is no folder
  void set_confine(const std::string& folder);
  /// Messages below errors are not shown from now on.
  void set_quiet();
  lua_State* lua() { return L_; }
  /// What scripts of this Lua may have, be it a State's or a host's [bytes].
  static size_t memory_of(lua_State* L);

  /// Makes the running chunk fail with "interrupted", coroutines too. What catches that error has
  /// half a second to end; then, or when called again, nothing can catch it. May be called from a
  /// signal handler.
  void interrupt();

  /// For a state in a thread of its own: from now on it looks by itself whether `end` was called.
  void look_for_end();
  /// Makes the running chunk fail with "stopped", uncatchably. May be called from any thread.
  void end();
  /// Holds the running chunk, of a state that looks for its end, at its next instruction until
  /// `resume` or `end` is called. May be called from any thread.
  void pause() { paused_ = true; }
  void resume();
  /// Is the State of this Lua to be held? False for a Lua of a host.
  static bool is_paused(lua_State* L);
  /// Called in the state's own thread: with true before the running chunk is held by `pause`, with
  /// false before it continues. Must not throw; set before anything runs.
  void on_hold(std::function<void(bool)> call) { on_hold_ = std::move(call); }

 private:
  struct Memory {
    size_t used = 0, limit = 0;
    bool quiet = false;
    std::string warning;
  };
  // of the first three the state is the user data
  static void* allocate(void* state, void* block, size_t old_size, size_t new_size);
  static void warn(void* state, const char* text, int to_be_continued);
  static void on_hook(lua_State* L, lua_Debug*);
  static void on_count(lua_State* L, lua_Debug*);
  static int track(lua_State* L);

  void set_arguments(const std::string& path, const std::vector<std::string>& arguments);
  Result run_loaded(int status, const std::vector<std::string>& arguments);
  Result finish(int status, int base);

  Memory memory_;
  lua_State* L_ = nullptr;
  std::shared_ptr<Bar> bar_;                   // what watches the engine
  std::atomic<lua_State*> running_ = nullptr;  // the coroutine that runs, for interrupt
  std::atomic<int> interrupts_ = 0;            // since a run began
  std::atomic<bool> ended_ = false, paused_ = false;
  std::function<void(bool)> on_hold_;
  void hold();
  std::atomic<double> patient_until_ = 0;  // then an interruption can no longer be caught [s]
};

}  // namespace clench
