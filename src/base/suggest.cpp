#include "clench/base/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "clench/base/text.h"

namespace clench {

static bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

int edit_distance(std::string_view a, std::string_view b) {
  // optimal string alignment, with three rows of the table in memory
  const size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), row(n + 1);
  for (size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= n; ++j) {
      const int exchange = last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, exchange});
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[n];
}

// Terms of other simulators and the corresponding names here. If there are several, the first known
// one is suggested.
static constexpr std::pair<std::string_view, std::string_view> other_words[] = {
    {"qpos", "dofs"},          {"joints", "dofs"},         {"qvel", "dof_velocities"},
    {"ctrl", "set_targets"},   {"position", "pose"},       {"rotation", "pose"},
    {"orientation", "pose"},   {"xpos", "pose"},           {"step", "run"},
    {"simulate", "run"},       {"advance", "run"},         {"close", "autograsp"},
    {"fov", "field_of_view"},  {"fovy", "field_of_view"},  {"geoms", "bodies"},
    {"copy", "clone"},         {"save_state", "snapshot"}, {"reset", "restore"},
    {"xyz", "position"},       {"pos", "position"},        {"position", "point"},
    {"friction", "material"},  {"width", "size"},          {"height", "size"},
    {"scale", "mesh_scale"},   {"hands", "robots"},        {"timestep", "time_step"},
    {"time_step", "dynamics"}, {"quat", "rotation"},       {"orientation", "rotation"}};

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  // longest word that is compared: mistyped by a person, or quoted from a file
  constexpr size_t longest = 40;
  if (name.size() < 3 || name.size() > longest) return "";
  for (const auto& [word, ours] : other_words)
    if (word == name && std::ranges::find(known, ours) != known.end())
      return fmt::format("; did you mean '{}'?", ours);
  // a typing error affects at most a third of the letters, and never all of a short name
  const int limit = std::clamp(static_cast<int>(name.size()) / 3, 1, 3);
  int best = limit + 1;
  std::string_view nearest;
  for (const auto& candidate : known) {
    if (candidate == name || candidate.size() > longest) continue;
    const int edits = edit_distance(name, candidate);
    if (edits < best) best = edits, nearest = candidate;
  }
  return best > limit ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::string instead_of(std::string_view name, const std::vector<std::string>& known) {
  constexpr size_t few = 10;
  const std::string all = known.empty() || known.size() > few
                              ? ""
                              : fmt::format(", expected one of {}", name_list(known));
  return all + did_you_mean(name, known);
}

}  // namespace clench
