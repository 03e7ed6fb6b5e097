#include "io/gltf.h"

#include "base/error.h"

namespace clench {

bool read_gltf(const std::filesystem::path& path, GeometryBuilder&, const ReadOptions&) {
  fail("{}: not read", path.filename().string());
}

}  // namespace clench
