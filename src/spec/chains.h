// A robot's links as chains, the fingers of a hand: a view of its tree.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// Successive links, starting at the base or at a link.
struct Chain {
  int parent = -1;         ///< link to which it is attached; -1: the base
  std::vector<int> links;  ///< each attached to the one before
};

/// Every child of the base begins a chain. Elsewhere a chain continues with the only child that
/// leads to further joints; if there is none or several, with the first child. In the order of
/// their first links.
std::vector<Chain> chains_of(const RobotSpec& robot);

/// Position of a link in the chains.
struct ChainPlace {
  int chain = -1;  ///< -1: the base
  int link = 0;    ///< index in the chain

  bool operator==(const ChainPlace&) const = default;
};
/// link  -1: the base
ChainPlace place_of(const std::vector<Chain>& chains, int link);
/// The link at a position; -1: the base.
/// returns  empty if there is none
std::optional<int> link_at(const std::vector<Chain>& chains, ChainPlace place);

/// The chain whose last link it is, by which GraspIt! files name it.
/// returns  empty if there is none
std::optional<int> chain_ending_at(const RobotSpec& robot, int link);

/// A joint in GraspIt!'s numbering: by chain, then by index in it.
struct NumberedJoint {
  int chain = 0, number = 0;
  const JointSpec* joint = nullptr;
};
/// One per joint, link by link.
std::vector<NumberedJoint> joints_of(const RobotSpec& robot);

/// Unique names of all joints, link by link: that of its file; otherwise that of the DOF, or
/// "dof1", for the joint that has the DOF's value; otherwise "chain0_joint1", by chain and index in
/// it.
std::vector<std::string> joint_names_of(const std::vector<NumberedJoint>& joints,
                                        const std::vector<DofSpec>& dofs);

/// Reorders links so that those of each chain are consecutive, chain by chain.
/// returns  new index of each former link
std::vector<int> order_by_chains(RobotSpec& robot);

}  // namespace clench
