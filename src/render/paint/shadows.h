// What of a scene each light reaches: maps of depth, and light gathered at corners.
#pragma once
#include <span>

#include "clench/render/gl/gl_objects.h"
#include "clench/render/gl/programs.h"
#include "clench/render/mesh/draw_list.h"
#include "clench/render/view/lights.h"

namespace clench {

/// Corners of triangles on the graphics card, in the order of their indices; the array reads both.
struct LoadedCorners {
  LoadedCorners(const std::vector<Corner>& corners, const std::vector<uint32_t>& indices);
  gl::Object array, corners, indices;
  int count;  ///< of indices
};

/// One triangle over all of the framebuffer; reads nothing but the program.
class Cover {
 public:
  void draw(unsigned program) const;

 private:
  gl::Object array_ = gl::make_vertex_array();
};

class Shadows {
 public:
  /// lights at a time; those that are not cast are dark
  static constexpr int most = lights_at_once;

  /// `size` of the maps in pixels, `count` of them
  Shadows(const Programs& programs, int size, int count = most);

  /// Draws the maps of these lights, at most `count`. Bodies that are seen through stop a part of
  /// the lights.
  void cast(const DrawList& list, const LoadedCorners& loaded, std::span<const Light> lights);
  /// The lights just cast, for a program that has `light_part`; takes texture unit 0.
  void give(unsigned program) const;

 private:
  const Programs& programs_;
  int size_;
  gl::Object maps_, framebuffer_;
  std::vector<Eigen::Matrix3f> axes_;
  std::vector<Eigen::Vector3f> to_light_;
  std::vector<float> radiance_, share_;
};

/// The corners of a list read this buffer of light at a place of `surface_vertex`.
void read_light(const LoadedCorners& loaded, int place, unsigned light);

/// Light at each corner, a buffer of four numbers each: front and back, and how open each lies.
/// throws Error when there are more corners than a texture holds
/// throws Stopped
gl::Object gather(const Programs& programs, const DrawList& list, const LoadedCorners& loaded,
                  Shadows& shadows, const std::vector<Light>& lights, const Progress& progress);

}  // namespace clench
