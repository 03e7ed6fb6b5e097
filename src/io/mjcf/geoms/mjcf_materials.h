// Materials of MJCF bodies, from the friction of their geoms.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "clench/io/mjcf/geoms/mjcf_geoms.h"

namespace clench {

class MjcfMaterials {
 public:
  /// file  for messages
  explicit MjcfMaterials(std::string file) : file_(std::move(file)) {}

  /// Material of a body: the one of its colliding geom with the highest priority, among these with
  /// the largest friction. Friction 1 if no geom collides.
  std::string of(const std::vector<MjcfGeom>& geoms, const std::string& body);
  /// All frictions that of() returned.
  std::vector<OwnFriction> list() const { return {frictions_.begin(), frictions_.end()}; }
  /// Warns once of bodies whose geoms differ.
  void tell(const FileCache& cache) const;

 private:
  std::string file_;
  std::set<OwnFriction> frictions_;
  std::vector<std::string> mixed_;  // bodies whose geoms have different coefficients
};

/// True if the file gives the friction of any colliding geom.
bool is_friction_given(const std::vector<MjcfGeom>& geoms);

}  // namespace clench
