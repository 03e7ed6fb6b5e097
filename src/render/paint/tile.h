// A large picture is drawn tile by tile, which bounds the memory that it takes.
#pragma once
#include <vector>

#include "clench/render/figure/picture.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"

namespace clench {

/// A part of the picture, from its lower left corner, and a border around it that is drawn but not
/// kept [pixels].
struct Tile {
  int x, y, width, height, border = 0;
  int drawn_width() const { return width + 2 * border; }
  int drawn_height() const { return height + 2 * border; }
};

/// All tiles of a picture, wide enough a border for its lines.
std::vector<Tile> tiles_of(const RenderOptions& options);

/// Everything in clip coordinates to the part that a tile shows, shifted by parts of a pixel.
Eigen::Matrix4d crop_to(const Tile& tile, const RenderOptions& options,
                        const Eigen::Vector2d& shift = Eigen::Vector2d::Zero());

/// Depths between which all of a scene and its floor lie, seen from an eye in scene units.
Eigen::Vector2d depth_range(const Eye& eye);

/// Where rays come from, for shading: a perspective eye, or a point far behind an orthographic one;
/// scene units.
Eigen::Vector3f shading_eye(const Eye& eye);

/// Of the framebuffer that is bound, which holds the tile with its border from `first` on: red, green,
/// blue, alpha.
void read_tile(const Tile& tile, Picture& out, const Eigen::Vector2i& first = {0, 0});

/// Size of a map of shadows, its texels about as wide as the pixels of the picture: a power of two
/// times `min_size`, at most `max_size`.
int map_size_for(const RenderOptions& options, int min_size, int max_size);

/// throws  Error when OpenGL has met a fault
void check_driver();

/// Of this size, with alpha unless a studio is behind.
Picture empty_picture(const RenderOptions& options);

}  // namespace clench
