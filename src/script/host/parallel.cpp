// clench.parallel.map: calls a function for each item of a list, in as many Lua states as there are
// threads.
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/script/bind/parcel.h"
#include "clench/script/host/child_processes.h"
#include "clench/script/host/job_classes.h"
#include "clench/script/host/slots.h"
#include "clench/script/host/state.h"
#include "clench/script/host/worker.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/read.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/stack.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

namespace {

struct Outcome {
  Parcel value;
  WorkerError failure;
};

// work shared by the states
struct Task : WorkerTask {
  std::vector<Parcel> items;
  size_t memory = 0;  // limit of each state [bytes]
};

// --- in a worker's state: slot 1 of its stack is the function, slot 2 the shared value ---

struct Worker {
  Parcel shared;
  std::unique_ptr<State> state;  // null before and after its work
  int thread = 0;
  std::vector<std::pair<WorldPtr, std::shared_ptr<const Snapshot>>>
      moments;  // of the shared worlds
};

// (worker) -> shared
int unpack_shared(lua_State* L) {
  auto& worker = *static_cast<Worker*>(lua_touserdata(L, 1));
  worker.shared.unpack(L);
  for (const WorldPtr& world : worker.shared.worlds())
    worker.moments.emplace_back(world, world->snapshot());
  return 1;
}

struct Turn {
  const Parcel* item;
  lua_Integer number;
  Outcome* outcome;
  std::string subject;  // for messages
};

int seed_random(lua_State* L, lua_Integer number) {
  lua_getglobal(L, LUA_MATHLIBNAME);
  lua_getfield(L, -1, "randomseed");
  lua_pushinteger(L, number);
  protected_call(L, 1, 0);
  lua_pop(L, 1);
  return 0;
}

// (turn, function, shared): calls function(item, shared, number)
int take_turn(lua_State* L) {
  const auto& turn = *static_cast<const Turn*>(lua_touserdata(L, 1));
  seed_random(L, turn.number);
  lua_pushvalue(L, 2);
  turn.item->unpack(L);
  lua_pushvalue(L, 3);
  lua_pushinteger(L, turn.number);
  call_script(L, 3, 1, turn.subject);
  turn.outcome->value = Parcel(L, -1, "the result");
  return 0;
}

bool make_ready(Worker& worker, const Task& task, WorkerError& failure) {
  lua_State* L = worker.state->lua();
  if (!open_worker(*worker.state, task, failure)) return false;
  lua_pushcfunction(L, guarded<unpack_shared>);
  lua_pushlightuserdata(L, &worker);
  if (lua_pcall(L, 1, 1, 0) == LUA_OK) return true;
  failure = take_worker_error(L);
  return false;
}

// bit-exactly independent of earlier items
void do_item(Worker& worker, const Task& task, size_t i, Outcome& outcome) {
  lua_State* L = worker.state->lua();
  for (const auto& [world, moment] : worker.moments) world->restore(*moment);
  Turn turn{&task.items[i], static_cast<lua_Integer>(i) + 1, &outcome,
            fmt::format("{}: items[{}]", task.name.substr(1), i + 1)};
  lua_pushcfunction(L, guarded<take_turn>);
  lua_pushlightuserdata(L, &turn);
  lua_pushvalue(L, 1);
  lua_pushvalue(L, 2);
  if (lua_pcall(L, 3, 0, 0) == LUA_OK) return;
  outcome.failure = take_worker_error(L);
}

// --- the threads ---

class Crew {
 public:
  /// handed  has the caller handed its core to the first worker? Otherwise one is reserved before
  ///         any worker starts, so that the others do not take it first
  Crew(const Task& task, std::vector<Parcel> shared, bool handed)
      : task_(task), outcomes_(task.items.size()) {
    workers_.resize(shared.size());
    if (!handed && !workers_.empty()) CoreSlot::reserve();
    for (size_t i = 0; i < shared.size(); ++i) workers_[i].shared = std::move(shared[i]);
    for (Worker& worker : workers_) threads_.emplace_back([this, &worker] { run(worker); });
  }
  ~Crew() { end(); }

  void end() {
    ended_ = true;
    const std::lock_guard lock(mutex_);
    for (Worker& worker : workers_) {
      if (!worker.state) continue;
      worker.state->end();
      end_children(worker.thread);
    }
  }

  /// Holds all workers, or lets them continue.
  void pause(bool paused) {
    const std::lock_guard lock(mutex_);
    if (std::exchange(paused_, paused) == paused) return;
    for (Worker& worker : workers_)
      if (worker.state) paused ? worker.state->pause() : worker.state->resume();
  }

  /// Waits for the outcome of item i, for a limited time.
  /// returns  null if it is not available yet
  Outcome* wait(size_t i, std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, time,
                      [&] { return outcomes_[i] || broken() || idle_ == workers_.size(); });
    if (broken()) fail("{}", broken_);
    return outcomes_[i] ? &*outcomes_[i] : nullptr;
  }
  bool is_over() {
    const std::lock_guard lock(mutex_);
    return idle_ == workers_.size();
  }
  size_t done() {
    const std::lock_guard lock(mutex_);
    return done_;
  }

 private:
  bool broken() const { return !broken_.empty(); }

  // Opens the state, in the thread that uses it.
  void open(Worker& worker) {
    auto state = std::make_unique<State>(task_.memory);
    state->on_hold(lend_while_held);
    const std::lock_guard lock(mutex_);
    worker.state = std::move(state);
    worker.thread = thread_number();
    if (ended_) worker.state->end();
    if (paused_) worker.state->pause();
  }

  void do_items(Worker& worker) {
    const Watched watched{Progress(bar_of(worker.state->lua()))};
    WorkerError failure;
    if (!make_ready(worker, task_, failure)) {
      if (!ended_) fail("{}", failure.words);
      return;
    }
    for (size_t i; !ended_ && (i = next_++) < outcomes_.size();) {
      Outcome outcome;
      do_item(worker, task_, i, outcome);
      const std::lock_guard lock(mutex_);
      outcomes_[i] = std::move(outcome);
      ++done_;
      changed_.notify_one();
    }
  }

  void run(Worker& worker) {
    set_thread_nice(task_.nice);
    // the first one replaces the caller, so that a map proceeds even if all cores are busy
    const CoreSlot slot([this] { return ended_.load(); }, &worker == &workers_.front()
                                                              ? CoreSlot::Start::handed
                                                              : CoreSlot::Start::wait);
    std::string problem;
    try {
      // after waiting for a core there may be nothing left to do
      if (!ended_ && next_ < outcomes_.size()) {
        open(worker);
        do_items(worker);
      }
    } catch (const std::exception& error) {
      problem = error.what();
    }
    std::unique_ptr<State> state;
    {
      const std::lock_guard lock(mutex_);
      state = std::move(worker.state);
    }
    worker.moments.clear();
    state.reset();
    const std::lock_guard lock(mutex_);
    if (broken_.empty()) broken_ = problem;
    ++idle_;
    changed_.notify_one();
  }

  const Task& task_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::optional<Outcome>> outcomes_;
  std::string broken_;
  size_t idle_ = 0, done_ = 0;
  std::atomic<size_t> next_ = 0;
  std::atomic<bool> ended_ = false;
  bool paused_ = false;
  std::vector<Worker> workers_;
  std::vector<std::jthread> threads_;  // the last member: joined before all others are destroyed
};

// --- in the calling state ---

void read_items(lua_State* L, Task& task, const std::string& subject) {
  if (!lua_istable(L, 2)) fail("{}: items: expected a list, got {}", subject, described(L, 2));
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, 2));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, 2, i);
    task.items.emplace_back(L, lua_gettop(L), fmt::format("{}: items[{}]", subject, i));
    lua_pop(L, 1);
  }
}

void push_outcome(lua_State* L, const Outcome* outcome) {
  if (outcome && outcome->failure.words.empty()) return outcome->value.unpack(L);
  static const WorkerError not_done{"stopped before it was done", "stopped"};
  const WorkerError& failure = outcome ? outcome->failure : not_done;
  lua_createtable(L, 0, 2);
  push(L, std::string_view(failure.words));
  lua_setfield(L, -2, "error");
  if (failure.kind.empty()) return;
  push(L, std::string_view(failure.kind));
  lua_setfield(L, -2, "kind");
}

int map(lua_State* L) {
  lua_settop(L, 3);
  const std::string subject = clench::subject(L);
  Task task{read_worker_task(L, 1), {}, 0};
  read_items(L, task, subject);
  Table options(L, 3);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = options.integer("threads", cores);
  const bool told = options.push_function("each");
  const int each = lua_gettop(L);
  options.push("shared");
  const int shared = lua_gettop(L);
  std::vector<Parcel> copies;
  const size_t count = task.items.size();
  for (size_t i = 0; i < std::min<size_t>(threads, count); ++i)
    copies.emplace_back(L, shared, subject + ": shared");
  options.done();
  lua_createtable(L, static_cast<int>(count), 0);
  const int results = lua_gettop(L);
  const auto tell = [&](size_t i) {
    lua_pushvalue(L, each);
    lua_rawgeti(L, results, static_cast<lua_Integer>(i) + 1);
    lua_pushinteger(L, static_cast<lua_Integer>(i) + 1);
    return try_script(L, 2, 0, subject + ": each");
  };
  // re-raises the error on top of the stack
  const auto raise = [&] {
    lua_pushcfunction(L, lua_error);
    lua_insert(L, -2);
    protected_call(L, 1, 0);
  };
  bool interrupted = false;
  lua_Integer failed = 0;
  if (count > 0) {
    // the workers compute, and this thread only passes on their results
    const SlotLent lent(SlotLent::To::one);
    task.memory = State::memory_of(L) / copies.size();
    Crew crew(task, std::move(copies), lent.is_lent());
    const Watching watching(L);
    // passes on stops and pauses, also while outcomes come without a pause
    const auto follow = [&] {
      if (watching.progress().stop_asked())
        crew.end();
      else
        watching.progress().tell(static_cast<double>(crew.done()) / static_cast<double>(count),
                                 subject);
      crew.pause(State::is_paused(L));
    };
    for (size_t i = 0; i < count; ++i) {
      const Outcome* outcome = nullptr;
      follow();
      while (!(outcome = crew.wait(i, std::chrono::milliseconds(20)))) {
        follow();
        if (crew.is_over() && !(outcome = crew.wait(i, {}))) break;
      }
      failed += !outcome || !outcome->failure.words.empty();
      push_outcome(L, outcome);
      lua_rawseti(L, results, static_cast<lua_Integer>(i) + 1);
      if (!told || !outcome) continue;
      // Ctrl-C interrupts one of these calls; it is repeated, and the remaining results are passed
      // on before the error is raised
      const bool asked = watching.progress().stop_asked();
      if (tell(i)) continue;
      if (!asked || interrupted) raise();
      interrupted = true;
      crew.end();
      if (!tell(i)) raise();
    }
  }
  if (interrupted) raise();
  lua_pushvalue(L, results);
  lua_pushinteger(L, failed);
  return 2;
}

int nice(lua_State* L) {
  if (given(L, 1)) {
    const auto level = check_integer(L, 1, "level");
    if (level < 0 || level > 19) fail("{}: level: expected 0 to 19, got {}", subject(L), level);
    set_setting(L, Setting::worker_nice, std::to_string(level));
  }
  return push(L, std::atoi(get_setting(L, Setting::worker_nice).c_str()));
}

int get_cores(lua_State* L) {
  lua_pushinteger(L, std::max(1u, std::thread::hardware_concurrency()));
  return 1;
}

const Entry functions[] = {
    {"map", guarded<map>, R"(
Calls a function for each item of a list, in several threads, each with a separate Lua state and separate worlds. Results come in the order of the items and do not depend on the number of threads: for each item the shared worlds are in their original state, and math.random is seeded anew. All states together are limited to the memory of the calling one.
@param task function|string  (item, shared, number), which uses nothing of the lines around it; or the name of a module that returns such a function
@param items table  a list of plain data, worlds, bodies, robots, snapshots, meshes, poses, vectors, random numbers and grasps; each is handed over as a copy, grasps in no world
@param options? table  threads and shared values
@option threads? integer [1 to 1024]  number of threads, all cores by default
@option shared? any  given to every state once
@option each? function  each(result, number), called here in the order of the items, as soon as they are done
@return table results  an item that failed gives {error: string, kind?: string}, the kind of an error of Clench, and so does one that was not done when it was stopped
@return integer failed
@effect long
> clench.parallel.map(function(x) return x * x end, {1, 2, 3})  --> {1, 4, 9}, 0
> clench.parallel.map(function(p, s) s.body.pose = p; return s.body.pose.position.z end, {clench.pose {xyz = {0, 0, 2}}}, {shared = {body = flask}})  --> {2.0}, 0
> clench.parallel.map(function(x) return hand.dofs end, {1})[1].error:match "global 'hand'" ~= nil  --> true
> clench.parallel.map(function() return world end, {print})  --> error: items[1]: a function cannot be copied to another state)"},
    {"nice", guarded<nice>, R"(
Niceness of the threads that `map` and `clench.job` start from now on; 10 gives an open window priority over them.
@param level? integer  from 0, as the script itself, to 19; without it the level stays
@return integer level
@effect edits
> clench.parallel.nice(10)  --> 10
> clench.parallel.nice()  --> 10
> clench.parallel.nice(0)  --> 0
> clench.parallel.nice(20)  --> error: level: expected 0 to 19, got 20)"},
};

const Entry fields[] = {
    {"cores", guarded<get_cores>, R"(
Number of threads that this machine runs at once.
@type integer
> clench.parallel.cores >= 1  --> true)"},
};

}  // namespace

extern const Library parallel_library = {"clench.parallel", "Work in many threads.", functions,
                                         fields};

}  // namespace clench
