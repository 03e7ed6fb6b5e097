// Jobs and work in many threads, as scripts see them.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

extern const Library parallel_library, job_library;
extern const Class job_class, this_job_class;

}  // namespace clench
