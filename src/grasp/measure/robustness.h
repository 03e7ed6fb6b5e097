// Robustness: how much disturbance a grasp resists before a contact slips or detaches, with
// compliant contacts and fingers; potential contact robustness, and potential grasp robustness over
// all choices of contacts that may detach.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/base/progress.h"
#include "clench/math/pose.h"

namespace clench {

/// Contact i has the rows starts[i] .. starts[i + 1] - 1 of f: its normal force into the object,
/// then with friction the tangential forces, including the torsion of a soft contact over its
/// radius [N].
struct RobustnessProblem {
  Eigen::MatrixXd G;        ///< 6 x forces: wrenches on the object of unit forces; torque over rho
  Eigen::MatrixXd J;        ///< forces x DOFs: motion of the hand's points along them
  std::vector<int> starts;  ///< one per contact, and at the end the number of forces
  Eigen::VectorXd mu;       ///< one per contact, >= 0
  Eigen::VectorXd compliance;  ///< one per force, > 0: compliance of the contact along it [m/N]
  /// wrench on the object that the contacts balance; torque over rho [N]
  Vector6d load = Vector6d::Zero();
  double max_force = 10;  ///< cap of each contact along its normal, > 0 [N]
};

/// Assumed state of a contact.
enum class ContactHold {
  sticks,   ///< transmits normal forces and, within its cone, tangential ones
  slips,    ///< transmits normal forces only
  detached  ///< transmits nothing
};

struct Robustness {
  /// Radius of a ball of wrenches: any disturbance within it leaves every contact force inside its
  /// bounds [N]. 0: there are no such forces, or the contacts do not span all wrenches.
  double radius = 0;
  double margin = 0;       ///< of the contact force closest to its bounds [N]
  Eigen::VectorXd forces;  ///< forces that balance the load with that margin; empty at radius 0
  std::vector<ContactHold> states;  ///< one per contact
  /// upper bound for all forces, for grasp_robustness over all choices of states; the radius itself
  /// unless a search was cut short or a program could not be solved with certainty [N]
  double most = 0;
};

/// Robustness with given states of all contacts. The forces balance the load through the springs,
/// plus internal forces that the joints can exert without moving the object.
/// throws  Error if sizes do not match or a number is out of range
/// source  Bicchi (1995); Pozzi, Malvezzi & Prattichizzo (2017), On grasp quality measures: grasp
///         robustness and contact force distribution in underactuated and compliant hands, eqs.
///         12-17
Robustness contact_robustness(const RobustnessProblem& problem,
                              const std::vector<ContactHold>& states);
/// the same with all contacts sticking
Robustness contact_robustness(const RobustnessProblem& problem);

/// The largest contact robustness over all states of the contacts, by branch and bound, starting
/// from the best result of single changes of state. Exact if the search ends within its steps, each
/// of which is a cone program; otherwise, and if it is stopped, the best found so far, and `most`.
/// throws  Error as contact_robustness
Robustness grasp_robustness(const RobustnessProblem& problem, int max_steps = 100000,
                            const Progress& progress = {});

}  // namespace clench
