// The velocities of a step as ODE, the Open Dynamics Engine, finds them: bodies, joints and
// contacts are its own, made anew from our state, and solved by its Dantzig method (dWorldStep).
// Where bodies go is still ours.
// source  Smith (2006), Open Dynamics Engine v0.5 User Guide, chapters 3 (joints, ERP and CFM) and
//         7.3.7 (contacts)
#pragma once
#include "clench/dynamics/ode/ode_problem.h"

namespace clench {

/// Has ODE step the world as it is by h.
/// Joints of one DOF: ODE has no joint for a ratio between them. The torques that hold it are found
/// by Newton's method around ODE's step, so that the ratio holds to 1e-9.
/// throws  Error when ODE refuses a body, or gives what is no number
OdeSolution step_ode(const World& world, const OdeProblem& problem, double h);

}  // namespace clench
