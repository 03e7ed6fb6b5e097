// clench.chart: numbers as a picture.
#pragma once
#include "script/entry.h"

namespace clench {

extern const Library chart_library;

}  // namespace clench
