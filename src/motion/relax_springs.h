// The springs of compliant DOFs come to rest.
#pragma once
#include "clench/motion/drive_result.h"
#include "clench/motion/drive_state.h"

namespace clench {

enum class Springs { at_rest, moving, stopped };

/// Lets springs come to rest among the contacts, the DOFs where they are, or a new touch stop them
/// where one is to. A finger that static friction does not hold slides until kinetic friction does.
/// result  counts queries and events, and names the pair that stopped them
/// returns  moving: they creep on after many changes of contact
Springs relax_springs(Drive& drive, const DriveOptions& options, DriveResult& result);

}  // namespace clench
