#include "clench/io/mjcf/mjcf_document.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "clench/base/suggest.h"
#include "clench/base/units.h"
#include "clench/io/text/find_file.h"
#include "clench/math/decompositions.h"

namespace clench {

namespace fs = std::filesystem;

static constexpr int max_files = 100;        // included; far above any robot
static constexpr int deepest_element = 200;  // of elements, over all includes

MjcfDocument::MjcfDocument(const fs::path& path, FileCache& cache)
    : path_(path),
      file_(path.filename().string()),
      cache_(cache),
      repairs_(cache.options().listeners()) {
  angle_unit_ = units::degree;
  files_.push_back(std::make_unique<XmlFile>(path));
  open_.push_back(fs::weakly_canonical(path));
  const XmlElement root = files_.back()->root();
  if (root.name() != "mujoco")
    root.fail("expected an element <mujoco>, got <{}>", excerpt(root.name()));
  root_ = load(root, 0);
  for (const auto& node : root_.children)
    if (node.name() == "compiler") read_compiler(node);
  classes_.emplace_back();
  class_numbers_["main"] = 0;
  for (const auto& node : root_.children)
    if (node.name() == "default") read_defaults(node, -1);
}

// --- elements ---

MjcfNode MjcfDocument::load(const XmlElement& element, int depth) {
  if (depth > deepest_element)
    element.fail("expected at most {} elements in each other", deepest_element);
  MjcfNode node{element, {}};
  for (const auto& child : element.children()) {
    if (child.name() == "include")
      include(child, node.children, depth);
    else
      node.children.push_back(load(child, depth + 1));
  }
  return node;
}

void MjcfDocument::include(const XmlElement& element, std::vector<MjcfNode>& into, int depth) {
  const std::string name = XmlValues(element).text("file");
  fs::path found;
  try {
    // beside the including file, else beside the outermost
    found = find_file(name, open_.back(), cache_.options());
  } catch (const Error& near) {
    try {
      found = find_file(name, path_, cache_.options());
    } catch (const Error&) {
      element.fail("include: {}", near.what());
    }
  }
  const fs::path canonical = fs::weakly_canonical(found);
  if (std::find(open_.begin(), open_.end(), canonical) != open_.end())
    element.fail("include: '{}' includes itself", excerpt(name));
  if (files_.size() >= max_files) element.fail("expected at most {} files", max_files);
  files_.push_back(std::make_unique<XmlFile>(found));
  open_.push_back(canonical);
  // its outermost element only holds the others
  MjcfNode root = load(files_.back()->root(), depth + 1);
  for (auto& child : root.children) into.push_back(std::move(child));
  open_.pop_back();
}

std::vector<const MjcfNode*> MjcfDocument::section(const std::string& name) const {
  std::vector<const MjcfNode*> out;
  for (const auto& node : root_.children)
    if (node.name() == name)
      for (const auto& child : node.children) out.push_back(&child);
  return out;
}

// --- settings ---

void MjcfDocument::read_compiler(const MjcfNode& node) {
  const XmlValues values(node.element);
  if (values.has("angle"))
    angle_unit_ =
        values.word("angle", {"degree", "radian"}, "degree") == "degree" ? units::degree : 1;
  if (values.word("coordinate", {"local", "global"}, "local") == "global")
    values.fail("coordinate",
                "expected local, got 'global'; save the model again with MuJoCo 2.3.3");
  euler_ = values.text("eulerseq", euler_);
  if (euler_.size() != 3 || euler_.find_first_not_of("xyzXYZ") != std::string::npos)
    values.fail("eulerseq", "expected three of xyzXYZ, got {}", in_quotes(euler_));
  autolimits_ = values.boolean("autolimits", autolimits_);
  strip_path_ = values.boolean("strippath", strip_path_);
  mesh_dir_ = values.text("assetdir", mesh_dir_);
  mesh_dir_ = values.text("meshdir", mesh_dir_);
  inertia_from_geoms_ = values.word("inertiafromgeom", {"true", "false", "auto"},
                                    inertia_from_geoms_ ? "true" : "auto") == "true";
  unused_.attributes(node.element, {"angle", "coordinate", "eulerseq", "autolimits", "strippath",
                                    "assetdir", "meshdir", "inertiafromgeom"});
}

void MjcfDocument::read_defaults(const MjcfNode& node, int parent) {
  const std::string name = node.element.attribute("class").value_or("");
  int number = std::max(parent, 0);
  if (parent < 0 && !name.empty() && name != "main") {
    // MuJoCo once called the global class so, and refuses it today
    if (const auto [at, is_new] = class_numbers_.emplace(name, 0); !is_new && at->second != 0)
      node.element.fail("default: there is another class '{}'", excerpt(name));
    cache_.warn(fmt::format("{}: default: the outermost class is called main; {} is taken for it",
                            node.element.place(), in_quotes(name)));
  } else if (!name.empty() && name != "main") {
    const auto [at, is_new] = class_numbers_.emplace(name, static_cast<int>(classes_.size()));
    number = at->second;
    if (is_new)
      classes_.push_back({parent, {}});
    else
      repairs_.add("class", fmt::format("{}: default: there is another class {}; they count as one",
                                        node.element.place(), in_quotes(name)));
  }
  for (const auto& child : node.children) {
    if (child.name() == "default")
      read_defaults(child, number);
    else
      classes_[number].elements.push_back(child.element);
  }
}

void MjcfDocument::check_class(const XmlElement& element, const std::string& name) const {
  if (name.empty() || class_numbers_.contains(name)) return;
  element.fail("{}: no default class {}{}", excerpt(element.name()), in_quotes(name),
               did_you_mean(name, names_in(class_numbers_)));
}

std::vector<XmlElement> MjcfDocument::defaults(const XmlElement& element,
                                               const std::string& child_class,
                                               std::span<const std::string_view> names) const {
  const std::string own = element.attribute("class").value_or("");
  const std::string& name = own.empty() ? child_class : own;
  check_class(element, name);
  std::vector<XmlElement> out;
  int at = name.empty() ? 0 : class_numbers_.at(name);
  for (; at >= 0; at = classes_[at].parent)
    // the last of several in a class counts
    for (auto it = classes_[at].elements.rbegin(); it != classes_[at].elements.rend(); ++it)
      if (std::ranges::find(names, it->name()) != names.end()) out.push_back(*it);
  return out;
}

XmlValues MjcfDocument::values(const XmlElement& element, const std::string& child_class,
                               const char* also) const {
  const std::array<std::string_view, 2> names = {element.name(), also ? also : element.name()};
  return {element, defaults(element, child_class, names)};
}

// --- poses ---

static Eigen::Quaterniond about(char axis, double angle) {
  const int i = std::tolower(axis) - 'x';
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(i)));
}

/// Turns z to a direction, about their common normal.
static Eigen::Quaterniond z_to(const Eigen::Vector3d& direction) {
  return shortest_rotation(Eigen::Vector3d::UnitZ(), direction).normalized();
}

Eigen::Quaterniond MjcfDocument::orientation(const XmlValues& values) const {
  const auto direction = [&](const char* name, const Eigen::Vector3d& v) {
    if (!(v.stableNorm() > 1e-9)) values.fail(name, "expected a direction, got none");
    return Eigen::Vector3d(v.stableNormalized());
  };
  if (values.has("axisangle")) {
    const auto v = values.numbers("axisangle", 4, 4);
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(angle(v[3]), direction("axisangle", {v[0], v[1], v[2]})));
  }
  if (values.has("euler")) {
    const auto v = values.numbers("euler", 3, 3);
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    // small letters turn about axes that turn along, capital ones about fixed axes
    for (int i = 0; i < 3; ++i) {
      const Eigen::Quaterniond turn = about(euler_[i], angle(v[i]));
      q = std::islower(euler_[i]) ? q * turn : turn * q;
    }
    return q.normalized();
  }
  if (values.has("xyaxes")) {
    const auto v = values.numbers("xyaxes", 6, 6);
    const Eigen::Vector3d x = direction("xyaxes", {v[0], v[1], v[2]}), y0(v[3], v[4], v[5]);
    const Eigen::Vector3d y = direction("xyaxes", y0 - y0.dot(x) * x);
    Eigen::Matrix3d axes;
    axes << x, y, x.cross(y);
    return Eigen::Quaterniond(axes).normalized();
  }
  if (values.has("zaxis")) return z_to(direction("zaxis", values.vec3("zaxis", {0, 0, 1})));
  if (!values.has("quat")) return Eigen::Quaterniond::Identity();
  const auto v = values.numbers("quat", 4, 4);
  const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
  if (!(q.coeffs().stableNorm() > 1e-9)) values.fail("quat", "expected a quaternion, got zeros");
  Eigen::Quaterniond out;
  out.coeffs() = q.coeffs().stableNormalized();
  return out;
}

Pose MjcfDocument::pose(const XmlValues& values) const {
  return {orientation(values), values.vec3("pos", {0, 0, 0})};
}

fs::path MjcfDocument::mesh_file(const std::string& name, const ReadOptions& options) const {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path file = strip_path_ ? fs::path(slashed).filename() : fs::path(slashed);
  return find_file((fs::path(mesh_dir_) / file).string(), path_, options);
}

}  // namespace clench
