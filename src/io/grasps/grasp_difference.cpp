#include "clench/io/grasps/grasp_difference.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/text.h"
#include "clench/io/grasps/identity_texts.h"

namespace clench {

namespace {

using NamedNumbers = std::map<std::string, double>;

constexpr double matrix_angle = 1e-6, matrix_length = 1e-9;  // [rad], and per length or meter

bool same_pose(const std::optional<Pose>& a, const std::optional<Pose>& b, bool exact) {
  if (a.has_value() != b.has_value()) return false;
  if (!a || *a == *b) return true;
  const Pose off = a->inverse() * *b;
  return !exact && off.angle() < matrix_angle &&
         off.position.norm() < matrix_length * std::max(1.0, a->position.norm());
}

// numbers that are not finite are skipped
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

// the DOFs sorted by name, because a table has them in the order of its columns
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

// isaac_grasp lists following joints after the DOFs
bool same_dofs(const GraspSpec& a, const GraspSpec& back, bool more) {
  if (back.dofs.size() < a.dofs.size() || back.dof_names.size() < a.dof_names.size()) return false;
  if (!more && (back.dofs.size() > a.dofs.size() || back.dof_names.size() > a.dof_names.size()))
    return false;
  return std::equal(a.dofs.begin(), a.dofs.end(), back.dofs.begin()) &&
         std::equal(a.dof_names.begin(), a.dof_names.end(), back.dof_names.begin());
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

bool same_joints(const GraspSpec& a, const GraspSpec& back) {
  if (a.joint_names != back.joint_names || a.joint_offsets != back.joint_offsets ||
      a.joints.size() != back.joints.size())
    return false;
  // values are written with their offsets
  for (size_t j = 0; j < a.joints.size(); ++j) {
    const double slack = a.joint_offsets.empty() ? 0 : 1e-12 * (1 + std::abs(a.joint_offsets[j]));
    if (!(std::abs(a.joints[j] - back.joints[j]) <= slack)) return false;
  }
  return true;
}

std::string of_measured(const GraspSpec& a, const GraspSpec& back) {
  if (!same_contacts(a, back)) return "contacts";
  if (a.com != back.com) return "the center of mass";
  if (a.rho != back.rho || a.largest_radius != back.largest_radius ||
      a.gyration_radius != back.gyration_radius)
    return "a length";
  if (a.options.edges != back.options.edges || a.options.soft != back.options.soft ||
      a.options.normal_force.values != back.options.normal_force.values ||
      a.options.modulus != back.options.modulus)
    return "an option";
  if (!same_pregrasp(a, back)) return "the pregrasp";
  return a.squeeze != back.squeeze ? "the squeeze posture" : "";
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
  } else if (!same_dofs(a, back, format == isaac_grasp)) {
    return "a DOF";
  }
  if (format == isaac_grasp) {
    const auto& before = a.pregrasp ? a.pregrasp->dofs : a.dofs;
    return !std::equal(before.begin(), before.end(), back.pregrasp->dofs.begin()) ? "the pregrasp"
                                                                                  : "";
  }
  if (format == multigripper) return "";
  if (format != csv && !same_units(a, back)) return "the unit of a DOF";
  if (a.collision_free != back.collision_free) return "collision_free";
  if (a.hand_file != back.hand_file || a.object_file != back.object_file) return "a file";
  for (const auto& [name, text] : identity_texts)
    if (a.*text != back.*text) return name;
  auto labels = a.labels;
  // an array of texts contains an empty text if a grasp has none
  if (format == npz) std::erase_if(labels, [](const auto& one) { return one.second.empty(); });
  for (const std::string& what :
       {numbers_differ("measure", a.measures, back.measures),
        numbers_differ("note", a.info, back.info), labels_differ(labels, back.labels)})
    if (!what.empty()) return what;
  // hands with different joints, or a different order of joints, do not fit into one table, which
  // is reported as a warning
  const auto is_finite = [](double q) { return std::isfinite(q); };
  const bool without = (format == csv || format == npz) && back.joints.empty() &&
                       std::ranges::all_of(a.joints, is_finite);
  if (!without && !same_joints(a, back)) return "a joint";
  return of_measured(a, back);
}

}  // namespace clench
