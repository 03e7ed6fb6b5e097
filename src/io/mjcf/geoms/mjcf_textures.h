// Textures of MJCF: images of files and built-in patterns, on geoms whose material names them.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <string>

#include "clench/io/mesh/texture_files.h"
#include "clench/io/mjcf/document/mjcf_document.h"
#include "clench/io/tree/tree_geometry.h"

namespace clench {

/// How a material uses a texture.
struct MjcfTextureUse {
  std::string texture = {};               ///< name; empty: none
  std::array<double, 2> repeat = {1, 1};  ///< repetitions of 2d images, over the geom or per 2 m
  bool uniform = false;                   ///< by lengths [m] instead of the size of the geom
};

class MjcfTextures {
 public:
  MjcfTextures(MjcfDocument& document, FileCache& cache) : document_(document), cache_(cache) {}

  /// Adds a <texture> element of the assets; warns of kinds that are not drawn.
  void add(const XmlElement& element);
  /// Stores how a <material> element uses a texture.
  MjcfTextureUse use_of(const MjcfNode& material) const;

  /// Adds the texture to a piece whose color is set, tinted by this color. The color is then
  /// replaced by that of the mean of the image. Coordinates in 2d images come from the file of a
  /// mesh, otherwise from x and y. Coordinates in cube images come from the direction of a point
  /// from the origin; each triangle uses the side that contains its center.
  /// half  half lengths of the geom [m]; not used for directions of mesh points, which are in
  ///       meters
  void dress(const MjcfTextureUse& use, const Eigen::Vector3d& half, bool is_mesh,
             GeometryPiece& piece);

 private:
  struct Image6 {
    bool cube = false;
    /// sides x, -x, y, -y, z, -z; for a 2d image only the first; null: it is not drawn
    std::array<std::shared_ptr<const Image>, 6> sides = {};
  };
  Image6 read(const XmlValues& values, const std::string& name);

  MjcfDocument& document_;
  FileCache& cache_;
  TextureFiles files_;
  std::map<std::string, Image6> textures_;
  std::map<std::string, SkinPtr> skins_;  // by texture, tint, mapping and geometry
};

}  // namespace clench
