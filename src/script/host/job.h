// A function of a script that runs in a separate thread and a separate state.
#pragma once
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clench/base/progress.h"
#include "clench/script/bind/parcel.h"
#include "clench/script/host/bell.h"
#include "clench/script/host/worker.h"

namespace clench {

class Bar;
class State;

class Job {
 public:
  enum class Phase { queued, running, paused, done, failed, stopped };

  /// Task, arguments and limits of a new job.
  struct Start {
    WorkerTask task;
    std::string name;            ///< in messages
    Parcel arguments;            ///< {args =, shared =}, of copies that share worlds
    int count = 0;               ///< number of arguments
    size_t memory = 0;           ///< limit of its state [bytes]
    std::shared_ptr<Bell> bell;  ///< rung at each event, at each shown value and at the end
  };

  /// Starts a job. Its thread keeps it alive until its function has ended.
  static std::shared_ptr<Job> begin(Start start);
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const std::string& name() const { return start_.name; }
  Phase phase() const;
  bool is_over() const;
  Watcher::State progress() const;
  /// Waits until the job is over, for at most `time`.
  /// returns  true if it is over
  bool wait(std::chrono::milliseconds time) const;

  void stop();
  bool is_stop_asked() const;
  void pause();
  void resume();

  /// Events sent since the last call, in order.
  std::deque<Parcel> take_events();
  /// The latest value that the job has shown; null before the first.
  std::shared_ptr<const Parcel> snapshot() const;
  /// Leaves the values that the function returned on the stack.
  /// returns  their number
  /// throws  Error of the function, or if it was stopped, or is not over yet
  int push_results(lua_State* L) const;

  // --- called by the function itself, in its thread ---

  void add_event(Parcel value);
  void show(Parcel value);

 private:
  explicit Job(Start start) : start_(std::move(start)) {}
  void run();
  void open_and_run();
  bool run_function(State& state);
  static int call_function(lua_State* L);

  Start start_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Phase phase_ = Phase::queued;
  bool stop_asked_ = false, pause_asked_ = false;
  std::unique_ptr<State> state_;  // null before it runs and after
  int thread_ = 0;                // that runs it; 0 before
  bool is_done_ = false;          // has the function returned?
  std::shared_ptr<Bar> watcher_;
  std::deque<Parcel> events_;
  std::shared_ptr<const Parcel> snapshot_;
  std::vector<Parcel> results_;
  WorkerError failure_;
};

using JobPtr = std::shared_ptr<Job>;

/// The job whose function runs in the state; null outside of jobs.
Job* running_job(lua_State* L);
/// Pushes the value that was passed to that job as the option `shared`.
void push_shared_of_job(lua_State* L);

}  // namespace clench
