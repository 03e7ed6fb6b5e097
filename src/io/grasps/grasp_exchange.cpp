#include "clench/io/grasps/grasp_exchange.h"

#include <algorithm>
#include <filesystem>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/grasps/dof_labels.h"
#include "clench/io/grasps/grasp_arrays.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace {

/// A value of the file, and how messages call it.
struct Value {
  const YamlNode& node;
  const std::string& file;
  std::string name = {};

  std::string place() const {
    return fmt::format("{}:{}{}{}", file, node.line, name.empty() ? "" : ": ", name);
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    fail("{}: expected {}, got {}", place(), expected, node.described());
  }
  std::string key_name(std::string_view key) const {
    return name.empty() ? excerpt(key) : name + "." + excerpt(key);
  }
  bool has(std::string_view key) const { return node.find(key); }
  Value get(std::string_view key) const {
    const YamlNode* found = node.find(key);
    if (!found) fail("{}: expected a key '{}', got none", place(), key);
    return {*found, file, key_name(key)};
  }
  Value item(size_t i) const { return {node.items[i], file, fmt::format("{}[{}]", name, i)}; }
  std::string text() const {
    if (node.kind != YamlNode::Kind::scalar) refuse("a text");
    return node.text;
  }
  double number() const {
    const auto x = node.kind == YamlNode::Kind::scalar && !node.quoted ? parse_number(node.text)
                                                                       : std::nullopt;
    if (!x) refuse("a number");
    return *x;
  }
  size_t list(const char* what, size_t count = std::string::npos) const {
    if (node.kind != YamlNode::Kind::list ||
        (count != std::string::npos && node.items.size() != count))
      refuse(count == std::string::npos ? fmt::format("a list of {}", what)
                                        : fmt::format("{} {}", count, what));
    return node.items.size();
  }
  std::vector<double> numbers(size_t count = std::string::npos) const {
    std::vector<double> out(list("numbers", count));
    for (size_t i = 0; i < out.size(); ++i) out[i] = item(i).number();
    return out;
  }
  void map() const {
    if (node.kind != YamlNode::Kind::map) refuse("a map");
  }
  Pose pose(const std::vector<double>& p, const std::vector<double>& q) const {
    const auto unit = made_unit({q[0], q[1], q[2], q[3]});
    if (!unit)
      fail("{}: expected a quaternion of length 1, got ({} {} {} {})", place(), q[0], q[1], q[2],
           q[3]);
    return {*unit, {p[0], p[1], p[2]}};
  }
  void tell_unused(const std::vector<std::string>& known, const ReadOptions& options) const {
    std::vector<std::string> rest;
    for (const auto& key : node.keys)
      if (std::ranges::find(known, key) == known.end()) rest.push_back(key);
    if (!rest.empty() && options.warn)
      options.warn(fmt::format("{}: {} {} not used", place(), name_list(rest),
                               rest.size() > 1 ? "are" : "is"));
  }
};

// the last part of a path, as USD and files have them
std::string last_part(const std::string& path) {
  return path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
}

std::string plain_or(const std::string& text, const char* other) {
  return yaml_quoted(text.empty() ? other : text);
}

std::string named_list(const std::vector<std::string>& names, const std::vector<double>& values) {
  std::string out;
  for (size_t i = 0; i < values.size(); ++i)
    out += fmt::format("      {}: {}\n",
                       yaml_quoted(i < names.size() ? names[i] : fmt::format("dof{}", i + 1)),
                       real_text(values[i]));
  return out.empty() ? " {}\n" : "\n" + out;
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
  report_lost(grasps, {.dofs = true, .epsilon = true, .pregrasp_dofs = true}, file, "isaac_grasp",
              options);
  const GraspSpec first = grasps.empty() ? GraspSpec{} : grasps[0];
  std::string out = fmt::format(
      "format: isaac_grasp\nformat_version: 1.0\n\nobject_frame: {}\ngripper_frame: "
      "{}\n\ngrasps:{}\n",
      plain_or(first.object_name, "object"), plain_or(first.hand_name, "gripper"),
      grasps.empty() ? " {}" : "");
  for (size_t i = 0; i < grasps.size(); ++i) {
    const GraspSpec& g = grasps[i];
    const auto names = dof_names_of(g);
    const auto& p = g.X_OH->position;
    const auto& q = g.X_OH->rotation;
    const double epsilon = number_of(g.measures, "epsilon", 1);
    const double confidence = std::clamp(number_of(g.info, "confidence", epsilon), 0.0, 1.0);
    out += fmt::format(
        "  grasp_{}:\n    confidence: {}\n    position: {}\n    orientation: {{w: {}, xyz: {}}}\n",
        i, real_text(confidence), real_list({p.x(), p.y(), p.z()}), real_text(q.w()),
        real_list({q.x(), q.y(), q.z()}));
    out += "    cspace_position:" + named_list(names, g.dofs);
    out +=
        "    pregrasp_cspace_position:" + named_list(names, g.pregrasp ? g.pregrasp->dofs : g.dofs);
  }
  return out;
}

std::vector<GraspSpec> read_isaac_grasps(const YamlNode& root, const std::string& file,
                                         const ReadOptions& options) {
  const Value top{root, file};
  top.map();
  if (const auto format = top.get("format"); format.text() != "isaac_grasp")
    format.refuse("'isaac_grasp'");
  if (const auto version = top.get("format_version"); parse_number(version.text()) != 1.0)
    version.refuse("version 1.0");
  top.tell_unused({"format", "format_version", "object_frame", "gripper_frame", "grasps",
                   "created_with", "created_at"},
                  options);
  const std::string object =
      top.has("object_frame") ? last_part(top.get("object_frame").text()) : "";
  const std::string hand =
      top.has("gripper_frame") ? last_part(top.get("gripper_frame").text()) : "";
  std::vector<GraspSpec> out;
  const Value grasps = top.get("grasps");
  grasps.map();
  for (size_t i = 0; i < root.find("grasps")->items.size(); ++i) {
    options.progress.check();
    const Value one{grasps.node.items[i], file, grasps.key_name(grasps.node.keys[i])};
    one.map();
    GraspSpec& g = out.emplace_back();
    g.hand_name = hand;
    g.object_name = object;
    g.labels["name"] = grasps.node.keys[i];
    const Value turn = one.get("orientation");
    turn.map();
    const auto xyz = turn.get("xyz").numbers(3);
    g.X_OH =
        one.pose(one.get("position").numbers(3), {turn.get("w").number(), xyz[0], xyz[1], xyz[2]});
    if (one.has("confidence")) g.info["confidence"] = one.get("confidence").number();
    const auto named = [&](const char* key, auto add) {
      const Value values = one.get(key);
      values.map();
      for (size_t k = 0; k < values.node.items.size(); ++k)
        add(values.node.keys[k],
            Value{values.node.items[k], file, values.key_name(values.node.keys[k])}.number());
    };
    named("cspace_position", [&](const std::string& name, double x) {
      g.dof_names.push_back(name);
      g.dofs.push_back(x);
    });
    if (!one.has("pregrasp_cspace_position")) continue;
    std::map<std::string, double> before;
    named("pregrasp_cspace_position", [&](const std::string& name, double x) { before[name] = x; });
    g.pregrasp = PregraspState{*g.X_OH, g.dofs};
    for (size_t k = 0; k < g.dofs.size(); ++k)
      g.pregrasp->dofs[k] = number_of(before, g.dof_names[k], g.dofs[k]);
  }
  return out;
}

// --- GraspGen ---

std::string graspgen_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                          const WriteOptions& options) {
  check_writable(grasps, file, false, true);
  report_lost(grasps, {}, file, "graspgen", options);
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
  return fmt::format(
      "{{\n  \"object\": {{\"file\": {}, \"scale\": 1.0}},\n  \"grasps\": {{\n    \"transforms\": "
      "[\n      {}\n    ],\n"
      "    \"object_in_gripper\": [{}]\n  }}\n}}\n",
      yaml_quoted(first.object_file.empty() ? first.object_name : first.object_file), transforms,
      held);
}

std::vector<GraspSpec> read_graspgen(const YamlNode& root, const std::string& file,
                                     const ReadOptions& options) {
  const Value top{root, file};
  top.map();
  const Value object = top.get("object"), grasps = top.get("grasps");
  object.map();
  grasps.map();
  top.tell_unused({"object", "grasps"}, options);
  const std::string object_file = object.has("file") ? object.get("file").text() : "";
  const double scale = object.has("scale") ? object.get("scale").number() : 1;
  if (!(scale > 0)) object.get("scale").refuse("a number > 0");
  if (scale != 1 && options.warn)
    options.warn(fmt::format(
        "{}: the object has to be loaded at scale {}, at which these grasps hold it", file, scale));
  const Value transforms = grasps.get("transforms");
  std::vector<GraspSpec> out(transforms.list("4 x 4 matrices"));
  for (size_t i = 0; i < out.size(); ++i) {
    options.progress.check();
    const Value matrix = transforms.item(i);
    matrix.list("rows of 4 numbers", 4);
    std::vector<double> m;
    for (size_t r = 0; r < 4; ++r)
      for (const double x : matrix.item(r).numbers(4)) m.push_back(x);
    out[i].X_OH = pose_of_matrix(m.data(), matrix.place());
    out[i].object_file = object_file;
    out[i].object_name = std::filesystem::path(object_file).stem().string();
    out[i].info["scale"] = scale;
  }
  if (!grasps.has("object_in_gripper")) return out;
  const Value held = grasps.get("object_in_gripper");
  held.list("true and false", out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    const Value word = held.item(i);
    const std::string text = lower_case(word.text());
    if (text != "true" && text != "false" && text != "1" && text != "0")
      word.refuse("true or false");
    out[i].info["object_in_gripper"] = text == "true" || text == "1";
  }
  return out;
}

// --- MultiGripperGrasp ---

std::string multigripper_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                              const WriteOptions& options) {
  check_writable(grasps, file, true, true);
  report_lost(grasps, {.dofs = true}, file, "multigripper", options);
  const GraspSpec first = grasps.empty() ? GraspSpec{} : grasps[0];
  std::string poses, dofs;
  for (const GraspSpec& g : grasps) {
    poses += (poses.empty() ? "" : ",\n    ") + real_list(pose_numbers(*g.X_OH));
    dofs += (dofs.empty() ? "" : ",\n    ") + real_list(g.dofs);
  }
  const std::string object = yaml_quoted(first.object_name);
  // its documentation says object_ID, its program reads object_id
  return fmt::format(
      "{{\n  \"gripper\": {},\n  \"object_ID\": {},\n  \"object_id\": {},\n  \"pose\": [\n    {}\n "
      " ],\n  \"dofs\": [\n    {}\n  ],\n"
      "  \"dof_names\": {}\n}}\n",
      yaml_quoted(first.hand_name), object, object, poses, dofs, text_list(dof_names_of(first)));
}

std::vector<GraspSpec> read_multigripper(const YamlNode& root, const std::string& file,
                                         const ReadOptions& options) {
  const Value top{root, file};
  top.map();
  const std::string hand = top.get("gripper").text();
  const std::string object =
      top.has("object_id") ? top.get("object_id").text() : top.get("object_ID").text();
  const Value poses = top.get("pose");
  std::vector<GraspSpec> out(poses.list("poses"));
  std::vector<std::string> names;
  if (top.has("dof_names")) {
    const Value list = top.get("dof_names");
    for (size_t i = 0; i < list.list("texts"); ++i) names.push_back(list.item(i).text());
    check_dof_names(list.place(), names);
  }
  const char* dofs_key = top.has("final_dofs") ? "final_dofs" : "dofs";
  if (top.has(dofs_key)) top.get(dofs_key).list("lists of DOFs", out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    options.progress.check();
    GraspSpec& g = out[i];
    const auto x = poses.item(i).numbers(7);
    g.hand_name = hand;
    g.object_name = object;
    g.X_OH = poses.item(i).pose(x, {x[3], x[4], x[5], x[6]});
    if (!top.has(dofs_key)) continue;
    g.dofs = top.get(dofs_key).item(i).numbers(names.empty() ? std::string::npos : names.size());
    g.dof_names = names;
  }
  std::vector<std::string> known = {"gripper", "object_ID",  "object_id", "pose",
                                    "dofs",    "final_dofs", "dof_names"};
  for (const char* key : {"result", "result_time", "fall_time", "slip_time"}) {
    if (!top.has(key)) continue;
    known.emplace_back(key);
    const Value list = top.get(key);
    list.list("numbers", out.size());
    for (size_t i = 0; i < out.size(); ++i) out[i].info[key] = list.item(i).number();
  }
  top.tell_unused(known, options);
  return out;
}

}  // namespace clench
