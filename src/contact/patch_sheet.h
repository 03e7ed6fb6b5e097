// The part of a body's surface that a contact sees, and how it bends between its vertices.
#pragma once
#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "clench/contact/near_surface.h"
#include "clench/geometry/tree/shape.h"
#include "clench/math/pose.h"

namespace clench {

/// The sheet of triangles that holds the contacts: those that hang together with the nearest to the
/// sites and face the contact, leaning less than 73 degrees. So a thin plate has no far side.
///
/// Between the vertices a surface is taken for round where neighbouring triangles lean from each
/// other by less than 40 degrees, flat at sharper edges: there points lie on the curved surface
/// whose normals the triangles around the vertices tell, not on its chords.
///
/// source Boubekeur & Alexa (2008), Phong tessellation (with half a step, which makes it exact to
///        second order); Max (1999), Weights for computing vertex normals from facet normals
class PatchSheet {
 public:
  static constexpr double min_facing = 0.3;  ///< cosine: what leans more belongs to the flank
  /// of the radius: a sphere around a site holds what lies over its disc, slopes of 45 degrees on
  /// the whole. So far around the sites all is known.
  static constexpr double reach = std::numbers::sqrt2;

  /// X_PB    body in the frame of the patch, whose +z goes into the body
  /// sites   about where the contacts are, frame P [m]
  /// radius  how far around them the surface counts, > 0 [m]
  PatchSheet(const Shape& shape, const Pose& X_PB, std::span<const Eigen::Vector3d> sites,
             double radius);

  /// triangles of the sheet, by numbers for what follows
  const std::vector<int>& triangles() const { return triangles_; }
  const Corners& corners(int triangle) const { return near_.corners(triangle); }  ///< frame P [m]
  /// cosine between its outside and -z; open surfaces have two outsides
  double facing(int triangle) const;
  double highest() const {
    return highest_;
  }  ///< what is farther from the tangent plane does not count [m]

  /// edges beyond which the sheet does not go on, or is not known [m]
  std::vector<std::array<Eigen::Vector3d, 2>> rim() const;
  /// on the round surface, by barycentric weights [m]
  Eigen::Vector3d round_point(int triangle, const Eigen::Vector3d& weights);

  /// How long creases are around a site, of the site that has most: edges where neighbours lean
  /// from each other by more than 40 degrees, or none follows. Counted whole where they lie within
  /// half the radius across the tangent plane, less from there to none at the radius [m].
  double crease_length() const;

 private:
  // a triangle at a corner
  struct Blade {
    int triangle = -1;                    // of the mesh
    Eigen::Vector3d normal;               // frame P
    double twice_area = 0;                // [m^2]
    double weight = 0;                    // in the corner's normal
    std::array<int, 2> ends = {};         // its other corners: equal numbers are one place
    bool round = false, reached = false;  // for the triangle that asks
  };
  // the triangles around a corner, and which go on smoothly in each other
  struct Fan {
    std::vector<Blade> blades;
    std::vector<std::pair<int, int>> links;
  };
  const Eigen::Vector3d& corner_normal(int triangle, int k);
  Eigen::Vector3d make_corner_normal(int triangle, int k);
  std::vector<Blade> blades_at(int triangle, int k) const;
  std::vector<Blade> far_blades_at(int triangle, int k) const;
  bool linked(const Blade& a, const Blade& b) const;

  const Shape& shape_;
  Pose X_PB_, X_BP_;
  std::vector<Eigen::Vector3d> sites_;
  double radius_, highest_;
  std::vector<double> reaches_;  // about each site, to where all triangles are known
  std::vector<int> known_;       // triangles of the mesh, ascending
  NearSurface near_;             // of them
  std::vector<Eigen::Vector3d> normals_;
  std::vector<int> triangles_;
  std::vector<Eigen::Vector3d> corner_normals_;  // by slot; 0 until asked for
  std::vector<Fan> fans_;                        // by corner; empty until asked for
  double touching_;                              // nearer corners are one [m]
};

}  // namespace clench
