#include <array>
#include <limits>
#include <optional>

#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/view/ui_frame.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/push.h"

namespace clench {

namespace {

template <class T>
int push_edited(lua_State* L, const Edited<T>& edited) {
  push(L, edited.value);
  push(L, edited.changed);
  push(L, edited.finished);
  return 3;
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
  const double speed = options.number("speed", 0.01);
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

// calls the function at the index
std::string completion_of(lua_State* L, int function, const std::string& before) {
  lua_pushvalue(L, function);
  push(L, before);
  call_script(L, 1, 1, "ui:text_input");
  const std::string rest = lua_isnil(L, -1) ? "" : read_string(L, -1, {L, {}, "complete"});
  lua_pop(L, 1);
  return rest;
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
  if (options.push_function("complete"))
    input.complete = [L, function = lua_gettop(L)](const std::string& before) {
      return completion_of(L, function, before);
    };
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

int ui_image(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string key = check_string(L, 2, "key");
  const Picture& picture = check_object<Picture>(L, 3, "picture");
  Table options(L, 4);
  const double width = options.number("width", picture.width);
  const double height = options.number("height", picture.height);
  options.done();
  return push(L, gui.image(key, picture, width, height));
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
int push_rect(lua_State* L, const GuiRect& rect) {
  return push_record(
      L, {{"x", rect.x}, {"y", rect.y}, {"width", rect.width}, {"height", rect.height}});
}
int ui_rect(lua_State* L) { return push_rect(L, framed_gui(L).last_rect()); }
int ui_separator(lua_State* L) { return framed_gui(L).separator(), 0; }
int ui_spacing(lua_State* L) { return framed_gui(L).spacing(), 0; }
int ui_focus(lua_State* L) { return framed_gui(L).focus_next(), 0; }
int ui_scroll_to_end(lua_State* L) { return framed_gui(L).scroll_to_end(), 0; }
int ui_reveal(lua_State* L) { return framed_gui(L).reveal(), 0; }
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
  const double width = options.number("width", 2);
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
  const double width = options.number("width", 2);
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

}  // namespace

static const Entry ui_widget_methods[] = {
    {"text", guarded<ui_text>, R"(
A text.
@param text string  UTF-8
@param options? table  look
@option color? number[]  red, green, blue and perhaps opacity, 0 to 1
@option wrap? boolean = false  true: broken into lines
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text("hello", {color = {1, 0, 0}}) end) end)
> ui.items[#ui.items].label  --> hello)"},
    {"button", guarded<ui_button>, R"(
A button.
@param label string  text
@param options? table  size and look
@option width? number [pixels] = 0  0: as wide as its text
@option height? number [pixels] = 0  0: as high as its text
@option selected? boolean = false  true: highlighted
@return boolean clicked
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() clicked = ui:button "go" end) end)
> clicked  --> false)"},
    {"checkbox", guarded<ui_checkbox>, R"(
A check box.
@param label string  text
@param value boolean  is it checked?
@return boolean value
@return boolean changed
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() value, changed = ui:checkbox("on", true) end) end)
> value, changed  --> true, false)"},
    {"radio", guarded<ui_radio>, R"(
A radio button.
@param label string  text
@param selected boolean  is it selected?
@return boolean clicked
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() clicked = ui:radio("a", true) end) end)
> clicked  --> false)"},
    {"selectable", guarded<ui_selectable>, R"(
A line that can be selected.
@param label string  text
@param selected boolean  is it selected?
@return boolean clicked
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() clicked = ui:selectable("a", false) end) end)
> clicked  --> false)"},
    {"slider", guarded<ui_slider>, R"(
A slider.
@param label string  text
@param value number  present value
@param options? table  range and look
@option min? number = 0  left end
@option max? number = 1  right end
@option format? string = "%.3g"  as in "%.2f mm"
@return number value
@return boolean changed
@return boolean finished  was it released?
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() value, changed = ui:slider("x", 0.5, {min = 0, max = 1}) end) end)
> value, changed  --> 0.5, false)"},
    {"drag", guarded<ui_drag>, R"(
A number that is dragged, or typed after a double click.
@param label string  text
@param value number  present value
@param options? table  range and look
@option speed? number [> 0] = 0.01  change per pixel
@option min? number  smallest value
@option max? number  largest value
@option format? string = "%.4g"  as in "%.2f mm"
@return number value
@return boolean changed
@return boolean finished
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() value, changed = ui:drag("x", 0.5, {speed = 0.1}) end) end)
> value, changed  --> 0.5, false)"},
    {"number", guarded<ui_number>, R"(
A number that is typed.
@param label string  text
@param value number  present value
@param options? table  look
@option step? number = 0  of its buttons; 0: none
@option format? string = "%.6g"  as in "%.2f mm"
@return number value
@return boolean changed
@return boolean finished
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() value, changed = ui:number("x", 2) end) end)
> value, changed  --> 2.0, false)"},
    {"text_input", guarded<ui_text_input>, R"(
A text that is typed.
@param label string  text beside it
@param value string  present text
@param options? table  behavior and look
@option hint? string  shown while it is empty
@option lines? integer = 1  height in lines
@option on_enter? boolean = false  true: `finished` at Enter
@option focus? boolean = false  true: takes the keyboard now
@option password? boolean = false  true: hides the text
@option complete? fun(before: string): string?  called at Tab with the text before the cursor; what it returns is inserted there
@return string value
@return boolean changed
@return boolean finished
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() value, changed = ui:text_input("name", "mug") end) end)
> value, changed  --> mug, false)"},
    {"combo", guarded<ui_combo>, R"(
A list from which one entry is chosen.
@param label string  text beside it
@param index index?  number of the chosen one
@param choices string[]  texts
@return index index
@return boolean changed
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() index, changed = ui:combo("c", 2, {"a", "b"}) end) end)
> index, changed  --> 2, false)"},
    {"progress", guarded<ui_progress>, R"(
A progress bar.
@param fraction number [0 to 1]  part that is done
@param text? string  on the bar
@param width? number [pixels]  all that is left by default
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:progress(0.5, "half") end) end)
> ui.items[#ui.items].label  --> half)"},
    {"image", guarded<ui_image>, R"(
A picture.
@param key string  identifies it from frame to frame
@param picture picture  its pixels
@param options? table  size
@option width? number [pixels]  by default that of the picture
@option height? number [pixels]  by default that of the picture
@return boolean clicked
@effect edits
> picture = clench.render(world, {size = {32, 32}, quality = "draft"})
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() clicked = ui:image("i", picture) end) end)
> clicked  --> false)"},
    {"separator", guarded<ui_separator>, R"(
A line between widgets.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:separator() ui:text "below" end) end)
> ui.items[#ui.items].label  --> below)"},
    {"spacing", guarded<ui_spacing>, R"(
Space between widgets.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:spacing() ui:text "below" end) end)
> ui.items[#ui.items].label  --> below)"},
    {"same_line", guarded<ui_same_line>, R"(
The next widget stays on the line of the last one.
@param spacing? number [pixels]  between them
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "a" ui:same_line() ui:text "b" end) end)
> ui.items[2].y == ui.items[3].y  --> true)"},
    {"width", guarded<ui_width>, R"(
Width of the next widget.
@param width number [pixels]  below 0: what is left, less that
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:width(100) ui:slider("x", 0, {}) end) end)
> ui.items[#ui.items].kind  --> slider)"},
    {"indent", guarded<ui_indent>, R"(
Moves the following widgets to the right.
@param width number [pixels]  below 0: back
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "a" ui:indent(10) ui:text "b" end) end)
> ui.items[3].x - ui.items[2].x  --> 10.0)"},
    {"tooltip", guarded<ui_tooltip>, R"(
A text that appears while the mouse is over the last widget.
@param text string  UTF-8
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "a" ui:tooltip "more" end) end)
> ui.items[#ui.items].label  --> a)"},
    {"focus", guarded<ui_focus>, R"(
Gives the keyboard to the next widget.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:focus() ui:text_input("t", "") end) end)
> ui.items[#ui.items].kind  --> input)"},
    {"scroll_to_end", guarded<ui_scroll_to_end>, R"(
Scrolls to the last widget.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "a" ui:scroll_to_end() end) end)
> ui.items[#ui.items].label  --> a)"},
    {"reveal", guarded<ui_reveal>, R"(
Scrolls the last widget into view, as little as possible.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "a" ui:reveal() end) end)
> ui.items[#ui.items].label  --> a)"},
    {"hovered", guarded<ui_hovered>, R"(
Is the mouse over the last widget?
@return boolean
@effect reads
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:text "a" over = ui:hovered() end) end)
> over  --> false)"},
    {"active", guarded<ui_active>, R"(
Is the last widget held or edited?
@return boolean
@effect reads
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:button "a" held = ui:active() end) end)
> held  --> false)"},
    {"available", guarded<ui_available>, R"(
Space that is left in the container.
@return number width
@return number height
@effect reads
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() width, height = ui:available() end) end)
> width > 0  --> true)"},
    {"rect", guarded<ui_rect>, R"(
Rectangle of the last widget.
@return table  {x, y, width, height} [pixels]
@effect reads
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:button "a" rect = ui:rect() end) end)
> rect.width > 0  --> true)"},
    {"line", guarded<ui_line>, R"(
A line over the picture, under the panels.
@param points number[]  x and y of each point [pixels]
@param options? table  look
@option color? number[] = {0, 0, 0, 1}  red, green, blue and perhaps opacity, 0 to 1
@option width? number [pixels, > 0] = 2  width of the line
@option closed? boolean = false  true: from the last point to the first
@option filled? boolean = false  true: a convex polygon
@effect edits
> ui:frame(0.01, function(ui) ui:line({0, 0, 10, 10}, {color = {1, 0, 0}}) end)
> ui:line {0, 0, 1, 1}  --> error: expected a call within ui:frame)"},
    {"circle", guarded<ui_circle>, R"(
A circle over the picture.
@param x number [pixels]  of its center
@param y number [pixels]  of its center
@param radius number [pixels]  its radius
@param options? table  look
@like ui:line  color, width
@option filled? boolean = false  true: a disk
@effect edits
> ui:frame(0.01, function(ui) ui:circle(20, 20, 5, {filled = true}) end)
> ui:circle(1, 1, 1)  --> error: expected a call within ui:frame)"},
    {"label", guarded<ui_label>, R"(
A text over the picture.
@param x number [pixels]  of its left edge
@param y number [pixels]  of its upper edge
@param text string  UTF-8
@param options? table  look
@like ui:line  color
@effect edits
> ui:frame(0.01, function(ui) ui:label(20, 20, "0.1 m") end)
> ui:label(1, 1, "a")  --> error: expected a call within ui:frame)"},
};

const Class ui_widgets_class{.name = "ui_widgets",
                             .variable = "ui",
                             .doc = "Widgets of a user interface, and lines over its picture.",
                             .methods = ui_widget_methods,
                             .parent = &ui_plots_class};

}  // namespace clench
