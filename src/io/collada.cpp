#include "io/collada.h"

#include "base/error.h"

namespace clench {

bool read_collada(const std::filesystem::path& path, GeometryBuilder&, const ReadOptions&) {
  fail("{}: not read", path.filename().string());
}

}  // namespace clench
