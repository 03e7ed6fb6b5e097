// Objects as a few boxes, balls, cylinders and cones, for planners that look for handles to grasp.
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"

namespace clench {

enum class PrimitiveKind { box, sphere, cylinder, cone };

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::box;
  /// its center in the object's frame; y is the axis of cylinder and cone, whose tip is +y
  Pose X_OP;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of a box [m]
  double radius = 0;                               ///< of the others; of a cone's bottom [m]
  double height = 0;                               ///< of cylinder and cone [m]
};

/// The primitives in an Inventor or VRML file, in its order, or in the one that an XML body names,
/// scaled and placed as it says. Of an object's file those in primitives/<its name>.iv beside it
/// are read instead, when that exists. Other geometry is not used, with a warning.
/// throws Error  "mug.iv: ..." when the file is malformed, or skews a primitive
std::vector<Primitive> read_primitives(const std::filesystem::path& path,
                                       const ReadOptions& options = {});

}  // namespace clench
