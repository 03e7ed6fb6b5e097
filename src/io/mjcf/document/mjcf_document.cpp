#include "clench/io/mjcf/document/mjcf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "clench/base/suggest.h"
#include "clench/base/watched.h"
#include "clench/io/text/find_file.h"
#include "clench/math/decompositions.h"

namespace clench {

namespace fs = std::filesystem;

static constexpr int max_files = 100;        // of includes; far above any robot
static constexpr int deepest_element = 200;  // of elements, over all includes
// per name and class: each element of that class searches all of them
static constexpr size_t max_alike_defaults = 10;

MjcfDocument::MjcfDocument(const fs::path& path, FileCache& cache)
    : path_(path),
      file_(path.filename().string()),
      cache_(cache),
      repairs_(cache.diagnostics()),
      losses_(cache.diagnostics(), About::ignored) {
  root_ = load_file(path);
  add_classes(root_, "");
}

// --- elements ---

const XmlFile& MjcfDocument::open(const fs::path& path) {
  files_.push_back(std::make_unique<XmlFile>(path));
  settings_[&files_.back()->file()] = reading_.back();
  open_.push_back(fs::weakly_canonical(path));
  return *files_.back();
}

MjcfNode MjcfDocument::load_file(const fs::path& path) {
  reading_.push_back(std::make_shared<MjcfSettings>());
  reading_.back()->path = path;
  const XmlElement root = open(path).root();
  if (root.name() != "mujoco")
    root.fail("expected an element <mujoco>, got <{}>", excerpt(root.name()));
  MjcfNode out = load(root, 0);
  for (const MjcfNode& node : out.children)
    if (node.name() == "compiler") reading_.back()->read(node.element, unused_, repairs_);
  open_.pop_back();
  reading_.pop_back();
  return out;
}

MjcfNode MjcfDocument::load(const XmlElement& element, int depth) {
  if (depth > deepest_element)
    element.fail("expected at most {} elements in each other", deepest_element);
  MjcfNode node{element, {}};
  for (const auto& child : element.children()) {
    check_stop();
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
    // next to the including file, otherwise next to the outermost
    found = find_file(name, open_.back(), cache_.options());
  } catch (const Error& near) {
    try {
      found = find_file(name, reading_.back()->path, cache_.options());
    } catch (const Error&) {
      element.fail("include: {}", near.what());
    }
  }
  const fs::path canonical = fs::weakly_canonical(found);
  if (std::find(open_.begin(), open_.end(), canonical) != open_.end())
    element.fail("include: '{}' includes itself", excerpt(name));
  if (files_.size() >= max_files) element.fail("expected at most {} files", max_files);
  // the root element only groups the others
  MjcfNode root = load(open(found).root(), depth + 1);
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

// --- classes ---

void MjcfDocument::add_classes(const MjcfNode& root, const std::string& prefix) {
  const int outermost = static_cast<int>(classes_.size());
  classes_.emplace_back();
  class_numbers_[prefix + "main"] = outermost;
  for (const auto& node : root.children)
    if (node.name() == "default") read_defaults(node, -1, prefix, outermost);
}

void MjcfDocument::read_defaults(const MjcfNode& node, int parent, const std::string& prefix,
                                 int outermost) {
  const std::string name = node.element.attribute("class").value_or("");
  int number = parent < 0 ? outermost : parent;
  if (parent < 0 && !name.empty() && name != "main") {
    // older versions of MuJoCo used this name for the global class; current ones reject it
    if (const auto [at, is_new] = class_numbers_.emplace(prefix + name, outermost);
        !is_new && at->second != outermost)
      node.element.fail("default: there is another class '{}'", excerpt(name));
    cache_.diagnostics().warn(node.element.place().of("default"),
                              "the outermost class is called main; {} is taken for it",
                              in_quotes(name));
  } else if (!name.empty() && name != "main") {
    const auto [at, is_new] =
        class_numbers_.emplace(prefix + name, static_cast<int>(classes_.size()));
    number = at->second;
    if (is_new)
      classes_.push_back({parent < 0 ? outermost : parent, {}});
    else
      repairs_.add("class", node.element.place().of("default"),
                   "there is another class {}; they count as one", in_quotes(name));
  }
  for (const auto& child : node.children) {
    check_stop();
    if (child.name() == "default") {
      read_defaults(child, number, prefix, outermost);
      continue;
    }
    auto& alike = classes_[number].elements[child.name()];
    if (alike.size() == max_alike_defaults)
      child.element.fail("default: expected at most {} elements <{}> in one class",
                         max_alike_defaults, excerpt(child.name()));
    alike.emplace_back(default_elements_++, child.element);
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
  std::vector<std::pair<int, XmlElement>> of_class;
  int at = name.empty() ? 0 : class_numbers_.at(name);
  for (; at >= 0; at = classes_[at].parent) {
    of_class.clear();
    for (size_t i = 0; i < names.size(); ++i) {
      if (std::ranges::find(names.first(i), names[i]) != names.first(i).end()) continue;
      const auto found = classes_[at].elements.find(names[i]);
      if (found != classes_[at].elements.end())
        of_class.insert(of_class.end(), found->second.begin(), found->second.end());
    }
    // if a class has several such elements, the last one is used
    std::ranges::sort(of_class, std::greater{}, [](const auto& entry) { return entry.first; });
    for (const auto& entry : of_class) out.push_back(entry.second);
  }
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

Eigen::Quaterniond euler_turn(const MjcfSettings& settings, const std::vector<double>& angles) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  // lower-case letters: intrinsic rotations; capital letters: extrinsic rotations
  for (int i = 0; i < 3; ++i) {
    const char axis = settings.euler[i];
    const Eigen::Quaterniond turn = about(axis, angles[i] * settings.angle_unit);
    q = std::islower(axis) ? q * turn : turn * q;
  }
  return q.normalized();
}

Eigen::Quaterniond turn_z_to(const Eigen::Vector3d& direction) {
  constexpr double nearly_opposite = 1e-6, opposite = 1e-10;  // sine of the angle between them
  const double sine = std::hypot(direction.x(), direction.y());
  if (direction.z() > 0 || sine > nearly_opposite)
    return shortest_rotation(Eigen::Vector3d::UnitZ(), direction).normalized();
  if (sine < opposite) return {0, 1, 0, 0};
  const Eigen::Vector3d axis(-direction.y() / sine, direction.x() / sine, 0);
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(sine, direction.z()), axis));
}

static constexpr const char* turn_spellings[] = {"axisangle", "euler", "xyaxes", "zaxis"};

Eigen::Quaterniond MjcfDocument::orientation(const XmlValues& all) const {
  const XmlValues values = all.nearest(turn_spellings);
  const MjcfSettings& own = settings(all.element());
  if (const auto count =
          std::ranges::count_if(turn_spellings, [&](const char* name) { return values.has(name); });
      count > 1)
    values.element().fail("{}: expected one of axisangle, euler, xyaxes and zaxis, got {}",
                          excerpt(values.element().name()), count);
  const auto direction = [&](const char* name, const Eigen::Vector3d& v) {
    if (!(v.stableNorm() > 1e-9)) values.fail(name, "expected a direction, got none");
    return Eigen::Vector3d(v.stableNormalized());
  };
  if (values.has("axisangle")) {
    const auto v = values.numbers("axisangle", 4, 4);
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(v[3] * own.angle_unit, direction("axisangle", {v[0], v[1], v[2]})));
  }
  if (values.has("euler")) return euler_turn(own, values.numbers("euler", 3, 3));
  if (values.has("xyaxes")) {
    const auto v = values.numbers("xyaxes", 6, 6);
    const Eigen::Vector3d x = direction("xyaxes", {v[0], v[1], v[2]}), y0(v[3], v[4], v[5]);
    const Eigen::Vector3d y = direction("xyaxes", y0 - y0.dot(x) * x);
    Eigen::Matrix3d axes;
    axes << x, y, x.cross(y);
    return Eigen::Quaterniond(axes).normalized();
  }
  if (values.has("zaxis")) return turn_z_to(direction("zaxis", values.vec3("zaxis", {0, 0, 1})));
  if (!all.has("quat")) return Eigen::Quaterniond::Identity();
  const auto v = all.numbers("quat", 4, 4);
  const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
  if (!(q.coeffs().stableNorm() > 1e-9)) all.fail("quat", "expected a quaternion, got zeros");
  Eigen::Quaterniond out;
  out.coeffs() = q.coeffs().stableNormalized();
  return out;
}

Pose MjcfDocument::pose(const XmlValues& values) const {
  return {orientation(values), values.vec3("pos", {0, 0, 0})};
}

std::string MjcfDocument::asset_file(const XmlValues& asset, const std::string& folder) const {
  std::string slashed = asset.text("file");
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path file =
      settings(asset.element()).strip_path ? fs::path(slashed).filename() : fs::path(slashed);
  return (fs::path(folder) / file).string();
}

fs::path MjcfDocument::mesh_file(const XmlValues& asset, const ReadOptions& options) const {
  const MjcfSettings& own = settings(asset.element());
  return find_file(asset_file(asset, own.mesh_dir), own.path, options);
}

std::shared_ptr<const Image> MjcfDocument::texture_image(const XmlValues& asset,
                                                         const ReadOptions& options,
                                                         TextureFiles& files,
                                                         const TextureFiles::Warn& warn) const {
  const MjcfSettings& own = settings(asset.element());
  return files.find(asset_file(asset, own.texture_dir), own.path, options, warn);
}

}  // namespace clench
