// What a drive of DOFs is told, and what came of it.
#pragma once
#include <vector>

#include "clench/model/find.h"

namespace clench {

enum class DofStop {
  reached,  ///< its target, inside the limits
  limit,    ///< its target, a limit
  contact,
  not_driven,       ///< it had nowhere to go
  iteration_limit,  ///< it slid and stuck more often than a drive waits for
};

struct DriveOptions {
  bool stop_at_contact = false;  ///< end at the first new contact of any link
};

struct DriveResult {
  bool moved = false;                ///< did any DOF or joint change by more than 1e-5 [rad or m]?
  std::vector<DofStop> stops;        ///< one per DOF: why it stopped
  std::vector<BodyPair> stopped_by;  ///< pairs whose contacts block a joint at the end; link first
  int queries = 0;                   ///< distance queries it took
  int events = 0;                    ///< contacts met on the way
};

}  // namespace clench
