// Objects as a few boxes, balls, cylinders and cones, for planners that grasp primitive shapes.
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"

namespace clench {

enum class PrimitiveKind { box, sphere, cylinder, cone };

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::box;
  /// pose of its center in the object's frame; y is the axis of cylinder and cone, with the cone's
  /// tip at +y
  Pose X_OP;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of a box [m]
  double radius = 0;                               ///< of the others; of a cone's base [m]
  double height = 0;                               ///< of cylinder and cone [m]
};

/// The primitives in an Inventor or VRML file, in order; for an XML body, those in the file that it
/// names, scaled and placed accordingly. If primitives/NAME.iv exists next to an object's file
/// NAME, it is read instead. Other geometry is not used, with a warning.
/// throws Error  "mug.iv: ..." if the file is malformed, or skews a primitive
std::vector<Primitive> read_primitives(const std::filesystem::path& path,
                                       const ReadOptions& options = {});

}  // namespace clench
