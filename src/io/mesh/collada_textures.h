// Finds the image files of COLLADA materials.
#pragma once
#include <initializer_list>
#include <map>
#include <string>

#include "clench/io/mesh/collada_mesh.h"
#include "clench/io/mesh/mesh_input.h"
#include "clench/io/mesh/texture_files.h"

namespace clench {

/// The first child of that name, its first child of the next name, and so on; null if one is
/// missing.
XmlElement inner_element(XmlElement element, std::initializer_list<const char*> path);

class ColladaTextures {
 public:
  ColladaTextures(const MeshInput& input, const ColladaIds& ids, ColladaWork& work)
      : input_(input), ids_(ids), work_(work) {}

  /// Appearance given by a <texture> of a <profile_COMMON>, bound by an <instance_material>.
  ColladaLook look(const XmlElement& texture, const XmlElement& profile,
                   const XmlElement& material);

 private:
  std::shared_ptr<const Image> image(const XmlElement& element);

  const MeshInput& input_;
  const ColladaIds& ids_;
  ColladaWork& work_;
  TextureFiles files_;
  std::map<std::string, int> numbers_;  // of textures, by file and wrap mode
};

}  // namespace clench
