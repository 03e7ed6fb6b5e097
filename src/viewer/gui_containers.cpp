#include <imgui_internal.h>

#include <algorithm>
#include <cfloat>

#include "clench/viewer/gui_state.h"

namespace clench {

std::string visible_label(const std::string& label) { return label.substr(0, label.find("##")); }

ImVec4 to_imgui(const Rgba& color) { return {color[0], color[1], color[2], color[3]}; }
ImU32 packed(const Rgba& color) { return ImGui::ColorConvertFloat4ToU32(to_imgui(color)); }

void Gui::State::note(const std::string& label, const char* kind) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  if (!ImGui::IsItemVisible()) return;
  items.push_back({.label = visible_label(label),
                   .kind = kind,
                   .window = windows.empty() ? "" : windows.back(),
                   .rect = {low.x, low.y, high.x - low.x, high.y - low.y},
                   .enabled = disabled == 0});
}

bool Gui::window(const std::string& name, const WindowOptions& options, Body body) {
  State& s = *state_;
  const ImGuiCond when =
      options.movable || options.resizable ? ImGuiCond_Appearing : ImGuiCond_Always;
  const GuiRect& at = options.rect;
  if (at.width > 0) {
    ImGui::SetNextWindowPos({pixels(at.x), pixels(at.y)}, when);
    ImGui::SetNextWindowSize({pixels(at.width), pixels(at.height)}, when);
  }
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;
  if (!options.title) flags |= ImGuiWindowFlags_NoTitleBar;
  if (!options.resizable) flags |= ImGuiWindowFlags_NoResize;
  if (!options.movable) flags |= ImGuiWindowFlags_NoMove;
  if (!options.scroll) flags |= ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  if (!options.background) flags |= ImGuiWindowFlags_NoBackground;
  if (!options.movable && !options.modal) flags |= ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (at.width <= 0) flags |= ImGuiWindowFlags_AlwaysAutoResize;
  bool open = true;
  if (options.modal) {
    if (!ImGui::IsPopupOpen(imgui_label(name))) ImGui::OpenPopup(imgui_label(name));
    if (at.width <= 0)
      ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing,
                              {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(imgui_label(name), options.can_close ? &open : nullptr, flags))
      return open;
    s.windows.push_back(visible_label(name));
    const Closing closing([&] { s.windows.pop_back(), ImGui::EndPopup(); });
    body();
    return open;
  }
  const bool visible = ImGui::Begin(imgui_label(name), options.can_close ? &open : nullptr, flags);
  s.windows.push_back(visible_label(name));
  const Closing closing([&] { s.windows.pop_back(), ImGui::End(); });
  const ImGuiWindow& own = *ImGui::GetCurrentWindow();
  if (options.background && !options.movable && !own.Hidden)
    s.opaque.push_back({own.Pos.x, own.Pos.y, own.Size.x, own.Size.y});
  if (visible && options.title) {
    const ImRect bar = own.TitleBarRect();
    s.items.push_back({.label = visible_label(name),
                       .kind = "window",
                       .window = visible_label(name),
                       .rect = {bar.Min.x, bar.Min.y, bar.GetWidth(), bar.GetHeight()}});
  }
  if (visible) body();
  return open;
}

void Gui::child(const std::string& id, double width, double height, bool border, Body body) {
  const bool visible = ImGui::BeginChild(imgui_label(id), {pixels(width), pixels(height)}, border);
  const Closing closing([] { ImGui::EndChild(); });
  if (visible) body();
}

void Gui::menu_bar(Body body) {
  if (!ImGui::BeginMainMenuBar()) return;
  state_->windows.push_back("menu bar");
  const Closing closing([this] { state_->windows.pop_back(), ImGui::EndMainMenuBar(); });
  body();
}

void Gui::menu(const std::string& label, bool enabled, Body body) {
  // a menu that is higher than the space below its title is scrolled: placed over the title, it
  // would take the release of the button that opened it as a click on an entry
  const float below = ImGui::GetCursorScreenPos().y + ImGui::GetFrameHeight();
  const float space = std::max(ImGui::GetIO().DisplaySize.y - below - 8, 60.0F);
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(FLT_MAX, space));
  const bool open = ImGui::BeginMenu(imgui_label(label), enabled);
  if (open) {
    state_->windows.push_back(visible_label(label));
    const Closing closing([this] { state_->windows.pop_back(), ImGui::EndMenu(); });
    body();
  }
  // after EndMenu, and while it is closed, the last widget is the menu's title
  state_->note(label, "menu");
}

bool Gui::menu_item(const std::string& label, const std::string& shortcut, bool selected,
                    bool enabled) {
  const bool clicked = ImGui::MenuItem(
      imgui_label(label), shortcut.empty() ? nullptr : shortcut.c_str(), selected, enabled);
  state_->note(label, "menu item");
  if (!state_->items.empty() && state_->items.back().label == visible_label(label))
    state_->items.back().enabled = enabled;
  return clicked;
}

void Gui::open_popup(const std::string& id) { ImGui::OpenPopup(imgui_label(id)); }
void Gui::close_popup() { ImGui::CloseCurrentPopup(); }

void Gui::popup(const std::string& id, Body body) {
  if (!ImGui::BeginPopup(imgui_label(id))) return;
  state_->windows.push_back(visible_label(id));
  const Closing closing([this] { state_->windows.pop_back(), ImGui::EndPopup(); });
  body();
}

void Gui::context_menu(const std::string& id, Body body) {
  if (!ImGui::BeginPopupContextItem(imgui_label(id))) return;
  state_->windows.push_back(visible_label(id));
  const Closing closing([this] { state_->windows.pop_back(), ImGui::EndPopup(); });
  body();
}

void Gui::disabled(bool disabled, Body body) {
  if (!disabled) return body();
  ImGui::BeginDisabled();
  ++state_->disabled;
  const Closing closing([this] { --state_->disabled, ImGui::EndDisabled(); });
  body();
}

void Gui::id(const std::string& id, Body body) {
  ImGui::PushID(imgui_label(id));
  const Closing closing([] { ImGui::PopID(); });
  body();
}

void Gui::group(Body body) {
  ImGui::BeginGroup();
  const Closing closing([] { ImGui::EndGroup(); });
  body();
}

void Gui::tabs(const std::string& id, std::span<const std::string> names,
               std::optional<size_t> chosen, FunctionRef<void(size_t)> body) {
  if (!ImGui::BeginTabBar(imgui_label(id))) return;
  const Closing closing([] { ImGui::EndTabBar(); });
  for (size_t i = 0; i < names.size(); ++i) {
    const ImGuiTabItemFlags flags = chosen == i ? ImGuiTabItemFlags_SetSelected : 0;
    const bool open = ImGui::BeginTabItem(imgui_label(names[i]), nullptr, flags);
    state_->note(names[i], "tab");
    if (!open) continue;
    const Closing closing_tab([] { ImGui::EndTabItem(); });
    body(i);
  }
}

int Gui::tree(const std::string& label, const TreeOptions& options, Body body) {
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth;
  if (options.open) flags |= ImGuiTreeNodeFlags_DefaultOpen;
  if (options.leaf) flags |= ImGuiTreeNodeFlags_Leaf;
  if (options.selected) flags |= ImGuiTreeNodeFlags_Selected;
  if (options.unfold) ImGui::SetNextItemOpen(true);
  const bool open = ImGui::TreeNodeEx(imgui_label(label), flags);
  state_->note(label, "tree");
  int clicked = 0;
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen())
    clicked = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ? 2 : 1;
  if (open) {
    const Closing closing([] { ImGui::TreePop(); });
    body();
  }
  return clicked;
}

bool Gui::collapsing(const std::string& label, bool open, Body body) {
  const bool visible = ImGui::CollapsingHeader(
      imgui_label(label), open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  state_->note(label, "header");
  if (visible) body();
  return visible;
}

void Gui::table(const std::string& id, std::span<const std::string> columns, double height,
                Body body) {
  const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                ImGuiTableFlags_Resizable | ImGuiTableFlags_SizingStretchProp |
                                (height > 0 ? ImGuiTableFlags_ScrollY : 0);
  if (!ImGui::BeginTable(imgui_label(id), static_cast<int>(columns.size()), flags,
                         {0, pixels(height)}))
    return;
  const Closing closing([] { ImGui::EndTable(); });
  bool named = false;
  for (const std::string& column : columns) {
    ImGui::TableSetupColumn(column.c_str());
    named = named || !visible_label(column).empty();
  }
  if (named) {
    if (height > 0) ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
  }
  body();
}

void Gui::next_column() { ImGui::TableNextColumn(); }

}  // namespace clench
