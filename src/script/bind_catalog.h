// clench.catalog: our own hands, arms, objects, obstacles and worlds.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library catalog_library;

}  // namespace clench
