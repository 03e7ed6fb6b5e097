#include "clench/base/watched.h"

namespace clench {

thread_local constinit Watched* Watched::innermost_ = nullptr;

}  // namespace clench
