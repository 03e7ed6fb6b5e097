// The <compiler> settings of an MJCF file: units of its numbers, and how masses are inferred.
#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "clench/io/tree/tree_xml.h"

namespace clench {

/// The defaults are those of MuJoCo.
struct MjcfSettings {
  enum class FromGeoms { never, always, missing };

  std::filesystem::path path;  ///< of the outermost file; file names are relative to its folder
  double angle_unit = 0;       ///< [rad]
  std::string euler = "xyz";   ///< capital letters: axes fixed in the parent frame
  bool autolimits = true, strip_path = false;
  std::string mesh_dir, texture_dir;
  FromGeoms inertia_from_geoms = FromGeoms::missing;  ///< for masses of bodies
  std::array<int, 2> inertia_groups = {0, 5};  ///< geoms of these groups have mass, bounds included
  double min_mass = 0;                         ///< of a body [kg]
  double min_inertia = 0;                      ///< principal moments of a body [kg m^2]
  double total_mass = 0;         ///< all masses are scaled to this sum; <= 0: unscaled [kg]
  bool balance_inertia = false;  ///< replaces the moments of an invalid inertia by their mean
  bool fit_bounds = false;       ///< fits primitives to bounding boxes instead of inertias

  MjcfSettings();
  /// Applies one <compiler> element.
  /// throws  Error  "hand.xml:3: compiler: eulerseq: expected three of xyzXYZ, got 'xyw'"
  void read(const XmlElement& element, UnusedXml& unused, Repairs& repairs);
};

}  // namespace clench
