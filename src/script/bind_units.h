// The module's version, and the units that people think in.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library units_library;

}  // namespace clench
