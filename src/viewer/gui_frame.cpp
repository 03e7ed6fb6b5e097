#include "clench/viewer/gui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <epoxy/gl.h>

#include <atomic>
#include <exception>

#include "clench/base/error.h"
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

// Closes modal windows that were not described in this frame. Dear ImGui leaves them open if another
// window has the focus, and a window that appears in the next frame fails its assertion that a
// modal window is visible.
void close_abandoned_modals() {
  const ImVector<ImGuiPopupData>& popups = ImGui::GetCurrentContext()->OpenPopupStack;
  for (int i = 0; i < popups.Size; ++i) {
    const ImGuiWindow* window = popups[i].Window;
    if (!window || !(window->Flags & ImGuiWindowFlags_Modal) || window->Active) continue;
    ImGui::ClosePopupToLevel(i, false);
    return;
  }
}

constexpr int max_textures_idle = 120;  // frames until an unused image is released

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
    name_keys();
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
    state_->kept = {};
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
  s.apply_input();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  s.items.clear(), s.windows.clear();
  s.disabled = 0;
  s.panes.clear(), s.opaque.clear();
  ++s.frame;
}

void Gui::end() {
  State& s = *state_;
  s.use();
  close_abandoned_modals();
  ImGui::Render();
  std::exception_ptr problem;
  try {
    s.lay_picture();
  } catch (const Error&) {
    problem = std::current_exception();
  }
  s.lay_interface();
  s.screen->present();
  std::erase_if(s.images, [&](const auto& image) {
    return s.frame - image.second.frame > max_textures_idle;
  });
  s.last_items.swap(s.items);
  s.entered.reset();
  if (problem) std::rethrow_exception(problem);
}

void Gui::State::lay_interface() const {
  glBindFramebuffer(GL_FRAMEBUFFER, screen->framebuffer());
  glViewport(0, 0, screen->width(), screen->height());
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Gui::redraw() {
  State& s = *state_;
  const std::shared_ptr<void> entered = s.screen->enter();
  s.use();
  s.discard_pictures();
  if (!ImGui::GetDrawData()) return;  // within a frame, or before the first one
  s.lay_picture();
  s.lay_interface();
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

}  // namespace clench
