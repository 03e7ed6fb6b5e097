// Bodies and robots from their files, by what these hold.
#pragma once
#include "clench/io/text/library.h"

namespace clench {

/// What a Library reads files with: all formats.
extern const Loaders all_formats;

}  // namespace clench
