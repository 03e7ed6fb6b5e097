#include "clench/grasp/measure/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/grasp/force/contact_forces.h"
#include "clench/grasp/force/hand_jacobian.h"
#include "clench/grasp/force/link_weight.h"
#include "clench/grasp/measure/clearance.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

namespace {

Vector6d weight_of(const World& world, const Body& body) {
  Vector6d weight = Vector6d::Zero();
  weight.head<3>() = world.gravity() * body.mass;
  return weight;
}

// six of them, with zeros for missing ones and those at the level of rounding
Vector6d six_singular_values(const MatrixXd& m) {
  constexpr double rounding =
      1e-12;  // of the largest: sums of a hundred products are accurate to 1e-14
  Vector6d out = Vector6d::Zero();
  if (m.size() == 0) return out;
  const VectorXd values = singular_value_decomposition(m).values;
  for (Index i = 0; i < std::min<Index>(6, values.size()); ++i)
    if (values[i] > rounding * values[0]) out[i] = values[i];
  return out;
}

double ratio(double least, double largest) { return largest > 0 ? least / largest : 0; }

}  // namespace

const World& MeasuredGrasp::world() const {
  check_unmoved(world_, grasp_);
  return world_;
}

MeasuredGrasp::MeasuredGrasp(const World& world, const Grasp& grasp, const Progress& progress)
    : world_(world), grasp_(grasp), progress_(progress) {}

const ContactPolygon& MeasuredGrasp::polygon() {
  if (!polygon_) {
    std::vector<Eigen::Vector3d> points;
    for (const PointContact& point : grasp_.points) points.push_back(point.p_O);
    polygon_ = contact_polygon(points);
  }
  return *polygon_;
}

const MeasuredGrasp::Maps& MeasuredGrasp::maps() {
  if (maps_) return *maps_;
  const GraspMap map = grasp_map(grasp_.points, grasp_.com);
  maps_.emplace();
  maps_->G = map.matrix;
  maps_->J = dof_jacobian(world_, grasp_, hand_jacobian(world_, grasp_));
  maps_->starts = map.starts;
  maps_->G.bottomRows(3) /= grasp_.rho;
  // torsions as friction at the contact's own radius: within the cone the two share one bound
  for (int i = 0; i < map.contacts(); ++i)
    if (map.starts[i + 1] - map.starts[i] == 4) {
      maps_->G.col(map.starts[i] + 3) *= grasp_.points[i].torsion_radius;
      maps_->J.row(map.starts[i] + 3) *= grasp_.points[i].torsion_radius;
    }
  return *maps_;
}

const Vector6d& MeasuredGrasp::singular_values() {
  if (!values_) values_ = six_singular_values(maps().G);
  return *values_;
}

const Vector6d& MeasuredGrasp::hand_singular_values() {
  if (hand_values_) return *hand_values_;
  hand_values_ = Vector6d::Zero();
  // an object that the contacts do not restrain is not moved by any
  if (singular_values()[5] == 0) return *hand_values_;
  const MatrixXd &G = maps().G, &J = maps().J;
  hand_values_ = six_singular_values(solve_symmetric(G * G.transpose(), G * J));
  return *hand_values_;
}

RobustnessProblem MeasuredGrasp::robustness_problem() {
  RobustnessProblem problem;
  problem.G = maps().G;
  problem.J = maps().J;
  problem.starts = maps().starts;
  problem.mu.resize(static_cast<Index>(grasp_.points.size()));
  for (size_t i = 0; i < grasp_.points.size(); ++i)
    problem.mu[static_cast<Index>(i)] = grasp_.points[i].mu;
  problem.compliance = VectorXd::Ones(problem.G.cols());
  const Body& object = world_.body(grasp_.object);
  const Vector6d weight = weight_of(world_, object);
  problem.load.head<3>() =
      world_.pose(grasp_.object).rotation.conjugate() * Eigen::Vector3d(weight.head<3>());
  return problem;
}

const Robustness& MeasuredGrasp::robustness() {
  if (!robustness_) robustness_ = contact_robustness(robustness_problem());
  return *robustness_;
}

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double centroid_distance(MeasuredGrasp& g) {
  if (g.grasp().points.empty()) return unbounded;
  return (g.polygon().centroid - g.grasp().com).norm();
}

double polygon_area(MeasuredGrasp& g) { return g.grasp().points.empty() ? 0 : g.polygon().area; }

double polygon_irregularity(MeasuredGrasp& g) {
  return g.grasp().points.empty() ? 1 : g.polygon().irregularity;
}

double gravity_effort(MeasuredGrasp& g) {
  const ForceResult held = contact_forces(
      g.world(), g.grasp(), {.load = weight_of(g.world(), g.world().body(g.grasp().object))});
  return held.status == ForceStatus::optimal ? held.objective : unbounded;
}

// the DOFs with limits, each with its relative position between them, from 0 to 1
template <class Act>
void each_place_in_range(const World& world, Id<Robot> id, Act act) {
  const Robot& robot = world.robot(id);
  const auto q = world.dofs(id);
  for (Index i = 0; i < q.size(); ++i)
    if (const auto [low, high] = robot.limits[i];
        high > low && std::isfinite(high - low) && !robot.endless[i])
      act((q[i] - low) / (high - low));
}

double joint_margin(MeasuredGrasp& g) {
  double least = unbounded;
  each_place_in_range(g.world(), g.grasp().hand, [&](double place) {
    least = std::min({least, std::max(0.0, place), std::max(0.0, 1 - place)});
  });
  return least;
}

double joint_deviation(MeasuredGrasp& g) {
  double sum = 0;
  int count = 0;
  each_place_in_range(g.world(), g.grasp().hand, [&](double place) {
    sum += (2 * place - 1) * (2 * place - 1);
    ++count;
  });
  return count > 0 ? sum / count : unbounded;
}

// in the object frame; no axis if two moments differ by less than the faceting of a round body
// causes
std::optional<Eigen::Vector3d> principal_axis(const Body& body) {
  constexpr double alike = 1e-3;  // relative to the largest moment
  const auto [moments, axes] = eigensystem(body.inertia_per_mass);
  const double below = moments[1] - moments[0], above = moments[2] - moments[1];
  if (!(std::max(below, above) > alike * moments[2])) return {};
  return Eigen::Vector3d(axes.col(below >= above ? 0 : 2));
}

double orthogonality(MeasuredGrasp& g) {
  const Body& object = g.world().body(g.grasp().object);
  const auto axis = principal_axis(object);
  if (!axis) return unbounded;
  const Robot& hand = g.world().robot(g.grasp().hand);
  const Eigen::Vector3d approach =
      g.world().pose(hand.base).rotation * hand.X_BA.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis_W = g.world().pose(g.grasp().object).rotation * *axis;
  const double along = std::abs(axis_W.dot(approach)), across = axis_W.cross(approach).norm();
  return std::atan2(std::min(along, across), std::max(along, across));
}

double coplanarity(MeasuredGrasp& g) {
  // duplicate contacts count once
  std::vector<const PointContact*> distinct;
  for (const PointContact& c : g.grasp().points)
    if (std::ranges::none_of(distinct, [&](const PointContact* d) {
          return (c.p_O - d->p_O).norm() < 1e-6 && (c.n_O - d->n_O).norm() < 1e-6;
        }))
      distinct.push_back(&c);
  if (distinct.empty()) return unbounded;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PointContact* c : distinct) scatter += c->n_O * c->n_O.transpose();
  return std::sqrt(std::max(0.0, eigenvalues(scatter)[0] / static_cast<double>(distinct.size())));
}

// A contact displaced by d changes its unit wrenches by d times their force, over rho: the support
// in any direction decreases by at most that much.
double contact_position_tolerance(MeasuredGrasp& g) {
  double force = 1;
  for (const PointContact& c : g.grasp().points) force = std::max(force, std::hypot(1, c.mu));
  return g.space().epsilon(g.progress()) * g.grasp().rho / force;
}

double volume(MeasuredGrasp& g) { return g.space({}).volume(g.progress()); }

const Measure all_measures[] = {
    {"epsilon",
     "radius of the largest ball of wrenches that contact forces resist, with normal forces that "
     "sum to one; 0 without force closure",
     "0 to sqrt(1 + mu^2)", "1", true, "Ferrari and Canny (1992)",
     [](MeasuredGrasp& g) { return g.space().epsilon(g.progress()); }},
    {"epsilon_linf", "the same, with each normal force at most one", ">= 0", "1", true,
     "Ferrari and Canny (1992)",
     [](MeasuredGrasp& g) {
       return g.space({.space = {.norm = WrenchNorm::linf}}).epsilon(g.progress());
     }},
    {"epsilon_exact", "epsilon with round friction cones", "0 to sqrt(1 + mu^2)", "1", true,
     "Ferrari and Canny (1992)",
     [](MeasuredGrasp& g) { return g.space({.edges = round_edges}).epsilon(g.progress()); }},
    {"epsilon_force",
     "radius of the largest ball of forces that such contact forces resist, with any torque",
     "0 to sqrt(1 + mu^2)", "1", true, "Mirtich and Canny (1994)",
     [](MeasuredGrasp& g) {
       return g.space({.space = {.coordinates = {0, 1, 2}}}).epsilon(g.progress());
     }},
    {"epsilon_torque",
     "radius of the largest ball of torques, over rho, that such contact forces resist, with any "
     "force",
     ">= 0", "1", true, "Mirtich and Canny (1994)",
     [](MeasuredGrasp& g) {
       return g.space({.space = {.coordinates = {3, 4, 5}}}).epsilon(g.progress());
     }},
    {"volume", "of the hull of all unit wrenches in its six dimensions; 0 if it is flat", ">= 0",
     "1", true, "Miller and Allen (1999)", volume},
    {"min_singular_value",
     "of the grasp map, torques over rho: distance from the loss of a direction of wrenches",
     ">= 0", "1", true, "Li and Sastry (1988)",
     [](MeasuredGrasp& g) { return g.singular_values()[5]; }},
    {"ellipsoid_volume",
     "product of the singular values of the grasp map, torques over rho: volume of the wrenches of "
     "all contact forces of length one, over that of the unit ball",
     ">= 0", "1", true, "Li and Sastry (1988)",
     [](MeasuredGrasp& g) { return g.singular_values().prod(); }},
    {"isotropy", "smallest over largest singular value of the grasp map, torques over rho",
     "0 to 1", "1", true, "Kim, Oh, Yi and Suh (2001)",
     [](MeasuredGrasp& g) { return ratio(g.singular_values()[5], g.singular_values()[0]); }},
    {"polygon_area",
     "of the convex polygon of the contact points, in the plane that fits them best", ">= 0", "m^2",
     true, "Mirtich and Canny (1994)", polygon_area},
    {"polygon_irregularity",
     "deviation of the angles of that polygon from those of a regular one; 1 with fewer than three "
     "corners",
     "0 to 1", "1", false, "Park and Starr (1992)", polygon_irregularity},
    {"centroid_distance", "of the mean of the contact points from the object's center of mass",
     ">= 0", "m", false, "Ponce, Sullivan, Sudsang, Boissonnat and Merlet (1997)",
     centroid_distance},
    {"orthogonality",
     "angle of the hand's approach to the object's principal axis or to the plane across it, "
     "whichever is smaller: people grasp along or across; infinite for an object without such an "
     "axis",
     "0 to pi/4", "rad", false, "Balasubramanian, Xu, Brook, Smith and Matsuoka (2012)",
     orthogonality},
    {"coplanarity",
     "of the contact normals: root mean square of the sines of their angles to the plane that fits "
     "them best; 0 in one plane",
     "0 to sqrt(1/3)", "1", false, "smallest singular value of the normals", coplanarity},
    {"contact_position_tolerance",
     "displacement of all contact points at once, with unchanged normals, up to which force "
     "closure is certain: epsilon rho / sqrt(1 + mu^2), with the largest mu",
     ">= 0", "m", true, "after Roa and Suarez (2009), independent contact regions",
     contact_position_tolerance},
    {"gravity_effort",
     "smallest sum of normal forces that holds the object's weight, in round cones; infinite if "
     "none do",
     "> 0", "N", false, "Han, Trinkle and Li (2000)", gravity_effort},
    {"hand_min_singular_value",
     "of the map from DOF velocities to the object's twist (v, rho omega): distance from the loss "
     "of a direction of motion; 0 with fewer than six DOFs",
     ">= 0", "m", true, "Shimoga (1996)",
     [](MeasuredGrasp& g) { return g.hand_singular_values()[5]; }},
    {"manipulability", "product of the singular values of that map", ">= 0", "m^6", true,
     "Yoshikawa (1985)", [](MeasuredGrasp& g) { return g.hand_singular_values().prod(); }},
    {"hand_isotropy", "smallest over largest singular value of that map", "0 to 1", "1", true,
     "Salisbury and Craig (1982)",
     [](MeasuredGrasp& g) {
       return ratio(g.hand_singular_values()[5], g.hand_singular_values()[0]);
     }},
    {"joint_margin", "of the DOF nearest to a limit: its distance, over its range", "0 to 0.5", "1",
     true, "Liegeois (1977)", joint_margin},
    {"joint_deviation",
     "mean over the DOFs of the squared distance from the middle of the range, over half the range",
     "0 to 1", "1", false, "Liegeois (1977)", joint_deviation},
    {"clearance", "of the hand from obstacles and other objects; infinite if there are none",
     ">= 0", "m", true, "distance of meshes",
     [](MeasuredGrasp& g) { return clearance(g.world(), g.grasp().hand, g.grasp().object); }},
    {"penetration",
     "largest distance from the object's surface of a point of the hand inside the object, up to 1 "
     "um + 0.1 %; infinite if two open meshes intersect",
     ">= 0", "m", false, "branch and bound over meshes",
     [](MeasuredGrasp& g) {
       return penetration(g.world(), g.grasp().hand, g.grasp().object, g.progress());
     }},
    {"contact_robustness",
     "radius of the ball of disturbing wrenches that leave every contact force in its cone and "
     "below 10 N, while they hold the weight; contacts yield 1 m/N, joints do not",
     ">= 0", "N", true, "Bicchi (1995); Pozzi, Malvezzi and Prattichizzo (2017)",
     [](MeasuredGrasp& g) { return g.robustness().radius; }},
    {"grasp_robustness",
     "the same, the largest over all choices of contacts that slip or separate; with many "
     "contacts, the largest that 400 steps of a search find",
     ">= 0", "N", true, "Pozzi, Malvezzi and Prattichizzo (2017)",
     [](MeasuredGrasp& g) {
       return grasp_robustness(g.robustness_problem(), 400, g.progress()).radius;
     }},
};

}  // namespace

std::span<const Measure> measures() { return all_measures; }

const Measure& find_measure(std::string_view name) {
  std::vector<std::string> names;
  for (const Measure& measure : all_measures) {
    if (measure.name == name) return measure;
    names.emplace_back(measure.name);
  }
  const std::string meant = did_you_mean(std::string(name), names);
  fail("unknown measure '{}'{}", name, meant.empty() ? "; clench.measures() lists them" : meant);
}

}  // namespace clench
