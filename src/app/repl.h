// The console: reads chunks, runs them, prints what they return.
#pragma once

namespace clench {

class State;

/// Until the input ends. On a terminal with editing, history and completion; otherwise line by
/// line, silently.
/// returns  the exit code
int run_console(State& state);

}  // namespace clench
