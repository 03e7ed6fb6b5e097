#include <algorithm>
#include <optional>

#include "clench/script/bind/view/ui_frame.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/push.h"

namespace clench {

namespace {

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

int ui_clip(lua_State* L) {
  Gui& gui = framed_gui(L);
  const GuiRect rect{check_number(L, 2, "x"), check_number(L, 3, "y"), check_number(L, 4, "width"),
                     check_number(L, 5, "height")};
  return gui.clip(rect, BodyOf(L, 6)), 0;
}

int ui_channels(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string channels = check_string(L, 2, "channels");
  if (channels != "all" && channels != "red" && channels != "cyan")
    fail("{}: channels: expected 'all', 'red' or 'cyan', got '{}'", subject(L), channels);
  const bool red = channels != "cyan", cyan = channels != "red";
  return gui.channels({red, cyan, cyan}, BodyOf(L, 3)), 0;
}

int ui_tabs(lua_State* L) {
  Gui& gui = framed_gui(L);
  const std::string name = check_string(L, 2, "id");
  const std::vector<std::string> names = check_names(L, 3, "names");
  const BodyOf checked(L, 4);
  (void)checked;
  const std::string chosen = lua_isnoneornil(L, 5) ? "" : check_string(L, 5, "chosen");
  const auto found = std::find(names.begin(), names.end(), chosen);
  std::optional<size_t> index;
  if (found != names.end()) index = static_cast<size_t>(found - names.begin());
  gui.tabs(name, names, index, [&](size_t i) {
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
  tree.unfold = options.boolean("unfold", false);
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

int ui_next_column(lua_State* L) { return framed_gui(L).next_column(), 0; }

}  // namespace

static const Entry ui_container_methods[] = {
    {"window", guarded<ui_window>, R"(
A window with contents.
@param name string  title, and after "##" more that makes it unique
@param options table  place and look
@option x? number [pixels] = 0  of its left edge
@option y? number [pixels] = 0  of its upper edge
@option width? number [pixels] = 0  0: it fits its contents
@option height? number [pixels] = 0  0: it fits its contents
@option title? boolean = true  true: with a title bar
@option resizable? boolean = false  true: the user can resize it
@option movable? boolean = false  true: the user can move it
@option scroll? boolean = true  true: with scroll bars if they are needed
@option background? boolean = true  false: transparent
@option modal? boolean = false  true: nothing else takes input
@option can_close? boolean = false  true: with a button that closes it
@param draw fun(ui: ui)  describes the contents
@return boolean open  false: the user has closed it
@effect edits
> ui:frame(0.01, function(ui) open = ui:window("w", {can_close = true}, function() end) end)
> open  --> true)"},
    {"child", guarded<ui_child>, R"(
A part of a window that scrolls separately.
@param id string  unique name
@param options table  size and look
@option width? number [pixels] = 0  0: all that is left; below 0: less than that
@option height? number [pixels] = 0  0: all that is left; below 0: less than that
@option border? boolean = false  true: with a border
@param draw fun(ui: ui)  describes the contents
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:child("part", {height = 20}, function() inside = true end) end) end)
> inside  --> true)"},
    {"menu_bar", guarded<ui_menu_bar>, R"(
The menu bar at the top of the screen.
@param draw fun(ui: ui)  describes the menus
@effect edits
> ui:frame(0.01, function(ui) ui:menu_bar(function() ui:menu("File", function() end) end) end)
> ui.items[1].label  --> File)"},
    {"menu", guarded<ui_menu>, R"(
A menu.
@param label string  title
@param draw fun(ui: ui)  describes the entries
@effect edits
> ui:frame(0.01, function(ui) ui:menu_bar(function() ui:menu("File", function() end) end) end)
> ui.items[1].kind  --> menu)"},
    {"menu_item", guarded<ui_menu_item>, R"(
An entry of a menu.
@param label string  text
@param options? table  look
@option shortcut? string  shown beside the text
@option selected? boolean = false  true: with a mark
@option enabled? boolean = true  false: gray, and without effect
@return boolean clicked
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() clicked = ui:menu_item("Open", {shortcut = "Ctrl+O"}) end) end)
> clicked  --> false)"},
    {"popup", guarded<ui_popup>, R"(
A popup that open_popup opens.
@param id string  unique name
@param draw fun(ui: ui)  describes the contents
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:popup("more", function() shown = true end) end) end)
> shown  --> nil)"},
    {"context_menu", guarded<ui_context_menu>, R"(
A popup that a right click on the last widget opens.
@param id string  unique name
@param draw fun(ui: ui)  describes the contents
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:button "go" ui:context_menu("more", function() shown = true end) end) end)
> shown  --> nil)"},
    {"open_popup", guarded<ui_open_popup>, R"(
Opens a popup.
@param id string  its name
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:open_popup "more" ui:popup("more", function() shown = true end) end) end)
> shown  --> true)"},
    {"close_popup", guarded<ui_close_popup>, R"(
Closes the popup that is being described.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:open_popup "more" ui:popup("more", function() ui:close_popup() end) end) end)
> #ui.items  --> 1)"},
    {"disabled", guarded<ui_disabled>, R"(
Widgets that are disabled, and gray, if `disabled` is true.
@param disabled boolean  are they?
@param draw fun(ui: ui)  describes the widgets
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:disabled(true, function() ui:button "go" end) end) end)
> ui.items[#ui.items].enabled  --> false)"},
    {"id", guarded<ui_id>, R"(
A scope for labels: those of its widgets may equal labels outside it.
@param id string  unique name
@param draw fun(ui: ui)  describes the widgets
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:id("a", function() ui:button "go" end) ui:id("b", function() ui:button "go" end) end) end)
> #ui.items  --> 3)"},
    {"clip", guarded<ui_clip>, R"(
Restricts lines, circles and labels over the picture to a rectangle.
@param x number [pixels]  of its upper left corner
@param y number [pixels]  of its upper left corner
@param width number [pixels]  of the rectangle
@param height number [pixels]  of the rectangle
@param draw fun(ui: ui)  draws them
@effect edits
> ui:frame(0.01, function(ui) ui:clip(0, 0, 10, 10, function(ui) ui:circle(10, 10, 5) end) end)
> ui:clip(0, 0, 9, 9, print)  --> error: expected a call within ui:frame)"},
    {"channels", guarded<ui_channels>, R"(
Restricts lines, circles and labels over the picture to some of its colors.
@param channels "all"|"red"|"cyan"  the colors that are drawn
@param draw fun(ui: ui)  draws them
@effect edits
> ui:frame(0.01, function(ui) ui:channels("red", function(ui) ui:circle(10, 10, 5) end) end)
> ui:channels("red", print)  --> error: expected a call within ui:frame)"},
    {"group", guarded<ui_group>, R"(
Widgets laid out as one.
@param draw fun(ui: ui)  describes the widgets
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:group(function() ui:text "a" ui:text "b" end) end) end)
> #ui.items  --> 3)"},
    {"tabs", guarded<ui_tabs>, R"(
Tabs.
@param id string  unique name
@param names string[]  of the tabs
@param draw fun(ui: ui, name: string)  describes the open one
@param chosen? string  name of the tab that is opened now
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:tabs("t", {"one", "two"}, function(ui, name) chosen = name end) end) end)
> chosen  --> one)"},
    {"tree", guarded<ui_tree>, R"(
A node of a tree.
@param label string  text
@param options table  look
@option open? boolean = false  true: open at first
@option leaf? boolean = false  true: without children
@option selected? boolean = false  true: highlighted
@option unfold? boolean = false  true: opened now
@param draw? fun(ui: ui)  describes what is below it
@return boolean clicked
@return boolean double_clicked
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() clicked = ui:tree("node", {leaf = true}) end) end)
> clicked  --> false)"},
    {"collapsing", guarded<ui_collapsing>, R"(
A section with a title that folds it.
@param label string  title
@param open boolean  at first
@param draw fun(ui: ui)  describes the contents
@return boolean open
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() open = ui:collapsing("more", true, function() end) end) end)
> open  --> true)"},
    {"table", guarded<ui_table>, R"(
A table, filled cell by cell after next_column.
@param id string  unique name
@param columns string[]  titles
@param options table  size
@option height? number [pixels] = 0  0: as high as its rows
@param draw fun(ui: ui)  describes the cells
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:table("t", {"a", "b"}, {}, function() ui:next_column() ui:text "1" end) end) end)
> ui:table("t", {"a"}, {}, print)  --> error: expected a call within ui:frame)"},
    {"next_column", guarded<ui_next_column>, R"(
Moves on to the next cell of a table.
@effect edits
> ui:frame(0.01, function(ui) ui:window("w", {width = 300, height = 200}, function() ui:table("t", {"a", "b"}, {}, function() for i = 1, 4 do ui:next_column() ui:text(tostring(i)) end end) end) end)
> ui:next_column()  --> error: expected a call within ui:frame)"},
};

const Class ui_containers_class{
    .name = "ui_containers",
    .variable = "ui",
    .doc = "Windows, menus, trees, tables and other parts of a user interface that hold widgets.",
    .methods = ui_container_methods};

}  // namespace clench
