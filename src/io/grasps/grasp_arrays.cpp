#include "clench/io/grasps/grasp_arrays.h"

#include <cmath>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace fs = std::filesystem;

void write_grasp_arrays(const std::vector<GraspSpec>& grasps, const fs::path& path,
                        const WriteOptions& options) {
  const std::string file = path.filename().string();
  check_writable(grasps, file, false, false);
  const size_t n = grasps.size();
  const auto names = n ? dof_names_of(grasps[0]) : std::vector<std::string>();
  std::map<std::string, NpyArray> out;
  NpyArray poses{.shape = {n, 7}}, dofs{.shape = {n, names.size()}};
  for (size_t i = 0; i < n; ++i) {
    for (const double x : pose_numbers(*grasps[i].X_OH)) poses.numbers.push_back(x);
    if (dof_names_of(grasps[i]) != names)
      fail("{}: grasps[{}]: expected the DOFs of the first grasp, {}, got {}", file, i + 1,
           name_list(names), name_list(dof_names_of(grasps[i])));
    dofs.numbers.insert(dofs.numbers.end(), grasps[i].dofs.begin(), grasps[i].dofs.end());
  }
  out["poses"] = std::move(poses);
  out["dofs"] = std::move(dofs);
  out["dof_names"] = {.shape = {names.size()}, .texts = names, .is_text = true};
  if (n && grasps[0].dof_units.size() == names.size())
    out["dof_units"] = {.shape = {names.size()}, .texts = grasps[0].dof_units, .is_text = true};
  const auto numbers = [&](const char* name, auto value) {
    NpyArray& array = out[name] = {.shape = {n}};
    for (const GraspSpec& g : grasps) array.numbers.push_back(value(g));
  };
  const auto texts = [&](const char* name, auto value) {
    NpyArray& array = out[name] = {.shape = {n}, .is_text = true};
    for (const GraspSpec& g : grasps) array.texts.push_back(value(g));
  };
  numbers("epsilon", [](const GraspSpec& g) { return number_of(g.measures, "epsilon", NAN); });
  numbers("energy", [](const GraspSpec& g) { return number_of(g.info, "energy", NAN); });
  numbers("seed", [](const GraspSpec& g) { return number_of(g.info, "seed", NAN); });
  numbers("collision_free",
          [](const GraspSpec& g) { return g.collision_free ? double(*g.collision_free) : NAN; });
  texts("hands", [](const GraspSpec& g) { return g.hand_name; });
  texts("objects", [](const GraspSpec& g) { return g.object_name; });
  texts("planners", [](const GraspSpec& g) {
    return g.labels.contains("planner") ? g.labels.at("planner") : std::string();
  });
  // what is kept is not told to be lost
  std::vector<GraspSpec> rest = grasps;
  for (GraspSpec& g : rest) {
    g.info.erase("energy");
    g.info.erase("seed");
    g.labels.erase("planner");
  }
  report_lost(rest, {.dofs = true, .epsilon = true}, file, "npz", options);
  write_file(path, npz_bytes(out));
}

Pose pose_of_matrix(const double* m, const std::string& place) {
  Eigen::Matrix3d R;
  for (int r = 0; r < 3; ++r) R.row(r) << m[4 * r], m[4 * r + 1], m[4 * r + 2];
  const bool rigid =
      (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-3 &&
      R.determinant() > 0;
  if (!rigid || std::abs(m[12]) + std::abs(m[13]) + std::abs(m[14]) + std::abs(m[15] - 1) > 1e-6)
    fail("{}: expected a homogeneous matrix of a rotation and a translation", place);
  return {Eigen::Quaterniond(R).normalized(), {m[3], m[7], m[11]}};
}

std::vector<GraspSpec> read_grasp_arrays(const fs::path& path, const ReadOptions& options) {
  const std::string file = path.filename().string();
  const auto arrays = read_npz(file, read_bytes(path));
  const auto shape_text = [](const NpyArray& a) {
    std::string out;
    for (const size_t n : a.shape) out += (out.empty() ? "" : " x ") + std::to_string(n);
    return (out.empty() ? "a single value" : out) + (a.is_text ? " texts" : "");
  };
  const auto find = [&](const std::string& name) {
    const auto found = arrays.find(name);
    return found == arrays.end() ? nullptr : &found->second;
  };
  const NpyArray* poses = find("poses");
  if (!poses) fail("{}: expected an array 'poses', got none", file);
  const auto& shape = poses->shape;
  const bool matrices = shape.size() == 3 && shape[1] == 4 && shape[2] == 4;
  if (poses->is_text || !(matrices || (shape.size() == 2 && shape[1] == 7)))
    fail("{}: poses: expected n x 7 or n x 4 x 4 numbers, got {}", file, shape_text(*poses));
  const size_t n = shape[0];
  std::vector<GraspSpec> out(n);
  for (size_t i = 0; i < n; ++i) {
    const double* x = poses->numbers.data() + i * (matrices ? 16 : 7);
    const std::string place = fmt::format("{}: poses[{}]", file, i);
    for (int k = 0; k < (matrices ? 16 : 7); ++k)
      if (!std::isfinite(x[k])) fail("{}: expected finite numbers, got {}", place, x[k]);
    if (matrices) {
      out[i].X_OH = pose_of_matrix(x, place);
      continue;
    }
    const auto q = made_unit({x[3], x[4], x[5], x[6]});
    if (!q)
      fail("{}: expected a quaternion of length 1, got ({} {} {} {})", place, x[3], x[4], x[5],
           x[6]);
    out[i].X_OH = Pose{*q, {x[0], x[1], x[2]}};
  }
  const auto of_grasps = [&](const char* name, bool text) {
    const NpyArray* a = find(name);
    if (a && (a->is_text != text || a->shape != std::vector<size_t>{n}))
      fail("{}: {}: expected {} {}, got {}", file, name, n, text ? "texts" : "numbers",
           shape_text(*a));
    return a;
  };
  if (const NpyArray* dofs = find("dofs")) {
    if (dofs->is_text || dofs->shape.size() != 2 || dofs->shape[0] != n)
      fail("{}: dofs: expected {} x d numbers, got {}", file, n, shape_text(*dofs));
    const size_t d = dofs->shape[1];
    const auto labels = [&](const char* name) {
      const NpyArray* a = find(name);
      if (a && (!a->is_text || a->texts.size() != d))
        fail("{}: {}: expected {} texts, got {}", file, name, d, shape_text(*a));
      return a ? a->texts : std::vector<std::string>();
    };
    const auto names = labels("dof_names"), units = labels("dof_units");
    check_dof_names(file + ": dof_names", names);
    check_dof_units(file + ": dof_units", units);
    for (size_t i = 0; i < n; ++i) {
      out[i].dofs.assign(dofs->numbers.begin() + std::ptrdiff_t(i * d),
                         dofs->numbers.begin() + std::ptrdiff_t((i + 1) * d));
      for (const double x : out[i].dofs)
        if (!std::isfinite(x)) fail("{}: dofs[{}]: expected finite numbers, got {}", file, i, x);
      out[i].dof_names = names;
      out[i].dof_units = units;
    }
  }
  const auto each = [&](const char* name, auto set) {
    if (const NpyArray* a = of_grasps(name, false))
      for (size_t i = 0; i < n; ++i)
        if (std::isfinite(a->numbers[i])) set(out[i], a->numbers[i]);
  };
  each("epsilon", [](GraspSpec& g, double x) { g.measures["epsilon"] = x; });
  each("energy", [](GraspSpec& g, double x) { g.info["energy"] = x; });
  each("seed", [](GraspSpec& g, double x) { g.info["seed"] = x; });
  each("collision_free", [](GraspSpec& g, double x) { g.collision_free = x != 0; });
  if (const NpyArray* a = of_grasps("hands", true))
    for (size_t i = 0; i < n; ++i) out[i].hand_name = a->texts[i];
  if (const NpyArray* a = of_grasps("objects", true))
    for (size_t i = 0; i < n; ++i) out[i].object_name = a->texts[i];
  if (const NpyArray* a = of_grasps("planners", true))
    for (size_t i = 0; i < n; ++i)
      if (!a->texts[i].empty()) out[i].labels["planner"] = a->texts[i];
  static const std::vector<std::string> known = {
      "poses", "dofs",           "dof_names", "dof_units", "epsilon", "energy",
      "seed",  "collision_free", "hands",     "objects",   "planners"};
  for (const auto& [name, array] : arrays)
    if (options.warn && std::find(known.begin(), known.end(), name) == known.end())
      options.warn(fmt::format("{}: the array {} is not used", file, in_quotes(name)));
  return out;
}

}  // namespace clench
