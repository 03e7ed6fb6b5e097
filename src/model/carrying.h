// Finds the bodies that a joint of a robot moves, including those of robots that it carries.
#pragma once
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// The link of the robot that is the body or carries it; -1: the base, or none.
int carrying_link(const World& world, Id<Robot> robot, Id<Body> body);

/// Does the joint move the body? A body of a carried robot moves with the link that carries it.
bool joint_moves(const World& world, Id<Robot> robot, int joint, Id<Body> body);

/// The bodies that a robot's joints move, computed once per motion, during which nothing is
/// mounted.
class CarriedBodies {
 public:
  CarriedBodies(const World& world, Id<Robot> robot);

  /// as movable_bodies
  const std::vector<Id<Body>>& movable() const { return movable_; }
  /// as carrying_link
  int link(Id<Body> body) const { return links_[body.index]; }
  /// as joint_moves
  bool moved_by(int joint, Id<Body> body) const {
    const int l = link(body);
    return l >= 0 && moves_[static_cast<size_t>(joint) * link_count_ + static_cast<size_t>(l)];
  }

 private:
  std::vector<Id<Body>> movable_;
  std::vector<int> links_;   // indexed by body
  std::vector<char> moves_;  // indexed by joint, then by link
  size_t link_count_ = 0;
};

/// The robot's bodies that its joints can move, and those of all robots that it carries.
std::vector<Id<Body>> movable_bodies(const World& world, Id<Robot> robot);

}  // namespace clench
