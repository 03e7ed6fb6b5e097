// clench.job: a function of a script that runs in a separate thread.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "clench/base/error.h"
#include "clench/script/host/bind_poller.h"
#include "clench/script/host/job.h"
#include "clench/script/host/job_classes.h"
#include "clench/script/host/state.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

template <>
inline constexpr const Class* script_class<JobPtr> = &job_class;

namespace {

// the function of a job, in its own state
struct ThisJob {
  Job* job;
};

}  // namespace

template <>
inline constexpr const Class* script_class<ThisJob> = &this_job_class;

namespace {

// Jobs started by a state. Those whose handles no longer exist continue; when the state is closed,
// all are stopped.
struct StartedJobs {
  std::vector<JobPtr> jobs;

  // All at once, because one may wait for another that holds a resource. Programs that they wait
  // for are ended with them. One that is in a C call that cannot be stopped is left behind, and
  // ends with the program.
  ~StartedJobs() {
    for (const JobPtr& job : jobs) job->stop();
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    for (const JobPtr& job : jobs) {
      const auto left = last - std::chrono::steady_clock::now();
      job->wait(std::max(std::chrono::milliseconds(0),
                         std::chrono::duration_cast<std::chrono::milliseconds>(left)));
    }
  }
};

// maximum number of jobs of one state that are queued, running or paused
constexpr size_t max_jobs = 1000;

// number of items of a list, or of a table that table.pack has made
lua_Integer count_arguments(lua_State* L, int list, const std::string& subject) {
  auto count = static_cast<lua_Integer>(lua_rawlen(L, list));
  lua_getfield(L, list, "n");
  if (lua_isinteger(L, -1)) count = std::max(count, lua_tointeger(L, -1));
  lua_pop(L, 1);
  for (lua_pushnil(L); lua_next(L, list); lua_pop(L, 1)) {
    const bool is_n = lua_type(L, -2) == LUA_TSTRING && string_at(L, -2) == "n";
    const bool is_place = lua_isinteger(L, -2) && lua_tointeger(L, -2) >= 1;
    if (!is_n && !is_place)
      fail("{}: args: expected a list of arguments in their order, got the key {}", subject,
           described(L, -2));
  }
  return count;
}

// Packs the arguments and the shared value into one parcel, so that a world in both is one copy.
void read_arguments(lua_State* L, int list, int shared, Job::Start& start) {
  constexpr lua_Integer most = 100;
  const std::string subject = clench::subject(L);
  if (!lua_isnil(L, list) && !lua_istable(L, list))
    fail("{}: args: expected a list, got {}", subject, described(L, list));
  const auto count = lua_istable(L, list) ? count_arguments(L, list, subject) : 0;
  if (count > most) fail("{}: args: expected at most {} arguments, got {}", subject, most, count);
  lua_createtable(L, 0, 2);
  lua_pushvalue(L, list);
  lua_setfield(L, -2, "args");
  lua_pushvalue(L, shared);
  lua_setfield(L, -2, "shared");
  start.arguments = Parcel(L, lua_gettop(L), subject);
  start.count = static_cast<int>(count);
  lua_pop(L, 1);
}

int new_job(lua_State* L) {
  lua_settop(L, 2);
  Job::Start start{.task = read_worker_task(L, 1),
                   .name = {},
                   .arguments = {},
                   .memory = State::memory_of(L),
                   .bell = bell_of(L)};
  Table options(L, 2);
  start.name = options.string("name", start.task.module.empty() ? "job" : start.task.module);
  options.push("args");
  options.push("shared");
  read_arguments(L, lua_gettop(L) - 1, lua_gettop(L), start);
  options.done();
  auto& started = kept<StartedJobs>(L).jobs;
  std::erase_if(started, [](const JobPtr& job) { return job->is_over(); });
  if (started.size() >= max_jobs)
    fail(ErrorKind::limit, "{}: expected at most {} jobs at once", subject(L), max_jobs);
  started.push_back(Job::begin(std::move(start)));
  return push_object(L, JobPtr(started.back()));
}

constexpr Word<Job::Phase> phases[] = {
    {"queued", Job::Phase::queued}, {"running", Job::Phase::running},
    {"paused", Job::Phase::paused}, {"done", Job::Phase::done},
    {"failed", Job::Phase::failed}, {"stopped", Job::Phase::stopped}};

std::string job_text(const JobPtr& job) {
  return fmt::format("job '{}', {}", job->name(), word_of(job->phase(), phases));
}

// waits in intervals of 20 ms, between which Ctrl-C is checked
int wait_for_job(lua_State* L) {
  const JobPtr job = self<JobPtr>(L);
  const double seconds = given(L, 2) ? check_number(L, 2, "seconds") : INFINITY;
  if (!(seconds >= 0)) fail("{}: seconds: expected a time >= 0, got {}", subject(L), seconds);
  using Clock = std::chrono::steady_clock;
  const auto left = [&, began = Clock::now()] {
    return seconds - std::chrono::duration<double>(Clock::now() - began).count();
  };
  const Watching watching(L);
  for (;;) {
    const double piece = std::clamp(left(), 0.0, 0.02);
    if (job->wait(std::chrono::milliseconds(static_cast<int>(std::ceil(1e3 * piece)))))
      return push(L, true);
    watching.progress().check();
    if (left() <= 0) return push(L, false);
  }
}

int get_results(lua_State* L) {
  luaL_checkstack(L, 110, "too many results");
  return self<JobPtr>(L)->push_results(L);
}

int take_events(lua_State* L) {
  return push_list_of(L, self<JobPtr>(L)->take_events(),
                      [&](const Parcel& event) { event.unpack(L); });
}

int get_snapshot(lua_State* L) {
  const auto snapshot = self<JobPtr>(L)->snapshot();
  if (!snapshot) return 0;
  snapshot->unpack(L);
  return 1;
}

int get_progress(lua_State* L) {
  const Watcher::State state = self<JobPtr>(L)->progress();
  if (state.fraction < 0) return push_record(L, {{"text", state.text}});
  return push_record(L, {{"fraction", state.fraction}, {"text", state.text}});
}

int send_event(lua_State* L) {
  self<ThisJob>(L).job->add_event(Parcel(L, 2, subject(L)));
  return 0;
}

int show_value(lua_State* L) {
  self<ThisJob>(L).job->show(Parcel(L, 2, subject(L)));
  return 0;
}

int get_this_job(lua_State* L) {
  Job* job = running_job(L);
  return job ? push_object(L, ThisJob{job}) : 0;
}

const Entry job_functions[] = {
    {"job", guarded<new_job>, R"(
Runs a function concurrently with the script: in a thread, in a separate Lua state, on copies of its arguments. As many jobs run at once as there are cores, but at least two; others are queued. A job without a handle continues; the end of the program stops it.
@param task function|string  which uses nothing of the lines around it; or the name of a module that returns such a function
@param options? table  what it is given
@option args? any[]  the function's arguments, of the kinds that clench.parallel.map hands over
@option shared? any  the same, as `clench.this_job.shared`
@option name? string  for messages
@return job
@effect reads
> job = clench.job(function(n) return n * n end, {args = {7}})
> job:wait()
> job:result()  --> 49
> job = clench.job(function(h) h:autograsp() return #h.world:contacts() > 0 end, {args = {hand}})
> job:wait(20), job:result()  --> true, true
> clench.job(function() return hand end)
> clench.job(print)  --> error: expected one written in Lua)"},
};

const Entry job_library_fields[] = {
    {"this_job", guarded<get_this_job>, R"(
The job whose function this is; nil outside of jobs.
@type this_job?
> clench.this_job  --> nil)"},
};

const Entry job_fields[] = {
    {"state", getter<[](const JobPtr& x) { return word_of(x->phase(), phases); }>, R"(
Its present state.
@type "queued"|"running"|"paused"|"done"|"failed"|"stopped"
> job = clench.job(function() end)
> job:wait()
> job.state  --> done)"},
    {"name", getter<[](const JobPtr& x) { return x->name(); }>, R"(
Its name in messages.
@type string
> clench.job(function() end, {name = "idle"}).name  --> idle)"},
    {"progress", guarded<get_progress>, R"(
Progress of its longest call, or of the loop that it shows by `clench.progress`.
@type {fraction?: number, text: string}  fraction: of the work, in [0, 1]; nil: not known
> job = clench.job(function() for i = 1, 4 do clench.this_job:show(i) end end)
> job:wait()
> job.progress.text  --> )"},
    {"snapshot", guarded<get_snapshot>, R"(
The latest value shown by `clench.this_job:show`; nil before the first.
@type any
> job = clench.job(function() for i = 1, 4 do clench.this_job:show(i) end end)
> job:wait()
> job.snapshot  --> 4)"},
};

const Entry job_methods[] = {
    {"wait", guarded<wait_for_job>, R"(
Waits for its end. Coroutines of `clench.loop` do not run meanwhile: in them, `clench.loop.wait(job)` waits.
@param seconds? number  at most so long; 0: not at all [s]
@return boolean over  is it done, failed or stopped?
@effect long
> clench.job(function() end):wait()  --> true
> clench.job(function() end):wait(-1)  --> error: seconds: expected a time >= 0, got -1)"},
    {"result", guarded<get_results>, R"(
Results of its function. Raises the function's error, and an error if the job was stopped or is not over yet.
@return any ...
@effect long
> job = clench.job(function() error "no luck" end, {name = "lottery"})
> job:wait()
> job:result()  --> error: no luck)"},
    {"stop", method<[](const JobPtr& x) { x->stop(); }>, R"(
Stops it within about 100 ms, in Lua and in calls of the engine; other programs that it has started and not waited for to the end are ended, too. A call of string.find with a hostile pattern ends first. A job that is over is not affected.
@effect edits
> job = clench.job(function() while true do end end)
> job:stop()
> job:wait(5), job.state  --> true, stopped
> job = clench.job(function() os.execute "sleep 60" end)
> job:stop()
> job:wait(5), job.state  --> true, stopped)"},
    {"pause", method<[](const JobPtr& x) { x->pause(); }>, R"(
Pauses it at its next instruction in Lua; a call of the engine ends first.
@effect edits
> job = clench.job(function() while true do end end)
> job:pause()
> job:stop()
> job:wait(5), job.state  --> true, stopped)"},
    {"resume", method<[](const JobPtr& x) { x->resume(); }>, R"(
Lets it continue after `pause`.
@effect edits
> job = clench.job(function() end)
> job:pause()
> job:resume()
> job:wait(5)  --> true)"},
    {"events", guarded<take_events>, R"(
All values that it has sent by `clench.this_job:event` since the last call, in order.
@return any[] events
@effect edits
> job = clench.job(function() for i = 1, 3 do clench.this_job:event(i) end end)
> job:wait()
> job:events(), #job:events()  --> {1, 2, 3}, 0)"},
};

const Entry job_operators[] = {{"__tostring", method<job_text>, ""}};

int get_shared(lua_State* L) {
  push_shared_of_job(L);
  return 1;
}

const Entry this_job_fields[] = {
    {"shared", guarded<get_shared>, R"(
A copy of the option `shared` of clench.job; worlds in it are those of the arguments.
@type any
> job = clench.job(function() return clench.this_job.shared.limit end, {shared = {limit = 3}})
> job:wait()
> job:result()  --> 3)"},
};

const Entry this_job_methods[] = {
    {"event", guarded<send_event>, R"(
Sends a value to the script that has started the job. Events arrive in order, and none is lost.
@param value any  of the kinds that clench.parallel.map hands over
@effect edits
> job = clench.job(function() clench.this_job:event {grasps = 1} end)
> job:wait()
> job:events()  --> {{grasps = 1}})"},
    {"show", guarded<show_value>, R"(
Shows a value, which becomes `job.snapshot` and replaces the previous one.
@param value any  of the kinds that clench.parallel.map hands over
@effect edits
> job = clench.job(function() clench.this_job:show "half" end)
> job:wait()
> job.snapshot  --> half)"},
};

}  // namespace

int has_jobs(lua_State* L) {
  const auto& started = kept<StartedJobs>(L).jobs;
  return push(L, std::ranges::any_of(started, [](const JobPtr& job) { return !job->is_over(); }));
}

const Library job_library{
    .name = "clench", .doc = "", .functions = job_functions, .fields = job_library_fields};

const Class job_class{
    .name = "job",
    .variable = "job",
    .doc = "A function that runs concurrently with the script, started by `clench.job`.",
    .fields = job_fields,
    .methods = job_methods,
    .operators = job_operators};

const Class this_job_class{.name = "this_job",
                           .variable = "this_job",
                           .doc = "Used by a job's function, in its own state, to report.",
                           .fields = this_job_fields,
                           .methods = this_job_methods};

}  // namespace clench
