// Triangles from any mesh reader, gathered into a welded mesh and its colours.
#pragma once
#include "io/read.h"

namespace clench {

struct Geometry {
  Mesh mesh;  ///< welded, no triangle with a vertex twice; may be empty
  Appearance appearance;
};

class GeometryBuilder {
 public:
  /// Corners [m]. A triangle with two equal corners is dropped.
  void add(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3f& color,
           float transparency);
  size_t triangle_count() const { return mesh_.triangles.size(); }
  /// Colours are kept one a triangle when they differ. A closed mesh that is inside out is turned,
  /// with a warning. `colors_given`: do the colours come from the file?
  Geometry finish(bool colors_given, const std::string& subject, const ReadOptions& options);

 private:
  Mesh mesh_;
  std::vector<Eigen::Vector3f> colors_;
  Eigen::Vector3d weighted_color_ = Eigen::Vector3d::Zero();
  double weighted_transparency_ = 0, weight_ = 0;
};

}  // namespace clench
