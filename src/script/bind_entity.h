// What bodies and robots have in common: material, mass, surface, colour.
// Of a robot they are its base's.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Class entity_class;

}  // namespace clench
