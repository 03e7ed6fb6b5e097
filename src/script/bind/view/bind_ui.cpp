#include <algorithm>
#include <cmath>
#include <cstring>

#include "clench/base/hash.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/picture/read_scene.h"
#include "clench/script/bind/view/ui_frame.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/viewer/gui.h"

namespace clench {

namespace {

// --- frames ---

int make_ui(lua_State* L) {
  Table options(L, 1);
  std::vector<double> size = {1070, 937};
  if (options.has("size")) size = options.numbers("size", 2);
  GuiStyle style;
  style.dark = options.boolean("dark", false);
  style.scale = options.number("scale", 1);
  const bool window = options.boolean("window", false);
  const std::string title = options.string("title", "Clench");
  options.done();
  const auto pixels = [](double n) { return static_cast<int>(std::clamp(n, -1.0, 1e6)); };
  const int width = pixels(size[0]), height = pixels(size[1]);
  std::unique_ptr<Screen> screen =
      window ? make_window(width, height, title) : make_offscreen(width, height);
  if (window && !options.has("scale")) style.scale = std::clamp(screen->scale(), 0.25, 8.0);
  return push_object(L, UiHandle{std::make_shared<Gui>(std::move(screen), style)});
}

int ui_frame(lua_State* L) {
  Gui& gui = open_gui(L);
  UiHandle& handle = self<UiHandle>(L);
  if (handle.in_frame) fail("{}: a frame is open already", subject(L));
  const double dt = check_number(L, 2, "dt");
  const BodyOf body(L, 3);
  gui.begin(dt);
  handle.in_frame = true;
  try {
    body();
  } catch (...) {
    handle.in_frame = false;
    try {
      gui.end();
    } catch (const Error&) {
      // the error of the body is reported
    }
    throw;
  }
  handle.in_frame = false;
  gui.end();
  return 0;
}

ScenePane read_pane(Table& options) {
  using Part = ScenePane::Part;
  using Channels = std::array<bool, 3>;
  ScenePane pane;
  pane.part = options.choice(
      "part", {{"all", Part::all}, {"left", Part::left}, {"right", Part::right}}, Part::all);
  pane.channels = options.choice("channels",
                                 {{"all", Channels{true, true, true}},
                                  {"red", Channels{true, false, false}},
                                  {"cyan", Channels{false, true, true}}},
                                 Channels{true, true, true});
  pane.style = read_style(options);
  return pane;
}

int ui_show(lua_State* L) {
  Gui& gui = framed_gui(L);
  const World* world = check_object<WorldHandle>(L, 2, "world").world.get();
  Table options(L, 3);
  Eye eye;
  const bool given = options.has("eye");
  if (given) {
    eye.eye = options.vec3("eye");
    eye.target = options.vec3("target");
    eye.up = options.vec3("up", eye.up);
    eye.field_of_view = options.number("field_of_view", eye.field_of_view);
    eye.ortho_height = options.number("orthographic", 0);
    eye.aside = options.number("aside", 0);
  }
  const ScenePane pane = read_pane(options);
  Scene scene = read_scene(L, options, {&world, 1});
  options.done();
  if (!given) eye = gui.frame_all(scene);
  scene.eye = eye;
  gui.show(std::move(scene), eye, pane);
  return 0;
}

int ui_close(lua_State* L) {
  UiHandle& handle = self<UiHandle>(L);
  if (handle.in_frame) fail("{}: a frame is open", subject(L));
  handle.gui.reset();
  return 0;
}

int ui_input(lua_State* L) {
  Gui& gui = open_gui(L);
  Table options(L, 2);
  using Kind = InputEvent::Kind;
  InputEvent event;
  event.kind = options.choice("kind",
                              {{"move", Kind::move},
                               {"button", Kind::button},
                               {"wheel", Kind::wheel},
                               {"key", Kind::key},
                               {"text", Kind::text},
                               {"close", Kind::close},
                               {"drop", Kind::drop}},
                              Kind::move);
  event.x = options.number("x", 0), event.y = options.number("y", 0);
  constexpr double max_position = 1e6;  // [pixels]
  if (!(std::abs(event.x) <= max_position && std::abs(event.y) <= max_position))
    fail("{}: x and y: expected -1e6 to 1e6 pixels, got {} and {}", options.subject(), event.x,
         event.y);
  event.code = options.integer("code", 0);
  event.down = options.boolean("down", false);
  if (options.has("time")) event.time = options.number("time");
  event.text = options.string("text", "");
  options.done();
  gui.add(std::move(event));
  return 0;
}

int get_items(lua_State* L) {
  return push_list_of(L, open_gui(L).items(), [&](const GuiItem& item) {
    push_list(L, 0, 8);
    set_field(L, "label", item.label);
    set_field(L, "kind", item.kind);
    set_field(L, "window", item.window);
    set_field(L, "x", item.rect.x), set_field(L, "y", item.rect.y);
    set_field(L, "width", item.rect.width), set_field(L, "height", item.rect.height);
    set_field(L, "enabled", item.enabled);
  });
}

int get_pressed(lua_State* L) {
  return push_list_of(L, open_gui(L).pressed(), [&](const KeyPress& press) {
    push_list(L, 0, 4);
    set_field(L, "key", press.key);
    set_field(L, "ctrl", press.ctrl);
    set_field(L, "shift", press.shift);
    set_field(L, "alt", press.alt);
  });
}

// the mouse in this frame
int get_mouse(lua_State* L) {
  const Gui& gui = open_gui(L);
  const auto at = gui.mouse(), by = gui.mouse_move();
  push_list(L, 0, 12);
  set_field(L, "x", at[0]), set_field(L, "y", at[1]);
  set_field(L, "dx", by[0]), set_field(L, "dy", by[1]);
  set_field(L, "wheel", gui.wheel());
  const char* names[] = {"left", "right", "middle"};
  for (int button = 0; button < 3; ++button) {
    push_list(L, 0, 5);
    set_field(L, "down", gui.button_down(button));
    set_field(L, "clicked", gui.button_clicked(button));
    set_field(L, "released", gui.button_released(button));
    set_field(L, "double", gui.double_clicked(button));
    set_field(L, "again", gui.clicked_again(button));
    lua_setfield(L, -2, names[button]);
  }
  return 1;
}

int ui_take_dropped(lua_State* L) {
  return push_list_of(L, open_gui(L).take_dropped(),
                      [&](const std::string& path) { push(L, path); });
}

int ui_set_style(lua_State* L) {
  Gui& gui = open_gui(L);
  Table options(L, 2);
  GuiStyle style = gui.style();
  style.dark = options.boolean("dark", style.dark);
  style.scale = options.number("scale", style.scale);
  style.font_size = options.number("font_size", style.font_size);
  options.done();
  gui.set_style(style);
  return 0;
}

int get_size(lua_State* L) {
  const Gui& gui = open_gui(L);
  const double size[] = {static_cast<double>(gui.width()), static_cast<double>(gui.height())};
  return push(L, std::span<const double>(size));
}
int ui_redraw(lua_State* L) { return open_gui(L).redraw(), 0; }
int get_pictures_drawn(lua_State* L) { return push(L, open_gui(L).pictures_drawn()); }
int ui_poll(lua_State* L) { return push(L, open_gui(L).poll()); }
int ui_read(lua_State* L) { return push_object(L, open_gui(L).read()); }
int ui_hash(lua_State* L) {
  const Picture picture = open_gui(L).read();
  Hasher hash;
  for (size_t i = 0; i + 8 <= picture.pixels.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, &picture.pixels[i], 8);
    hash.add(word);
  }
  for (size_t i = picture.pixels.size() / 8 * 8; i < picture.pixels.size(); ++i)
    hash.add(uint64_t{picture.pixels[i]});
  return push(L, fmt::format("{:016x}", hash.value()));
}
int ui_set_title(lua_State* L) { return open_gui(L).set_title(check_string(L, 2, "title")), 0; }
int ui_key_down(lua_State* L) { return push(L, open_gui(L).key_down(check_int(L, 2, "key"))); }
int ui_keep_open(lua_State* L) { return open_gui(L).close_handled(), 0; }
int get_wants_mouse(lua_State* L) { return push(L, open_gui(L).wants_mouse()); }
int get_wants_text(lua_State* L) { return push(L, open_gui(L).wants_text()); }
int get_close_requested(lua_State* L) { return push(L, open_gui(L).close_requested()); }
int get_renderer(lua_State* L) { return push(L, open_gui(L).renderer()); }
int get_line_height(lua_State* L) { return push(L, framed_gui(L).line_height()); }
int ui_text_of(lua_State* L) {
  const auto& handle = self<UiHandle>(L);
  if (!handle.gui) return push(L, "closed user interface");
  return push(L, fmt::format("user interface of {} x {} pixels", handle.gui->width(),
                             handle.gui->height()));
}

}  // namespace

static const Entry ui_functions[] = {
    {"ui", guarded<make_ui>, R"(
Opens a user interface: a window, or a framebuffer that needs no display. clench.view builds the viewer on it.
@param options? table  size and look
@option size? number[] [pixels] = {1070, 937}  width and height
@option window? boolean = false  true: opens a window
@option title? string = "Clench"  of the window
@option dark? boolean = false  true: light text on a dark ground
@option scale? number [0.25 to 8]  of fonts and sizes, by default 1, or that of the monitor
@return ui
@effect edits
> u = clench.ui {size = {64, 48}}
> u:frame(0.01, function(ui) ui:window("w", {x = 0, y = 0, width = 64, height = 48}, function() ui:button "go" end) end)
> u:frame(0.01, function() end)
> u:read()  --> picture of 64 x 48 pixels
> u:close()
> clench.ui {size = {4, 4}}  --> error: size of the view: expected 16 to 8192 pixels, got 4)"},
};

static const Entry ui_fields[] = {
    {"size", guarded<get_size>, R"(
Width and height.
@type number[] [pixels]
> ui.size  --> {320.0, 240.0})"},
    {"items", guarded<get_items>, R"(
Widgets of the last frame.
@type table[]  {label, kind, window, x, y, width, height, enabled}  rectangles [pixels]
> #ui.items  --> 0)"},
    {"pressed", guarded<get_pressed>, R"(
Keys that went down in this frame.
@type table[]  {key, ctrl, shift, alt}  key: code of GLFW
> #ui.pressed  --> 0)"},
    {"mouse", guarded<get_mouse>, R"(
The mouse in this frame.
@type table  {x, y, dx, dy, wheel, left, right, middle}  positions [pixels]; of a button {down, clicked, released, double, again}; again: second or later press of a multiple click
> ui.mouse.left.down  --> false)"},
    {"wants_mouse", guarded<get_wants_mouse>, R"(
Is the mouse over a panel?
@type boolean
> ui.wants_mouse  --> false)"},
    {"wants_text", guarded<get_wants_text>, R"(
Is text being typed into a widget?
@type boolean
> ui.wants_text  --> false)"},
    {"close_requested", guarded<get_close_requested>, R"(
Has the user asked to close the window?
@type boolean
> ui.close_requested  --> false)"},
    {"renderer", guarded<get_renderer>, R"(
Name of the OpenGL renderer, which differs where pictures may differ.
@type string
> #ui.renderer > 0  --> true)"},
    {"pictures_drawn", guarded<get_pictures_drawn>, R"(
Number of pictures that ui:show has drawn. One that shows the same as that of the last frame is kept.
@type integer
> for _ = 1, 3 do ui:frame(0.01, function(ui) ui:show(world) end) end
> ui.pictures_drawn  --> 1)"},
    {"line_height", guarded<get_line_height>, R"(
Height of a row of widgets.
@type number [pixels]
> ui:frame(0.01, function(ui) height = ui.line_height end)
> height > 10  --> true)"},
};

static const Entry ui_methods[] = {
    {"frame", guarded<ui_frame>, R"(
Describes and draws one frame.
@param dt number [s]  time since the last frame
@param draw fun(ui: ui)  describes the widgets of the frame
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "hello" end) end)
> ui:frame(0.01, function() error "no" end)  --> error: no)"},
    {"show", guarded<ui_show>, R"(
Shows a world behind the panels, as a draft of clench.render, which is drawn when something that it shows has changed.
@param world world  world to draw
@param options? table  the camera, and what is shown
@option eye? vec3 [m]  position of the camera; by default a camera that shows everything
@option target? vec3 [m]  point at which it looks
@option up? vec3 = {0, 0, 1}  direction that is up in the picture
@option field_of_view? number [rad, > 0]  vertical
@option orthographic? number [m, > 0]  height that is shown
@option aside? number = 0  shift of what is seen to the right, as a fraction of the height
@option part? "all"|"left"|"right" = "all"  the screen or half of it
@option channels? "all"|"red"|"cyan" = "all"  the colors that are drawn
@like clench.render  frame, contacts, cones, cone_height, patches, approach, ground, transparent_objects, file_colors, forces, force_scale, arrows, ghosts, wrenches, style
@effect edits
> ui:frame(0.01, function(ui) ui:show(world) end)
> ui:show(world)  --> error: expected a call within ui:frame
> ui:frame(0.01, function(ui) ui:show(world, {part = "top"}) end)  --> error: part)"},
    {"read", guarded<ui_read>, R"(
The pixels of the last frame.
@return picture
@effect reads
> ui:frame(0.01, function() end)
> ui:read()  --> picture of 320 x 240 pixels)"},
    {"hash", guarded<ui_hash>, R"(
Hash of the pixels of the last frame.
@return string
@effect reads
> ui:frame(0.01, function() end)
> #ui:hash()  --> 16)"},
    {"input", guarded<ui_input>, R"(
Adds input, which the next frames apply.
@param event table  the synthetic event
@option kind? "move"|"button"|"wheel"|"key"|"text"|"close"|"drop" = "move"  what happens
@option x? number [pixels] = 0  position, or turns of the wheel
@option y? number [pixels] = 0  position, or turns of the wheel
@option code? integer = 0  of a key of GLFW, or 0 left, 1 right, 2 middle
@option down? boolean = false  true: pressed, false: released
@option time? number [s]  when a button was pressed, to recognize double clicks; by default when the frame is drawn that applies it
@option text? string  typed text, or the dropped path
@effect edits
> ui:input {kind = "move", x = 5, y = 5}
> ui:frame(0.01, function() end)
> ui.mouse.x  --> 5.0)"},
    {"redraw", guarded<ui_redraw>, R"(
Draws the last frame again: its picture anew, including what panels cover. Images of widgets are uploaded anew in the next frame.
@effect edits
> ui:frame(0.01, function(ui) ui:show(world) end)
> ui:redraw()
> ui.pictures_drawn  --> 2)"},
    {"poll", guarded<ui_poll>, R"(
Collects input of the window.
@return boolean waiting  is there input that no frame has applied?
@effect edits
> ui:poll()  --> false)"},
    {"close", guarded<ui_close>, R"(
Closes the window.
@effect edits
> ui:close()
> ui:read()  --> error: the screen was closed)"},
    {"keep_open", guarded<ui_keep_open>, R"(
Rejects a request to close the window: it stays open.
@effect edits
> ui:input {kind = "close"}
> ui:frame(0.01, function() end)
> ui:keep_open()
> ui.close_requested  --> false)"},
    {"set_title", guarded<ui_set_title>, R"(
Sets the title of the window.
@param title string  new title
@effect edits
> ui:set_title "Clench"
> ui.size[1]  --> 320.0)"},
    {"set_style", guarded<ui_set_style>, R"(
Sets theme and sizes from the next frame on.
@param options table  look; what is not given stays
@option dark? boolean  true: light text on a dark ground
@option scale? number [0.25 to 8]  of fonts and sizes
@option font_size? number [pixels, > 0]  at scale 1; times scale from 4 to 128
@effect edits
> ui:set_style {font_size = 0}  --> error: font_size)"},
    {"take_dropped", guarded<ui_take_dropped>, R"(
Files that were dropped on the window since the last call.
@return string[] paths
@effect edits
> ui:input {kind = "drop", text = "mug.obj"}
> ui:frame(0.01, function() end)
> ui:take_dropped()  --> {"mug.obj"})"},
    {"key_down", guarded<ui_key_down>, R"(
Is a key held?
@param key integer  code of GLFW
@return boolean
@effect reads
> ui:input {kind = "key", code = 65, down = true}
> ui:frame(0.01, function() end)
> ui:key_down(65)  --> true)"},
};

static const Entry ui_operators[] = {
    {"__tostring", guarded<ui_text_of>, ""},
};

const Class ui_class{.name = "ui",
                     .variable = "ui",
                     .doc = "Panels and widgets over a picture, described anew for each frame.",
                     .fields = ui_fields,
                     .methods = ui_methods,
                     .operators = ui_operators,
                     .parent = &ui_widgets_class};
const Library ui_library{.name = "clench", .doc = "", .functions = ui_functions};

}  // namespace clench
