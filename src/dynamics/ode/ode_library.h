// ODE as a library: initialized once per process and in each thread, and kept from printing or
// terminating the program.
#pragma once

namespace clench {

/// Must be called before any other function of ODE, in each thread.
/// throws  Error (internal) if ODE runs out of memory; later calls of ODE throw it for internal
///         faults
void start_ode();

/// Warnings of ODE in this thread since the last call, such as "LCP internal error".
int take_ode_warnings();

}  // namespace clench
