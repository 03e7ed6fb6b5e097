#include "clench/io/grasps/grasp_difference.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/text.h"

namespace clench {

namespace {

using NamedNumbers = std::map<std::string, double>;

constexpr double matrix_angle = 1e-6, matrix_length = 1e-9;  // [rad], of a length or metre

bool same_pose(const std::optional<Pose>& a, const std::optional<Pose>& b, bool exact) {
  if (a.has_value() != b.has_value()) return false;
  if (!a || *a == *b) return true;
  const Pose off = a->inverse() * *b;
  return !exact && off.angle() < matrix_angle &&
         off.position.norm() < matrix_length * std::max(1.0, a->position.norm());
}

// numbers that are not finite are left out
std::string numbers_differ(const char* what, const NamedNumbers& a, const NamedNumbers& back) {
  for (const auto& [name, x] : a) {
    if (!std::isfinite(x)) continue;
    const auto found = back.find(name);
    if (found == back.end() || found->second != x)
      return fmt::format("the {} {}", what, in_quotes(name));
  }
  return "";
}

std::string labels_differ(const std::map<std::string, std::string>& a,
                          const std::map<std::string, std::string>& back) {
  for (const auto& [name, text] : a)
    if (const auto found = back.find(name); found == back.end() || found->second != text)
      return fmt::format("the label {}", in_quotes(name));
  return "";
}

bool same_units(const GraspSpec& a, const GraspSpec& back) {
  for (size_t i = 0; i < a.dofs.size(); ++i) {
    const auto unit = [i](const GraspSpec& g) {
      const std::string text = i < g.dof_units.size() ? g.dof_units[i] : "";
      return text == "rad or m" ? std::string() : text;
    };
    if (unit(a) != unit(back)) return false;
  }
  return true;
}

// a table has the DOFs in the order of its columns
GraspSpec by_names(const GraspSpec& g) {
  GraspSpec out;
  std::vector<size_t> order(g.dofs.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (g.dof_names.size() == g.dofs.size())
    std::ranges::stable_sort(order, {}, [&](size_t i) { return g.dof_names[i]; });
  for (const size_t i : order) {
    out.dofs.push_back(g.dofs[i]);
    if (i < g.dof_names.size()) out.dof_names.push_back(g.dof_names[i]);
    out.dof_units.push_back(i < g.dof_units.size() ? g.dof_units[i] : "");
  }
  return out;
}

bool same_point(const PointContact& a, const PointContact& b) {
  return a.p_O == b.p_O && a.n_O == b.n_O && a.mu == b.mu &&
         std::max(a.torsion_radius, 0.0) == b.torsion_radius;
}

bool same_contacts(const GraspSpec& a, const GraspSpec& back) {
  if (!std::ranges::equal(a.points, back.points, same_point)) return false;
  for (size_t i = 0; i < a.points.size(); ++i)
    if ((i < a.links.size() ? a.links[i] : "") != back.links[i]) return false;
  return true;
}

bool same_pregrasp(const GraspSpec& a, const GraspSpec& back) {
  if (a.pregrasp.has_value() != back.pregrasp.has_value()) return false;
  return !a.pregrasp ||
         (a.pregrasp->X_OH == back.pregrasp->X_OH && a.pregrasp->dofs == back.pregrasp->dofs);
}

std::string of_lines(const GraspSpec& a, const GraspSpec& back) {
  if (a.joints != back.joints) return "joints";
  if (!same_contacts(a, back)) return "contacts";
  if (a.com != back.com) return "the centre of mass";
  if (a.rho != back.rho || a.largest_radius != back.largest_radius ||
      a.gyration_radius != back.gyration_radius)
    return "a length";
  if (a.options.edges != back.options.edges || a.options.soft != back.options.soft ||
      a.options.normal_force.values != back.options.normal_force.values ||
      a.options.modulus != back.options.modulus)
    return "an option";
  if (!same_pregrasp(a, back)) return "the pregrasp";
  return "";
}

std::string of_arrays(const GraspSpec& a, const GraspSpec& back) {
  const auto only = [](const auto& named, std::initializer_list<const char*> names) {
    auto out = named;
    std::erase_if(out, [&](const auto& one) {
      return std::ranges::find(names, one.first) == std::end(names);
    });
    return out;
  };
  for (const std::string& what :
       {numbers_differ("measure", only(a.measures, {"epsilon"}), back.measures),
        numbers_differ("note", only(a.info, {"energy", "seed"}), back.info)})
    if (!what.empty()) return what;
  auto labels = only(a.labels, {"planner"});
  std::erase_if(labels, [](const auto& one) { return one.second.empty(); });
  return labels_differ(labels, back.labels);
}

std::string of_graspit(const GraspSpec& a, const GraspSpec& back) {
  for (const char* name : {"run", "spread"})
    if (const auto note = a.info.find(name);
        note != a.info.end() &&
        !(std::abs(note->second - back.info.at(name)) <= 1e-12 * std::abs(note->second)))
      return fmt::format("the note '{}'", name);
  const auto quality = a.measures.find("quality");
  return quality != a.measures.end() && quality->second != back.measures.at("quality")
             ? "the measure 'quality'"
             : "";
}

}  // namespace

std::string difference(const GraspSpec& a, const GraspSpec& back, GraspFormat format) {
  using enum GraspFormat;
  const bool rounds = format == graspgen || format == graspit;
  if (!same_pose(a.X_OH, back.X_OH, !rounds)) return "the pose";
  if (format == graspit) return of_graspit(a, back);
  if (format == graspgen)
    return !a.object_file.empty() && a.object_file != back.object_file ? "the file of the object"
                                                                       : "";
  if (a.hand_name != back.hand_name) return "the name of the hand";
  if (a.object_name != back.object_name) return "the name of the object";
  if (format == csv) {
    const GraspSpec own = by_names(a), other = by_names(back);
    if (own.dofs != other.dofs || own.dof_names != other.dof_names || !same_units(own, other))
      return "a DOF";
  } else if (a.dofs != back.dofs || a.dof_names != back.dof_names) {
    return "a DOF";
  }
  if (format == isaac_grasp) {
    const auto& before = a.pregrasp ? a.pregrasp->dofs : a.dofs;
    return before != back.pregrasp->dofs ? "the pregrasp" : "";
  }
  if (format == multigripper) return "";
  if (format != csv && !same_units(a, back)) return "the unit of a DOF";
  if (a.collision_free != back.collision_free) return "collision_free";
  if (format == npz) return of_arrays(a, back);
  if (a.hand_file != back.hand_file || a.object_file != back.object_file) return "a file";
  for (const std::string& what :
       {numbers_differ("measure", a.measures, back.measures),
        numbers_differ("note", a.info, back.info), labels_differ(a.labels, back.labels)})
    if (!what.empty()) return what;
  return format == lines ? of_lines(a, back) : "";
}

}  // namespace clench
