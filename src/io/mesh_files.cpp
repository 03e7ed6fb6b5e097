#include "io/mesh_files.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <cmath>

#include "base/text.h"

namespace clench {

namespace {

/// What the reader library says, where it says it well.
std::string sentence(const std::string& message, const std::string& extension) {
  if (message.find("vertex index out of range") != std::string::npos)
    return "a face names a vertex that does not exist";
  if (message.find("number of vertices") != std::string::npos)
    return "wanted three vertices a facet";
  if (message.find("storage representation") != std::string::npos ||
      message.find("too small") != std::string::npos || message.find("empty") != std::string::npos)
    return extension == ".stl" ? "wanted an ASCII or binary STL file, got something else"
                               : "wanted triangles, got none";
  if (message.find("No output meshes") != std::string::npos) return "wanted triangles, got none";
  return fmt::format("the file is malformed ({})", trim(message.substr(0, message.find('\n'))));
}

/// The number of the point that a word of an OBJ face names: "7", "7/1", "-2//3"; from 1, or -1 for
/// the last.
std::optional<int> point_number(std::string_view word) {
  return parse_integer(word.substr(0, word.find('/')));
}

/// Refuses points and faces with the line that the reader library leaves out.
void check_obj(const std::string& text, const std::string& file) {
  struct Face {
    Line line;
    int points;  // so far
  };
  LineReader lines(file, text);
  std::vector<Face> faces;
  int points = 0;
  while (!lines.done()) {
    const Line line = lines.next().before('#');
    // a '\\' at the end goes on in the next line; the library reads those
    if (line.text().ends_with('\\')) {
      if (line.word(0) == "v") ++points;
      continue;
    }
    if (line.word(0) == "f") faces.push_back({line, points});
    if (line.word(0) != "v") continue;
    ++points;
    for (int i = 1; i <= 3; ++i)
      if (!parse_number(line.word(i)))
        line.fail("wanted three numbers after v, got {}", in_quotes(line.word(i)));
  }
  // a face may come before its points
  for (const auto& [line, before] : faces)
    for (int i = 1; i < line.size(); ++i) {
      const auto n = point_number(line.word(i));
      if (!n) line.fail("wanted numbers of points after f, got {}", in_quotes(line.word(i)));
      if (*n == 0 || *n > points || *n < -before)
        line.fail("wanted one of {} points after f, got {}", points, *n);
    }
}

Eigen::Vector3f color_of(const aiMaterial* material, float& transparency, bool& given) {
  aiColor3D color(0.7f, 0.7f, 0.7f);
  float opacity = 1;
  // the reader makes a material up where the file has none
  aiString name;
  material->Get(AI_MATKEY_NAME, name);
  if (std::string_view(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME)
    given |= material->Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
  material->Get(AI_MATKEY_OPACITY, opacity);
  transparency = std::clamp(1 - opacity, 0.0f, 1.0f);
  return Eigen::Vector3f(color.r, color.g, color.b).cwiseMax(0.0f).cwiseMin(1.0f);
}

}  // namespace

Geometry read_mesh_file(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string file = path.filename().string();
  const std::string text = read_text(path);  // refuses what is no readable file, in our own words
  if (lower_case(path.extension().string()) == ".obj") check_obj(text, file);
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_SortByPType |
                                           aiProcess_PreTransformVertices);
  if (!scene)
    fail("{}: {}", file,
         sentence(importer.GetErrorString(), lower_case(path.extension().string())));

  GeometryBuilder builder;
  bool given = false;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    float transparency = 0;
    const Eigen::Vector3f color =
        color_of(scene->mMaterials[mesh.mMaterialIndex], transparency, given);
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
