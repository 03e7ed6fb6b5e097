// clench.convert: a file written as another format.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library convert_library;

}  // namespace clench
