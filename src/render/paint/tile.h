// Tiles of a large picture, drawn one after the other to limit memory.
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

/// All tiles of a picture, with borders wide enough for its lines.
std::vector<Tile> tiles_of(const RenderOptions& options);

/// Maps clip coordinates of the picture to those of a tile, shifted by fractions of a pixel.
Eigen::Matrix4d crop_to(const Tile& tile, const RenderOptions& options,
                        const Eigen::Vector2d& shift = Eigen::Vector2d::Zero());

/// Near and far depths that enclose a scene and its floor, seen from an eye in scene units.
Eigen::Vector2d depth_range(const Eye& eye);

/// Origin of view rays, for shading: a perspective eye, or a point far behind an orthographic one;
/// scene units.
Eigen::Vector3f shading_eye(const Eye& eye);

/// Reads the tile, without its border, from the bound framebuffer, in which it begins at `first`
/// including the border: red, green, blue, alpha.
void read_tile(const Tile& tile, Picture& out, const Eigen::Vector2i& first = {0, 0});

/// Size of a shadow map, with texels about as wide as the pixels of the picture: a power of two
/// times `min_size`, at most `max_size`.
int map_size_for(const RenderOptions& options, int min_size, int max_size);

/// throws  Error if OpenGL has reported one
void check_driver();

/// A picture of this size, with alpha unless the backdrop is a studio.
Picture empty_picture(const RenderOptions& options);

}  // namespace clench
