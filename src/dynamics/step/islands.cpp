#include "clench/dynamics/step/islands.h"

#include "clench/base/disjoint_sets.h"

namespace clench {

void find_islands(StepProblem& problem) {
  const size_t trees = problem.columns.size();
  DisjointSets touching(trees);
  for (const StepBlock& block : problem.blocks)
    if (block.tree[0] >= 0 && block.tree[1] >= 0) touching.join(block.tree[0], block.tree[1]);
  std::vector<int> island_of(trees, -1);  // by the first tree of each set
  problem.islands.clear();
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const StepBlock& block = problem.blocks[i];
    const int tree = block.tree[0] >= 0 ? block.tree[0] : block.tree[1];
    if (tree < 0) continue;
    int& island = island_of[touching.find(tree)];
    if (island < 0) {
      island = static_cast<int>(problem.islands.size());
      problem.islands.emplace_back();
    }
    problem.islands[island].blocks.push_back(static_cast<int>(i));
  }
  for (size_t t = 0; t < trees; ++t)
    if (const int island = island_of[touching.find(static_cast<int>(t))];
        island >= 0 && !problem.columns[t].rows.empty())
      problem.islands[island].trees.push_back(static_cast<int>(t));
}

}  // namespace clench
