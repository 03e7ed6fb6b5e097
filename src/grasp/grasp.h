// A grasp: one hand, one object, the contacts between them.
#pragma once
#include "grasp/wrench_space.h"
#include "model/find.h"

namespace clench {

struct GraspOptions {
  int edges = 8;  ///< of the friction pyramids
  /// torque length [m]; default: the object's largest radius about its centre of mass
  std::optional<double> rho = {};
  bool soft = true;         ///< soft contacts resist turns about their normals; else all are points
  double normal_force = 5;  ///< at which they are judged, > 0 [N]
  ModulusRule modulus = ModulusRule::series;
};

struct Grasp {
  Id<Robot> hand;
  Id<Body> object;
  std::vector<Contact> contacts;                  ///< on the object, world frame
  std::vector<PointContact> points;               ///< the same in the object frame
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< of the object, object frame [m]
  double rho = 1;                                 ///< [m]
  int edges = 8;
  int sharp_contacts = 0;  ///< soft ones on corners or edges, where their patch is but a guess
};

/// The contacts of palm, links and mount with the object, now. None is no error: such a grasp resists nothing.
/// throws Error when edges are out of 3 to most_edges, rho <= 0, the normal force is
///        not > 0 or the object is a part of a robot
Grasp measure_grasp(const World& world, Id<Robot> hand, Id<Body> object,
                    const GraspOptions& options = {});

/// L1 wrench space of the unit wrenches about the centre of mass, torques over rho.
WrenchSpace wrench_space(const Grasp& grasp);

}  // namespace clench
