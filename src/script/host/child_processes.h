// Programs that a thread has started and waits for, as os.execute does.
#pragma once

namespace clench {

/// Thread id of the calling thread in the system.
int thread_number();

/// Ends the programs that a thread of this process has started, and those that these have started,
/// so that a call that waits for them returns. Does nothing where the system does not list them.
void end_children(int thread);

/// Gives the calling thread a niceness of at least `level`, from 0 to 19: others come first. 0 changes nothing.
void set_thread_nice(int level);

}  // namespace clench
