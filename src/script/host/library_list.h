// All classes and libraries visible to scripts, in the order of the documentation.
#pragma once
#include <span>

#include "clench/script/lua/entry.h"

namespace clench {

std::span<const Class* const> all_classes();
std::span<const Library* const> all_libraries();

extern const Library entries_library;

}  // namespace clench
