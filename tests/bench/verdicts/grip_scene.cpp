#include "bench/verdicts/grip_scene.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace clench::bench {

using nlohmann::json;

namespace {

Eigen::Vector3d vector_of(const json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

Eigen::Isometry3d pose_of(const json& v) {
  const json& q = v.at(1);
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = Eigen::Quaterniond(q.at(0).get<double>(), q.at(1).get<double>(),
                                    q.at(2).get<double>(), q.at(3).get<double>())
                     .normalized()
                     .toRotationMatrix();
  out.translation() = vector_of(v.at(0));
  return out;
}

Surface surface_of(const json& mesh) {
  Surface out;
  for (const json& v : mesh.at("vertices")) out.vertices.push_back(vector_of(v));
  for (const json& t : mesh.at("triangles")) out.triangles.push_back({t.at(0), t.at(1), t.at(2)});
  return out;
}

GripBody body_of(const json& v) {
  GripBody out{
      .name = v.at("name"), .mass = v.at("mass"), .com = vector_of(v.at("com")), .pieces = {}};
  for (int i = 0; i < 3; ++i) out.inertia.row(i) = vector_of(v.at("inertia").at(i));
  return out;
}

}  // namespace

GripScene read_grip_scene(const std::string& path) {
  std::ifstream file(path);
  json all;
  file >> all;
  GripScene out{.hand_name = all.at("hand_name"),
                .object_name = all.at("object_name"),
                .table = {},
                .links = {},
                .dofs = {},
                .object = body_of(all.at("object")),
                .mu = all.at("mu"),
                .force = all.at("force"),
                .grasps = {}};
  if (all.contains("table"))
    out.table = {vector_of(all.at("table").at("point")), vector_of(all.at("table").at("up"))};
  out.object.pieces = pieces_of_object(surface_of(all.at("object").at("mesh")));
  for (const json& v : all.at("hand").at("links")) {
    GripLink link{.body = body_of(v), .parent = v.at("parent"), .pose = pose_of(v.at("pose"))};
    link.point = link.pose.translation();
    if (v.contains("mesh")) link.body.pieces = hulls_of_parts(surface_of(v.at("mesh")));
    if (v.contains("joint")) {
      const json& joint = v.at("joint");
      link.has_joint = true;
      link.turns = joint.at("kind") == "revolute";
      link.dof = joint.at("dof"), link.ratio = joint.at("ratio"),
      link.axis = vector_of(joint.at("axis")), link.point = vector_of(joint.at("point"));
    }
    out.links.push_back(link);
  }
  for (const json& v : all.at("hand").at("dofs"))
    out.dofs.push_back({.value = v.at("value"),
                        .min = v.at("min"),
                        .max = v.at("max"),
                        .damping = v.at("damping"),
                        .friction = v.at("friction"),
                        .armature = v.at("armature")});
  for (const json& v : all.at("grasps")) {
    StoredGrasp grasp{.pose = pose_of(v.at("pose")),
                      .dofs = v.at("dofs").get<std::vector<double>>(),
                      .torques = {},
                      .epsilon = v.at("epsilon"),
                      .load = v.at("load"),
                      .torsion_radii = v.value("torsion_radii", std::vector<double>()),
                      .verified = v.at("verified"),
                      .held = v.at("held"),
                      .survived = v.at("survived")};
    if (!grasp.torsion_radii.empty() && grasp.torsion_radii.size() != out.links.size())
      throw std::runtime_error(path + ": torsion_radii: expected one per link, " +
                               std::to_string(out.links.size()) + ", got " +
                               std::to_string(grasp.torsion_radii.size()));
    if (v.contains("torques")) grasp.torques = v.at("torques").get<std::vector<double>>();
    out.grasps.push_back(grasp);
  }
  return out;
}

}  // namespace clench::bench
