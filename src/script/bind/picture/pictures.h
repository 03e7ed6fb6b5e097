// Pictures, plots and cameras.
#pragma once
#include <memory>
#include <string>

#include "clench/render/figure/drawing.h"
#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"
#include "clench/render/view/render_options.h"
#include "clench/scene/scene.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/table.h"

namespace clench {

extern const Library film_library, chart_library, plot_library, render_library;

// --- picture: result of clench.render. ---

/// Reads size, samples and the camera, which must be all remaining options, and draws.
Picture draw_scene(lua_State* L, Table& options, Scene scene);

/// Reads how bodies are drawn.
DrawStyle read_style(Table& options);

/// Logs the reason why pictures have no letters, if so, once per Lua state.
void warn_without_letters(lua_State* L, const Font& font);

extern const Class picture_class;

template <>
inline constexpr const Class* script_class<Picture> = &picture_class;

inline size_t owned_bytes(const Picture& picture) {
  return picture.pixels.capacity() + picture.alpha.capacity();
}

// --- plot: numbers over numbers as a figure. ---

struct PlotHandle {
  std::shared_ptr<const Drawing> drawing;
};

extern const Class plot_class;

template <>
inline constexpr const Class* script_class<PlotHandle> = &plot_class;

inline size_t owned_bytes(const PlotHandle& handle) {
  return handle.drawing->items.size() * (sizeof(Drawing::Item) + 4 * sizeof(Eigen::Vector2f));
}

// --- cameras of worlds. ---

/// The pose of a camera at eye that looks at target: along its -z, with y up.
/// throws Error that begins with the subject, if eye and target coincide, or up is along the view
Pose camera_pose(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                 const Eigen::Vector3d& up, const std::string& subject);
int get_camera(lua_State* L);
int set_camera(lua_State* L);

}  // namespace clench
