// The console: reads chunks, runs them, prints what they return.
#pragma once

namespace clench {

class State;

/// Runs until the end of input: on a terminal with editing, history and completion; otherwise line
/// by line, without prompts or echo.
/// returns  the exit code
int run_console(State& state);

}  // namespace clench
