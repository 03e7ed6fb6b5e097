// ODE as a library: started once for the process, made ready in each thread, and kept from printing
// or ending the program.
#pragma once

namespace clench {

/// To be called before anything else of ODE is, in each thread.
/// throws  Error (internal) when ODE has no memory; so does any call of ODE that meets a fault
///         afterwards
void start_ode();

/// Warnings of ODE in this thread since it was last asked, such as "LCP internal error".
int take_ode_warnings();

}  // namespace clench
