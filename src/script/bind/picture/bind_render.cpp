#include <cmath>
#include <memory>
#include <utility>

#include "clench/base/convert.h"
#include "clench/render/renderer.h"
#include "clench/render/view/pick.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/picture/read_scene.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

static Eye read_eye(Table& options, const Eye& from) {
  Eye eye = from;
  eye.eye = options.vec3("eye", from.eye);
  eye.target = options.vec3("target", from.target);
  eye.up = options.vec3("up", from.up);
  eye.field_of_view = options.number("field_of_view", from.field_of_view);
  const Eigen::Vector3d back = eye.eye - eye.target;
  // a default up vector along the view is replaced
  if (options.has("up") && !(eye.up.cross(back).norm() > 1e-9 * back.norm() * eye.up.norm()))
    fail("{}: expected different eye and target, and up in another direction than the view",
         options.subject());
  return eye;
}

void warn_without_letters(lua_State* L, const Font& font) {
  static const char told = 0;
  if (!font.fault().empty()) warn_once(L, &told, font.fault());
}

static void read_samples(Table& options, RenderOptions& rendering) {
  if (rendering.quality == Quality::paper) {
    rendering.samples = options.integer("samples", rendering.samples);
    return;
  }
  const int samples = options.integer("samples", 1);
  for (int scale = 1; scale <= rendering.max_draft_scale; ++scale)
    if (samples == scale * scale) rendering.draft_scale = scale;
  if (samples != rendering.draft_scale * rendering.draft_scale)
    fail("{}: samples: expected 1, 4, 9 or 16 of a draft, got {}", options.subject(), samples);
}

DrawStyle read_style(Table& options) {
  return options.choice("style",
                        {{"faces", DrawStyle::faces},
                         {"wireframe", DrawStyle::wireframe},
                         {"points", DrawStyle::points}},
                        DrawStyle::faces);
}

static RenderOptions read_rendering(Table& options) {
  RenderOptions rendering;
  const auto size =
      options.has("size") ? options.numbers("size", 2) : std::vector<double>{1280, 960};
  for (const double n : size)
    if (n != std::floor(n) || !(n >= rendering.min_size && n <= rendering.max_size))
      fail("{}: size: expected whole numbers of pixels, {} to {}, got {}", options.subject(),
           rendering.min_size, rendering.max_size, n);
  rendering.width = floor_int(size[0]);
  rendering.height = floor_int(size[1]);
  rendering.quality = options.choice(
      "quality", {{"paper", Quality::paper}, {"draft", Quality::draft}}, Quality::paper);
  read_samples(options, rendering);
  rendering.backdrop = options.choice("background",
                                      {{"studio", Backdrop::studio},
                                       {"white", Backdrop::white},
                                       {"transparent", Backdrop::transparent}},
                                      Backdrop::studio);
  rendering.style = read_style(options);
  if (rendering.style != DrawStyle::faces && rendering.quality != Quality::draft)
    fail("{}: style: expected 'faces' unless the quality is 'draft'", options.subject());
  rendering.outline = options.number("outline", rendering.outline);
  rendering.letters = options.number("letters", rendering.letters);
  return rendering;
}

// height of an orthographic view [m]: true keeps the framed height, or that of a camera at its
// target
static double read_ortho(lua_State* L, Table& options, const Eye& eye) {
  const int type = options.push("orthographic");
  const double height = lua_tonumber(L, -1);
  const bool on = lua_toboolean(L, -1);
  if (type != LUA_TNIL && type != LUA_TBOOLEAN &&
      (type != LUA_TNUMBER || !(height > 0 && std::isfinite(height))))
    fail_expected(options.what("orthographic"), "true, false, or a height > 0 in meters", -1);
  lua_pop(L, 1);
  if (type == LUA_TNUMBER) return height;
  if (!on) return 0;
  if (eye.ortho_height > 0) return eye.ortho_height;
  return 2 * (eye.eye - eye.target).norm() * std::tan(eye.field_of_view / 2);
}

namespace {

struct View {
  RenderOptions rendering;
  Eye eye;
};

constexpr const char* camera_keys[] = {"eye", "target", "up", "field_of_view", "orthographic"};

// a partly specified camera is completed from the one that frames everything
Eye read_camera(lua_State* L, Table& options, const Scene& scene, const RenderOptions& rendering) {
  const int parts =
      options.has("eye") + options.has("target") + options.has("up") + options.has("field_of_view");
  options.push("orthographic");
  const bool ortho = lua_toboolean(L, -1);
  lua_pop(L, 1);
  const double aspect = static_cast<double>(rendering.width) / rendering.height;
  const Eye framed = parts == 4 ? Eye{} : kept<Renderer>(L).frame_all(scene, aspect, ortho);
  Eye eye = read_eye(options, framed);
  // with another target, the height is that at the target
  if (options.has("eye") || options.has("target") || options.has("field_of_view"))
    eye.ortho_height = 0;
  eye.ortho_height = read_ortho(L, options, eye);
  return eye;
}

// reads size, quality and the camera, given as a table or as single options; rejects all other
// options
View read_view(lua_State* L, Table& options, const Scene& scene) {
  View view{read_rendering(options), {}};
  check(view.rendering);
  if (options.has("camera")) {
    for (const char* key : camera_keys)
      if (options.has(key))
        fail("{}: expected either camera or {}, got both", options.subject(), key);
    options.push("camera");
    Table camera(L, lua_gettop(L), options.what("camera").text());
    view.eye = read_camera(L, camera, scene, view.rendering);
    camera.done();
    lua_pop(L, 1);
  } else {
    view.eye = read_camera(L, options, scene, view.rendering);
  }
  options.done();
  return view;
}

// a table that render takes as options
int push_view(lua_State* L, const Eye& eye) {
  push_record(L, {{"eye", eye.eye},
                  {"target", eye.target},
                  {"up", eye.up},
                  {"field_of_view", eye.field_of_view}});
  if (eye.ortho_height > 0) {
    lua_pushnumber(L, eye.ortho_height);
    lua_setfield(L, -2, "orthographic");
  }
  return 1;
}

}  // namespace

Picture draw_scene(lua_State* L, Table& options, Scene scene) {
  View view = read_view(L, options, scene);
  scene.eye = view.eye;
  const Font font;
  if (!scene.labels.empty() || !scene.caption.empty()) warn_without_letters(L, font);
  const Watching watching(L);
  view.rendering.progress = watching.progress();
  Picture picture = kept<Renderer>(L).draw(scene, view.rendering, font);
  picture.scene = std::make_shared<const Scene>(std::move(scene));
  return picture;
}

static int render_draw(lua_State* L) {
  const World* world = check_object<WorldHandle>(L, 1, "world").world.get();
  Table options(L, 2);
  Scene scene = read_scene(L, options, {&world, 1});
  // the bodies that can be picked in the picture
  push_object(L, draw_scene(L, options, std::move(scene)), 1);
  lua_pushvalue(L, 1);
  lua_setiuservalue(L, -2, 1);
  return 1;
}

// a world, or a list of states of one
static std::vector<const World*> check_states(lua_State* L, int i) {
  if (!lua_istable(L, i))
    return {check_object<WorldHandle>(L, i, "world or list of worlds").world.get()};
  std::vector<const World*> states;
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, i));
  if (count == 0) fail("{}: worlds: expected at least one, got none", subject(L));
  for (lua_Integer k = 1; k <= count; ++k) {
    lua_rawgeti(L, i, k);
    const auto* world = to<WorldHandle>(L, -1);
    if (!world) fail("{}: worlds[{}]: expected a world, got {}", subject(L), k, described(L, -1));
    states.push_back(world->world.get());
    lua_pop(L, 1);
  }
  return states;
}

static int choose_camera(lua_State* L) {
  const std::vector<const World*> states = check_states(L, 1);
  Table options(L, 2);
  const Scene scene = read_scene(L, options, states);
  return push_view(L, read_view(L, options, scene).eye);
}

static int get_picture_camera(lua_State* L) {
  const auto& eye = self<Picture>(L).eye;
  return eye ? push_view(L, *eye) : push_nil(L);
}

static int render_save(lua_State* L) {
  const Picture& picture = self<Picture>(L);
  const std::string path = check_output(L, 2);
  if (!path.ends_with(".png"))
    fail("{}: expected a name that ends in .png, got '{}'", subject(L), path);
  save_png(picture, path);
  return 0;
}

// the pixel given by arguments 2 and 3, from 0, row by row
static size_t check_pixel(lua_State* L, const Picture& p) {
  const int x = check_int(L, 2, "x"), y = check_int(L, 3, "y");
  if (x < 1 || x > p.width || y < 1 || y > p.height)
    fail("{}: expected 1..{}, 1..{}, got {}, {}", subject(L), p.width, p.height, x, y);
  return static_cast<size_t>(y - 1) * p.width + (x - 1);
}

static int pixel(lua_State* L) {
  const Picture& p = self<Picture>(L);
  const size_t at = 3 * check_pixel(L, p);
  for (int k = 0; k < 3; ++k) push(L, static_cast<int>(p.pixels[at + k]));
  return 3;
}

static int alpha(lua_State* L) {
  const Picture& p = self<Picture>(L);
  const size_t at = check_pixel(L, p);
  return push(L, p.alpha.empty() ? 255 : static_cast<int>(p.alpha[at]));
}

static const char* kind_word(Shown::Kind kind) {
  switch (kind) {
    case Shown::Kind::body:
      return "body";
    case Shown::Kind::contact:
      return "contact";
    case Shown::Kind::site:
      return "patch";
    case Shown::Kind::approach:
      return "approach";
    case Shown::Kind::force:
      return "force";
    case Shown::Kind::floor:
      return "floor";
    case Shown::Kind::nothing:
      break;
  }
  return "other";
}

// a field of the table on top of the stack: a body that still exists in the world
static void set_picked_body(lua_State* L, const char* key, const WorldHandle* world, Id<Body> id) {
  if (!world || !id || !world->world->alive(id)) return;
  push_object(L, BodyHandle{world->world, id});
  lua_setfield(L, -2, key);
}

static int pick_pixel(lua_State* L) {
  const Picture& p = self<Picture>(L);
  check_pixel(L, p);
  if (!p.scene || !p.eye) fail("{}: expected a picture of a world, got a figure", subject(L));
  const PicturePlace place{.x = check_int(L, 2, "x") - 0.5,
                           .y = check_int(L, 3, "y") - 0.5,
                           .width = static_cast<double>(p.width),
                           .height = static_cast<double>(p.height)};
  const auto found = pick(*p.scene, *p.eye, place);
  if (!found) return push_nil(L);
  lua_getiuservalue(L, 1, 1);
  const auto* world = to<WorldHandle>(L, -1);
  push_record(L, {{"point", found->p_W}, {"normal", found->n_W}, {"distance", found->distance}});
  lua_pushstring(L, kind_word(found->shown.kind));
  lua_setfield(L, -2, "kind");
  set_picked_body(L, "body", world, found->shown.body);
  set_picked_body(L, "other", world, found->shown.other);
  return 1;
}

static std::string picture_text(const Picture& p) {
  return fmt::format("picture of {} x {} pixels", p.width, p.height);
}

static const Entry render_functions[] = {
    {"render", guarded<render_draw>, R"(
Draws a world: robots, objects, obstacles, and the friction cones where robots touch objects; with `patches`, the patches of
all soft contacts instead of the cones, which would cover them. The camera looks at the objects that robots touch and the
links of those robots, or at everything, unless it is given completely or in part. The same world gives the same bytes.
It needs EGL and OpenGL, but no display. Data of a picture are cached for the next one, which is drawn faster.
@param world world  world to draw
@param options? table  the picture, the camera, and what is shown
@option size? integer[] [pixels] = {1280, 960}  width and height, 16 to 8192
@option quality? "paper"|"draft" = "paper"  draft: a fraction of the time
@option background? "studio"|"white"|"transparent" = "studio"  white and transparent have the shadow on the floor
@option outline? number [pixels, 0 to 32] = 0  width of lines around bodies
@option letters? number [pixels, 0 to 200] = 0  height of capital letters; 0: a fraction of the height of the picture
@option samples? integer [1 to 256]  per pixel, 8 by default; of a draft 1 (default), 4, 9 or 16
@option eye? vec3 [m]  position of the camera; the parts of the camera that are not given are chosen
@option target? vec3 [m]  point at which it looks
@option up? vec3  direction that is up in the picture
@option field_of_view? number [rad, > 0]  vertical
@option orthographic? boolean|number [m, > 0] = false  true, or the height that is shown
@option camera? table  these five in a table, such as the camera of a picture
@option camera.eye? vec3 [m]  position of the camera
@option camera.target? vec3 [m]  point at which it looks
@option camera.up? vec3  direction that is up in the picture
@option camera.field_of_view? number [rad, > 0]  vertical
@option camera.orthographic? boolean|number [m, > 0] = false  true, or the height that is shown
@option frame? "contacts"|"all" = "contacts"  what a camera that is not given looks at
@option contacts? boolean  true: friction cones; by default true without patches
@option cones? "apart"|"equal"|"friction"|"force" = "apart"  their sizes: apart: lowered where they are close together; friction, force: in proportion to friction or normal force
@option cone_height? number [m, > 0]  of the highest cone
@option patches? boolean = false  true: patches of soft contacts
@option approach? boolean = false  true: an arrow from the approach point of each robot that closes, along its direction
@option ground? boolean|number [m] = true  the floor; or its height
@option transparent_objects? boolean = true  true: objects are transparent
@option file_colors? boolean = true  false: colors by the kind of body
@option forces? table[]  those of grasp:contact_forces, as arrows with their tips at the contacts, labelled in newtons, through transparent links; the caption states the largest
@option forces.contact contact  where it acts
@option forces.force vec3 [N]  on the object, in the world
@option force_scale? number [m/N, > 0]  length of the arrows, by default so that the longest has 0.6 of the object's largest radius
@option arrows? boolean = true  false: forces only size the cones
@option ghosts? table[]  robots that are drawn in addition, transparent
@option ghosts.robot robot  of any world, such as a clone
@option ghosts.color? number[]  red, green and blue, each from 0 to 1; green by default
@option wrenches? table[]  forces and torques as arrows from a point: 5 mm/N and 50 mm/(N m), at most 200 mm long
@option wrenches.point vec3 [m]  in the world
@option wrenches.force? vec3 [N] = {0, 0, 0}  in the world
@option wrenches.torque? vec3 [N m] = {0, 0, 0}  in the world
@option style? "faces"|"wireframe"|"points" = "faces"  of bodies; others than faces are for drafts
@return picture
@effect long
> clench.render(world, {size = {64, 48}})  --> picture of 64 x 48 pixels
> plain = clench.render(world, {size = {64, 48}, quality = "draft"})
> held = grasp:contact_forces{load = {0, 0, -3, 0, 0, 0}}
> clench.render(world, {size = {64, 48}, quality = "draft", forces = held.forces}) == plain  --> false
> clench.render(world, {size = {64, 48}, quality = "draft", approach = true}) == plain  --> false
> bare = clench.render(world, {size = {64, 48}, quality = "draft", patches = true, contacts = false})
> clench.render(world, {size = {64, 48}, quality = "draft", patches = true}) == bare  --> true
> clench.render(world, {size = {64, 48}, background = "white", orthographic = true, outline = 1})  --> picture of 64 x 48 pixels
> clench.render(world, {size = {64, 48}, quality = "draft", camera = plain.camera}) == plain  --> true
> clench.render(world, {camera = plain.camera, up = {0, 1, 0}})  --> error: expected either camera or up, got both
> clench.render(world, {cones = "force"})  --> error: 'force' needs the option forces
> copy = world:clone()
> copy.robots[1].pose = clench.pose {xyz = {0, 0, 0.02}} * copy.robots[1].pose
> clench.render(world, {size = {64, 48}, quality = "draft", ghosts = {{robot = copy.robots[1]}}}) == plain  --> false
> clench.render(world, {size = {64, 48}, quality = "draft", wrenches = {{point = flask.pose.position, force = {0, 0, 20}}}}) == plain  --> false
> clench.render(world, {size = {64, 48}, quality = "draft", style = "wireframe"}) == plain  --> false
> clench.render(world, {style = "points"})  --> error: style: expected 'faces' unless the quality is 'draft'
> clench.render(world, {ghosts = {{robot = flask}}})  --> error: ghosts[1]: robot: expected a robot
> clench.render(world, {forces = {{force = {0, 0, 1}}}})  --> error: forces[1]: contact: expected a contact, got nothing)"},
    {"camera", guarded<choose_camera>, R"(
The camera that clench.render chooses with the same options; for several states of a world, one camera for all of them, as for a film: it
shows the objects that robots touch in some state, and those robots from the palm outward; if nothing is touched, everything.
@param worlds world|world[]  a list: states of one world, such as clones of it
@param options? table  those of clench.render
@like clench.render
@return table camera  {eye: vec3, target: vec3, up: vec3, field_of_view: number, orthographic?: number}, options of clench.render
@effect reads
> c = clench.camera(world, {size = {64, 48}})
> c.eye == clench.render(world, {size = {64, 48}, quality = "draft"}).camera.eye  --> true
> clench.camera({world, world:clone()}, {size = {64, 48}}).eye == c.eye  --> true
> clench.camera {}  --> error: worlds: expected at least one, got none)"},
};

static const Entry render_fields[] = {
    {"camera", guarded<get_picture_camera>, R"(
The camera of the picture, given or chosen, as options of clench.render; nil for figures. The same world drawn with it gives the same
bytes.
@type table?  {eye: vec3, target: vec3, up: vec3, field_of_view: number, orthographic?: number}  [m], [rad]; orthographic: height that is shown [m]
> p = clench.render(world, {size = {64, 48}, quality = "draft"})
> c = p.camera
> c.size, c.quality = {64, 48}, "draft"
> clench.render(world, c) == p  --> true
> clench.sheet{pictures = {p}}.camera  --> nil)"},
    {"width", getter<[](const Picture& x) { return x.width; }>, R"(
Its width.
@type integer  pixels
> clench.render(world, {size = {64, 48}, quality = "draft"}).width  --> 64)"},
    {"height", getter<[](const Picture& x) { return x.height; }>, R"(
Its height.
@type integer  pixels
> clench.render(world, {size = {64, 48}, quality = "draft"}).height  --> 48)"},
};

static const Entry render_methods[] = {
    {"save", guarded<render_save>, R"(
Writes a PNG file, with alpha if the background is transparent.
@param path string  file to write, .png
@effect files
> clench.render(world, {size = {64, 48}, quality = "draft"}):save("no/such/folder/a.png")  --> error: no/such/folder/a.png
> clench.render(world, {size = {64, 48}, quality = "draft"}):save("a.jpg")  --> error: .png)"},
    {"pixel", guarded<pixel>, R"(
Red, green and blue of a pixel, 0 to 255; (1, 1) is the upper left.
@param x index  column, from the left
@param y index  row, from the top
@return integer red
@return integer green
@return integer blue
@effect reads
> select("#", clench.render(world, {size = {64, 48}, quality = "draft"}):pixel(1, 1))  --> 3)"},
    {"alpha", guarded<alpha>, R"(
Opacity of a pixel, 0 to 255: less than 255 where a transparent background shows through; (1, 1) is the upper left.
@param x index  column, from the left
@param y index  row, from the top
@return integer alpha
@effect reads
> clench.render(world, {size = {64, 48}, quality = "draft"}):alpha(1, 1)  --> 255
> clench.render(world, {size = {64, 48}, quality = "draft", background = "transparent"}):alpha(1, 1)  --> 0)"},
    {"pick", guarded<pick_pixel>, R"(
The nearest surface under a pixel of a picture of a world, in the state in which it was drawn; transparent bodies count. nil if
there is none. `body` and `other` are nil if they have been removed since.
@param x index  column, from the left
@param y index  row, from the top
@return table? picked  {kind: string, body?: body, other?: body, point: vec3, normal: vec3, distance: number}  kind: "body"; "contact" (a cone) or "patch", where body is touched by other; "approach", where body is the base of the robot; "force"; "floor"; or "other"; point: [m]; normal: unit, to the side of the camera; distance: from the camera [m]
@effect reads
> place = world.objects[1].pose.position
> p = clench.render(world, {size = {64, 48}, quality = "draft", camera = {eye = place + clench.vec3(0, 0, 1), target = place, up = {1, 0, 0}}})
> p:pick(32, 24).body.name == world.objects[1].name  --> true
> p:pick(32, 24).normal.z > 0  --> true
> p:pick(65, 1)  --> error: expected 1..64, 1..48, got 65, 1
> clench.sheet{pictures = {p}}:pick(1, 1)  --> error: expected a picture of a world, got a figure)"},
};

static const Entry render_operators[] = {
    {"__tostring", method<picture_text>, ""},
    {"__eq", equality<Picture>, ""},
};

const Library render_library{.name = "clench", .doc = "", .functions = render_functions};

const Class picture_class{.name = "picture",
                          .variable = "picture",
                          .doc =
                              "A picture: red, green and blue, 8 bits each, and how much each "
                              "pixel covers. `==` compares every pixel.",
                          .fields = render_fields,
                          .methods = render_methods,
                          .operators = render_operators};

}  // namespace clench
