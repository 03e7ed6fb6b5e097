// Options and results of driving DOFs.
#pragma once
#include <vector>

#include "clench/model/find.h"

namespace clench {

enum class DofStop {
  reached,  ///< reached its target, inside the limits
  limit,    ///< reached its target, a limit
  contact,
  not_driven,       ///< had no motion to make
  iteration_limit,  ///< slid and stuck more often than a drive allows
};

struct DriveOptions {
  bool stop_at_contact = false;  ///< end at the first new contact of any link
};

struct DriveResult {
  bool moved = false;                ///< did any DOF or joint change by more than 1e-5 [rad or m]?
  std::vector<DofStop> stops;        ///< one per DOF: reason of its stop
  std::vector<BodyPair> stopped_by;  ///< pairs whose contacts block a joint at the end; link first
  int queries = 0;                   ///< number of distance queries
  int events = 0;                    ///< number of contacts on the path
};

}  // namespace clench
