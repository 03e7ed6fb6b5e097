#include <cstring>

#include "clench/base/hash.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/picture/read_scene.h"
#include "clench/script/bind/view/ui.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/viewer/gui.h"

namespace clench {

namespace {

Gui& open_gui(lua_State* L) {
  const UiHandle& handle = self<UiHandle>(L);
  if (!handle.gui) fail("{}: the screen was closed", subject(L));
  return *handle.gui;
}

// for what describes a frame
Gui& framed_gui(lua_State* L) {
  Gui& gui = open_gui(L);
  if (!self<UiHandle>(L).in_frame) fail("{}: expected a call within ui:frame", subject(L));
  gui.resume();
  return gui;
}

Rgba read_color(Table& options, const char* key, const Rgba& fallback) {
  if (!options.has(key)) return fallback;
  const std::vector<double> numbers = options.numbers(key);
  if (numbers.size() != 3 && numbers.size() != 4)
    fail("{}: {}: expected 3 or 4 numbers from 0 to 1, got {}", options.subject(), key,
         numbers.size());
  Rgba color{0, 0, 0, 1};
  for (size_t i = 0; i < numbers.size(); ++i) color[i] = static_cast<float>(numbers[i]);
  return color;
}

// An error of a body, kept until the containers around it are closed.
class BodyOf {
 public:
  BodyOf(lua_State* L, int function) : L_(L), function_(function) {
    if (!lua_isfunction(L, function))
      fail("{}: expected a function, got {}", subject(L), described(L, function));
  }
  void operator()() const {
    lua_pushvalue(L_, function_);
    lua_pushvalue(L_, 1);
    call_script(L_, 1, 0, "ui");
  }

 private:
  lua_State* L_;
  int function_;
};

std::vector<std::string> check_names(lua_State* L, int i, const char* name) {
  std::vector<std::string> names;
  each_item(L, i, {L, {}, name}, "a list of strings",
            [&](int k, const What& what) { names.push_back(read_string(L, k, what)); });
  return names;
}

template <class T>
int push_edited(lua_State* L, const Edited<T>& edited) {
  push(L, edited.value);
  push(L, edited.changed);
  push(L, edited.finished);
  return 3;
}

// --- frames ---

int make_ui(lua_State* L) {
  Table options(L, 1);
  std::vector<double> size = {1070, 937};
  if (options.has("size")) size = options.numbers("size", 2);
  GuiStyle style;
  style.dark = options.boolean("dark", false);
  style.scale = options.positive("scale", 1);
  const bool window = options.boolean("window", false);
  const std::string title = options.string("title", "Clench");
  options.done();
  const int width = static_cast<int>(size[0]), height = static_cast<int>(size[1]);
  std::unique_ptr<Screen> screen =
      window ? make_window(width, height, title) : make_offscreen(width, height);
  if (window && !options.has("scale")) style.scale = screen->scale();
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
  struct End {
    Gui& gui;
    UiHandle& handle;
    ~End() { handle.in_frame = false, gui.end(); }
  } end{gui, handle};
  body();
  return 0;
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
    eye.field_of_view = options.positive("field_of_view", eye.field_of_view);
    eye.ortho_height = options.has("orthographic") ? options.positive("orthographic", 1) : 0;
  }
  Scene scene = read_scene(L, options, {&world, 1});
  options.done();
  if (!given) eye = gui.frame_all(scene);
  scene.eye = eye;
  gui.show(scene, eye, {});
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
  event.code = options.integer("code", 0);
  event.down = options.boolean("down", false);
  event.text = options.string("text", "");
  options.done();
  gui.add(std::move(event));
  return 0;
}

int push_rect(lua_State* L, const GuiRect& rect) {
  return push_record(
      L, {{"x", rect.x}, {"y", rect.y}, {"width", rect.width}, {"height", rect.height}});
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
    push_list(L, 0, 4);
    set_field(L, "down", gui.button_down(button));
    set_field(L, "clicked", gui.button_clicked(button));
    set_field(L, "released", gui.button_released(button));
    set_field(L, "double", gui.double_clicked(button));
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
  style.scale = options.positive("scale", style.scale);
  style.font_size = options.positive("font_size", style.font_size);
  options.done();
  gui.set_style(style);
  return 0;
}

// --- containers ---

int ui_window(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string name = check_string(L, 2, "name");
  Table options(L, 3);
  WindowOptions window;
  window.rect = {options.number("x", 0), options.number("y", 0), options.number("width", 0),
                 options.number("height", 0)};
  window.title = options.boolean("title", true);
  window.resizable = options.boolean("resizable", false);
  window.movable = options.boolean("movable", false);
  window.scroll = options.boolean("scroll", true);
  window.background = options.boolean("background", true);
  window.modal = options.boolean("modal", false);
  window.can_close = options.boolean("can_close", false);
  options.done();
  return push(L, gui.window(name, window, BodyOf(L, 4)));
}

int ui_child(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string name = check_string(L, 2, "id");
  Table options(L, 3);
  const double width = options.number("width", 0), height = options.number("height", 0);
  const bool border = options.boolean("border", false);
  options.done();
  gui.child(name, width, height, border, BodyOf(L, 4));
  return 0;
}

int ui_menu_bar(lua_State* L) { return framed_gui(L).menu_bar(BodyOf(L, 2)), 0; }

int ui_menu(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  gui.menu(label, true, BodyOf(L, 3));
  return 0;
}

int ui_menu_item(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  Table options(L, 3);
  const std::string shortcut = options.string("shortcut", "");
  const bool selected = options.boolean("selected", false),
             enabled = options.boolean("enabled", true);
  options.done();
  return push(L, gui.menu_item(label, shortcut, selected, enabled));
}

int ui_popup(lua_State* L) {
  return framed_gui(L).popup(check_string(L, 2, "id"), BodyOf(L, 3)), 0;
}
int ui_context_menu(lua_State* L) {
  return framed_gui(L).context_menu(check_string(L, 2, "id"), BodyOf(L, 3)), 0;
}
int ui_open_popup(lua_State* L) { return framed_gui(L).open_popup(check_string(L, 2, "id")), 0; }
int ui_close_popup(lua_State* L) { return framed_gui(L).close_popup(), 0; }
int ui_disabled(lua_State* L) {
  return framed_gui(L).disabled(check_boolean(L, 2, "disabled"), BodyOf(L, 3)), 0;
}
int ui_id(lua_State* L) { return framed_gui(L).id(check_string(L, 2, "id"), BodyOf(L, 3)), 0; }
int ui_group(lua_State* L) { return framed_gui(L).group(BodyOf(L, 2)), 0; }

int ui_tabs(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string name = check_string(L, 2, "id");
  const std::vector<std::string> names = check_names(L, 3, "names");
  const BodyOf checked(L, 4);
  (void)checked;
  gui.tabs(name, names, [&](size_t i) {
    lua_pushvalue(L, 4);
    lua_pushvalue(L, 1);
    lua_pushstring(L, names[i].c_str());
    call_script(L, 2, 0, "ui:tabs");
  });
  return 0;
}

int ui_tree(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  Table options(L, 3);
  Gui::TreeOptions tree;
  tree.open = options.boolean("open", false);
  tree.leaf = options.boolean("leaf", false);
  tree.selected = options.boolean("selected", false);
  options.done();
  const int clicked =
      lua_isnoneornil(L, 4) ? gui.tree(label, tree, [] {}) : gui.tree(label, tree, BodyOf(L, 4));
  push(L, clicked > 0);
  push(L, clicked > 1);
  return 2;
}

int ui_collapsing(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  return push(L, gui.collapsing(label, check_boolean(L, 3, "open"), BodyOf(L, 4)));
}

int ui_table(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string name = check_string(L, 2, "id");
  const std::vector<std::string> columns = check_names(L, 3, "columns");
  if (columns.empty() || columns.size() > 64)
    fail("{}: expected 1 to 64 columns, got {}", subject(L), columns.size());
  Table options(L, 4);
  const double height = options.number("height", 0);
  options.done();
  gui.table(name, columns, height, BodyOf(L, 5));
  return 0;
}

// --- widgets ---

int ui_text(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string text = check_string(L, 2, "text");
  Table options(L, 3);
  std::optional<Rgba> color;
  if (options.has("color")) color = read_color(options, "color", {});
  const bool wrap = options.boolean("wrap", false);
  options.done();
  gui.text(text, color, wrap);
  return 0;
}

int ui_button(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  Table options(L, 3);
  const double width = options.number("width", 0), height = options.number("height", 0);
  const bool selected = options.boolean("selected", false);
  options.done();
  return push(L, gui.button(label, width, height, selected));
}

int ui_checkbox(lua_State* L) {
  return push_edited(
      L, framed_gui(L).checkbox(check_string(L, 2, "label"), check_boolean(L, 3, "value")));
}
int ui_radio(lua_State* L) {
  return push(L, framed_gui(L).radio(check_string(L, 2, "label"), check_boolean(L, 3, "selected")));
}
int ui_selectable(lua_State* L) {
  return push(
      L, framed_gui(L).selectable(check_string(L, 2, "label"), check_boolean(L, 3, "selected")));
}

int ui_slider(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const double value = check_number(L, 3, "value");
  Table options(L, 4);
  const double low = options.number("min", 0), high = options.number("max", 1);
  const std::string format = options.string("format", "%.3g");
  options.done();
  return push_edited(L, gui.slider(label, value, low, high, format));
}

int ui_drag(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const double value = check_number(L, 3, "value");
  Table options(L, 4);
  const double speed = options.positive("speed", 0.01);
  constexpr double any = std::numeric_limits<double>::infinity();
  const double low = options.number("min", -any), high = options.number("max", any);
  const std::string format = options.string("format", "%.4g");
  options.done();
  return push_edited(L, gui.drag(label, value, speed, low, high, format));
}

int ui_number(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const double value = check_number(L, 3, "value");
  Table options(L, 4);
  const double step = options.number("step", 0);
  const std::string format = options.string("format", "%.6g");
  options.done();
  return push_edited(L, gui.number(label, value, step, format));
}

int ui_text_input(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const std::string value = check_string(L, 3, "value");
  Table options(L, 4);
  Gui::InputOptions input;
  input.hint = options.string("hint", "");
  input.lines = options.integer("lines", 1);
  input.on_enter = options.boolean("on_enter", false);
  input.focus = options.boolean("focus", false);
  input.password = options.boolean("password", false);
  options.done();
  return push_edited(L, gui.input(label, value, input));
}

int ui_combo(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const int index = lua_isnoneornil(L, 3) ? 0 : check_int(L, 3, "index");
  const std::vector<std::string> choices = check_names(L, 4, "choices");
  const Edited<int> edited = gui.combo(label, index - 1, choices);
  push(L, edited.value + 1);
  push(L, edited.changed);
  return 2;
}

int ui_progress(lua_State* L) {
  Gui& gui = framed_gui(L);
  const double fraction = check_number(L, 2, "fraction");
  gui.progress(fraction, given(L, 3) ? check_string(L, 3, "text") : "",
               given(L, 4) ? check_number(L, 4, "width") : 0);
  return 0;
}

int ui_plot(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string label = check_string(L, 2, "label");
  const std::vector<double> values = check_numbers(L, 3, "values");
  Table options(L, 4);
  std::optional<double> low, high;
  if (options.has("min")) low = options.number("min");
  if (options.has("max")) high = options.number("max");
  const double height = options.number("height", 80);
  options.done();
  gui.plot(label, values, low, high, height);
  return 0;
}

int ui_image(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string key = check_string(L, 2, "key");
  const Picture& picture = check_object<Picture>(L, 3, "picture");
  Table options(L, 4);
  const double width = options.number("width", picture.width);
  const double height = options.number("height", picture.height);
  const bool changed = options.boolean("changed", true);
  options.done();
  return push(L, gui.image(key, picture, changed, width, height));
}

int ui_same_line(lua_State* L) {
  return framed_gui(L).same_line(given(L, 2) ? check_number(L, 2, "spacing") : -1), 0;
}
int ui_width(lua_State* L) { return framed_gui(L).next_width(check_number(L, 2, "width")), 0; }
int ui_indent(lua_State* L) { return framed_gui(L).indent(check_number(L, 2, "width")), 0; }
int ui_tooltip(lua_State* L) { return framed_gui(L).tooltip(check_string(L, 2, "text")), 0; }
int ui_available(lua_State* L) {
  const auto space = framed_gui(L).available();
  push(L, space[0]);
  push(L, space[1]);
  return 2;
}
int ui_rect(lua_State* L) { return push_rect(L, framed_gui(L).last_rect()); }
int ui_separator(lua_State* L) { return framed_gui(L).separator(), 0; }
int ui_spacing(lua_State* L) { return framed_gui(L).spacing(), 0; }
int ui_next_column(lua_State* L) { return framed_gui(L).next_column(), 0; }
int ui_focus(lua_State* L) { return framed_gui(L).focus_next(), 0; }
int ui_scroll_to_end(lua_State* L) { return framed_gui(L).scroll_to_end(), 0; }
int ui_hovered(lua_State* L) { return push(L, framed_gui(L).hovered()); }
int ui_active(lua_State* L) { return push(L, framed_gui(L).active()); }

// --- over the picture ---

std::vector<std::array<double, 2>> check_points(lua_State* L, int i) {
  const std::vector<double> numbers = check_numbers(L, i, "points");
  if (numbers.size() < 4 || numbers.size() % 2)
    fail("{}: points: expected x and y of two or more points, got {} numbers", subject(L),
         numbers.size());
  std::vector<std::array<double, 2>> points;
  for (size_t k = 0; k < numbers.size(); k += 2) points.push_back({numbers[k], numbers[k + 1]});
  return points;
}

int ui_line(lua_State* L) {
  Gui& gui = framed_gui(L);
  const auto points = check_points(L, 2);
  Table options(L, 3);
  const Rgba color = read_color(options, "color", {0, 0, 0, 1});
  const double width = options.positive("width", 2);
  const bool closed = options.boolean("closed", false), filled = options.boolean("filled", false);
  options.done();
  if (filled)
    gui.polygon(points, color);
  else
    gui.line(points, color, width, closed);
  return 0;
}

int ui_circle(lua_State* L) {
  Gui& gui = framed_gui(L);
  const double x = check_number(L, 2, "x"), y = check_number(L, 3, "y");
  const double radius = check_number(L, 4, "radius");
  Table options(L, 5);
  const Rgba color = read_color(options, "color", {0, 0, 0, 1});
  const double width = options.positive("width", 2);
  const bool filled = options.boolean("filled", false);
  options.done();
  gui.circle(x, y, radius, color, width, filled);
  return 0;
}

int ui_label(lua_State* L) {
  Gui& gui = framed_gui(L);
  const double x = check_number(L, 2, "x"), y = check_number(L, 3, "y");
  const std::string text = check_string(L, 4, "text");
  Table options(L, 5);
  const Rgba color = read_color(options, "color", {0, 0, 0, 1});
  options.done();
  gui.label(x, y, text, color);
  return 0;
}

int get_size(lua_State* L) {
  const Gui& gui = open_gui(L);
  const double size[] = {static_cast<double>(gui.width()), static_cast<double>(gui.height())};
  return push(L, std::span<const double>(size));
}
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
@param options? {size?: number[], window?: boolean, title?: string, dark?: boolean, scale?: number}  size: width and height [pixels]; window: true opens one; scale: of fonts and sizes, by default that of the monitor
@return ui
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
@type number[] [pixels])"},
    {"items", guarded<get_items>, R"(
Widgets of the last frame.
@type table[]  {label, kind, window, x, y, width, height, enabled}  rectangles [pixels])"},
    {"pressed", guarded<get_pressed>, R"(
Keys that went down in this frame.
@type table[]  {key, ctrl, shift, alt}  key: code of GLFW)"},
    {"mouse", guarded<get_mouse>, R"(
The mouse in this frame.
@type table  {x, y, dx, dy, wheel, left, right, middle}  positions [pixels]; of a button {down, clicked, released, double})"},
    {"wants_mouse", guarded<get_wants_mouse>, R"(
Is the mouse over a panel?
@type boolean)"},
    {"wants_text", guarded<get_wants_text>, R"(
Is text being typed into a widget?
@type boolean)"},
    {"close_requested", guarded<get_close_requested>, R"(
Has the user asked to close the window?
@type boolean)"},
    {"line_height", guarded<get_line_height>, R"(
Height of a row of widgets.
@type number [pixels])"},
};

static const Entry ui_methods[] = {
    {"frame", guarded<ui_frame>, R"(
Describes and draws one frame.
@param dt number [s]  time since the last frame
@param draw fun(ui: ui)  describes the widgets of the frame)"},
    {"show", guarded<ui_show>, R"(
Draws a world behind the panels, as a draft of clench.render.
@param world world  world to draw
@param options? table  eye, target, up, field_of_view, orthographic and those of clench.render that choose what is drawn)"},
    {"read", guarded<ui_read>, R"(
The pixels of the last frame.
@return picture)"},
    {"hash", guarded<ui_hash>, R"(
Hash of the pixels of the last frame.
@return string)"},
    {"input", guarded<ui_input>, R"(
Adds input, which the next frames apply.
@param event {kind: string, x?: number, y?: number, code?: integer, down?: boolean, text?: string}  kind: "move", "button", "wheel", "key", "text", "close" or "drop"; code: of a key of GLFW, or 0 left, 1 right, 2 middle)"},
    {"poll", guarded<ui_poll>, R"(
Collects input of the window.
@return boolean waiting  is there input that no frame has applied?)"},
    {"close", guarded<ui_close>, "Closes the window."},
    {"keep_open", guarded<ui_keep_open>, "Answers a request to close the window: it stays open."},
    {"set_title", guarded<ui_set_title>, R"(
Sets the title of the window.
@param title string  new title)"},
    {"set_style", guarded<ui_set_style>, R"(
Sets theme and sizes from the next frame on.
@param options {dark?: boolean, scale?: number, font_size?: number}  font_size [pixels])"},
    {"take_dropped", guarded<ui_take_dropped>, R"(
Files that were dropped on the window since the last call.
@return string[] paths)"},
    {"key_down", guarded<ui_key_down>, R"(
Is a key held?
@param key integer  code of GLFW
@return boolean)"},
    {"window", guarded<ui_window>, R"(
A window with contents.
@param name string  title, and after "##" more that makes it unique
@param options {x?: number, y?: number, width?: number, height?: number, title?: boolean, resizable?: boolean, movable?: boolean, scroll?: boolean, background?: boolean, modal?: boolean, can_close?: boolean}  without a width it fits its contents
@param draw fun(ui: ui)  describes the contents
@return boolean open  false: the user has closed it)"},
    {"child", guarded<ui_child>, R"(
A part of a window that scrolls by itself.
@param id string  unique name
@param options {width?: number, height?: number, border?: boolean}  0: all that is left; below 0: less than that
@param draw fun(ui: ui)  describes the contents)"},
    {"menu_bar", guarded<ui_menu_bar>, R"(
The menu bar at the top of the screen.
@param draw fun(ui: ui)  describes the menus)"},
    {"menu", guarded<ui_menu>, R"(
A menu.
@param label string  title
@param draw fun(ui: ui)  describes the entries)"},
    {"menu_item", guarded<ui_menu_item>, R"(
An entry of a menu.
@param label string  text
@param options? {shortcut?: string, selected?: boolean, enabled?: boolean}  shortcut: shown beside the text
@return boolean clicked)"},
    {"popup", guarded<ui_popup>, R"(
A popup that open_popup opens.
@param id string  unique name
@param draw fun(ui: ui)  describes the contents)"},
    {"context_menu", guarded<ui_context_menu>, R"(
A popup that a right click on the last widget opens.
@param id string  unique name
@param draw fun(ui: ui)  describes the contents)"},
    {"open_popup", guarded<ui_open_popup>, R"(
Opens a popup.
@param id string  its name)"},
    {"close_popup", guarded<ui_close_popup>, "Closes the popup that is being described."},
    {"disabled", guarded<ui_disabled>, R"(
Widgets that are gray if `disabled` is true.
@param disabled boolean  are they?
@param draw fun(ui: ui)  describes the widgets)"},
    {"id", guarded<ui_id>, R"(
Widgets whose labels may equal others'.
@param id string  unique name
@param draw fun(ui: ui)  describes the widgets)"},
    {"group", guarded<ui_group>, R"(
Widgets that are laid out as one.
@param draw fun(ui: ui)  describes the widgets)"},
    {"tabs", guarded<ui_tabs>, R"(
Tabs.
@param id string  unique name
@param names string[]  of the tabs
@param draw fun(ui: ui, name: string)  describes the open one)"},
    {"tree", guarded<ui_tree>, R"(
A node of a tree.
@param label string  text
@param options {open?: boolean, leaf?: boolean, selected?: boolean}  open: at first
@param draw? fun(ui: ui)  describes what is below it
@return boolean clicked
@return boolean double_clicked)"},
    {"collapsing", guarded<ui_collapsing>, R"(
A section with a title that folds it.
@param label string  title
@param open boolean  at first
@param draw fun(ui: ui)  describes the contents
@return boolean open)"},
    {"table", guarded<ui_table>, R"(
A table, filled cell by cell after next_column.
@param id string  unique name
@param columns string[]  titles
@param options {height?: number}  0: as high as its rows [pixels]
@param draw fun(ui: ui)  describes the cells)"},
    {"next_column", guarded<ui_next_column>, "Goes on to the next cell of a table."},
    {"text", guarded<ui_text>, R"(
A text.
@param text string  UTF-8
@param options? {color?: number[], wrap?: boolean}  color: red, green, blue and perhaps opacity, 0 to 1)"},
    {"button", guarded<ui_button>, R"(
A button.
@param label string  text
@param options? {width?: number, height?: number, selected?: boolean}  sizes [pixels]
@return boolean clicked)"},
    {"checkbox", guarded<ui_checkbox>, R"(
A check box.
@param label string  text
@param value boolean  is it checked?
@return boolean value
@return boolean changed)"},
    {"radio", guarded<ui_radio>, R"(
A radio button.
@param label string  text
@param selected boolean  is it selected?
@return boolean clicked)"},
    {"selectable", guarded<ui_selectable>, R"(
A line that can be selected.
@param label string  text
@param selected boolean  is it selected?
@return boolean clicked)"},
    {"slider", guarded<ui_slider>, R"(
A slider.
@param label string  text
@param value number  present value
@param options? {min?: number, max?: number, format?: string}  format: as in "%.2f mm"
@return number value
@return boolean changed
@return boolean finished  was it released?)"},
    {"drag", guarded<ui_drag>, R"(
A number that is dragged, or typed after a double click.
@param label string  text
@param value number  present value
@param options? {speed?: number, min?: number, max?: number, format?: string}  speed: change per pixel
@return number value
@return boolean changed
@return boolean finished)"},
    {"number", guarded<ui_number>, R"(
A number that is typed.
@param label string  text
@param value number  present value
@param options? {step?: number, format?: string}  step: of its buttons, 0: none
@return number value
@return boolean changed
@return boolean finished)"},
    {"text_input", guarded<ui_text_input>, R"(
A text that is typed.
@param label string  text beside it
@param value string  present text
@param options? {hint?: string, lines?: integer, on_enter?: boolean, focus?: boolean, password?: boolean}  on_enter: `finished` at Enter; focus: take the keyboard now
@return string value
@return boolean changed
@return boolean finished)"},
    {"combo", guarded<ui_combo>, R"(
A list of which one is chosen.
@param label string  text beside it
@param index integer?  chosen one, from 1
@param choices string[]  texts
@return integer index
@return boolean changed)"},
    {"progress", guarded<ui_progress>, R"(
A bar of progress.
@param fraction number [0 to 1]  part that is done
@param text? string  on the bar
@param width? number [pixels]  all that is left by default)"},
    {"plot", guarded<ui_plot>, R"(
A curve of numbers.
@param label string  text beside it
@param values number[]  at equal distances
@param options? {min?: number, max?: number, height?: number}  height [pixels])"},
    {"image", guarded<ui_image>, R"(
A picture.
@param key string  identifies it from frame to frame
@param picture picture  its pixels
@param options? {width?: number, height?: number, changed?: boolean}  sizes [pixels]; changed: are its pixels others than in the last frame?
@return boolean clicked)"},
    {"separator", guarded<ui_separator>, "A line between widgets."},
    {"spacing", guarded<ui_spacing>, "Space between widgets."},
    {"same_line", guarded<ui_same_line>, R"(
The next widget stays on the line of the last one.
@param spacing? number [pixels]  between them)"},
    {"width", guarded<ui_width>, R"(
Width of the next widget.
@param width number [pixels]  below 0: what is left, less that)"},
    {"indent", guarded<ui_indent>, R"(
Moves the following widgets to the right.
@param width number [pixels]  below 0: back)"},
    {"tooltip", guarded<ui_tooltip>, R"(
A text that appears while the mouse is over the last widget.
@param text string  UTF-8)"},
    {"focus", guarded<ui_focus>, "Gives the keyboard to the next widget."},
    {"scroll_to_end", guarded<ui_scroll_to_end>, "Scrolls to the last widget."},
    {"hovered", guarded<ui_hovered>, R"(
Is the mouse over the last widget?
@return boolean)"},
    {"active", guarded<ui_active>, R"(
Is the last widget held or edited?
@return boolean)"},
    {"available", guarded<ui_available>, R"(
Space that is left in the container.
@return number width
@return number height)"},
    {"rect", guarded<ui_rect>, R"(
Rectangle of the last widget.
@return table  {x, y, width, height} [pixels])"},
    {"line", guarded<ui_line>, R"(
A line over the picture, under the panels.
@param points number[]  x and y of each point [pixels]
@param options? {color?: number[], width?: number, closed?: boolean, filled?: boolean}  filled: a convex polygon)"},
    {"circle", guarded<ui_circle>, R"(
A circle over the picture.
@param x number [pixels]  of its center
@param y number [pixels]  of its center
@param radius number [pixels]  its radius
@param options? {color?: number[], width?: number, filled?: boolean}  look)"},
    {"label", guarded<ui_label>, R"(
A text over the picture.
@param x number [pixels]  of its left edge
@param y number [pixels]  of its upper edge
@param text string  UTF-8
@param options? {color?: number[]}  look)"},
};

static const Entry ui_operators[] = {
    {"__tostring", guarded<ui_text_of>, "\"user interface of 1070 x 937 pixels\""},
};

const Class ui_class{.name = "ui",
                     .variable = "ui",
                     .doc = "Panels and widgets over a picture, described anew for each frame.",
                     .fields = ui_fields,
                     .methods = ui_methods,
                     .operators = ui_operators};
const Library ui_library{.name = "clench", .doc = "", .functions = ui_functions};

}  // namespace clench
