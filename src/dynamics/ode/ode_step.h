// Velocities of a step computed by ODE, the Open Dynamics Engine: its bodies, joints and contacts
// are created anew from our state, and solved by its Dantzig method (dWorldStep). Positions are
// integrated by our own code.
// source  Smith (2006), Open Dynamics Engine v0.5 User Guide, chapters 3 (joints, ERP and CFM) and
//         7.3.7 (contacts)
#pragma once
#include "clench/dynamics/ode/ode_problem.h"

namespace clench {

/// Steps the world by h with ODE.
/// Joints of one DOF: ODE has no joint for a ratio between them. The torques that keep it are found
/// by Newton's method around ODE's step, so that the ratio holds to 1e-9.
/// throws  Error if ODE rejects a body, or returns a value that is not finite
OdeSolution step_ode(const World& world, const OdeProblem& problem, double h);

}  // namespace clench
