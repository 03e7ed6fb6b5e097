// A robot's links in rows, as users think of fingers: a view of its tree.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// Links in a row, from the base or a link on.
struct Chain {
  int parent = -1;         ///< link that it begins on; -1: the base
  std::vector<int> links;  ///< each on the one before
};

/// Every child of the base begins a chain. Elsewhere that one goes on which alone leads on to
/// joints; where none does, the first child. In the order of their first links.
std::vector<Chain> chains_of(const RobotSpec& robot);

/// Where a link is in the chains.
struct ChainPlace {
  int chain = -1;  ///< -1: the base
  int link = 0;    ///< number in the chain

  bool operator==(const ChainPlace&) const = default;
};
/// link  -1: the base
ChainPlace place_of(const std::vector<Chain>& chains, int link);
/// The link there; -1: the base.
/// returns  empty when there is none
std::optional<int> link_at(const std::vector<Chain>& chains, ChainPlace place);

/// The chain whose last link it is, by which files of the original name it.   returns  empty when
/// there is none
std::optional<int> chain_ending_at(const RobotSpec& robot, int link);

/// A joint as users count it: by chain, then by number in it.
struct NumberedJoint {
  int chain = 0, number = 0;
  const JointSpec* joint = nullptr;
};
/// One per joint, link by link.
std::vector<NumberedJoint> joints_of(const RobotSpec& robot);

/// Names of all joints, link by link, each once: that of its file; else that of the DOF, or "dof1",
/// of the joint that has its value; else "chain0_joint1", by chain and number in it.
std::vector<std::string> joint_names_of(const std::vector<NumberedJoint>& joints,
                                        const std::vector<DofSpec>& dofs);

/// Puts the links of each chain side by side, chain by chain.
/// returns  of each former link: its new place
std::vector<int> order_by_chains(RobotSpec& robot);

}  // namespace clench
