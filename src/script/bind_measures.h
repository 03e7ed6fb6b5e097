// What every grasp can say of its worth: the methods of grasp that measure it.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Class measures_class;
extern const Library measures_library;

}  // namespace clench
