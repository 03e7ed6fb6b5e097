#include "clench/planning/search/run_together.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <set>
#include <thread>
#include <vector>

#include "clench/base/error.h"
#include "clench/base/watched.h"

namespace clench {

void run_together(std::span<Share> shares, int threads, const Progress& progress) {
  if (threads < 1 || threads > 1024) fail("threads: expected 1 to 1024, got {}", threads);
  std::set<const World*> worlds;
  for (const Share& share : shares)
    if (!worlds.insert(&share.search->world()).second)
      fail("searches that run at once need separate worlds");

  std::vector<std::exception_ptr> failures(shares.size());
  const auto run = [&](size_t i) {
    try {
      shares[i].taken = shares[i].search->run(shares[i].steps, progress);
    } catch (const std::exception&) {
      failures[i] = std::current_exception();
    }
  };
  const auto elsewhere = [&](size_t i) { return shares[i].search->any_thread(); };

  std::atomic<size_t> next = 0;
  const auto work = [&] {
    for (size_t i; (i = next++) < shares.size();)
      if (elsewhere(i)) run(i);
  };
  std::vector<std::jthread> workers;
  const size_t most = std::min<size_t>(threads, shares.size());
  for (size_t t = 1; t < most; ++t)
    workers.emplace_back([&] {
      const Watched watched(progress);
      work();
    });
  for (size_t i = 0; i < shares.size(); ++i)
    if (!elsewhere(i)) run(i);
  work();
  workers.clear();  // waits for them
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace clench
