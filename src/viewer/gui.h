// An immediate-mode user interface over a picture: windows, menus and widgets, described anew for
// each frame. Built on Dear ImGui, whose types are not visible outside this module.
#pragma once
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clench/base/function_ref.h"
#include "clench/render/renderer.h"
#include "clench/viewer/event.h"
#include "clench/viewer/screen.h"

namespace clench {

/// Rectangle on the screen, from its upper left corner [pixels].
struct GuiRect {
  double x = 0, y = 0, width = 0, height = 0;
  bool contains(double at_x, double at_y) const {
    return at_x >= x && at_x < x + width && at_y >= y && at_y < y + height;
  }
};

/// A widget of the last frame, by its visible label.
struct GuiItem {
  std::string label;
  std::string kind;    ///< "button", "menu", "text", ...
  std::string window;  ///< label of the window that contains it
  GuiRect rect;
  bool enabled = true;
};

/// A key pressed in this frame, with the modifiers held at that time.
struct KeyPress {
  int key = 0;  ///< GLFW key code
  bool ctrl = false, shift = false, alt = false;
};

/// A color: red, green, blue, opacity, each from 0 to 1.
using Rgba = std::array<float, 4>;

/// Where and how a scene is drawn: for pictures of two eyes, half of the screen, or some of the
/// channels red, green and blue.
struct ScenePane {
  enum class Part { all, left, right };
  Part part = Part::all;
  std::array<bool, 3> channels = {true, true, true};
  DrawStyle style = DrawStyle::faces;
  bool operator==(const ScenePane&) const = default;
};

struct GuiStyle {
  bool dark = false;
  double scale = 1;       ///< factor of fonts and sizes, 0.25 to 8
  double font_size = 15;  ///< at scale 1; times scale 4 to 128 [pixels]
};

struct WindowOptions {
  GuiRect rect;
  bool title = true, resizable = false, movable = false, scroll = true, background = true;
  bool modal = false;
  bool can_close = false;
};

/// A widget's value after the user's input, and whether that changed it.
template <class T>
struct Edited {
  T value;
  bool changed = false;
  bool finished = false;  ///< has the edit ended, by the release of a drag or by Enter?
};

/// Used by one thread at a time. Between begin() and end(), each call describes one widget;
/// containers call `body` for their contents if these are visible, and are closed even if it
/// throws.
class Gui {
 public:
  /// throws  Error if another thread has a Gui, or as the screen does
  Gui(std::unique_ptr<Screen> screen, const GuiStyle& style);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // --- frames ---
  void set_style(const GuiStyle& style);
  const GuiStyle& style() const;
  /// Adds input, applied by the next frames: in its order, and not before clicks and keys ahead of it
  /// have had their effect.
  void add(InputEvent event);
  /// Collects input of the window system.
  /// returns  true if there is input that no frame has applied yet
  bool poll();
  /// dt  time since the last frame, > 0 [s]
  void begin(double dt);
  /// Shows the scene behind all panels, as a draft with the size of the pane. It is drawn at the end
  /// of the frame, unless all panes of the frame are those of the last picture, which is kept.
  /// throws  Error if scene, eye or size are invalid
  void show(Scene scene, const Eye& eye, const ScenePane& pane = {});
  /// Camera that frames the scene.
  Eye frame_all(const Scene& scene);
  /// Ends the frame, in any case.
  /// throws  Error if the driver fails to draw the picture
  void end();
  /// Draws the last frame again, all of its picture anew, including what panels cover; images of
  /// widgets are uploaded anew in the next frame. Within a frame, that applies to this one.
  /// throws  Error if the driver fails
  void redraw();
  int pictures_drawn() const;  ///< number of panes that have been drawn
  /// Continues the frames of this interface after frames of others.
  void resume();
  /// The pixels of the last frame.
  Picture read();
  int width() const;
  int height() const;
  std::string renderer() const;  ///< name of the OpenGL renderer
  void set_title(const std::string& title);
  bool close_requested() const;  ///< since the last begin()
  void close_handled();
  /// Files dropped on the window since the last call.
  std::vector<std::string> take_dropped();
  const std::vector<GuiItem>& items() const;

  // --- input of this frame ---
  std::vector<KeyPress> pressed() const;
  bool key_down(int key) const;
  std::array<double, 2> mouse() const;       ///< [pixels]
  std::array<double, 2> mouse_move() const;  ///< since the last frame [pixels]
  double wheel() const;
  bool button_down(int button) const;
  bool button_clicked(int button) const;  ///< pressed in this frame
  bool button_released(int button) const;
  bool double_clicked(int button) const;
  /// second or later press of a multiple click, in this frame
  bool clicked_again(int button) const;
  bool wants_mouse() const;  ///< is the mouse over a panel, or a widget of a panel held?
  bool wants_text() const;   ///< is text being typed into a widget?

  // --- containers ---
  using Body = FunctionRef<void()>;
  /// returns  false: the user has closed it
  bool window(const std::string& name, const WindowOptions& options, Body body);
  void child(const std::string& id, double width, double height, bool border, Body body);
  void menu_bar(Body body);
  void menu(const std::string& label, bool enabled, Body body);
  bool menu_item(const std::string& label, const std::string& shortcut, bool selected,
                 bool enabled);
  void open_popup(const std::string& id);
  void popup(const std::string& id, Body body);
  void context_menu(const std::string& id, Body body);  ///< of the last widget
  void close_popup();
  void disabled(bool disabled, Body body);
  void id(const std::string& id, Body body);
  void group(Body body);
  /// chosen  number of the tab that is opened now, if any
  void tabs(const std::string& id, std::span<const std::string> names, std::optional<size_t> chosen,
            FunctionRef<void(size_t)> body);
  struct TreeOptions {
    bool open = false, leaf = false, selected = false;
    bool unfold = false;  ///< opened now
  };
  /// returns  clicked (1), double-clicked (2) or neither (0)
  int tree(const std::string& label, const TreeOptions& options, Body body);
  bool collapsing(const std::string& label, bool open, Body body);
  void table(const std::string& id, std::span<const std::string> columns, double height, Body body);
  void next_column();

  // --- widgets ---
  void text(const std::string& text, std::optional<Rgba> color, bool wrap);
  bool button(const std::string& label, double width, double height, bool selected);
  Edited<bool> checkbox(const std::string& label, bool value);
  bool radio(const std::string& label, bool selected);
  bool selectable(const std::string& label, bool selected);
  Edited<double> slider(const std::string& label, double value, double low, double high,
                        const std::string& format);
  Edited<double> drag(const std::string& label, double value, double speed, double low, double high,
                      const std::string& format);
  Edited<double> number(const std::string& label, double value, double step,
                        const std::string& format);
  struct InputOptions {
    std::string hint;
    int lines = 1;
    bool on_enter = false;
    bool focus = false;
    bool password = false;
    /// called at Tab with the text before the cursor; what it returns is inserted there
    std::function<std::string(const std::string& before)> complete;
  };
  Edited<std::string> input(const std::string& label, const std::string& value,
                            const InputOptions& options);
  Edited<int> combo(const std::string& label, int index, std::span<const std::string> choices);
  void progress(double fraction, const std::string& text, double width);
  /// Curves over one range of values; those without a color have that of a plot.
  void curves(const std::string& label, std::span<const std::vector<double>> curves,
              std::span<const Rgba> colors, std::optional<double> low, std::optional<double> high,
              double height);
  void plot(const std::string& label, std::span<const double> values, std::optional<double> low,
            std::optional<double> high, double height);
  /// key  identifies the picture between frames: its pixels are uploaded if they have changed
  bool image(const std::string& key, const Picture& picture, double width, double height);
  void separator();
  void same_line(double spacing);
  void spacing();
  void indent(double width);
  void next_width(double width);
  void tooltip(const std::string& text);  ///< of the last widget
  void focus_next();
  void scroll_to_end();
  void reveal();         ///< scrolls the last widget into view, as little as possible
  bool hovered() const;  ///< is the mouse over the last widget?
  bool active() const;   ///< is the last widget held or edited?
  bool deactivated_after_edit() const;
  std::array<double, 2> available() const;  ///< remaining size of the container [pixels]
  GuiRect last_rect() const;                ///< of the last widget
  double line_height() const;

  // --- drawing over the picture, under the panels [pixels] ---
  /// Restricts what `body` draws to a rectangle.
  void clip(const GuiRect& rect, Body body);
  /// Restricts what `body` draws to some of red, green and blue.
  void channels(const std::array<bool, 3>& colors, Body body);
  void line(std::span<const std::array<double, 2>> points, const Rgba& color, double width,
            bool closed);
  void polygon(std::span<const std::array<double, 2>> points, const Rgba& color);
  void circle(double x, double y, double radius, const Rgba& color, double width, bool filled);
  void label(double x, double y, const std::string& text, const Rgba& color);

  struct State;  ///< for the files that implement this class

 private:
  std::unique_ptr<State> state_;
};

}  // namespace clench
