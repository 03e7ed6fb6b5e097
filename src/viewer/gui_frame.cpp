#include "clench/viewer/gui.h"

#include <backends/imgui_impl_opengl3.h>

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <atomic>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/viewer/gui_state.h"

namespace clench {

namespace {

// Dear ImGui has one current context per process: all user interfaces belong to one thread
std::mutex owner_mutex;
std::thread::id owner;
int owned = 0;

void claim_thread() {
  const std::lock_guard lock(owner_mutex);
  if (owned > 0 && owner != std::this_thread::get_id())
    fail("a view is open in another thread; close it first");
  owner = std::this_thread::get_id();
  ++owned;
}

void release_thread() {
  const std::lock_guard lock(owner_mutex);
  --owned;
}

constexpr int max_textures_idle = 120;  // frames until an unused image is released

void name_keys(ImGuiIO& io) {
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

bool changes_state(const InputEvent& event) {
  return event.kind == InputEvent::Kind::button || event.kind == InputEvent::Kind::key;
}

}  // namespace

Gui::Gui(std::unique_ptr<Screen> screen, const GuiStyle& style)
    : state_(std::make_unique<State>()) {
  check_style(style);
  claim_thread();
  try {
    state_->screen = std::move(screen);
    state_->style = style;
    const std::shared_ptr<void> entered = state_->screen->enter();
    state_->context = ImGui::CreateContext();
    state_->use();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.MousePos = ImVec2(-1, -1);
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ConfigInputTextCursorBlink = false;  // frames are drawn when something has changed
    name_keys(io);
    if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
      fail("the view needs OpenGL 3.3; install the packages libgl1 and libgl1-mesa-dri");
  } catch (...) {
    release_thread();
    throw;
  }
}

// another interface may be within a frame when this one is garbage-collected
Gui::~Gui() {
  ImGuiContext* const before = ImGui::GetCurrentContext();
  try {
    state_->entered.reset();
    const std::shared_ptr<void> entered = state_->screen->enter();
    state_->use();
    state_->images.clear();
    state_->renderer.clear();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(state_->context);
  } catch (const Error&) {
    // without the OpenGL context its objects no longer exist
  }
  ImGui::SetCurrentContext(before == state_->context ? nullptr : before);
  release_thread();
}

void Gui::resume() { state_->use(); }

void Gui::set_style(const GuiStyle& style) {
  check_style(style);
  state_->style = style, state_->style_changed = true;
}
const GuiStyle& Gui::style() const { return state_->style; }

void Gui::add(InputEvent event) { state_->waiting.push_back(std::move(event)); }

bool Gui::poll() {
  state_->screen->poll(state_->waiting);
  return !state_->waiting.empty();
}

// applies input up to the second change of a button or key
static void apply_input(Gui::State& s) {
  using Kind = InputEvent::Kind;
  ImGuiIO& io = ImGui::GetIO();
  s.pressed.clear();
  bool changed = false;
  while (!s.waiting.empty()) {
    const InputEvent event = s.waiting.front();
    if (changed && (changes_state(event) || event.kind == Kind::move)) break;
    s.waiting.pop_front();
    changed = changed || changes_state(event);
    if (event.kind == Kind::move) {
      io.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
    } else if (event.kind == Kind::button) {
      if (event.code >= 0 && event.code < 5) io.MouseDown[event.code] = event.down;
    } else if (event.kind == Kind::wheel) {
      io.MouseWheel += static_cast<float>(event.y);
      io.MouseWheelH += static_cast<float>(event.x);
    } else if (event.kind == Kind::text) {
      io.AddInputCharactersUTF8(event.text.c_str());
    } else if (event.kind == Kind::key) {
      if (event.code < 0 || event.code >= IM_ARRAYSIZE(io.KeysDown)) continue;
      io.KeysDown[event.code] = event.down;
      const auto down = [&](int left, int right) {
        return io.KeysDown[left] || io.KeysDown[right];
      };
      io.KeyCtrl = down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
      io.KeyShift = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
      io.KeyAlt = down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
      if (event.down) s.pressed.push_back({event.code, io.KeyCtrl, io.KeyShift, io.KeyAlt});
    } else if (event.kind == Kind::close) {
      s.close_requested = true;
    } else if (event.kind == Kind::drop) {
      s.dropped.push_back(event.text);
    }
  }
}

void Gui::begin(double dt) {
  State& s = *state_;
  s.entered = s.screen->enter();
  s.use();
  if (s.style_changed) {
    apply_style(s.style);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    s.style_changed = false;
  }
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize =
      ImVec2(static_cast<float>(s.screen->width()), static_cast<float>(s.screen->height()));
  io.DeltaTime = static_cast<float>(dt > 0 ? dt : 1e-3);
  apply_input(s);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  s.items.clear(), s.windows.clear();
  s.disabled = 0;
  s.shown = false;
  ++s.frame;
}

// the panels have no background yet
static void clear_screen(Gui::State& s) {
  glBindFramebuffer(GL_FRAMEBUFFER, s.screen->framebuffer());
  glViewport(0, 0, s.screen->width(), s.screen->height());
  glDisable(GL_SCISSOR_TEST);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

void Gui::show(const Scene& scene, const Eye& eye, const RenderOptions& options,
               const ScenePane& pane) {
  State& s = *state_;
  if (!s.shown) clear_screen(s);
  RenderOptions frame = options;
  frame.width = width(), frame.height = height();
  frame.quality = Quality::draft;
  const int left = frame.width / 2;
  int x = 0;
  if (pane.part == ScenePane::Part::left) frame.width = left;
  if (pane.part == ScenePane::Part::right) x = left, frame.width -= left;
  s.renderer.draw_to({.framebuffer = s.screen->framebuffer(), .x = x, .channels = pane.channels},
                     scene, eye, frame);
  s.shown = true;
}

Eye Gui::frame_all(const Scene& scene) {
  return state_->renderer.frame_all(scene, static_cast<double>(width()) / height());
}

void Gui::end() {
  State& s = *state_;
  s.use();
  ImGui::Render();
  if (!s.shown) clear_screen(s);
  glBindFramebuffer(GL_FRAMEBUFFER, s.screen->framebuffer());
  glViewport(0, 0, s.screen->width(), s.screen->height());
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  s.screen->present();
  std::erase_if(s.images, [&](const auto& image) {
    return s.frame - image.second.frame > max_textures_idle;
  });
  s.last_items.swap(s.items);
  s.entered.reset();
}

Picture Gui::read() {
  const std::shared_ptr<void> entered = state_->screen->enter();
  return state_->screen->read();
}

std::string Gui::renderer() const {
  const std::shared_ptr<void> entered = state_->screen->enter();
  return state_->screen->renderer();
}

int Gui::width() const { return state_->screen->width(); }
int Gui::height() const { return state_->screen->height(); }
void Gui::set_title(const std::string& title) { state_->screen->set_title(title); }
bool Gui::close_requested() const { return state_->close_requested; }
void Gui::close_handled() { state_->close_requested = false; }
std::vector<std::string> Gui::take_dropped() { return std::exchange(state_->dropped, {}); }
const std::vector<GuiItem>& Gui::items() const { return state_->last_items; }

// --- input ---

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
bool Gui::wants_mouse() const { return input_of(*state_).WantCaptureMouse; }
bool Gui::wants_text() const { return input_of(*state_).WantTextInput; }

}  // namespace clench
