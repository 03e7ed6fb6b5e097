// A ball in a closing hand, without a world: fast enough for trials at hundreds of positions.
#pragma once
#include "clench/spec/hand_tree.h"

namespace clench {

/// The open hand as points of its links, and a ball whose radius is a quarter of its fingers'
/// length. DOFs close in the direction of their default velocities; those without one are at rest.
class BallTrial {
 public:
  /// robot  must outlive it
  explicit BallTrial(const RobotSpec& robot);

  /// Does it have a finger and a DOF that closes?
  bool closes() const { return !hand_.fingers.empty() && !closing_.empty(); }
  /// May touch() and held() be called: does it have a size, and not too many parts?
  bool possible() const { return possible_; }
  double radius() const { return radius_; }
  /// Mean position of the tips of the half-closed hand, in the base.
  Eigen::Vector3d tips_center() const;
  /// Direction in which the hand opens, unit, in the base: the initial direction of the closing
  /// tips, if they agree; otherwise the direction in which the fingers point, or that from the palm
  /// to their tips. Snapped to an axis of the base within 20 degrees of it.
  std::optional<Eigen::Vector3d> direction() const;
  /// Center of a ball that moves against the direction, on the line through `from`, at which it
  /// touches the open hand; empty: it passes by.
  std::optional<Eigen::Vector3d> touch(const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& direction) const;
  /// Quality of the hold on the ball, after each DOF has closed until its links touch it: the
  /// minimum, over all directions, of the cosine between the direction and the contact nearest to
  /// it, minus friction. -1 .. 1
  double held(const Eigen::Vector3d& center) const;

 private:
  struct Closing {
    int dof;
    double step;
    std::vector<int> links;  // links that it moves, parents first
  };
  struct Part {
    std::vector<Eigen::Vector3d> points;               // in the frame of its link
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // of their bounding sphere
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
              const Eigen::Vector3d& center) const;
  Posture close_on(const Eigen::Vector3d& center) const;

  HandTree hand_;
  Posture open_;
  std::vector<Closing> closing_;
  double radius_ = 0;
  bool possible_ = false;
  std::vector<Part> parts_;  // of the base and the links
};

}  // namespace clench
