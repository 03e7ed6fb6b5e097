#include "clench/io/grasps/grasp_writing.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"

namespace clench {

std::string real_text(double x) {
  if (!std::isfinite(x)) return std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string real_list(const std::vector<double>& numbers) {
  std::string out;
  for (const double x : numbers) out += (out.empty() ? "" : ", ") + real_text(x);
  return "[" + out + "]";
}

std::vector<double> pose_numbers(const Pose& X) {
  const auto& p = X.position;
  const auto& q = X.rotation;
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

std::vector<std::string> dof_names_of(const GraspSpec& grasp) {
  std::vector<std::string> names = grasp.dof_names;
  for (size_t i = names.size(); i < grasp.dofs.size(); ++i)
    names.push_back(fmt::format("dof{}", i + 1));
  return names;
}

void report_lost(const std::vector<GraspSpec>& grasps, const Holds& holds, const std::string& file,
                 const std::string& format, const WriteOptions& options) {
  const auto any = [&](auto has) { return std::ranges::any_of(grasps, has); };
  std::vector<std::string> lost;
  const auto tell = [&](bool held, const char* what, auto has) {
    if (!held && any(has)) lost.emplace_back(what);
  };
  tell(holds.dofs, "DOFs", [](const GraspSpec& g) { return !g.dofs.empty(); });
  tell(holds.joints, "joint positions", [](const GraspSpec& g) { return !g.joints.empty(); });
  tell(holds.contacts, "contacts", [](const GraspSpec& g) { return !g.points.empty(); });
  tell(holds.pregrasp_poses, "poses of pregrasps",
       [](const GraspSpec& g) { return g.pregrasp.has_value(); });
  tell(holds.pregrasp_dofs, "DOFs of pregrasps",
       [](const GraspSpec& g) { return g.pregrasp.has_value(); });
  tell(holds.squeeze, "squeeze postures", [](const GraspSpec& g) { return !g.squeeze.empty(); });
  tell(holds.epsilon, "epsilon", [](const GraspSpec& g) { return g.measures.contains("epsilon"); });
  tell(holds.notes, "other measures",
       [](const GraspSpec& g) { return g.measures.size() > g.measures.count("epsilon"); });
  tell(holds.notes, "notes and labels",
       [](const GraspSpec& g) { return !g.info.empty() || !g.labels.empty(); });
  tell(holds.hand, "the name of the hand", [](const GraspSpec& g) { return !g.hand_name.empty(); });
  tell(holds.object, "the name of the object",
       [](const GraspSpec& g) { return !g.object_name.empty(); });
  tell(holds.files, "files of hand and object",
       [](const GraspSpec& g) { return !g.hand_file.empty() || !g.object_file.empty(); });
  tell(holds.files, "fingerprints", [](const GraspSpec& g) {
    return !g.hand_fingerprint.empty() || !g.object_fingerprint.empty();
  });
  if (!lost.empty())
    options.diagnostics.warn(Place(file), "the format {} does not hold {}, which are not written",
                             format, name_list(lost));
}

void check_same_dofs(const std::vector<GraspSpec>& grasps, const std::string& file) {
  for (size_t i = 1; i < grasps.size(); ++i) {
    const GraspSpec &first = grasps[0], &g = grasps[i];
    if (g.dofs.size() != first.dofs.size() || g.dof_names != first.dof_names)
      fail("{}: grasps[{}]: expected the DOFs of the first grasp, {}, got {}", file, i + 1,
           name_list(dof_names_of(first)), name_list(dof_names_of(g)));
    if (g.dof_units != first.dof_units)
      fail("{}: grasps[{}]: expected DOFs in the units of the first grasp, {}, got {}", file, i + 1,
           name_list(first.dof_units), name_list(g.dof_units));
  }
}

void check_writable(const std::vector<GraspSpec>& grasps, const std::string& file, bool one_hand,
                    bool one_object) {
  for (size_t i = 0; i < grasps.size(); ++i) {
    if (!grasps[i].X_OH) fail("{}: grasps[{}]: expected a pose, got none", file, i + 1);
    const auto same = [&](const std::string& name, const std::string& first, const char* what) {
      if (name != first)
        fail("{}: grasps[{}]: expected one {} for the whole file, {}, got {}", file, i + 1, what,
             in_quotes(first), in_quotes(name));
    };
    if (one_hand) same(grasps[i].hand_name, grasps[0].hand_name, "hand");
    if (one_object) same(grasps[i].object_name, grasps[0].object_name, "object");
  }
}

}  // namespace clench
