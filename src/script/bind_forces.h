// What every grasp can say of forces: the methods of grasp that balance loads.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Class forces_class;

}  // namespace clench
