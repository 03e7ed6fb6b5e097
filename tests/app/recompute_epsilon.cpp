// Epsilon of the grasps of a file by a program that shares no code with the engine: it reads JSON
// lines, makes the friction pyramids from points, normals and coefficients, and computes their hull
// with qhull.
// recompute_epsilon FILE.jsonl...     exit code 1 if a grasp differs by more than 1e-6
#include <Eigen/Geometry>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/peer_qhull.h"

using Eigen::Vector3d;
using nlohmann::json;

namespace {

constexpr double tolerance = 1e-6;

Vector3d vector_of(const json& list) {
  return Vector3d(list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>());
}

/// unit normal forces along the edges of a pyramid, the first edge along n x e1
std::vector<Vector3d> edges_of(const Vector3d& n, double mu, int count) {
  if (mu == 0) return {n};
  const bool along_x = std::abs(n.x()) > 1 - 1e-9;
  const Vector3d first = n.cross(along_x ? Vector3d::UnitZ() : Vector3d::UnitX()).normalized();
  std::vector<Vector3d> edges;
  for (int i = 0; i < count; ++i)
    edges.push_back(n + mu * (Eigen::AngleAxisd(2 * std::numbers::pi * i / count, n) * first));
  return edges;
}

/// columns (force; torque about the center of mass / rho)
Eigen::MatrixXd wrenches_of(const json& grasp) {
  const Vector3d com = vector_of(grasp.at("com"));
  const double rho = grasp.at("rho");
  std::vector<Eigen::VectorXd> columns;
  for (const json& contact : grasp.at("points")) {
    if (contact.contains("torsion_radius"))
      throw std::runtime_error("a soft contact: only points are known here");
    const Vector3d arm = vector_of(contact.at("point")) - com;
    for (const Vector3d& f :
         edges_of(vector_of(contact.at("normal")), contact.at("mu"), grasp.at("edges"))) {
      columns.emplace_back(6);
      columns.back() << f, arm.cross(f) / rho;
    }
  }
  Eigen::MatrixXd out(6, columns.size());
  for (size_t i = 0; i < columns.size(); ++i) out.col(static_cast<int>(i)) = columns[i];
  return out;
}

/// radius of the largest ball about the origin within the hull; 0 if the origin is outside or the
/// hull is flat
double epsilon_of(const json& grasp) {
  const Eigen::MatrixXd wrenches = wrenches_of(grasp);
  if (wrenches.cols() < 7) return 0;
  // if many wrenches lie in one plane except for rounding, qhull computes no facets unless it may
  // move the points a little
  auto hull = clench::bench::ask_qhull(wrenches, "qhull Qt");
  if (!hull) hull = clench::bench::ask_qhull(wrenches, "qhull QJ");
  return hull ? std::max(0.0, hull->min_offset) : 0;
}

}  // namespace

int main(int count, char** paths) try {
  int grasps = 0, closed = 0, different = 0;
  double worst = 0;
  for (int i = 1; i < count; ++i) {
    std::ifstream file(paths[i]);
    std::string line;
    if (!std::getline(file, line))
      throw std::runtime_error(std::string(paths[i]) + ": expected grasps, got nothing");
    for (int number = 2; std::getline(file, line); ++number) {
      const json grasp = json::parse(line);
      const double said = grasp.at("measures").at("epsilon"), own = epsilon_of(grasp);
      const double off = std::abs(std::max(0.0, said) - own);
      ++grasps, closed += own > 0, worst = std::max(worst, off);
      if (off <= tolerance) continue;
      ++different;
      std::printf("%s:%d: epsilon is said to be %.9g, and is %.9g\n", paths[i], number, said, own);
    }
  }
  std::printf("%d grasps, %d of them in force closure; epsilon differs by at most %.2g\n", grasps,
              closed, worst);
  return different || !grasps ? 1 : 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "recompute_epsilon: %s\n", problem.what());
  return 2;
}
