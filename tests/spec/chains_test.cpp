#include "clench/spec/chains.h"

#include <doctest/doctest.h>

using namespace clench;

// links by their parents; '+' for a link moved by a joint, '-' for a fixed one
static RobotSpec tree_of(const std::vector<int>& parents, const std::string& joints) {
  RobotSpec robot;
  for (size_t l = 0; l < parents.size(); ++l) {
    LinkSpec link{.parent = parents[l]};
    link.body.name = std::to_string(l);
    if (joints[l] == '+') link.joints.resize(1);
    robot.links.push_back(link);
  }
  return robot;
}

static std::vector<std::vector<int>> rows_of(const RobotSpec& robot) {
  std::vector<std::vector<int>> out;
  for (const Chain& chain : chains_of(robot)) out.push_back(chain.links);
  return out;
}

using Rows = std::vector<std::vector<int>>;

TEST_CASE("every link on the base begins a chain, which continues through single children") {
  CHECK(rows_of(tree_of({-1, 0, 1, -1, 3}, "+++++")) == Rows{{0, 1, 2}, {3, 4}});
  CHECK(rows_of(tree_of({-1, -1}, "--")) == Rows{{0}, {1}});
  CHECK(rows_of({}).empty());
}

TEST_CASE("each branch of a tree begins a chain") {
  const RobotSpec wrist = tree_of({-1, 0, 1, 0, 3}, "+++++");
  CHECK(rows_of(wrist) == Rows{{0}, {1, 2}, {3, 4}});
  CHECK(chains_of(wrist)[1].parent == 0);
  CHECK(chains_of(wrist)[0].parent == -1);
}

TEST_CASE(
    "among a link's children, the only one with further joints continues the chain, or the first") {
  // a nail is fixed on the finger before the next phalanx
  CHECK(rows_of(tree_of({-1, 0, 0, 2}, "+-++")) == Rows{{0, 2, 3}, {1}});
  CHECK(rows_of(tree_of({-1, 0, 0}, "+--")) == Rows{{0, 1}, {2}});
}

TEST_CASE("places in chains are converted to links and back") {
  const auto chains = chains_of(tree_of({-1, 0, 0, 2}, "+-++"));
  for (int link = -1; link < 4; ++link) CHECK(link_at(chains, place_of(chains, link)) == link);
  CHECK(place_of(chains, 3) == ChainPlace{0, 2});
  CHECK(place_of(chains, -1) == ChainPlace{-1, 0});
  CHECK_FALSE(link_at(chains, {2, 0}));
  CHECK_FALSE(link_at(chains, {0, 3}));
  CHECK_FALSE(link_at(chains, {0, -1}));
}

TEST_CASE("links of a chain become consecutive, and keep their parents") {
  RobotSpec robot = tree_of({-1, -1, 0, 1, 2}, "+++++");
  const auto now = order_by_chains(robot);
  CHECK(now == std::vector<int>{0, 3, 1, 4, 2});
  CHECK(rows_of(robot) == Rows{{0, 1, 2}, {3, 4}});
  const char* names[] = {"0", "2", "4", "1", "3"};
  for (int l = 0; l < 5; ++l) CHECK(robot.links[l].body.name == names[l]);
}

TEST_CASE("joints are numbered within their chains, and the last link identifies a chain") {
  RobotSpec robot = tree_of({-1, 0, 0, 2}, "+-++");
  robot.links[2].joints.resize(2);
  const auto joints = joints_of(robot);
  REQUIRE(joints.size() == 4);
  for (int j = 0; j < 4; ++j) {
    CHECK(joints[j].chain == 0);
    CHECK(joints[j].number == j);
  }
  CHECK(joints[2].joint == &robot.links[2].joints[1]);
  CHECK(chain_ending_at(robot, 3) == 0);
  CHECK(chain_ending_at(robot, 1) == 1);
  CHECK_FALSE(chain_ending_at(robot, 0));
}
