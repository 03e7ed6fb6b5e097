#include "clench/render/paint/paper_scene.h"

#include <algorithm>

#include "clench/render/view/lights.h"

namespace clench {

namespace {

constexpr int room_lights_per_sample = 16, min_room_lights = 24, max_room_lights = 512;
constexpr int room_map_size = 256;  // [pixels]
constexpr double max_cast = 12e6;   // triangles in all shadow maps of the room
constexpr int heavy_lamp = 4;       // lights of a lamp on transparent surfaces of heavy scenes

// a small picture shows fewer details of the light, and needs fewer lights
int room_lights(const RenderOptions& options, size_t casters) {
  const double fine = std::clamp(std::max(options.width, options.height) / 640.0, 0.25, 1.0);
  const double afford =
      max_cast * options.samples / 8 / static_cast<double>(std::max<size_t>(casters, 1));
  const double count = std::min(options.samples * room_lights_per_sample * fine, afford);
  return static_cast<int>(std::clamp<double>(count, min_room_lights, max_room_lights));
}

}  // namespace

PaperScene::PaperScene(const Programs& programs, const Scene& scene)
    : programs_(programs),
      list_(make_draw_list(scene)),
      loaded_(list_.corners, list_.indices),
      textures_(list_.textures),
      coarse_(programs, room_map_size) {
  for (const auto* batches : {&list_.solid, &list_.clear})
    for (const Batch& batch : *batches) casters_ += batch.caster_count / 3;
}

size_t PaperScene::bytes() const {
  // in memory and on the card, including light
  return list_.corners.size() * (2 * sizeof(Corner) + 32) +
         2 * list_.indices.size() * sizeof(uint32_t) + textures_.bytes();
}

void PaperScene::light_room(const RenderOptions& options) {
  const int count = room_lights(options, casters_);
  if (count == room_count_) return;
  const std::vector<Light> lights = place_room(count);
  room_ = gather(programs_, list_, loaded_, coarse_, lights, options.progress);
  room_count_ = count;
  open_room_ = light_on_floor(lights);
  read_light(loaded_, 3, room_);
}

void PaperScene::light_lamp(const Eigen::Matrix3d& axes, const Progress& progress) {
  if (lamp_axes_ == axes) return;
  lamp_ = gather(programs_, list_, loaded_, coarse_,
                 place_lamp(axes, heavy() ? heavy_lamp : Shadows::most), progress);
  lamp_axes_ = axes;
  read_light(loaded_, 4, lamp_);
}

}  // namespace clench
