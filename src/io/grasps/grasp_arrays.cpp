#include "clench/io/grasps/grasp_arrays.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/grasp_array_parts.h"
#include "clench/io/grasps/npz.h"
#include "clench/io/text/number_reader.h"

namespace clench {

std::string grasp_arrays_bytes(const std::vector<GraspSpec>& grasps, const std::string& file,
                               const WriteOptions& options) {
  check_writable(grasps, file, false, false);
  check_same_dofs(grasps, file);
  const size_t n = grasps.size(), d = n ? grasps[0].dofs.size() : 0;
  std::map<std::string, NpyArray> out;
  NpyArray poses{.shape = {n, 7}}, dofs{.shape = {n, d}};
  for (const GraspSpec& g : grasps) {
    for (const double x : pose_numbers(*g.X_OH)) poses.numbers.push_back(x);
    dofs.numbers.insert(dofs.numbers.end(), g.dofs.begin(), g.dofs.end());
  }
  out["poses"] = std::move(poses);
  out["dofs"] = std::move(dofs);
  if (n && !grasps[0].dof_names.empty())
    out["dof_names"] = {.shape = {d}, .texts = grasps[0].dof_names, .is_text = true};
  if (n && !grasps[0].dof_units.empty())
    out["dof_units"] = {.shape = {d}, .texts = grasps[0].dof_units, .is_text = true};
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
  add_array_parts(grasps, out);
  report_lost(grasps, everything(has_same_joints(grasps)), file, "npz", options);
  return npz_bytes(out, options.compress);
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

// pose in row i; `place` ends in the index, as in "g.npz: poses[3]"
static const double* pose_values(const NpyArray& poses, size_t i, size_t count,
                                 const std::string& place) {
  const double* x = poses.numbers.data() + i * count;
  for (size_t k = 0; k < count; ++k)
    if (!std::isfinite(x[k])) fail("{}: expected finite numbers, got {}", place, x[k]);
  return x;
}

static Pose pose_in_matrices(const NpyArray& poses, size_t i, const std::string& file) {
  const std::string place = fmt::format("{}: poses[{}]", file, i);
  return pose_of_matrix(pose_values(poses, i, 16, place), place);
}

static Pose pose_in_rows(const NpyArray& poses, size_t i, const std::string& file) {
  const std::string place = fmt::format("{}: poses[{}]", file, i);
  const double* x = pose_values(poses, i, 7, place);
  const auto q = made_unit({x[3], x[4], x[5], x[6]});
  if (!q)
    fail("{}: expected a quaternion of length 1, got ({} {} {} {})", place, x[3], x[4], x[5], x[6]);
  return {*q, {x[0], x[1], x[2]}};
}

namespace {

/// The arrays of a list that are not in ArrayParts, by the number of a grasp.
class GraspArrays {
 public:
  GraspArrays(const std::string& file, const std::map<std::string, NpyArray>& arrays)
      : file_(file), arrays_(arrays) {
    read_shapes();
    names_ = labels("dof_names");
    units_ = labels("dof_units");
    check_dof_names(file + ": dof_names", names_);
    check_dof_units(file + ": dof_units", units_);
    epsilon_ = of_grasps("epsilon", false);
    energy_ = of_grasps("energy", false);
    seed_ = of_grasps("seed", false);
    free_ = of_grasps("collision_free", false);
    hands_ = of_grasps("hands", true);
    objects_ = of_grasps("objects", true);
    planners_ = of_grasps("planners", true);
  }

  static bool knows(const std::string& name) {
    static const std::vector<std::string> known = {
        "poses", "dofs",           "dof_names", "dof_units", "epsilon", "energy",
        "seed",  "collision_free", "hands",     "objects",   "planners"};
    return std::ranges::find(known, name) != known.end();
  }
  size_t count() const { return count_; }
  size_t dofs() const { return dof_count_; }
  /// Number of poses' and DOFs' numbers.
  size_t numbers() const { return poses_->numbers.size() + (dofs_ ? dofs_->numbers.size() : 0); }
  GraspSpec read(size_t i) const;

 private:
  const NpyArray* find(const std::string& name) const {
    const auto found = arrays_.find(name);
    return found == arrays_.end() ? nullptr : &found->second;
  }
  void read_shapes();
  const NpyArray* of_grasps(const char* name, bool text) const;
  std::vector<std::string> labels(const char* name) const;

  const std::string& file_;
  const std::map<std::string, NpyArray>& arrays_;
  const NpyArray *poses_ = nullptr, *dofs_ = nullptr;
  bool matrices_ = false;
  size_t count_ = 0, dof_count_ = 0;
  std::vector<std::string> names_, units_;
  const NpyArray *epsilon_, *energy_, *seed_, *free_, *hands_, *objects_, *planners_;
};

void GraspArrays::read_shapes() {
  poses_ = find("poses");
  if (!poses_) fail("{}: expected an array 'poses', got none", file_);
  const auto& shape = poses_->shape;
  matrices_ = shape.size() == 3 && shape[1] == 4 && shape[2] == 4;
  if (poses_->is_text || !(matrices_ || (shape.size() == 2 && shape[1] == 7)))
    fail("{}: poses: expected n x 7 or n x 4 x 4 numbers, got {}", file_, shape_text(*poses_));
  count_ = shape[0];
  dofs_ = find("dofs");
  if (dofs_ && (dofs_->is_text || dofs_->shape.size() != 2 || dofs_->shape[0] != count_))
    fail("{}: dofs: expected {} x d numbers, got {}", file_, count_, shape_text(*dofs_));
  dof_count_ = dofs_ ? dofs_->shape[1] : 0;
}

const NpyArray* GraspArrays::of_grasps(const char* name, bool text) const {
  const NpyArray* a = find(name);
  if (a && (a->is_text != text || a->shape != std::vector<size_t>{count_}))
    fail("{}: {}: expected {} {}, got {}", file_, name, count_, text ? "texts" : "numbers",
         shape_text(*a));
  return a;
}

std::vector<std::string> GraspArrays::labels(const char* name) const {
  const NpyArray* a = dofs_ ? find(name) : nullptr;
  if (a && (!a->is_text || a->shape != std::vector<size_t>{dof_count_}))
    fail("{}: {}: expected {} texts, got {}", file_, name, dof_count_, shape_text(*a));
  return a ? a->texts : std::vector<std::string>();
}

GraspSpec GraspArrays::read(size_t i) const {
  GraspSpec g;
  g.X_OH = matrices_ ? pose_in_matrices(*poses_, i, file_) : pose_in_rows(*poses_, i, file_);
  if (dofs_) {
    g.dofs.assign(dofs_->numbers.begin() + std::ptrdiff_t(i * dof_count_),
                  dofs_->numbers.begin() + std::ptrdiff_t((i + 1) * dof_count_));
    for (const double x : g.dofs)
      if (!std::isfinite(x)) fail("{}: dofs[{}]: expected finite numbers, got {}", file_, i, x);
    g.dof_names = names_;
    g.dof_units = units_;
  }
  const auto number = [&](const NpyArray* a, auto set) {
    if (a && std::isfinite(a->numbers[i])) set(a->numbers[i]);
  };
  number(epsilon_, [&](double x) { g.measures["epsilon"] = x; });
  number(energy_, [&](double x) { g.info["energy"] = x; });
  number(seed_, [&](double x) { g.info["seed"] = x; });
  number(free_, [&](double x) { g.collision_free = x != 0; });
  if (hands_) g.hand_name = hands_->texts[i];
  if (objects_) g.object_name = objects_->texts[i];
  if (planners_ && !planners_->texts[i].empty()) g.labels["planner"] = planners_->texts[i];
  return g;
}

void warn_of_unused(const std::string& file, const std::map<std::string, NpyArray>& arrays,
                    const ReadOptions& options) {
  std::vector<std::string> unused;
  for (const auto& [name, array] : arrays)
    if (!GraspArrays::knows(name) && !ArrayParts::knows(name)) unused.push_back(in_quotes(name));
  if (!unused.empty())
    options.diagnostics.warn(Place(file), "the array{} {} {} not used",
                             unused.size() > 1 ? "s" : "", name_list(unused),
                             unused.size() > 1 ? "are" : "is");
}

}  // namespace

void read_grasp_arrays(const std::string& file, std::string_view bytes, const GraspSink& sink,
                       const ReadOptions& options) {
  const auto arrays = read_npz(file, bytes);
  const GraspArrays given(file, arrays);
  const ArrayParts parts(file, arrays, given.count(), given.dofs());
  // compressed files, and files of smaller numbers, are budgeted by their size as float64, up to
  // four times the file: their grasps take as much memory
  const size_t size = std::clamp(8 * given.numbers(), bytes.size(), 4 * bytes.size());
  GraspCollector list(file, size, sink);
  list.expect(given.count());
  for (size_t i = 0; i < given.count(); ++i) {
    options.progress.check();
    GraspSpec g = given.read(i);
    parts.read(i, g);
    list.add(std::move(g));
  }
  warn_of_unused(file, arrays, options);
}

}  // namespace clench
