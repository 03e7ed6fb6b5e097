// Textures of MJCF: images of files and built-in patterns, on geoms whose material names them.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <string>

#include "clench/io/mesh/texture_files.h"
#include "clench/io/mjcf/mjcf_document.h"
#include "clench/io/tree/tree_geometry.h"

namespace clench {

/// How a material uses a texture.
struct MjcfTextureUse {
  std::string texture = {};               ///< name; empty: none
  std::array<double, 2> repeat = {1, 1};  ///< of 2d images, over the geom or per 2 m
  bool uniform = false;                   ///< by lengths [m], not by the size of the geom
};

class MjcfTextures {
 public:
  MjcfTextures(MjcfDocument& document, FileCache& cache) : document_(document), cache_(cache) {}

  /// An element <texture> of the assets; warns of kinds that are not drawn.
  void add(const XmlElement& element);
  /// How an element <material> uses a texture.
  MjcfTextureUse use_of(const MjcfNode& material) const;

  /// Adds the texture to a piece whose color is set, tinted by the color. The color becomes that of
  /// the mean of the image. Places in 2d images come from the file of a mesh, else from x and y;
  /// those in cube images from the direction of a point from the origin, for each triangle on the
  /// side that its middle lies on.
  /// half  half lengths of the geom [m]; a mesh has its directions in meters all the same
  void dress(const MjcfTextureUse& use, const Eigen::Vector3d& half, bool is_mesh,
             GeometryPiece& piece);

 private:
  struct Image6 {
    bool cube = false;
    /// sides x, -x, y, -y, z, -z; of a 2d image the first; null: it is not drawn
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
