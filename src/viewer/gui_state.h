// Data of a Gui, shared by the files that implement it.
#pragma once
#include <imgui.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "clench/render/gl/gl_objects.h"
#include "clench/render/paint/draft_target.h"
#include "clench/render/view/pixel_rect.h"
#include "clench/render/view/scene_key.h"
#include "clench/viewer/gui.h"

namespace clench {

struct Gui::State {
  std::unique_ptr<Screen> screen;
  std::shared_ptr<void> entered;  // between begin() and end()
  ImGuiContext* context = nullptr;
  GuiStyle style;
  bool style_changed = true;
  std::deque<InputEvent> waiting;
  int waited = 0;          // frames in which no waiting input was applied
  int acted = -100;        // last frame that applied a click, or a key that may do more than type
  int focus_asked = -100;  // last frame in which a widget asked for the focus
  std::array<std::optional<double>, 5> press_times;  // of the last press of each button [s]
  std::vector<KeyPress> pressed;
  std::vector<std::string> dropped;
  bool close_requested = false;
  std::vector<GuiItem> items, last_items;
  std::vector<std::string> windows;  // containers being described, outermost first
  int disabled = 0;
  struct Texture {
    gl::Object texture;
    int width = 0, height = 0;
    std::vector<uint8_t> pixels;  // that it has
    int frame = 0;                // last frame that used it
  };
  std::map<std::string, Texture> images;

  // --- the picture behind the panels ---
  struct Pane {
    Scene scene;
    Eye eye;
    ScenePane where;
  };
  // everything from which the pixels of a pane are computed
  struct KeptPane {
    SceneKey key;
    Eye eye;
    ScenePane where;
  };
  struct KeptPicture {
    std::optional<FrameTarget> target;
    std::vector<KeptPane> panes;     // empty: undefined pixels
    std::vector<PixelRect> covered;  // parts with undefined pixels
  };
  Renderer renderer{Renderer::Context::caller};
  std::vector<Pane> panes;      // of this frame
  std::vector<GuiRect> opaque;  // windows of this frame that hide the picture and do not move
  KeptPicture kept;
  bool draw_all = false;  // next time including covered parts
  int pictures_drawn = 0;
  int frame = 0;

  /// Makes the Dear ImGui context of this interface the current one.
  void use() const { ImGui::SetCurrentContext(context); }
  /// Applies the input of the next frame.
  void apply_input();
  /// Has the last click or key had its effect on windows and focus?
  bool has_settled() const;
  /// Are the kept pixels those of this frame's panes?
  bool shows_kept() const;
  /// Draws this frame's panes, except for covered parts.
  void draw_picture(std::vector<PixelRect> covers);
  /// Copies the picture, drawn if it has changed, to the screen.
  /// throws  Error if the driver fails
  void lay_picture();
  /// Draws the widgets of the last frame over the picture.
  void lay_interface() const;
  /// Nothing is reused in the next drawing.
  void discard_pictures();
  /// Records the last widget.
  void note(const std::string& label, const char* kind);
};

/// Tells the current Dear ImGui context the codes of keys.
void name_keys();

/// The visible part of a label: without "##id".
std::string visible_label(const std::string& label);

/// A position or size for Dear ImGui, whose integers do not hold larger ones.
inline float pixels(double x) { return static_cast<float>(std::clamp(x, -1e6, 1e6)); }

/// A label for Dear ImGui, which aborts at an empty one; "##" displays nothing, too.
inline const char* imgui_label(const std::string& label) {
  return label.empty() ? "##" : label.c_str();
}

ImVec4 to_imgui(const Rgba& color);
ImU32 packed(const Rgba& color);

/// throws  Error unless fonts of this style fit into a texture
void check_style(const GuiStyle& style);

/// Sets colors and sizes.
void apply_style(const GuiStyle& style);

/// An opened container; its destructor closes the container, also after an exception.
template <class Close>
class Closing {
 public:
  explicit Closing(Close close) : close_(close) {}
  ~Closing() { close_(); }
  Closing(const Closing&) = delete;
  Closing& operator=(const Closing&) = delete;

 private:
  Close close_;
};

}  // namespace clench
