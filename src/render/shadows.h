// What of a scene each light reaches: maps of depth, and light gathered at corners.
#pragma once
#include <span>

#include "clench/render/draw_list.h"
#include "clench/render/gl_objects.h"
#include "clench/render/lights.h"

namespace clench {

/// A draw list on the graphics card, in the order of its indices.
struct LoadedList {
  explicit LoadedList(const DrawList& list);
  gl::Object array, corners, indices;
};

/// One triangle over all of the framebuffer; reads nothing but the program.
class Cover {
 public:
  void draw(unsigned program) const;

 private:
  gl::Object array_ = gl::make_vertex_array();
};

/// What every program begins with: the count of lights that it takes at a time.
std::string shader_head(int lights);

class Shadows {
 public:
  static constexpr int most = 12;  ///< lights at a time; those that are not cast are dark

  /// `size` of the maps in pixels
  Shadows(const DrawList& list, const LoadedList& loaded, int size);

  /// Draws the maps of these lights. Bodies that are seen through stop a part of the lights.
  void cast(std::span<const Light> lights);
  /// The lights just cast, for a program that has `light_part`; takes texture unit 0.
  void give(unsigned program) const;

 private:
  const DrawList& list_;
  const LoadedList& loaded_;
  int size_;
  gl::Object program_, maps_, framebuffer_;
  std::vector<Eigen::Matrix3f> axes_;
  std::vector<Eigen::Vector3f> to_light_;
  std::vector<float> radiance_, share_;
};

/// Light at each corner, as `surface_vertex` reads it: front and back, and how open each lies.
/// throws Error when there are more corners than a texture holds
/// throws Stopped
gl::Object gather(const DrawList& list, Shadows& shadows, const std::vector<Light>& lights,
                  const Progress& progress);

}  // namespace clench
