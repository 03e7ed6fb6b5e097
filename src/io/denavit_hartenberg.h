// Joints that stand anywhere as joints after Denavit and Hartenberg: by the common normals of their
// axes.
#pragma once
#include <vector>

#include "spec/robot_spec.h"

namespace clench {

/// Rz(theta) Tz(d) Tx(a) Rx(alpha)
Pose dh_pose(double theta, double d, double a, double alpha);

/// X_AB = Rz(theta) Tz(d) Tx(a) Rx(alpha) Rz(phi) Tz(h): along the z axis of A to the common normal
/// of both z axes, along that to the z axis of B, along which the rest leads. theta lies within a
/// quarter turn. Axes that meet have a = 0; parallel ones h = 0; of one line they have theta = 0,
/// too.
struct CommonNormal {
  double theta = 0, d = 0, a = 0, alpha = 0;  ///< [rad, m, m, rad]
  double phi = 0, h = 0;                      ///< [rad, m]
};

/// source  Denavit & Hartenberg (1955), A kinematic notation for lower-pair mechanisms
CommonNormal common_normal(const Pose& X_AB);

/// A chain with no pose of its own before or after a joint.
struct DhChain {
  Pose X_BC;                      ///< chain frame, on the first axis, where the chain's own was
  std::vector<JointSpec> joints;  ///< same DOFs, ranges and q
  std::vector<Pose>
      X_JL;  ///< of links, in the frame after their last joint; identity: it is that frame
  double farthest = 0;  ///< longest way along an axis that nearly parallel axes made necessary [m]
};

/// What stands after Denavit and Hartenberg already is kept to the bit. `X_BC` is the chain's
/// frame.
DhChain denavit_hartenberg(const ChainSpec& chain, const Pose& X_BC);

}  // namespace clench
