// How much disturbance a grasp bears before a contact slips or lets go, with contacts and fingers
// as springs: potential contact robustness, and potential grasp robustness over all ways to let
// some go.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/base/progress.h"
#include "clench/math/pose.h"

namespace clench {

/// Contact i has the rows starts[i] .. starts[i + 1] - 1 of f: its normal force into the object,
/// then with friction those across it, the torsion of a soft contact over its radius among them
/// [N].
struct RobustnessProblem {
  Eigen::MatrixXd G;        ///< 6 x forces: wrenches on the object of unit forces; torque over rho
  Eigen::MatrixXd J;        ///< forces x DOFs: how the hand's points move along them
  std::vector<int> starts;  ///< one per contact, and at the end the number of forces
  Eigen::VectorXd mu;       ///< one per contact, >= 0
  Eigen::VectorXd compliance;  ///< one per force, > 0: how far the contact yields to it [m/N]
  /// wrench on the object that the contacts hold; torque over rho [N]
  Vector6d load = Vector6d::Zero();
  double max_force = 10;  ///< of each contact along its normal, > 0 [N]
};

/// What a contact is counted on to do.
enum class ContactHold {
  sticks,   ///< holds along its normal and, within its cone, across it
  slips,    ///< holds along its normal only
  detached  ///< holds nothing
};

struct Robustness {
  /// Radius of a ball of wrenches: any disturbance within leaves every contact force inside its
  /// bounds [N]. 0: there are no such forces, or the contacts do not span all wrenches.
  double radius = 0;
  double margin = 0;       ///< of the contact force nearest to its bounds [N]
  Eigen::VectorXd forces;  ///< those that hold the load with that margin; empty at radius 0
  std::vector<ContactHold> states;  ///< one per contact
  /// what no forces, of grasp_robustness no choice of states, exceed; the radius itself unless a
  /// search was cut short or a program could not be solved for certain [N]
  double most = 0;
};

/// Robustness with every contact counted on as told. The forces hold the load by the springs, and
/// add what forces the joints can make against each other without moving the object.
/// throws  Error when sizes do not fit or a number is out of range
/// source  Bicchi (1995); Pozzi, Malvezzi & Prattichizzo (2017), On grasp quality measures: grasp
///         robustness and contact force distribution in underactuated and compliant hands, eqs.
///         12-17
Robustness contact_robustness(const RobustnessProblem& problem,
                              const std::vector<ContactHold>& states);
/// the same with all contacts sticking
Robustness contact_robustness(const RobustnessProblem& problem);

/// The largest contact robustness over all states of the contacts, by branch and bound from the
/// best that single changes of state lead to. Exact when the search ends within its steps, each a
/// cone program; else the best found, and `most`. Told to stop, the best found so far, too.
/// throws  Error as contact_robustness
Robustness grasp_robustness(const RobustnessProblem& problem, int max_steps = 100000,
                            const Progress& progress = {});

}  // namespace clench
