#include "clench/io/write/write_mjcf.h"

#include <cctype>

#include "clench/base/file.h"
#include "clench/io/mjcf_write/write_scene.h"
#include "clench/io/text/confine.h"

namespace clench {

namespace fs = std::filesystem;

// folder of the meshes, in characters that all file systems and MuJoCo accept
static std::string mesh_folder(const fs::path& path) {
  std::string out = path.stem().string();
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return out + "_files/";
}

void write_mjcf(const SceneRequest& request, const fs::path& path, const WriteOptions& options) {
  const std::string file = path.filename().string();
  check_folder_of(path);
  const MjcfFiles scene = mjcf_scene(request, mesh_folder(path));
  FileSet written;
  for (const auto& [name, text] : scene.files) {
    const fs::path mesh = fs::absolute(path).parent_path() / name;
    check_target(mesh, options.confine);
    written.write(mesh, text);
  }
  if (options.check) options.check(Draft(path, scene.text).path());
  write_file(path, scene.text);
  written.keep();
  for (const std::string& loss : scene.losses) options.diagnostics.warn(Place(file), "{}", loss);
}

}  // namespace clench
