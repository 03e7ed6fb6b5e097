#include "clench/script/host/job.h"

#include <thread>
#include <utility>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/script/host/child_processes.h"
#include "clench/script/host/slots.h"
#include "clench/script/host/state.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/watching.h"

namespace clench {

namespace {

struct RunningJob {
  Job* job = nullptr;
};

}  // namespace

static const char shared_key = 0;  // its address is the registry key of the shared value

void push_shared_of_job(lua_State* L) { lua_rawgetp(L, LUA_REGISTRYINDEX, &shared_key); }

Job* running_job(lua_State* L) { return kept<RunningJob>(L).job; }

// --- the job ---

std::shared_ptr<Job> Job::begin(Start start) {
  const std::shared_ptr<Job> job(new Job(std::move(start)));
  std::thread([job] { job->run(); }).detach();
  return job;
}

Job::Phase Job::phase() const {
  const std::lock_guard lock(mutex_);
  return phase_ == Phase::running && pause_asked_ ? Phase::paused : phase_;
}

static bool is_end(Job::Phase phase) {
  return phase != Job::Phase::queued && phase != Job::Phase::running && phase != Job::Phase::paused;
}

bool Job::is_over() const { return is_end(phase()); }

Watcher::State Job::progress() const {
  const std::lock_guard lock(mutex_);
  return watcher_ ? watcher_->shown() : Watcher::State();
}

bool Job::wait(std::chrono::milliseconds time) const {
  const SlotLent lent;
  std::unique_lock lock(mutex_);
  // a program that was started while the job was being stopped
  if (stop_asked_ && state_) end_children(thread_);
  return changed_.wait_for(lock, time, [this] { return is_end(phase_); });
}

bool Job::is_stop_asked() const {
  const std::lock_guard lock(mutex_);
  return stop_asked_;
}

void Job::stop() {
  const std::lock_guard lock(mutex_);
  stop_asked_ = true;
  if (!state_) return;
  state_->end();
  end_children(thread_);
}

void Job::pause() {
  const std::lock_guard lock(mutex_);
  pause_asked_ = !is_end(phase_);
  if (state_ && pause_asked_) state_->pause();
}

void Job::resume() {
  const std::lock_guard lock(mutex_);
  pause_asked_ = false;
  if (state_) state_->resume();
}

std::deque<Parcel> Job::take_events() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

std::shared_ptr<const Parcel> Job::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

int Job::push_results(lua_State* L) const {
  const std::lock_guard lock(mutex_);
  if (!is_end(phase_))
    fail("{}: job '{}' is not over yet; wait() waits for it", subject(L), name());
  if (phase_ == Phase::stopped)
    fail(ErrorKind::stale, "{}: job '{}' was stopped", subject(L), name());
  if (phase_ == Phase::failed) {
    const std::string sentence = fmt::format("job '{}': {}", name(), failure_.words);
    if (failure_.kind.empty()) throw Error(sentence);
    // a stop or time limit inside the job does not stop the script that asks for its result
    const bool ended = failure_.kind == "stopped" || failure_.kind == "timeout";
    throw Error(sentence, ended ? ErrorKind::limit : error_kind(failure_.kind));
  }
  for (const Parcel& result : results_) result.unpack(L);
  return static_cast<int>(results_.size());
}

void Job::add_event(Parcel value) {
  {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(value));
  }
  start_.bell->ring();
}

void Job::show(Parcel value) {
  {
    const std::lock_guard lock(mutex_);
    snapshot_ = std::make_shared<const Parcel>(std::move(value));
  }
  start_.bell->ring();
}

// (job, function) -> results
int Job::call_function(lua_State* L) {
  auto& job = *static_cast<Job*>(lua_touserdata(L, 1));
  kept<RunningJob>(L).job = &job;
  lua_remove(L, 1);
  luaL_checkstack(L, job.start_.count + 10, "too many arguments");
  job.start_.arguments.unpack(L);
  lua_getfield(L, 2, "shared");
  lua_rawsetp(L, LUA_REGISTRYINDEX, &shared_key);
  lua_getfield(L, 2, "args");
  lua_remove(L, 2);
  for (int i = 1; i <= job.start_.count; ++i) lua_rawgeti(L, 2, i);
  lua_remove(L, 2);
  call_script(L, lua_gettop(L) - 1, LUA_MULTRET, fmt::format("job '{}'", job.name()));
  std::vector<Parcel> results;
  for (int i = 1; i <= lua_gettop(L); ++i) results.emplace_back(L, i, fmt::format("result {}", i));
  job.results_ = std::move(results);
  return 0;
}

// returns  false if it failed; failure_ has the error
bool Job::run_function(State& state) {
  lua_State* L = state.lua();
  const Watched watched{Progress(bar_of(L))};
  if (!open_worker(state, start_.task, failure_)) return false;
  lua_pushcfunction(L, guarded<&Job::call_function>);
  lua_insert(L, -2);
  lua_pushlightuserdata(L, this);
  lua_insert(L, -2);
  if (lua_pcall(L, 2, 0, 0) == LUA_OK) return true;
  failure_ = take_worker_error(L);
  return false;
}

void Job::open_and_run() {
  auto state = std::make_unique<State>(start_.memory);
  State& opened = *state;
  opened.on_hold(lend_while_held);
  {
    const std::lock_guard lock(mutex_);
    state_ = std::move(state);
    thread_ = thread_number();
    watcher_ = bar_of(opened.lua());
    phase_ = Phase::running;
    if (stop_asked_) opened.end();
    if (pause_asked_) opened.pause();
  }
  is_done_ = run_function(opened);
}

void Job::run() {
  set_thread_nice(start_.task.nice);
  std::optional<CoreSlot> slot(std::in_place, [this] { return is_stop_asked(); });
  try {
    open_and_run();
  } catch (const std::exception& error) {
    failure_ = {error.what(), "limit"};
  }
  std::unique_ptr<State> state;
  {
    const std::lock_guard lock(mutex_);
    state = std::move(state_);
  }
  state.reset();  // before the end is announced, so that nothing of the job runs after it
  {
    const std::lock_guard lock(mutex_);
    phase_ = stop_asked_ ? Phase::stopped : is_done_ ? Phase::done : Phase::failed;
    pause_asked_ = false;
    changed_.notify_all();
  }
  slot.reset();
  start_.bell->ring();
}

}  // namespace clench
