// clench.files: the small files around hands and planners, as tables.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library files_library;

}  // namespace clench
