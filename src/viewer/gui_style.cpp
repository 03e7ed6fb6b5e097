#include <imgui.h>

#include <filesystem>

#include "clench/base/error.h"
#include "clench/viewer/gui_state.h"

namespace clench {

namespace {

// Latin, Greek, punctuation, arrows, mathematical operators, shapes and symbols
constexpr ImWchar letters[] = {0x20,   0x17F,  0x370,  0x3FF,  0x2010, 0x205E, 0x2190, 0x21FF,
                               0x2200, 0x22FF, 0x2300, 0x23FF, 0x25A0, 0x27BF, 0};

void load_font(const GuiStyle& style) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  const float size = static_cast<float>(style.font_size * style.scale);
  std::error_code none;
  if (std::filesystem::exists(CLENCH_FONT, none))
    fonts.AddFontFromFileTTF(CLENCH_FONT, size, nullptr, letters);
  else
    fonts.AddFontDefault();
  fonts.Build();
}

ImVec4 mixed(const ImVec4& a, const ImVec4& b, float part) {
  return {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, a.z + (b.z - a.z) * part,
          a.w + (b.w - a.w) * part};
}

}  // namespace

void check_style(const GuiStyle& style) {
  constexpr double min_scale = 0.25, max_scale = 8, min_size = 4, max_size = 128;
  const double size = style.font_size * style.scale;
  if (!(style.scale >= min_scale && style.scale <= max_scale))
    fail("scale of the view: expected {} to {}, got {}", min_scale, max_scale, style.scale);
  if (!(size >= min_size && size <= max_size))
    fail("font_size of the view, times its scale: expected {} to {} pixels, got {}", min_size,
         max_size, size);
}

void apply_style(const GuiStyle& style) {
  ImGuiStyle& s = ImGui::GetStyle();
  s = ImGuiStyle();
  s.WindowRounding = 4, s.FrameRounding = 3, s.PopupRounding = 4, s.GrabRounding = 3;
  s.ScrollbarRounding = 6, s.TabRounding = 3, s.ChildRounding = 3;
  s.WindowBorderSize = 1, s.FrameBorderSize = style.dark ? 0.0f : 1.0f, s.PopupBorderSize = 1;
  s.WindowPadding = {8, 8}, s.FramePadding = {7, 4}, s.ItemSpacing = {8, 5};
  s.ItemInnerSpacing = {6, 4}, s.IndentSpacing = 16, s.ScrollbarSize = 12;
  s.WindowTitleAlign = {0.02f, 0.5f};
  s.WindowMenuButtonPosition = ImGuiDir_None;
  const ImVec4 paper =
      style.dark ? ImVec4{0.13f, 0.14f, 0.16f, 1} : ImVec4{0.965f, 0.968f, 0.975f, 1};
  const ImVec4 ink = style.dark ? ImVec4{0.90f, 0.91f, 0.93f, 1} : ImVec4{0.12f, 0.14f, 0.18f, 1};
  // blue of the palette of Okabe and Ito, safe for the color-blind
  const ImVec4 accent = style.dark ? ImVec4{0.34f, 0.71f, 0.91f, 1} : ImVec4{0.0f, 0.45f, 0.70f, 1};
  ImVec4* c = s.Colors;
  style.dark ? ImGui::StyleColorsDark() : ImGui::StyleColorsLight();
  c[ImGuiCol_Text] = ink;
  c[ImGuiCol_TextDisabled] = mixed(paper, ink, 0.45f);
  c[ImGuiCol_WindowBg] = c[ImGuiCol_MenuBarBg] = paper;
  c[ImGuiCol_PopupBg] =
      mixed(paper, style.dark ? ink : ImVec4{1, 1, 1, 1}, style.dark ? 0.05f : 0.8f);
  c[ImGuiCol_ChildBg] = ImVec4{0, 0, 0, 0};
  c[ImGuiCol_Border] = mixed(paper, ink, 0.18f);
  c[ImGuiCol_Separator] = mixed(paper, ink, 0.14f);
  c[ImGuiCol_FrameBg] = style.dark ? mixed(paper, ink, 0.08f) : ImVec4{1, 1, 1, 1};
  c[ImGuiCol_FrameBgHovered] = mixed(c[ImGuiCol_FrameBg], accent, 0.15f);
  c[ImGuiCol_FrameBgActive] = mixed(c[ImGuiCol_FrameBg], accent, 0.28f);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] =
      mixed(paper, ink, 0.07f);
  c[ImGuiCol_Button] = mixed(paper, ink, style.dark ? 0.14f : 0.06f);
  c[ImGuiCol_ButtonHovered] = mixed(paper, accent, 0.28f);
  c[ImGuiCol_ButtonActive] = mixed(paper, accent, 0.50f);
  c[ImGuiCol_Header] = mixed(paper, accent, 0.22f);
  c[ImGuiCol_HeaderHovered] = mixed(paper, accent, 0.32f);
  c[ImGuiCol_HeaderActive] = mixed(paper, accent, 0.45f);
  c[ImGuiCol_CheckMark] = accent;
  c[ImGuiCol_SliderGrab] = mixed(paper, accent, 0.45f);  // the value is written over it
  c[ImGuiCol_SliderGrabActive] = mixed(paper, accent, 0.6f);
  c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = accent;
  c[ImGuiCol_Tab] = mixed(paper, ink, 0.05f);
  c[ImGuiCol_TabHovered] = mixed(paper, accent, 0.35f);
  c[ImGuiCol_TabActive] = mixed(paper, accent, 0.22f);
  c[ImGuiCol_TableHeaderBg] = mixed(paper, ink, 0.06f);
  c[ImGuiCol_TableBorderLight] = c[ImGuiCol_TableBorderStrong] = mixed(paper, ink, 0.12f);
  c[ImGuiCol_TableRowBgAlt] = mixed(paper, ink, 0.025f);
  c[ImGuiCol_ScrollbarBg] = ImVec4{0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = mixed(paper, ink, 0.25f);
  c[ImGuiCol_TextSelectedBg] = mixed(paper, accent, 0.4f);
  c[ImGuiCol_ModalWindowDimBg] = ImVec4{0, 0, 0, 0.35f};
  s.ScaleAllSizes(static_cast<float>(style.scale));
  load_font(style);
}

}  // namespace clench
