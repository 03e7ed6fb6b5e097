// A separate Lua state with clench in it, in which the command runs scripts. Every call is
// protected; a script can neither end the process by an error nor exhaust the machine's memory.
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
class Deadline;

class State {
 public:
  struct Result {
    bool ok = true;
    std::string error;                ///< message and traceback
    std::vector<std::string> values;  ///< returned values, as text
  };
  enum class Line { done, incomplete, failed };

  /// memory  limit for its scripts [bytes]; 0: three quarters of the machine's
  /// throws  Error if there is no memory
  explicit State(size_t memory = 0);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// From now on require first searches the folder of this file for the user's modules; until then
  /// it searches no folder.
  void set_script(const std::string& path);
  /// Runs a file, "-" for stdin, as the script, with the global `arg` and `...` as the command's
  /// arguments.
  Result run_file(const std::string& path, const std::vector<std::string>& arguments);
  /// Runs a chunk under a name for messages.
  Result run_code(const std::string& code, const std::string& name);
  /// Runs a console's input: an expression, "=expression" or statements; prints the results to
  /// stdout and errors to stderr. incomplete: it is the beginning of a chunk. line: name of its
  /// first line in messages
  Line evaluate(const std::string& text, int line = 1);
  /// Calls a function of the packed standard library, in its module's table, with strings.
  Result call(const std::string& module, const std::string& function,
              const std::vector<std::string>& arguments);

  /// From now on os.exit raises an error instead of ending the program. The first such message is
  /// stored in `asked`, which must outlive the state, because a script may catch the error.
  void refuse_exit(std::string& asked);
  /// From now on files are read only below this folder, unless a call names another.
  /// throws Error if it is not a folder
  void set_confine(const std::string& folder);
  /// From now on only errors are logged.
  void set_quiet();
  lua_State* lua() { return L_; }
  /// Memory limit of the scripts of this Lua state, which may be a State or a host's [bytes].
  static size_t memory_of(lua_State* L);

  /// Makes the running chunk fail with "interrupted", including coroutines. Code that catches that
  /// error has half a second to end; after that, or at a second call, nothing can catch it. May be
  /// called from a signal handler.
  void interrupt();

  /// For a state in a separate thread: from now on it regularly checks whether `end` was called.
  void look_for_end();
  /// Makes the running chunk fail with an uncatchable "stopped". May be called from any thread.
  void end();
  /// Holds the running chunk, of a state that checks for its end, at its next instruction until
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
  // the user data of the first three is the state
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
  std::shared_ptr<Bar> bar_;                   // watches calls of the engine
  std::atomic<lua_State*> running_ = nullptr;  // the running coroutine, for interrupt
  std::atomic<int> interrupts_ = 0;            // start of the run
  std::atomic<bool> ended_ = false, paused_ = false;
  std::function<void(bool)> on_hold_;
  void hold();
  std::atomic<double> patient_until_ = 0;  // time after which an interruption cannot be caught [s]
  std::unique_ptr<Deadline> reminder_;     // interrupts calls of the engine again at that time
  void remind();
};

}  // namespace clench
