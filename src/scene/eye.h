// The camera of a scene.
#pragma once
#include <Eigen/Core>

namespace clench {

struct Eye {
  /// world [m]
  Eigen::Vector3d eye = Eigen::Vector3d::UnitX(), target = Eigen::Vector3d::Zero(),
                  up = Eigen::Vector3d::UnitZ();
  double field_of_view = 0.6;  ///< vertical [rad], in [0.001, 3]
  double ortho_height = 0;     ///< height of an orthographic view [m]; 0: perspective
  /// shift of what is seen to the right, as a fraction of the picture's height, by a lens beside
  /// the picture's center: of the eyes of a stereoscopic picture
  double aside = 0;
};

}  // namespace clench
