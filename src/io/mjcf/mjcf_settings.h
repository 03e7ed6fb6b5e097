// The <compiler> settings of an MJCF file: units of its numbers, and how masses are inferred.
#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "clench/io/tree/tree_xml.h"

namespace clench {

/// The defaults are MuJoCo's.
struct MjcfSettings {
  enum class FromGeoms { never, always, missing };

  std::filesystem::path path;  ///< of the outermost file; names of files are relative to its folder
  double angle_unit = 0;       ///< [rad]
  std::string euler = "xyz";   ///< capital letters: axes fixed in the parent frame
  bool autolimits = true, strip_path = false;
  std::string mesh_dir, texture_dir;
  FromGeoms inertia_from_geoms = FromGeoms::missing;  ///< masses of bodies
  std::array<int, 2> inertia_groups = {0, 5};  ///< geoms of these groups have mass, bounds included
  double min_mass = 0;                         ///< of a body [kg]
  double min_inertia = 0;                      ///< principal moments of a body [kg m^2]
  double total_mass = 0;         ///< of all bodies, scaled to it; <= 0: as they are [kg]
  bool balance_inertia = false;  ///< average the moments of an inertia that no body can have
  bool fit_bounds = false;       ///< primitives are fitted to bounding boxes, not to inertias

  MjcfSettings();
  /// Applies one <compiler> element.
  /// throws  Error  "hand.xml:3: compiler: eulerseq: expected three of xyzXYZ, got 'xyw'"
  void read(const XmlElement& element, UnusedXml& unused, Repairs& repairs);
};

}  // namespace clench
