#include "io/mesh_files.h"

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <cmath>

#include "base/text.h"

namespace clench {

namespace {

/// First line of a message of the reader, without its own prefixes.
std::string sentence(const char* message) {
  std::string text(trim(message ? message : ""));
  text = text.substr(0, text.find('\n'));
  for (const std::string_view prefix : {"OBJ: ", "STL: ", "Obj: "})
    if (text.starts_with(prefix)) text.erase(0, prefix.size());
  return text.empty() ? "the file cannot be read" : text;
}

Eigen::Vector3f color_of(const aiMaterial* material, float& transparency, bool& given) {
  aiColor3D color(0.7f, 0.7f, 0.7f);
  float opacity = 1;
  given = given || material->Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
  material->Get(AI_MATKEY_OPACITY, opacity);
  transparency = std::clamp(1 - opacity, 0.0f, 1.0f);
  return Eigen::Vector3f(color.r, color.g, color.b).cwiseMax(0.0f).cwiseMin(1.0f);
}

}  // namespace

Geometry read_mesh_file(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string file = path.filename().string();
  read_text(path);   // refuses what is no readable file, in our own words
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (!scene) fail("{}: {}", file, sentence(importer.GetErrorString()));

  GeometryBuilder builder;
  bool given = false;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    float transparency = 0;
    const Eigen::Vector3f color = color_of(scene->mMaterials[mesh.mMaterialIndex], transparency, given);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      std::array<Eigen::Vector3d, 3> corners;
      for (int i = 0; i < 3; ++i) {
        const aiVector3D& p = mesh.mVertices[face.mIndices[i]];
        corners[i] = Eigen::Vector3d(p.x, p.y, p.z) * options.mesh_scale;
      }
      builder.add(corners, color, transparency);
    }
  }
  if (builder.triangle_count() == 0) fail("{}: wanted triangles, got none", file);
  return builder.finish(given, file, options);
}

}  // namespace clench
