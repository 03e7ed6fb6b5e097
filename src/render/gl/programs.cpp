#include "clench/render/gl/programs.h"

#include "clench/base/error.h"
#include "clench/render/gl/draft_shaders.h"
#include "clench/render/gl/edge_shader.h"
#include "clench/render/gl/shaders.h"

namespace clench {

static std::string lights(int count) { return fmt::format("#define LIGHTS {}\n", count); }

Programs::Programs() {
  using namespace shaders;
  const std::string head = lights(lamps_per_sample), light = light_part, shading = shade_part,
                    backdrop = backdrop_part, curve = curve_part, draft_part = draft_light_part,
                    skin = skin_part;
  first = gl::make_program(head, surface_vertex, skin + seen_fragment);
  shade = gl::make_program(head, cover_vertex, light + shading + backdrop + shade_fragment);
  mark = gl::make_program(head, surface_vertex, shading + mark_fragment);
  through = gl::make_program(head, surface_vertex, skin + shading + through_fragment);
  outline = gl::make_program(head, cover_vertex, outline_fragment);
  add = gl::make_program(head, cover_vertex, add_fragment);
  develop = gl::make_program(head, cover_vertex, curve + develop_fragment);
  shadow = gl::make_program(lights(1), shadow_vertex, depth_fragment);
  gather = gl::make_program(lights(lights_at_once), cover_vertex, light + gather_fragment);
  smooth = gl::make_program("", cover_vertex, smooth_fragment);
  const std::string shown = draft_curve_part + draft_part,
                    draft_body = shown + skin + draft_fragment;
  draft = gl::make_program("", draft_vertex, draft_body);
  draft_glass = gl::make_program("#define GLASS\n", draft_vertex, draft_body);
  draft_marks = gl::make_program("#define MARKS\n", draft_vertex, draft_body);
  draft_floor = gl::make_program("", draft_vertex, backdrop + shown + draft_floor_fragment);
  draft_behind =
      gl::make_program("", cover_vertex, backdrop + draft_curve_part + draft_behind_fragment);
  draft_shadow = gl::make_program("", draft_shadow_vertex, depth_fragment);
  draft_outline = gl::make_program("", draft_vertex, draft_seen_fragment);
  edges = gl::make_program("", cover_vertex, edge_fragment);
}

unsigned Programs::on_image(unsigned program) const {
  using namespace shaders;
  const bool of_paper = program == first || program == through,
             of_draft = program == draft || program == draft_glass;
  if (!of_paper && !of_draft) return 0;
  gl::Object& found = on_image_[program];
  if (found) return found;
  const std::string skin = skin_part, head = "#define SKIN\n";
  if (of_paper)
    found = gl::make_program(
        lights(lamps_per_sample) + head, surface_vertex,
        program == first ? skin + seen_fragment : skin + shade_part + through_fragment);
  else
    found =
        gl::make_program(program == draft ? head : head + "#define GLASS\n", draft_vertex,
                         std::string(draft_curve_part) + draft_light_part + skin + draft_fragment);
  return found;
}

}  // namespace clench
