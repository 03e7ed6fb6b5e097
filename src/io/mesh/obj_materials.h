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
  std::shared_ptr<const Image> image = {};  ///< null: one color
  bool colored = false;                     ///< does the file give the color?
  int number = -1;                          ///< of its texture in the builder
  bool clamped = false;                     ///< does the image end at its edges?
  /// texture coordinates of the file to those of the image, v upward
  Eigen::Vector2d image_scale = Eigen::Vector2d::Ones(), image_offset = Eigen::Vector2d::Zero();

  /// A point of the file, v down from the top, in the image.
  Eigen::Vector2d placed(const Eigen::Vector2d& uv) const;
  /// A material without a color, or a black one, does not tint its image.
  Texture texture() const;
};

struct MtlMaterials {
  using WarnOnce = std::function<void(const std::string& about, const Place& place,
                                      const std::string& sentence)>;
  std::map<std::string, MtlMaterial> by_name = {};
  TextureFiles images = {};

  /// Adds the materials of an MTL file, which `input` names.
  void read(const std::filesystem::path& path, const MeshInput& input, const WarnOnce& warn);
};

}  // namespace clench
