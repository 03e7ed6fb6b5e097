// The picture behind the panels: drawn when what it shows has changed, otherwise kept.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/view/frame.h"
#include "clench/viewer/gui_state.h"

namespace clench {

namespace {

constexpr int min_cover = 48;  // smaller covers save nothing [pixels]

bool same(const Eye& a, const Eye& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up &&
         a.field_of_view == b.field_of_view && a.ortho_height == b.ortho_height &&
         a.aside == b.aside;
}

bool is_kept(const Gui::State::Pane& pane, const Gui::State::KeptPane& kept) {
  return pane.where == kept.where && same(pane.eye, kept.eye) && kept.key.matches(pane.scene);
}

// a pane's left edge and size within the screen
struct PaneRect {
  int x;
  RenderOptions options;
};

PaneRect place(const Screen& screen, const ScenePane& pane) {
  PaneRect rect{0, {.width = screen.width(), .height = screen.height(), .quality = Quality::draft}};
  rect.options.style = pane.style;
  const int left = rect.options.width / 2;
  if (pane.part == ScenePane::Part::left) rect.options.width = left;
  if (pane.part == ScenePane::Part::right) rect.x = left, rect.options.width -= left;
  return rect;
}

void clear(unsigned framebuffer, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

// fixed panels, without their rounded corners
std::vector<PixelRect> find_covers(const Gui::State& s) {
  std::vector<PixelRect> covers;
  const int corner = static_cast<int>(std::ceil(ImGui::GetStyle().WindowRounding)) + 1;
  for (const GuiRect& rect : s.opaque) {
    const int x = static_cast<int>(std::ceil(rect.x)), y = static_cast<int>(std::ceil(rect.y));
    const int right = static_cast<int>(rect.x + rect.width);
    const int bottom = static_cast<int>(rect.y + rect.height);
    const PixelRect cover =
        PixelRect{x, s.screen->height() - bottom, right - x, bottom - y}.without(corner);
    if (cover.width >= min_cover && cover.height >= min_cover) covers.push_back(cover);
  }
  return covers;
}

bool are_covered(const std::vector<PixelRect>& parts, const std::vector<PixelRect>& covers) {
  return std::ranges::all_of(parts, [&](const PixelRect& part) {
    return std::ranges::any_of(covers, [&](const PixelRect& c) { return c.contains(part); });
  });
}

}  // namespace

void Gui::show(Scene scene, const Eye& eye, const ScenePane& pane) {
  check(scene);
  view_axes(eye);
  check(place(*state_->screen, pane).options);
  state_->panes.push_back({std::move(scene), eye, pane});
}

bool Gui::State::shows_kept() const {
  return kept.target && kept.target->width == screen->width() &&
         kept.target->height == screen->height() && std::ranges::equal(panes, kept.panes, is_kept);
}

void Gui::State::draw_picture(std::vector<PixelRect> covers) {
  const int width = screen->width(), height = screen->height();
  kept.panes.clear();
  if (!kept.target || kept.target->width != width || kept.target->height != height) {
    kept.target.reset();
    kept.target.emplace(width, height);
  }
  clear(kept.target->target, width, height);
  for (const Pane& pane : panes) {
    const auto& [x, options] = place(*screen, pane.where);
    std::vector<PixelRect> covered = covers;
    for (PixelRect& rect : covered) rect.x -= x;
    renderer.draw_to({kept.target->target, x, 0, pane.where.channels, std::move(covered)},
                     pane.scene, pane.eye, options);
    ++pictures_drawn;
  }
  for (const Pane& pane : panes) kept.panes.push_back({SceneKey(pane.scene), pane.eye, pane.where});
  kept.covered = std::move(covers);
}

void Gui::State::lay_picture() {
  const int width = screen->width(), height = screen->height();
  const unsigned framebuffer = screen->framebuffer();
  if (panes.empty()) return clear(framebuffer, width, height);
  const std::vector<PixelRect> covers = find_covers(*this);
  if (!shows_kept())
    draw_picture(draw_all ? std::vector<PixelRect>() : covers);
  else if (!are_covered(kept.covered, covers))
    draw_picture({});  // panels that shrink may do so in many frames
  draw_all = false;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, kept.target->target);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Gui::State::discard_pictures() {
  kept.panes.clear();
  for (auto& [key, image] : images) image.pixels.clear();
  draw_all = true;
}

int Gui::pictures_drawn() const { return state_->pictures_drawn; }

Eye Gui::frame_all(const Scene& scene) {
  return state_->renderer.frame_all(scene, static_cast<double>(width()) / height());
}

}  // namespace clench
