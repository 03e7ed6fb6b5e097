// Materials of Wavefront OBJ, from MTL files.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "clench/io/mesh/mesh_input.h"
#include "clench/io/mesh/texture_files.h"
#include "clench/spec/body_spec.h"

namespace clench {

struct MtlMaterial {
  Eigen::Vector3f color = Appearance().color;
  float transparency = 0;
  std::shared_ptr<const Image> image = {};  ///< null: uniform color
  bool colored = false;                     ///< true if the file gives the color
  int number = -1;                          ///< of its texture in the builder
  bool clamped = false;                     ///< true if the image is not repeated beyond its edges
  /// maps texture coordinates of the file to those of the image, v upward
  Eigen::Vector2d image_scale = Eigen::Vector2d::Ones(), image_offset = Eigen::Vector2d::Zero();

  /// A texture point of the file in coordinates of the image, v down from the top.
  Eigen::Vector2d placed(const Eigen::Vector2d& uv) const;
  /// If a material has no color, or a black one, its image is not tinted.
  Texture texture() const;
};

struct MtlMaterials {
  using WarnOnce = std::function<void(const std::string& about, const Place& place,
                                      const std::string& sentence)>;
  std::map<std::string, MtlMaterial> by_name = {};
  TextureFiles images = {};

  /// Adds the materials of an MTL file named by `input`.
  void read(const std::filesystem::path& path, const MeshInput& input, const WarnOnce& warn);
};

}  // namespace clench
