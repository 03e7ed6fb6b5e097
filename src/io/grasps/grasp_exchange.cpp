#include "clench/io/grasps/grasp_exchange.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/grasp_array_parts.h"
#include "clench/io/grasps/grasp_arrays.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace {

/// A value of the file, with its name in messages.
struct Value {
  ValueNode node;
  const std::string& file;
  std::string name = {};

  Place place() const { return Place(file, node.line(), name); }
  [[noreturn]] void refuse(const std::string& expected) const {
    fail("{}: expected {}, got {}", place(), expected, node.described());
  }
  std::string key_name(std::string_view key) const {
    return name.empty() ? excerpt(key) : name + "." + excerpt(key);
  }
  bool has(std::string_view key) const { return node.find(key).has_value(); }
  Value get(std::string_view key) const {
    const auto found = node.find(key);
    if (!found) fail("{}: expected a key '{}', got none", place(), key);
    return {*found, file, key_name(key)};
  }
  Value item(size_t i) const { return {node.item(i), file, fmt::format("{}[{}]", name, i)}; }
  /// The i-th value of a map.
  Value entry(size_t i) const { return {node.item(i), file, key_name(node.key(i))}; }
  std::string text() const {
    if (node.kind() != ValueKind::scalar) refuse("a text");
    return std::string(node.text());
  }
  /// The text at a key; empty if the key is absent.
  std::string text_at(std::string_view key) const { return has(key) ? get(key).text() : ""; }
  double number() const {
    const auto x = node.kind() == ValueKind::scalar && !node.quoted() ? parse_number(node.text())
                                                                      : std::nullopt;
    if (!x) refuse("a number");
    return *x;
  }
  size_t list(const char* what, size_t count = std::string::npos) const {
    if (node.kind() != ValueKind::list || (count != std::string::npos && node.size() != count))
      refuse(count == std::string::npos ? fmt::format("a list of {}", what)
                                        : fmt::format("{} {}", count, what));
    return node.size();
  }
  std::vector<double> numbers(size_t count = std::string::npos) const {
    std::vector<double> out(list("numbers", count));
    for (size_t i = 0; i < out.size(); ++i) {
      const ValueNode one = node.item(i);
      const auto x = one.kind() == ValueKind::scalar && !one.quoted() ? parse_number(one.text())
                                                                      : std::nullopt;
      out[i] = x ? *x : item(i).number();
    }
    return out;
  }
  void map() const {
    if (node.kind() != ValueKind::map) refuse("a map");
  }
  Pose pose(const std::vector<double>& p, const std::vector<double>& q) const {
    const auto unit = made_unit({q[0], q[1], q[2], q[3]});
    if (!unit)
      fail("{}: expected a quaternion of length 1, got ({} {} {} {})", place(), q[0], q[1], q[2],
           q[3]);
    return {*unit, {p[0], p[1], p[2]}};
  }
  /// Unknown keys of the map.
  std::vector<std::string> unknown(const std::vector<std::string>& known) const {
    std::vector<std::string> out;
    for (size_t i = 0; i < node.size(); ++i)
      if (std::ranges::find(known, node.key(i)) == known.end()) out.push_back(excerpt(node.key(i)));
    return out;
  }
};

void warn_of_unused(const Place& place, const std::vector<std::string>& keys,
                    const ReadOptions& options) {
  if (!keys.empty())
    options.diagnostics.warn(place, "{} {} not used", name_list(keys),
                             keys.size() > 1 ? "are" : "is");
}

void warn_of_scale(const std::string& file, double scale, const ReadOptions& options) {
  if (scale != 1)
    options.diagnostics.warn(
        Place(file), "the object has to be loaded at scale {}, at which these grasps hold it",
        scale);
}

// the last part of a path, for USD paths and files
std::string last_part(const std::string& path) {
  return path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
}

std::string named_list(const std::vector<std::string>& names, const std::vector<double>& values) {
  std::string out;
  for (size_t i = 0; i < values.size(); ++i)
    out += fmt::format("      {}: {}\n", yaml_quoted(names[i]), real_text(values[i]));
  return out.empty() ? " {}\n" : "\n" + out;
}

// the labels "name" if all grasps have different ones, otherwise grasp_0 and so on
std::vector<std::string> grasp_names(const std::vector<GraspSpec>& grasps) {
  std::vector<std::string> out;
  std::set<std::string> known;
  for (size_t i = 0; i < grasps.size(); ++i) {
    const auto label = grasps[i].labels.find("name");
    if (label == grasps[i].labels.end() || !known.insert(label->second).second) break;
    out.push_back(yaml_quoted(label->second));
  }
  if (out.size() == grasps.size()) return out;
  out.clear();
  for (size_t i = 0; i < grasps.size(); ++i) out.push_back(fmt::format("grasp_{}", i));
  return out;
}

bool has_joint_names(const std::vector<GraspSpec>& grasps) {
  return std::ranges::all_of(
      grasps, [](const GraspSpec& g) { return g.joint_names.size() == g.joints.size(); });
}

// names and values of the DOFs, then of the joints that have other names
std::pair<std::vector<std::string>, std::vector<double>> with_followers(const GraspSpec& g) {
  std::pair<std::vector<std::string>, std::vector<double>> out{g.dof_names, g.dofs};
  if (g.joint_names.size() != g.joints.size()) return out;
  for (size_t j = 0; j < g.joints.size(); ++j) {
    if (std::ranges::find(g.dof_names, g.joint_names[j]) != g.dof_names.end()) continue;
    out.first.push_back(g.joint_names[j]);
    out.second.push_back(g.joint_value(j));
  }
  return out;
}

std::string text_list(const std::vector<std::string>& texts) {
  std::string out;
  for (const auto& text : texts) out += (out.empty() ? "" : ", ") + yaml_quoted(text);
  return "[" + out + "]";
}

}  // namespace

// --- isaac_grasp ---

std::string isaac_grasp_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                             const WriteOptions& options) {
  check_writable(grasps, file, true, true);
  // contents of the list itself are not reported as losses
  std::vector<GraspSpec> rest = grasps;
  for (GraspSpec& g : rest) {
    g.info.erase("confidence");
    g.labels.erase("name");
  }
  report_lost(
      rest, {.dofs = true, .epsilon = true, .pregrasp_dofs = true, .joints = has_joint_names(rest)},
      file, "isaac_grasp", options);
  const GraspSpec first = grasps.empty() ? GraspSpec{} : grasps[0];
  std::string out = fmt::format(
      "format: isaac_grasp\nformat_version: 1.0\n\nobject_frame: {}\ngripper_frame: "
      "{}\n\ngrasps:{}\n",
      yaml_quoted(first.object_name), yaml_quoted(first.hand_name), grasps.empty() ? " {}" : "");
  const auto names_of_grasps = grasp_names(grasps);
  for (size_t i = 0; i < grasps.size(); ++i) {
    const GraspSpec& g = grasps[i];
    if (g.dof_names.size() != g.dofs.size())
      fail(
          "{}: grasps[{}]: expected DOFs with names, which the format isaac_grasp needs, got {} "
          "without; the option dof_order names them",
          file, i + 1, g.dofs.size());
    if (g.pregrasp && g.pregrasp->dofs.size() != g.dofs.size())
      fail("{}: grasps[{}]: expected a pregrasp of {} DOFs, got {}", file, i + 1, g.dofs.size(),
           g.pregrasp->dofs.size());
    const auto& p = g.X_OH->position;
    const auto& q = g.X_OH->rotation;
    const double epsilon = number_of(g.measures, "epsilon", 1);
    const double confidence = std::clamp(number_of(g.info, "confidence", epsilon), 0.0, 1.0);
    out += fmt::format(
        "  {}:\n    confidence: {}\n    position: {}\n    orientation: {{w: {}, xyz: {}}}\n",
        names_of_grasps[i], real_text(confidence), real_list({p.x(), p.y(), p.z()}),
        real_text(q.w()), real_list({q.x(), q.y(), q.z()}));
    const auto [names, values] = with_followers(g);
    out += "    cspace_position:" + named_list(names, values);
    out += "    pregrasp_cspace_position:" +
           named_list(g.dof_names, g.pregrasp ? g.pregrasp->dofs : g.dofs);
  }
  return out;
}

namespace {

constexpr const char *position_key = "cspace_position", *pregrasp_key = "pregrasp_cspace_position";

// values by names of DOFs
template <class Add>
void each_dof(const Value& values, Add add) {
  values.map();
  for (size_t i = 0; i < values.node.size(); ++i)
    add(std::string(values.node.key(i)), values.entry(i).number());
}

GraspSpec read_isaac_grasp(const Value& one, const ReadOptions& options) {
  one.map();
  GraspSpec g;
  const Value turn = one.get("orientation");
  turn.map();
  const auto xyz = turn.get("xyz").numbers(3);
  g.X_OH =
      one.pose(one.get("position").numbers(3), {turn.get("w").number(), xyz[0], xyz[1], xyz[2]});
  if (one.has("confidence")) g.info["confidence"] = one.get("confidence").number();
  // optional: without it the DOFs of the hand are unchanged
  if (one.has(position_key))
    each_dof(one.get(position_key), [&](std::string name, double x) {
      g.dof_names.push_back(std::move(name));
      g.dofs.push_back(x);
    });
  if (!one.has(pregrasp_key)) return g;
  std::map<std::string, double> before;
  each_dof(one.get(pregrasp_key), [&](const std::string& name, double x) { before[name] = x; });
  g.pregrasp = PregraspState{*g.X_OH, g.dofs};
  for (size_t k = 0; k < g.dofs.size(); ++k) {
    const auto found = before.find(g.dof_names[k]);
    if (found == before.end()) continue;
    g.pregrasp->dofs[k] = found->second;
    before.erase(found);
  }
  if (!before.empty())
    options.diagnostics.warn(one.get(pregrasp_key).place(),
                             "{} is not used, as {} does not list it",
                             excerpt(before.begin()->first), position_key);
  return g;
}

}  // namespace

void read_isaac_grasps(const ValueTree& tree, const std::string& file, GraspCollector& list,
                       const ReadOptions& options) {
  const Value top{tree.root(), file};
  top.map();
  if (const auto format = top.get("format"); format.text() != "isaac_grasp")
    format.refuse("'isaac_grasp'");
  if (const auto version = top.get("format_version"); parse_number(version.text()) != 1.0)
    version.refuse("version 1.0");
  // the frames by the names in the documentation of ROS, or those of Isaac Sim's Grasp Editor
  const auto frame = [&](const char* key, const char* link_key) {
    return last_part(top.text_at(top.has(key) ? key : link_key));
  };
  const std::string object = frame("object_frame", "object_frame_link"),
                    hand = frame("gripper_frame", "gripper_frame_link"),
                    object_file = top.text_at("object_file"),
                    hand_file = top.text_at("gripper_file");
  if (top.has("object_scale")) warn_of_scale(file, top.get("object_scale").number(), options);
  warn_of_unused(top.place(),
                 top.unknown({"format", "format_version", "object_frame", "object_frame_link",
                              "gripper_frame", "gripper_frame_link", "grasps", "object_file",
                              "object_scale", "gripper_file", "created_with", "created_at"}),
                 options);
  const Value grasps = top.get("grasps");
  grasps.map();
  list.expect(grasps.node.size());
  bool told = false;
  for (size_t i = 0; i < grasps.node.size(); ++i) {
    options.progress.check();
    const Value one = grasps.entry(i);
    GraspSpec g = read_isaac_grasp(one, options);
    g.hand_name = hand;
    g.object_name = object;
    g.hand_file = hand_file;
    g.object_file = object_file;
    g.labels["name"] = grasps.node.key(i);
    list.add(std::move(g));
    if (told) continue;  // of the first grasp with DOFs
    const auto unused =
        one.unknown({"position", "orientation", "confidence", position_key, pregrasp_key});
    warn_of_unused(one.place(), unused, options);
    told = !unused.empty();
  }
}

// --- GraspGen ---

std::string graspgen_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                          const WriteOptions& options) {
  check_writable(grasps, file, false, true);
  // contents of the list itself are not reported as losses
  std::vector<GraspSpec> rest = grasps;
  for (GraspSpec& g : rest) {
    for (const char* held : {"scale", "object_in_gripper"}) g.info.erase(held);
    g.hand_file.clear();
    g.object_file.clear();
  }
  report_lost(rest, {.hand = false}, file, "graspgen", options);
  const GraspSpec first = grasps.empty() ? GraspSpec{} : grasps[0];
  std::string transforms, held;
  for (const GraspSpec& g : grasps) {
    const Eigen::Matrix3d R = g.X_OH->rotation.toRotationMatrix();
    std::string rows;
    for (int r = 0; r < 3; ++r)
      rows += real_list({R(r, 0), R(r, 1), R(r, 2), g.X_OH->position[r]}) + ", ";
    transforms += (transforms.empty() ? "" : ",\n      ") + ("[" + rows + "[0.0, 0.0, 0.0, 1.0]]");
    const bool good = number_of(g.measures, "epsilon", 0) > 0 && g.collision_free.value_or(true);
    held += (held.empty() ? "" : ", ") +
            std::string(number_of(g.info, "object_in_gripper", good) != 0 ? "true" : "false");
  }
  const double scale = number_of(first.info, "scale", 1);
  for (size_t i = 0; i < grasps.size(); ++i)
    if (const double other = number_of(grasps[i].info, "scale", 1); other != scale)
      fail("{}: grasps[{}]: expected the scale of the first grasp, {}, got {}", file, i + 1, scale,
           other);
  return fmt::format(
      "{{\n  \"object\": {{\"file\": {}, \"scale\": {}}},\n  \"grasps\": {{\n    \"transforms\": "
      "[\n      {}\n    ],\n"
      "    \"object_in_gripper\": [{}]\n  }}\n}}\n",
      yaml_quoted(first.object_file.empty() ? first.object_name : first.object_file),
      real_text(scale), transforms, held);
}

void read_graspgen(const ValueTree& tree, const std::string& file, GraspCollector& list,
                   const ReadOptions& options) {
  const Value top{tree.root(), file};
  top.map();
  const Value object = top.get("object"), grasps = top.get("grasps");
  object.map();
  grasps.map();
  warn_of_unused(top.place(), top.unknown({"object", "grasps"}), options);
  warn_of_unused(object.place(), object.unknown({"file", "scale"}), options);
  warn_of_unused(grasps.place(), grasps.unknown({"transforms", "object_in_gripper"}), options);
  const std::string object_file = object.text_at("file");
  const double scale = object.has("scale") ? object.get("scale").number() : 1;
  if (!(scale > 0)) object.get("scale").refuse("a number > 0");
  warn_of_scale(file, scale, options);
  const Value transforms = grasps.get("transforms");
  const size_t count = transforms.list("4 x 4 matrices");
  std::optional<Value> held;
  if (grasps.has("object_in_gripper")) {
    held.emplace(grasps.get("object_in_gripper"));
    held->list("true and false", count);
  }
  list.expect(count);
  for (size_t i = 0; i < count; ++i) {
    options.progress.check();
    const Value matrix = transforms.item(i);
    matrix.list("rows of 4 numbers", 4);
    std::vector<double> m;
    for (size_t r = 0; r < 4; ++r)
      for (const double x : matrix.item(r).numbers(4)) m.push_back(x);
    GraspSpec g;
    g.X_OH = pose_of_matrix(m.data(), matrix.place().text());
    g.object_file = object_file;
    g.object_name = std::filesystem::path(object_file).stem().string();
    g.info["scale"] = scale;
    if (held) {
      const Value word = held->item(i);
      const std::string text = lower_case(word.text());
      if (text != "true" && text != "false" && text != "1" && text != "0")
        word.refuse("true or false");
      g.info["object_in_gripper"] = text == "true" || text == "1";
    }
    list.add(std::move(g));
  }
}

// --- MultiGripperGrasp ---

std::string multigripper_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                              const WriteOptions& options) {
  check_writable(grasps, file, true, true);
  check_same_dofs(grasps, file);
  const bool with_joints = has_joint_names(grasps) && has_same_joints(grasps);
  report_lost(grasps, {.dofs = true, .joints = with_joints}, file, "multigripper", options);
  const GraspSpec first = grasps.empty() ? GraspSpec{} : grasps[0];
  std::string poses, dofs, joints;
  for (const GraspSpec& g : grasps) {
    poses += (poses.empty() ? "" : ",\n    ") + real_list(pose_numbers(*g.X_OH));
    dofs += (dofs.empty() ? "" : ",\n    ") + real_list(g.dofs);
    std::vector<double> values;
    for (size_t j = 0; j < g.joints.size(); ++j) values.push_back(g.joint_value(j));
    joints += (joints.empty() ? "" : ",\n    ") + real_list(values);
  }
  if (!with_joints || first.joints.empty()) joints.clear();
  if (!joints.empty())
    joints = fmt::format(",\n  \"joints\": [\n    {}\n  ],\n  \"joint_names\": {}", joints,
                         text_list(first.joint_names));
  const std::string object = yaml_quoted(first.object_name);
  // its documentation says object_ID, its program reads object_id
  return fmt::format(
      "{{\n  \"gripper\": {},\n  \"object_ID\": {},\n  \"object_id\": {},\n  \"pose\": [\n    {}\n "
      " ],\n  \"dofs\": [\n    {}\n  ]{}{}\n}}\n",
      yaml_quoted(first.hand_name), object, object, poses, dofs,
      first.dof_names.empty() ? "" : ",\n  \"dof_names\": " + text_list(first.dof_names), joints);
}

void read_multigripper(const ValueTree& tree, const std::string& file, GraspCollector& list,
                       const ReadOptions& options) {
  const Value top{tree.root(), file};
  top.map();
  const std::string hand = top.get("gripper").text();
  const std::string object =
      top.get(top.has("object_ID") && !top.has("object_id") ? "object_ID" : "object_id").text();
  const Value poses = top.get("pose");
  const size_t count = poses.list("poses");
  std::vector<std::string> names;
  if (top.has("dof_names")) {
    const Value given = top.get("dof_names");
    for (size_t i = 0; i < given.list("texts"); ++i) names.push_back(given.item(i).text());
    check_dof_names(given.place().text(), names);
  }
  const char* dofs_key = top.has("final_dofs") ? "final_dofs" : "dofs";
  std::optional<Value> dofs;
  if (top.has(dofs_key)) {
    dofs.emplace(top.get(dofs_key));
    dofs->list("lists of DOFs", count);
  }
  std::vector<std::string> known = {"gripper",    "object_ID", "object_id", "pose",       "dofs",
                                    "final_dofs", "dof_names", "joints",    "joint_names"};
  std::vector<std::pair<std::string, Value>> results;
  for (const char* key : {"result", "result_time", "fall_time", "slip_time"}) {
    if (!top.has(key)) continue;
    known.emplace_back(key);
    results.emplace_back(key, top.get(key));
    results.back().second.list("numbers", count);
  }
  warn_of_unused(top.place(), top.unknown(known), options);
  list.expect(count);
  for (size_t i = 0; i < count; ++i) {
    options.progress.check();
    GraspSpec g;
    const Value pose = poses.item(i);
    const auto x = pose.numbers(7);
    g.hand_name = hand;
    g.object_name = object;
    g.X_OH = pose.pose(x, {x[3], x[4], x[5], x[6]});
    if (dofs) {
      g.dofs = dofs->item(i).numbers(names.empty() ? std::string::npos : names.size());
      g.dof_names = names;
    }
    for (const auto& [key, values] : results) g.info[key] = values.item(i).number();
    list.add(std::move(g));
  }
}

}  // namespace clench
