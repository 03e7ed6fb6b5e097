// Input of a user interface. Dear ImGui sees only the state at each frame, so events that could
// hide each other are applied in successive frames.
#include <GLFW/glfw3.h>

#include <cfloat>
#include <utility>

#include "clench/viewer/gui_state.h"

namespace clench {

namespace {

using Kind = InputEvent::Kind;

constexpr float double_click_time = 0.3f;  // between two presses [s]
// frames until a click or key has opened a window, or a request for the focus has been met
constexpr int settling = 2;
// maximum number of frames that input waits, if the focus is requested again and again
constexpr int max_waiting = 20;

bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }

// keys that do nothing but type a character, where text is typed
bool is_character(int key) {
  return (key >= GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2) ||
         (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_ADD) || key == GLFW_KEY_KP_EQUAL;
}

bool is_known(int key) { return key >= 0 && key < IM_ARRAYSIZE(ImGuiIO::KeysDown); }

void set_key(ImGuiIO& io, int key, bool down) {
  io.KeysDown[key] = down;
  const auto either = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
  io.KeyCtrl = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
  io.KeyShift = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
  io.KeyAlt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
}

// Input of one frame: which events it can still take after those that it has taken.
class FrameInput {
 public:
  explicit FrameInput(Gui::State& state) : s_(state), io_(ImGui::GetIO()) {}

  /// returns  false: the event must wait for a later frame
  bool take(const InputEvent& event) {
    switch (event.kind) {
      case Kind::move:
        return move(event);
      case Kind::button:
        return button(event);
      case Kind::wheel:
        return wheel(event);
      case Kind::key:
        return !is_known(event.code) || key(event);
      case Kind::text:
        return text(event);
      case Kind::close:
        s_.close_requested = true;
        break;
      case Kind::drop:
        s_.dropped.push_back(event.text);
        break;
      case Kind::resize:
        break;
    }
    return true;
  }

 private:
  bool move(const InputEvent& event) {
    if (clicked_ || pressed_ || turned_) return false;
    io_.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
    return true;
  }
  bool button(const InputEvent& event) {
    if (clicked_ || pressed_ || typed_) return false;
    if (event.code >= 0 && event.code < IM_ARRAYSIZE(io_.MouseDown)) {
      io_.MouseDown[event.code] = event.down;
      if (event.down) time_press(event);
    }
    clicked_ = true;
    s_.acted = s_.frame + 1;
    return true;
  }
  // Dear ImGui compares the times of frames, which may be much later than those of the presses
  void time_press(const InputEvent& event) {
    const std::optional<double> last = std::exchange(s_.press_times[event.code], event.time);
    io_.MouseDoubleClickTime = double_click_time;
    if (!event.time) return;
    const double passed = last ? *event.time - *last : -1;
    io_.MouseDoubleClickTime = passed >= 0 && passed < double_click_time ? FLT_MAX : 0;
  }
  bool wheel(const InputEvent& event) {
    if (pressed_) return false;
    io_.MouseWheel += static_cast<float>(event.y);
    io_.MouseWheelH += static_cast<float>(event.x);
    return turned_ = true;
  }
  bool key(const InputEvent& event) {
    if (is_modifier(event.code)) {
      const bool is_shift = event.code == GLFW_KEY_LEFT_SHIFT || event.code == GLFW_KEY_RIGHT_SHIFT;
      if (clicked_ || pressed_ || turned_ || (typed_ && !is_shift)) return false;
      set_key(io_, event.code, event.down);
      return true;
    }
    if (!event.down) {
      if (pressed_) return false;
      set_key(io_, event.code, false);
      return true;
    }
    return press(event.code);
  }
  bool press(int key) {
    const bool ready = !clicked_ && !pressed_ && s_.has_settled();
    const bool types = io_.WantTextInput && is_character(key) && !io_.KeyCtrl && !io_.KeyAlt;
    if (!ready || (!types && (typed_ || turned_))) return false;
    set_key(io_, key, true);
    s_.pressed.push_back({key, io_.KeyCtrl, io_.KeyShift, io_.KeyAlt});
    if (types) return true;
    pressed_ = true, has_character_ = is_character(key);
    s_.acted = s_.frame + 1;
    return true;
  }
  // the character of a key is of no other frame than the key: what it opens must not receive it
  bool text(const InputEvent& event) {
    const bool ready = pressed_ ? has_character_ : s_.has_settled();
    if (clicked_ || !ready) return false;
    io_.AddInputCharactersUTF8(event.text.c_str());
    return typed_ = true;
  }

  Gui::State& s_;
  ImGuiIO& io_;
  bool clicked_ = false, pressed_ = false;  // a button, or a key that may do more than type
  bool has_character_ = false;              // may text be the character of that key?
  bool turned_ = false, typed_ = false;     // the wheel, text
};

}  // namespace

void name_keys() {
  ImGuiIO& io = ImGui::GetIO();
  const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                           {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                           {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                           {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                           {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                           {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                           {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                           {ImGuiKey_Home, GLFW_KEY_HOME},
                                           {ImGuiKey_End, GLFW_KEY_END},
                                           {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                           {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                           {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                           {ImGuiKey_Space, GLFW_KEY_SPACE},
                                           {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                           {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                           {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                           {ImGuiKey_A, GLFW_KEY_A},
                                           {ImGuiKey_C, GLFW_KEY_C},
                                           {ImGuiKey_V, GLFW_KEY_V},
                                           {ImGuiKey_X, GLFW_KEY_X},
                                           {ImGuiKey_Y, GLFW_KEY_Y},
                                           {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [key, code] : keys) io.KeyMap[key] = code;
}

void Gui::add(InputEvent event) { state_->waiting.push_back(std::move(event)); }

bool Gui::poll() {
  state_->screen->poll(state_->waiting);
  return !state_->waiting.empty();
}

bool Gui::State::has_settled() const {
  const int next = frame + 1;
  return waited >= max_waiting || (next - acted >= settling && next - focus_asked >= settling);
}

void Gui::State::apply_input() {
  pressed.clear();
  FrameInput input(*this);
  const size_t before = waiting.size();
  while (!waiting.empty() && input.take(waiting.front())) waiting.pop_front();
  waited = waiting.empty() || waiting.size() < before ? 0 : waited + 1;
}

static const ImGuiIO& input_of(const Gui::State& s) {
  s.use();
  return ImGui::GetIO();
}

std::vector<KeyPress> Gui::pressed() const { return state_->pressed; }
bool Gui::key_down(int key) const {
  const ImGuiIO& io = input_of(*state_);
  return key >= 0 && key < IM_ARRAYSIZE(io.KeysDown) && io.KeysDown[key];
}
std::array<double, 2> Gui::mouse() const {
  const ImVec2 at = input_of(*state_).MousePos;
  return {at.x, at.y};
}
std::array<double, 2> Gui::mouse_move() const {
  const ImVec2 by = input_of(*state_).MouseDelta;
  return {by.x, by.y};
}
double Gui::wheel() const { return input_of(*state_).MouseWheel; }
bool Gui::button_down(int button) const { return input_of(*state_).MouseDown[button]; }
bool Gui::button_clicked(int button) const { return input_of(*state_).MouseClicked[button]; }
bool Gui::button_released(int button) const { return input_of(*state_).MouseReleased[button]; }
bool Gui::double_clicked(int button) const { return input_of(*state_).MouseDoubleClicked[button]; }
bool Gui::clicked_again(int button) const {
  const ImGuiIO& io = input_of(*state_);
  return io.MouseClicked[button] && io.MouseClickedCount[button] > 1;
}
bool Gui::wants_mouse() const { return input_of(*state_).WantCaptureMouse; }
bool Gui::wants_text() const { return input_of(*state_).WantTextInput; }

}  // namespace clench
