// Visibility of lights: depth maps, and light gathered at corners.
#pragma once
#include <span>

#include "clench/render/gl/gl_objects.h"
#include "clench/render/gl/programs.h"
#include "clench/render/mesh/draw_list.h"
#include "clench/render/view/lights.h"

namespace clench {

/// Corners of triangles on the graphics card, in the order of their indices; the vertex array reads
/// both.
struct LoadedCorners {
  LoadedCorners(const std::vector<Corner>& corners, const std::vector<uint32_t>& indices);
  gl::Object array, corners, indices;
  int count;  ///< number of indices
};

/// Draws one triangle over the complete framebuffer, without vertex attributes.
class Cover {
 public:
  void draw(unsigned program) const;

 private:
  gl::Object array_ = gl::make_vertex_array();
};

class Shadows {
 public:
  /// lights per pass; those not cast are dark
  static constexpr int most = lights_at_once;

  /// `count` maps of `size` pixels per side
  Shadows(const Programs& programs, int size, int count = most);

  /// Draws the maps of these lights, at most `count`. Transparent bodies block a fraction of the
  /// lights.
  void cast(const DrawList& list, const LoadedCorners& loaded, std::span<const Light> lights);
  /// Sets the lights just cast in a program that contains `light_part`; uses texture unit 0.
  void give(unsigned program) const;

 private:
  const Programs& programs_;
  int size_;
  gl::Object maps_, framebuffer_;
  std::vector<Eigen::Matrix3f> axes_;
  std::vector<Eigen::Vector3f> to_light_;
  std::vector<float> radiance_, share_;
};

/// Binds this buffer of light to a location of `surface_vertex`, for the corners of a list.
void read_light(const LoadedCorners& loaded, int place, unsigned light);

/// Light at each corner, a buffer of four numbers each: front and back, and the openness of each.
/// throws Error if there are more corners than a texture holds
/// throws Stopped
gl::Object gather(const Programs& programs, const DrawList& list, const LoadedCorners& loaded,
                  Shadows& shadows, const std::vector<Light>& lights, const Progress& progress);

}  // namespace clench
