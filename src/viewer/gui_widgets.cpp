#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>

#include "clench/base/error.h"
#include "clench/viewer/gui_state.h"

namespace clench {

namespace {

// formats of numbers come from scripts: only one conversion of a floating-point number is allowed
std::string checked_format(const std::string& format) {
  const size_t percent = format.find('%');
  const bool single =
      percent != std::string::npos && format.find('%', percent + 1) == std::string::npos;
  const size_t end = single ? format.find_first_not_of("0123456789.+- #", percent + 1) : percent;
  constexpr size_t max_flags = 6;  // wide numbers would fill the memory
  if (end != std::string::npos && end - percent <= max_flags + 1 &&
      std::string_view("fgeFGE").find(format[end]) != std::string_view::npos)
    return format;
  return "%.4g";
}

template <class T>
Edited<T> edited(T value, bool changed) {
  return {std::move(value), changed, ImGui::IsItemDeactivatedAfterEdit()};
}

// the beginning of a text: of a wrapped one Dear ImGui draws every character, also those outside of
// the window, and ends the program beyond 16383
std::string_view wrappable(std::string_view text) {
  constexpr size_t max_size = 10000;  // [bytes]
  if (text.size() <= max_size) return text;
  size_t end = max_size;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

// in lines of at most 40 em, within the screen
void open_tooltip(const std::string& text) {
  const float screen = ImGui::GetIO().DisplaySize.x - 4 * ImGui::GetStyle().WindowPadding.x;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(std::max(1.0F, std::min(40 * ImGui::GetFontSize(), screen)));
  const std::string_view drawn = wrappable(text);
  ImGui::TextUnformatted(drawn.data(), drawn.data() + drawn.size());
  ImGui::PopTextWrapPos();
}

// the completion of a text that is being typed; an exception must not pass through Dear ImGui
struct Completion {
  const Gui::InputOptions& options;
  std::exception_ptr problem;

  static int run(ImGuiInputTextCallbackData* data) {
    auto& self = *static_cast<Completion*>(data->UserData);
    try {
      const std::string before(data->Buf, static_cast<size_t>(data->CursorPos));
      const std::string rest = self.options.complete(before);
      data->InsertChars(data->CursorPos, rest.data(), rest.data() + rest.size());
    } catch (const std::exception&) {
      self.problem = std::current_exception();
    }
    return 0;
  }
};

}  // namespace

void Gui::text(const std::string& text, std::optional<Rgba> color, bool wrap) {
  if (color) ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(*color));
  if (wrap) ImGui::PushTextWrapPos(0);
  const std::string_view drawn = wrap ? wrappable(text) : text;
  ImGui::TextUnformatted(drawn.data(), drawn.data() + drawn.size());
  state_->note(text, "text");
  if (drawn.size() < text.size()) {
    const std::string rest = "... (" + std::to_string(text.size()) + " bytes)";
    ImGui::TextUnformatted(rest.c_str());
    state_->note(rest, "text");
  }
  if (wrap) ImGui::PopTextWrapPos();
  if (color) ImGui::PopStyleColor();
}

bool Gui::button(const std::string& label, double width, double height, bool selected) {
  if (selected)
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
  const bool clicked = ImGui::Button(imgui_label(label), {pixels(width), pixels(height)});
  if (selected) ImGui::PopStyleColor();
  state_->note(label, "button");
  return clicked;
}

Edited<bool> Gui::checkbox(const std::string& label, bool value) {
  const bool changed = ImGui::Checkbox(imgui_label(label), &value);
  state_->note(label, "checkbox");
  return {value, changed, changed};
}

bool Gui::radio(const std::string& label, bool selected) {
  const bool clicked = ImGui::RadioButton(imgui_label(label), selected);
  state_->note(label, "radio");
  return clicked;
}

bool Gui::selectable(const std::string& label, bool selected) {
  const bool clicked =
      ImGui::Selectable(imgui_label(label), selected, ImGuiSelectableFlags_AllowDoubleClick);
  state_->note(label, "selectable");
  return clicked;
}

Edited<double> Gui::slider(const std::string& label, double value, double low, double high,
                           const std::string& format) {
  constexpr double max_value = 1e300;  // Dear ImGui aborts at a range wider than a double
  if (!(std::abs(low) <= max_value && std::abs(high) <= max_value))
    fail("slider '{}': expected a range within -1e300 to 1e300, got {} to {}", label, low, high);
  const bool changed = ImGui::SliderScalar(imgui_label(label), ImGuiDataType_Double, &value, &low,
                                           &high, checked_format(format).c_str());
  const Edited<double> result = edited(value, changed);
  state_->note(label, "slider");
  return result;
}

Edited<double> Gui::drag(const std::string& label, double value, double speed, double low,
                         double high, const std::string& format) {
  const bool bounded = std::isfinite(low) || std::isfinite(high);
  const bool changed =
      ImGui::DragScalar(imgui_label(label), ImGuiDataType_Double, &value, static_cast<float>(speed),
                        bounded ? &low : nullptr, bounded ? &high : nullptr,
                        checked_format(format).c_str(), ImGuiSliderFlags_AlwaysClamp);
  const Edited<double> result = edited(value, changed);
  state_->note(label, "drag");
  return result;
}

Edited<double> Gui::number(const std::string& label, double value, double step,
                           const std::string& format) {
  const bool changed = ImGui::InputDouble(imgui_label(label), &value, step, 10 * step,
                                          checked_format(format).c_str());
  const Edited<double> result = edited(std::isfinite(value) ? value : 0, changed);
  state_->note(label, "number");
  return result;
}

Edited<std::string> Gui::input(const std::string& label, const std::string& value,
                               const InputOptions& options) {
  std::string text = value;
  ImGuiInputTextFlags flags = 0;
  if (options.on_enter) flags |= ImGuiInputTextFlags_EnterReturnsTrue;
  if (options.password) flags |= ImGuiInputTextFlags_Password;
  if (options.focus) focus_next();
  if (options.complete) flags |= ImGuiInputTextFlags_CallbackCompletion;
  Completion completion{options, nullptr};
  const auto callback = options.complete ? Completion::run : nullptr;
  bool changed;
  if (options.lines > 1)
    changed = ImGui::InputTextMultiline(
        imgui_label(label), &text,
        {-1, ImGui::GetTextLineHeight() * static_cast<float>(options.lines + 1)}, flags, callback,
        &completion);
  else
    changed = ImGui::InputTextWithHint(imgui_label(label), options.hint.c_str(), &text, flags,
                                       callback, &completion);
  Edited<std::string> result = edited(text, text != value);
  result.finished = options.on_enter ? changed : result.finished;
  state_->note(label, "input");
  if (completion.problem) std::rethrow_exception(completion.problem);
  return result;
}

Edited<int> Gui::combo(const std::string& label, int index, std::span<const std::string> choices) {
  const bool known = index >= 0 && index < static_cast<int>(choices.size());
  const bool open = ImGui::BeginCombo(imgui_label(label), known ? choices[index].c_str() : "");
  int chosen = index;
  if (open) {
    state_->windows.push_back(visible_label(label));
    const Closing closing([this] { state_->windows.pop_back(), ImGui::EndCombo(); });
    for (int i = 0; i < static_cast<int>(choices.size()); ++i) {
      ImGui::PushID(i);
      if (ImGui::Selectable(imgui_label(choices[i]), i == index)) chosen = i;
      state_->note(choices[i], "choice");
      ImGui::PopID();
    }
  }
  state_->note(label, "combo");
  return {chosen, chosen != index, chosen != index};
}

void Gui::progress(double fraction, const std::string& text, double width) {
  ImGui::ProgressBar(static_cast<float>(std::clamp(fraction, 0.0, 1.0)),
                     {width > 0 ? pixels(width) : -FLT_MIN, 0}, text.c_str());
  state_->note(text, "progress");
}

// where a value lies between two others; 0.5 between equal ones
static double share_of(double value, double low, double high) {
  const double range = high / 2 - low / 2;
  return range > 0 ? std::clamp((value / 2 - low / 2) / range, 0.0, 1.0) : 0.5;
}

static std::pair<double, double> extremes(std::span<const std::vector<double>> lists) {
  std::optional<double> least, most;
  for (const std::vector<double>& list : lists)
    for (const double value : list) {
      least = std::min(least.value_or(value), value);
      most = std::max(most.value_or(value), value);
    }
  return {least.value_or(0), most.value_or(0)};
}

void Gui::curves(const std::string& label, std::span<const std::vector<double>> curves,
                 std::span<const Rgba> colors, std::optional<double> low,
                 std::optional<double> high, double height) {
  const ImVec2 size(ImGui::CalcItemWidth(), pixels(height)), pad = ImGui::GetStyle().FramePadding;
  ImGui::Dummy(size);
  state_->note(label, "plot");
  if (!ImGui::IsItemVisible()) return;
  const auto [least, most] = extremes(curves);
  const double bottom = low.value_or(least), top = high.value_or(most);
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  ImGui::RenderFrame(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (size_t k = 0; k < curves.size(); ++k) {
    const std::vector<double>& curve = curves[k];
    const double steps = curve.size() > 1 ? static_cast<double>(curve.size() - 1) : 1;
    std::vector<ImVec2> points;
    for (size_t i = 0; i < curve.size(); ++i) {
      const double x = static_cast<double>(i) / steps;
      const double y = share_of(curve[i], bottom, top);
      points.emplace_back(from.x + pad.x + static_cast<float>(x) * (size.x - 2 * pad.x),
                          to.y - pad.y - static_cast<float>(y) * (size.y - 2 * pad.y));
    }
    const ImU32 color =
        k < colors.size() ? packed(colors[k]) : ImGui::GetColorU32(ImGuiCol_PlotLines);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), color, ImDrawFlags_None, 1.5F);
  }
}

void Gui::plot(const std::string& label, std::span<const double> values, std::optional<double> low,
               std::optional<double> high, double height) {
  std::vector<float> points(values.begin(), values.end());
  ImGui::PlotLines(imgui_label(label), points.data(), static_cast<int>(points.size()), 0, nullptr,
                   low ? static_cast<float>(*low) : FLT_MAX,
                   high ? static_cast<float>(*high) : FLT_MAX, {0, pixels(height)});
  state_->note(label, "plot");
}

bool Gui::image(const std::string& key, const Picture& picture, double width, double height) {
  State::Texture& image = state_->images[key];
  if (image.width != picture.width || image.height != picture.height) {
    image.texture = gl::make_texture(gl::Format::rgba8, picture.width, picture.height);
    image.width = picture.width, image.height = picture.height;
    image.pixels.clear();
  }
  image.frame = state_->frame;
  const unsigned name = image.texture;
  ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(name)),
               {pixels(width), pixels(height)});
  if (ImGui::IsItemVisible() && image.pixels != picture.pixels) {
    image.pixels = picture.pixels;
    glBindTexture(GL_TEXTURE_2D, image.texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE,
                    picture.pixels.data());
  }
  state_->note(key, "image");
  return ImGui::IsItemClicked();
}

void Gui::separator() { ImGui::Separator(); }
void Gui::same_line(double spacing) { ImGui::SameLine(0, pixels(spacing)); }
void Gui::spacing() { ImGui::Spacing(); }
void Gui::indent(double width) { ImGui::Indent(pixels(width)); }
void Gui::next_width(double width) { ImGui::SetNextItemWidth(pixels(width)); }
void Gui::tooltip(const std::string& text) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    open_tooltip(text), state_->note(text, "tooltip"), ImGui::EndTooltip();
}
void Gui::focus_next() {
  ImGui::SetKeyboardFocusHere();
  state_->focus_asked = state_->frame;
}
void Gui::scroll_to_end() { ImGui::SetScrollHereY(1); }
void Gui::reveal() { ImGui::ScrollToItem(ImGuiScrollFlags_KeepVisibleEdgeY); }
bool Gui::hovered() const { return ImGui::IsItemHovered(); }
bool Gui::active() const { return ImGui::IsItemActive(); }
bool Gui::deactivated_after_edit() const { return ImGui::IsItemDeactivatedAfterEdit(); }
std::array<double, 2> Gui::available() const {
  const ImVec2 space = ImGui::GetContentRegionAvail();
  return {space.x, space.y};
}
GuiRect Gui::last_rect() const {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  return {low.x, low.y, high.x - low.x, high.y - low.y};
}
double Gui::line_height() const { return ImGui::GetFrameHeightWithSpacing(); }

// --- over the picture ---

static std::vector<ImVec2> to_points(std::span<const std::array<double, 2>> points) {
  std::vector<ImVec2> result;
  for (const auto& p : points) result.emplace_back(pixels(p[0]), pixels(p[1]));
  return result;
}

void Gui::clip(const GuiRect& rect, Body body) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({pixels(rect.x), pixels(rect.y)},
                    {pixels(rect.x + rect.width), pixels(rect.y + rect.height)}, true);
  const Closing closing([&list] { list.PopClipRect(); });
  body();
}

// called between the lists of triangles: the bits of the data are red, green, blue
static void mask_colors(const ImDrawList*, const ImDrawCmd* command) {
  const auto bits = reinterpret_cast<std::uintptr_t>(command->UserCallbackData);
  glColorMask((bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, GL_TRUE);
}

void Gui::channels(const std::array<bool, 3>& colors, Body body) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto mask = [&list](bool red, bool green, bool blue) {
    const std::uintptr_t bits = (red ? 1U : 0U) | (green ? 2U : 0U) | (blue ? 4U : 0U);
    list.AddCallback(mask_colors, reinterpret_cast<void*>(bits));
  };
  mask(colors[0], colors[1], colors[2]);
  const Closing closing([&mask] { mask(true, true, true); });
  body();
}

void Gui::line(std::span<const std::array<double, 2>> points, const Rgba& color, double width,
               bool closed) {
  const std::vector<ImVec2> at = to_points(points);
  ImGui::GetBackgroundDrawList()->AddPolyline(at.data(), static_cast<int>(at.size()), packed(color),
                                              closed ? ImDrawFlags_Closed : ImDrawFlags_None,
                                              pixels(width));
}

void Gui::polygon(std::span<const std::array<double, 2>> points, const Rgba& color) {
  const std::vector<ImVec2> at = to_points(points);
  ImGui::GetBackgroundDrawList()->AddConvexPolyFilled(at.data(), static_cast<int>(at.size()),
                                                      packed(color));
}

void Gui::circle(double x, double y, double radius, const Rgba& color, double width, bool filled) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 at(pixels(x), pixels(y));
  if (filled)
    list.AddCircleFilled(at, pixels(radius), packed(color));
  else
    list.AddCircle(at, pixels(radius), packed(color), 0, pixels(width));
}

void Gui::label(double x, double y, const std::string& text, const Rgba& color) {
  ImGui::GetBackgroundDrawList()->AddText({pixels(x), pixels(y)}, packed(color), text.c_str());
}

}  // namespace clench
