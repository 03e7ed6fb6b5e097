#include "clench/io/grasps/grasp_array_parts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/grasps/identity_texts.h"
#include "clench/io/text/named_number.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace {

constexpr size_t any_columns = std::string::npos;

// --- writing ---

/// Rows of equal length; an empty row becomes NaN.
template <class RowOf>
void add_rows(const std::vector<GraspSpec>& grasps, const char* name, size_t columns, RowOf row_of,
              NamedArrays& out) {
  NpyArray array{.shape = {grasps.size(), columns}};
  bool any = false;
  for (const GraspSpec& g : grasps) {
    std::vector<double> row = row_of(g);
    any = any || !row.empty();
    row.resize(columns, NAN);
    array.numbers.insert(array.numbers.end(), row.begin(), row.end());
  }
  if (any) out[name] = std::move(array);
}

template <class ValueOf>
void add_numbers(const std::vector<GraspSpec>& grasps, const std::string& name, ValueOf value_of,
                 NamedArrays& out) {
  NpyArray& array = out[name] = {.shape = {grasps.size()}};
  for (const GraspSpec& g : grasps) array.numbers.push_back(value_of(g));
}

template <class TextOf>
void add_texts(const std::vector<GraspSpec>& grasps, const std::string& name, TextOf text_of,
               NamedArrays& out) {
  NpyArray array{.shape = {grasps.size()}, .is_text = true};
  for (const GraspSpec& g : grasps) array.texts.push_back(text_of(g));
  if (std::ranges::any_of(array.texts, [](const std::string& text) { return !text.empty(); }))
    out[name] = std::move(array);
}

void add_joint_arrays(const std::vector<GraspSpec>& grasps, NamedArrays& out) {
  const auto first = std::ranges::find_if(grasps, [](auto& g) { return !g.joints.empty(); });
  if (first == grasps.end() || !has_same_joints(grasps)) return;
  const size_t count = first->joints.size();
  const auto values = [](const GraspSpec& g) {
    std::vector<double> row;
    for (size_t j = 0; j < g.joints.size(); ++j) row.push_back(g.joint_value(j));
    return row;
  };
  add_rows(grasps, "joints", count, values, out);
  for (const auto& [name, texts] : {std::pair{"joint_names", &first->joint_names},
                                    std::pair{"joint_units", &first->joint_units}})
    if (!texts->empty()) out[name] = {.shape = {count}, .texts = *texts, .is_text = true};
  if (!first->joint_offsets.empty())
    out["joint_offsets"] = {.shape = {count}, .numbers = first->joint_offsets};
}

void add_postures(const std::vector<GraspSpec>& grasps, NamedArrays& out) {
  const size_t dofs = grasps.empty() ? 0 : grasps[0].dofs.size();
  add_rows(
      grasps, "pregrasp_poses", 7,
      [](const GraspSpec& g) {
        return g.pregrasp ? pose_numbers(g.pregrasp->X_OH) : std::vector<double>();
      },
      out);
  const auto of_dofs = [&](const char* name, auto values_of) {
    add_rows(
        grasps, name, dofs,
        [&](const GraspSpec& g) {
          const std::vector<double> values = values_of(g);
          return values.size() == dofs ? values : std::vector<double>();
        },
        out);
  };
  of_dofs("pregrasp_dofs",
          [](const GraspSpec& g) { return g.pregrasp ? g.pregrasp->dofs : std::vector<double>(); });
  of_dofs("squeeze_dofs", [](const GraspSpec& g) { return g.squeeze; });
}

void add_contact_arrays(const std::vector<GraspSpec>& grasps, NamedArrays& out) {
  NpyArray owner, points, normals, mu, torsion, links{.is_text = true};
  const auto add = [](NpyArray& to, const Eigen::Vector3d& v) {
    to.numbers.insert(to.numbers.end(), {v.x(), v.y(), v.z()});
  };
  for (size_t g = 0; g < grasps.size(); ++g)
    for (size_t i = 0; i < grasps[g].points.size(); ++i) {
      const PointContact& p = grasps[g].points[i];
      owner.numbers.push_back(static_cast<double>(g));
      add(points, p.p_O);
      add(normals, p.n_O);
      mu.numbers.push_back(p.mu);
      torsion.numbers.push_back(std::max(0.0, p.torsion_radius));
      links.texts.push_back(i < grasps[g].links.size() ? grasps[g].links[i] : "");
    }
  const size_t count = owner.numbers.size();
  if (count == 0) return;
  for (NpyArray* array : {&owner, &mu, &torsion, &links}) array->shape = {count};
  for (NpyArray* array : {&points, &normals}) array->shape = {count, 3};
  out["contact_grasps"] = std::move(owner);
  out["contact_points"] = std::move(points);
  out["contact_normals"] = std::move(normals);
  out["contact_mu"] = std::move(mu);
  out["contact_torsion_radius"] = std::move(torsion);
  out["contact_links"] = std::move(links);
}

void add_measured(const std::vector<GraspSpec>& grasps, NamedArrays& out) {
  const auto add = [&](const char* name, auto value_of) {
    add_numbers(grasps, name, value_of, out);
  };
  add_rows(
      grasps, "com", 3,
      [](const GraspSpec& g) {
        return std::vector<double>{g.com.x(), g.com.y(), g.com.z()};
      },
      out);
  add("rho", [](const GraspSpec& g) { return g.rho; });
  add("largest_radius", [](const GraspSpec& g) { return g.largest_radius; });
  add("gyration_radius", [](const GraspSpec& g) { return g.gyration_radius; });
  add("edges", [](const GraspSpec& g) { return double(g.options.edges); });
  add("soft", [](const GraspSpec& g) { return double(g.options.soft); });
  size_t most = 1;
  for (const GraspSpec& g : grasps) most = std::max(most, g.options.normal_force.values.size());
  add_rows(
      grasps, "normal_force", most,
      [](const GraspSpec& g) { return g.options.normal_force.values; }, out);
  add_texts(
      grasps, "moduli",
      [](const GraspSpec& g) {
        return std::string(g.options.modulus == ModulusRule::larger ? "larger" : "series");
      },
      out);
}

template <class Map>
std::set<std::string> keys_of(const std::vector<GraspSpec>& grasps, Map GraspSpec::*map,
                              const std::set<std::string>& without) {
  std::set<std::string> out;
  for (const GraspSpec& g : grasps)
    for (const auto& [name, value] : g.*map)
      if (!without.contains(name)) out.insert(name);
  return out;
}

void add_named(const std::vector<GraspSpec>& grasps, NamedArrays& out) {
  for (const auto& name : keys_of(grasps, &GraspSpec::measures, {"epsilon"}))
    add_numbers(
        grasps, "measure_" + name,
        [&](const GraspSpec& g) { return clench::number_of(g.measures, name.c_str(), NAN); }, out);
  for (const auto& name : keys_of(grasps, &GraspSpec::info, {"energy", "seed"}))
    add_numbers(
        grasps, "info_" + name,
        [&](const GraspSpec& g) { return clench::number_of(g.info, name.c_str(), NAN); }, out);
  for (const auto& name : keys_of(grasps, &GraspSpec::labels, {"planner"}))
    add_texts(
        grasps, "label_" + name,
        [&](const GraspSpec& g) {
          return g.labels.contains(name) ? g.labels.at(name) : std::string();
        },
        out);
  add_texts(
      grasps, "hand_files", [](const GraspSpec& g) { return g.hand_file; }, out);
  add_texts(
      grasps, "object_files", [](const GraspSpec& g) { return g.object_file; }, out);
  for (const auto& [name, text] : identity_texts)
    add_texts(
        grasps, name + std::string("s"), [text](const GraspSpec& g) { return g.*text; }, out);
}

// --- reading ---

// row i; empty if a number is missing
std::vector<double> row_at(const NpyArray& array, size_t i) {
  const size_t columns = array.shape.size() > 1 ? array.shape[1] : 1;
  const double* x = array.numbers.data() + i * columns;
  if (std::any_of(x, x + columns, [](double v) { return !std::isfinite(v); })) return {};
  return {x, x + columns};
}

Eigen::Vector3d vector_at(const NpyArray& array, size_t i) {
  return Eigen::Vector3d::Map(array.numbers.data() + 3 * i);
}

constexpr const char* known_arrays[] = {"joints",
                                        "joint_names",
                                        "joint_units",
                                        "joint_offsets",
                                        "pregrasp_poses",
                                        "pregrasp_dofs",
                                        "squeeze_dofs",
                                        "com",
                                        "rho",
                                        "largest_radius",
                                        "gyration_radius",
                                        "edges",
                                        "soft",
                                        "moduli",
                                        "normal_force",
                                        "contact_grasps",
                                        "contact_mu",
                                        "contact_points",
                                        "contact_normals",
                                        "contact_links",
                                        "contact_torsion_radius",
                                        "hand_files",
                                        "object_files",
                                        "hand_fingerprints",
                                        "object_fingerprints",
                                        "settings_fingerprints",
                                        "engine_versions"};

constexpr std::string_view measure_prefix = "measure_", info_prefix = "info_",
                           label_prefix = "label_";

}  // namespace

std::string shape_text(const NpyArray& array) {
  std::string out;
  for (const size_t n : array.shape) out += (out.empty() ? "" : " x ") + std::to_string(n);
  return (out.empty() ? "a single value" : out) + (array.is_text ? " texts" : "");
}

bool has_same_joints(const std::vector<GraspSpec>& grasps) {
  const GraspSpec* first = nullptr;
  for (const GraspSpec& g : grasps) {
    if (g.joints.empty()) continue;
    if (first && (g.joints.size() != first->joints.size() || g.joint_names != first->joint_names ||
                  g.joint_units != first->joint_units || g.joint_offsets != first->joint_offsets))
      return false;
    if (!first) first = &g;
  }
  return true;
}

void add_array_parts(const std::vector<GraspSpec>& grasps, NamedArrays& out) {
  add_joint_arrays(grasps, out);
  add_postures(grasps, out);
  add_contact_arrays(grasps, out);
  add_measured(grasps, out);
  add_named(grasps, out);
}

bool ArrayParts::knows(const std::string& name) {
  return std::ranges::find(known_arrays, name) != std::end(known_arrays) ||
         name.starts_with(measure_prefix) || name.starts_with(info_prefix) ||
         name.starts_with(label_prefix);
}

const NpyArray* ArrayParts::numbers(const char* name, size_t columns, size_t rows) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) return nullptr;
  const NpyArray& a = found->second;
  const bool fits = columns == 0 ? a.shape == std::vector<size_t>{rows}
                                 : a.shape.size() == 2 && a.shape[0] == rows &&
                                       (columns == any_columns || a.shape[1] == columns);
  if (a.is_text || !fits)
    fail("{}: {}: expected {}{} numbers, got {}", file_, name, rows,
         columns == 0             ? ""
         : columns == any_columns ? " x j"
                                  : fmt::format(" x {}", columns),
         shape_text(a));
  return &a;
}

const NpyArray* ArrayParts::texts(const std::string& name, size_t rows) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) return nullptr;
  if (!found->second.is_text || found->second.shape != std::vector<size_t>{rows})
    fail("{}: {}: expected {} texts, got {}", file_, excerpt(name), rows,
         shape_text(found->second));
  return &found->second;
}

ArrayParts::ArrayParts(const std::string& file, const NamedArrays& arrays, size_t grasps,
                       size_t dofs)
    : file_(file), arrays_(arrays), count_(grasps), dofs_(dofs) {
  check_shapes();
  const auto found = arrays.find("contact_grasps");
  if (found == arrays.end()) return;
  contacts_.resize(count_);
  for (size_t k = 0; k < found->second.numbers.size(); ++k) {
    const double owner = found->second.numbers[k];
    if (!(owner >= 0 && owner < static_cast<double>(count_) && owner == std::floor(owner)))
      fail("{}: contact_grasps[{}]: expected the number of a grasp, from 0 to {}, got {}", file_, k,
           count_ - 1, owner);
    contacts_[static_cast<size_t>(owner)].push_back(k);
  }
}

void ArrayParts::check_shapes() const {
  if (const NpyArray* joints = numbers("joints", any_columns, count_)) {
    const size_t count = joints->shape[1];
    for (const char* name : {"joint_names", "joint_units"})
      if (const NpyArray* a = texts(name, count); a && name == std::string_view("joint_names"))
        check_dof_names(file_ + ": joint_names", a->texts);
    numbers("joint_offsets", 0, count);
  }
  numbers("pregrasp_poses", 7, count_);
  for (const char* name : {"pregrasp_dofs", "squeeze_dofs"}) numbers(name, dofs_, count_);
  numbers("com", 3, count_);
  for (const char* name : {"rho", "largest_radius", "gyration_radius", "edges", "soft"})
    numbers(name, 0, count_);
  numbers("normal_force", any_columns, count_);
  for (const char* name : {"moduli", "hand_files", "object_files"}) texts(name, count_);
  for (const auto& [name, text] : identity_texts) texts(name + std::string("s"), count_);
  const auto owner = arrays_.find("contact_grasps");
  if (owner != arrays_.end()) {
    const size_t contacts = owner->second.shape.empty() ? 0 : owner->second.shape[0];
    numbers("contact_grasps", 0, contacts);
    for (const char* name : {"contact_points", "contact_normals"})
      if (!numbers(name, 3, contacts)) fail("{}: expected an array '{}', got none", file_, name);
    for (const char* name : {"contact_mu", "contact_torsion_radius"}) numbers(name, 0, contacts);
    texts("contact_links", contacts);
  }
  for (const auto& [name, array] : arrays_) {
    if (name.starts_with(measure_prefix) || name.starts_with(info_prefix))
      numbers(name.c_str(), 0, count_);
    if (name.starts_with(label_prefix)) texts(name, count_);
  }
}

void ArrayParts::read_joints(size_t i, GraspSpec& out) const {
  const NpyArray* joints = numbers("joints", any_columns, count_);
  if (!joints) return;
  const size_t count = joints->shape[1];
  out.joints = row_at(*joints, i);
  if (out.joints.empty()) return;
  if (const NpyArray* names = texts("joint_names", count)) out.joint_names = names->texts;
  if (const NpyArray* units = texts("joint_units", count)) out.joint_units = units->texts;
  if (const NpyArray* offsets = numbers("joint_offsets", 0, count)) {
    out.joint_offsets = offsets->numbers;
    for (size_t j = 0; j < count; ++j) out.joints[j] -= out.joint_offsets[j];
  }
}

void ArrayParts::read_postures(size_t i, GraspSpec& out) const {
  const NpyArray *poses = numbers("pregrasp_poses", 7, count_),
                 *dofs = numbers("pregrasp_dofs", dofs_, count_),
                 *squeeze = numbers("squeeze_dofs", dofs_, count_);
  if (squeeze && dofs_ > 0) out.squeeze = row_at(*squeeze, i);
  const auto pose = poses ? row_at(*poses, i) : std::vector<double>();
  const auto before = dofs && dofs_ > 0 ? row_at(*dofs, i) : std::vector<double>();
  if (pose.empty() && before.empty()) return;
  out.pregrasp = PregraspState{out.X_OH.value_or(Pose{}), before.empty() ? out.dofs : before};
  if (pose.empty()) return;
  const Eigen::Quaterniond q(pose[3], pose[4], pose[5], pose[6]);
  if (!(std::abs(q.norm() - 1) < 1e-6))
    fail("{}: pregrasp_poses[{}]: expected a quaternion of length 1, got ({} {} {} {})", file_, i,
         pose[3], pose[4], pose[5], pose[6]);
  out.pregrasp->X_OH = Pose{q, {pose[0], pose[1], pose[2]}};
}

void ArrayParts::read_measured(size_t i, GraspSpec& out) const {
  const auto set = [&](const char* name, auto apply) {
    const NpyArray* a = numbers(name, 0, count_);
    if (a && std::isfinite(a->numbers[i])) apply(a->numbers[i]);
  };
  if (const NpyArray* com = numbers("com", 3, count_))
    if (const auto row = row_at(*com, i); !row.empty()) out.com = Eigen::Vector3d::Map(row.data());
  const auto length = [&](const char* name, double& to) {
    set(name, [&](double x) {
      if (!(x > 0)) fail("{}: {}[{}]: expected a number > 0, got {}", file_, name, i, x);
      to = x;
    });
  };
  length("largest_radius", out.largest_radius);
  length("gyration_radius", out.gyration_radius);
  if (numbers("rho", 0, count_)) {
    length("rho", out.rho);
    out.options.rho = out.rho;
  }
  set("soft", [&](double x) { out.options.soft = x != 0; });
  set("edges", [&](double x) {
    if (x != std::floor(x) || x > max_edges || (x < 3 && x != round_edges))
      fail("{}: edges[{}]: expected 0, or a whole number from 3 to {}, got {}", file_, i, max_edges,
           x);
    out.options.edges = static_cast<int>(x);
  });
  if (const NpyArray* moduli = texts("moduli", count_))
    out.options.modulus = moduli->texts[i] == "larger" ? ModulusRule::larger : ModulusRule::series;
  if (const NpyArray* forces = numbers("normal_force", any_columns, count_)) {
    out.options.normal_force.values.clear();
    for (size_t k = 0; k < forces->shape[1]; ++k)
      if (const double x = forces->numbers[i * forces->shape[1] + k]; std::isfinite(x))
        out.options.normal_force.values.push_back(x);
  }
  if (contacts_.empty()) return;
  const NpyArray *mu = arrays_.contains("contact_mu") ? &arrays_.at("contact_mu") : nullptr,
                 *torsion = arrays_.contains("contact_torsion_radius")
                                ? &arrays_.at("contact_torsion_radius")
                                : nullptr,
                 *links =
                     arrays_.contains("contact_links") ? &arrays_.at("contact_links") : nullptr;
  for (const size_t k : contacts_[i]) {
    PointContact point{.p_O = vector_at(arrays_.at("contact_points"), k),
                       .n_O = vector_at(arrays_.at("contact_normals"), k),
                       .mu = mu ? mu->numbers[k] : 1};
    if (torsion) point.torsion_radius = torsion->numbers[k];
    if (!point.p_O.allFinite() || !(std::abs(point.n_O.norm() - 1) < 1e-6) || !(point.mu >= 0) ||
        !(point.torsion_radius >= 0))
      fail("{}: contact {}: expected a finite point, a normal of length 1, mu and torsion >= 0",
           file_, k);
    out.points.push_back(point);
    out.links.push_back(links ? links->texts[k] : "");
  }
}

void ArrayParts::read_named(size_t i, GraspSpec& out) const {
  for (const auto& [name, array] : arrays_) {
    const bool is_measure = name.starts_with(measure_prefix),
               is_note = name.starts_with(info_prefix);
    if ((is_measure || is_note) && std::isfinite(array.numbers[i]))
      (is_measure
           ? out.measures
           : out.info)[name.substr(is_measure ? measure_prefix.size() : info_prefix.size())] =
          array.numbers[i];
    if (name.starts_with(label_prefix) && !array.texts[i].empty())
      out.labels[name.substr(label_prefix.size())] = array.texts[i];
  }
  if (const NpyArray* files = texts("hand_files", count_)) out.hand_file = files->texts[i];
  if (const NpyArray* files = texts("object_files", count_)) out.object_file = files->texts[i];
  for (const auto& [name, text] : identity_texts)
    if (const NpyArray* found = texts(name + std::string("s"), count_)) out.*text = found->texts[i];
}

void ArrayParts::read(size_t i, GraspSpec& out) const {
  read_joints(i, out);
  read_postures(i, out);
  read_measured(i, out);
  read_named(i, out);
}

}  // namespace clench
