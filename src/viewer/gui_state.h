// Data of a Gui, shared by the files that implement it.
#pragma once
#include <imgui.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <thread>

#include "clench/render/gl/gl_objects.h"
#include "clench/viewer/gui.h"

namespace clench {

struct Gui::State {
  std::unique_ptr<Screen> screen;
  std::shared_ptr<void> entered;  // between begin() and end()
  ImGuiContext* context = nullptr;
  GuiStyle style;
  bool style_changed = true;
  std::deque<InputEvent> waiting;
  std::vector<KeyPress> pressed;
  std::vector<std::string> dropped;
  bool close_requested = false;
  std::vector<GuiItem> items, last_items;
  std::vector<std::string> windows;  // containers being described, outermost first
  int disabled = 0;
  struct Texture {
    gl::Object texture;
    int width = 0, height = 0;
    int frame = 0;  // last frame that used it
  };
  std::map<std::string, Texture> images;
  Renderer renderer{Renderer::Context::caller};
  bool shown = false;  // has the scene of this frame been drawn?
  int frame = 0;

  /// Makes the Dear ImGui context of this interface the current one.
  void use() const { ImGui::SetCurrentContext(context); }
  /// Records the last widget.
  void note(const std::string& label, const char* kind);
};

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
