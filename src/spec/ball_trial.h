// A ball in a hand that closes on it, without a world: quick enough to be tried at hundreds of
// places.
#pragma once
#include "clench/spec/hand_tree.h"

namespace clench {

/// The open hand as points of its links, and a ball of a quarter of its fingers' length. DOFs close
/// as their default velocities say; the others stay at rest.
class BallTrial {
 public:
  /// robot  outlives it
  explicit BallTrial(const RobotSpec& robot);

  /// Is there a finger, and a DOF that closes?
  bool closes() const { return !hand_.fingers.empty() && !closing_.empty(); }
  /// May touch() and held() be asked: has it a size, and not too many parts?
  bool possible() const { return possible_; }
  double radius() const { return radius_; }
  /// Where the tips are on average when the hand is half closed, in the base.
  Eigen::Vector3d tips_centre() const;
  /// Whither the hand opens, unit, in the base: the way that the tips go as it begins to close,
  /// where they agree; else the way that the fingers point, or that leads from the palm to their
  /// tips. A direction within 20 degrees of an axis of the base is that axis.
  std::optional<Eigen::Vector3d> direction() const;
  /// Centre of a ball that comes against the direction, on the line through `from`, where it
  /// touches the open hand; empty: it passes by.
  std::optional<Eigen::Vector3d> touch(const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& direction) const;
  /// How well the hand surrounds the ball when each DOF has closed until its links touch it: the
  /// least, over all directions, of the cosine between the direction and the contact nearest to it,
  /// less friction. -1 .. 1
  double held(const Eigen::Vector3d& centre) const;

 private:
  struct Closing {
    int dof;
    double step;
    std::vector<int> links;  // that it moves, parents first
  };
  struct Part {
    std::vector<Eigen::Vector3d> points;               // in the frame of its link
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // of a sphere around them
    double radius = 0;
  };
  struct Span {
    double mean_length, min_gap;  // of fingers, along their links; between two tips
  };

  const Part& part(int link) const { return parts_[link + 1]; }
  Span span() const;
  std::vector<int> moved_links(int dof) const;
  void add_part(int link);
  bool inside(const Posture& at, const std::vector<int>& links,
              const Eigen::Vector3d& centre) const;
  Posture close_on(const Eigen::Vector3d& centre) const;

  HandTree hand_;
  Posture open_;
  std::vector<Closing> closing_;
  double radius_ = 0;
  bool possible_ = false;
  std::vector<Part> parts_;  // of the base and the links
};

}  // namespace clench
