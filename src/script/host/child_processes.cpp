#include "clench/script/host/child_processes.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "clench/base/error.h"

namespace clench {

int thread_number() { return static_cast<int>(syscall(SYS_gettid)); }

// maximum size of a file /proc/PROCESS/task/THREAD/children
static std::vector<pid_t> read_children(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<pid_t> children;
  for (pid_t child; file >> child;) children.push_back(child);
  return children;
}

static void end_tree(pid_t process, int depth) {
  constexpr int max_depth = 20;
  // a stopped parent starts no more children while they are listed
  kill(process, SIGSTOP);
  const auto threads = std::filesystem::path("/proc") / std::to_string(process) / "task";
  std::error_code problem;
  for (const auto& thread : std::filesystem::directory_iterator(threads, problem))
    if (depth < max_depth)
      for (const pid_t child : read_children(thread.path() / "children"))
        end_tree(child, depth + 1);
  kill(process, SIGKILL);
}

void end_children(int thread) {
  const auto path = fmt::format("/proc/self/task/{}/children", thread);
  for (const pid_t child : read_children(path)) end_tree(child, 0);
}

void set_thread_nice(int level) {
  const auto thread = static_cast<id_t>(thread_number());
  if (level > 0 && getpriority(PRIO_PROCESS, thread) < level) setpriority(PRIO_PROCESS, thread, level);
}

}  // namespace clench
