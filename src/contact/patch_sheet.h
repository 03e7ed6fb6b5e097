// The part of a body's surface that faces a contact, and its curvature between its vertices.
#pragma once
#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "clench/contact/near_surface.h"
#include "clench/geometry/tree/shape.h"
#include "clench/math/pose.h"

namespace clench {

/// The sheet of triangles that contains the contacts: those connected with the nearest to the sites
/// that face the contact, leaning less than 73 degrees. So the far side of a thin plate does not
/// belong to it.
///
/// Between the vertices a surface is assumed to be round where adjacent triangles lean from each
/// other by less than 40 degrees, flat at sharper edges: there, points lie on the curved surface
/// defined by the normals of the triangles around the vertices, not on its chords.
///
/// source Boubekeur & Alexa (2008), Phong tessellation (with half a step, which makes it exact to
/// second order); Max (1999), Weights for computing vertex normals from facet normals
class PatchSheet {
 public:
  /// cosine: triangles that lean more belong to the flank
  static constexpr double min_facing = 0.3;
  /// factor of the radius: a sphere of this size around a site contains what lies over its disc,
  /// for mean slopes of up to 45 degrees. Within it all triangles are known.
  static constexpr double reach = std::numbers::sqrt2;

  /// X_PB    body in the frame of the patch, whose +z points into the body
  /// sites   approximate positions of the contacts, frame P [m]
  /// radius  of the surface considered around them, > 0 [m]
  PatchSheet(const Shape& shape, const Pose& X_PB, std::span<const Eigen::Vector3d> sites,
             double radius);

  /// triangles of the sheet; their numbers are used below
  const std::vector<int>& triangles() const { return triangles_; }
  const Corners& corners(int triangle) const { return near_.corners(triangle); }  ///< frame P [m]
  /// cosine between its outer side and -z; open surfaces have two outer sides
  double facing(int triangle) const;
  double highest() const {
    return highest_;
  }  ///< points farther from the tangent plane are ignored [m]

  /// edges at which the sheet ends, or is not known further [m]
  std::vector<std::array<Eigen::Vector3d, 2>> rim() const;
  /// point of the round surface, by barycentric weights [m]
  Eigen::Vector3d round_point(int triangle, const Eigen::Vector3d& weights);

  /// Length of the creases around a site, the maximum over all sites. A crease is an edge whose
  /// triangles lean from each other by more than 40 degrees, or that has only one triangle. Weight
  /// one within half the radius in the tangent plane, decreasing to zero at the radius [m].
  double crease_length() const;

 private:
  // a triangle at a corner
  struct Blade {
    int triangle = -1;                    // of the mesh
    Eigen::Vector3d normal;               // frame P
    double twice_area = 0;                // [m^2]
    double weight = 0;                    // weight in the corner's normal
    std::array<int, 2> ends = {};         // its other corners: equal numbers are the same position
    bool round = false, reached = false;  // for the triangle that the query is about
  };
  // the triangles around a corner, and which of them continue smoothly in each other
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
  std::vector<double> reaches_;  // radius about each site within which all triangles are known
  std::vector<int> known_;       // triangles of the mesh, ascending
  NearSurface near_;             // of them
  std::vector<Eigen::Vector3d> normals_;
  std::vector<int> triangles_;
  std::vector<Eigen::Vector3d> corner_normals_;  // by slot; 0 until computed
  std::vector<Fan> fans_;                        // by corner; empty until computed
  double touching_;                              // nearer corners coincide [m]
};

}  // namespace clench
