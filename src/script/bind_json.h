// clench.json: values as text for other programs.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library json_library;

}  // namespace clench
