// clench.entries: the bindings about themselves.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library entries_library;

}  // namespace clench
