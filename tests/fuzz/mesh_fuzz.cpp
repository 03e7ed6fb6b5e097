// A mesh file of arbitrary bytes is a mesh that a Shape accepts, or an Error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "clench/base/error.h"
#include "clench/io/mesh/mesh_files.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::filesystem::path path = "fuzz." FORMAT;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const clench::ReadOptions options;
  try {
    const clench::Geometry geometry = clench::read_mesh({path, bytes, options});
    clench::check_mesh(geometry.mesh, "mesh");
  } catch (const clench::Error& error) {
    // a message names its file
    if (!std::string(error.what()).starts_with("fuzz." FORMAT)) std::abort();
  }
  return 0;
}
