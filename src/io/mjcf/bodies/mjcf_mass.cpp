// Computes masses of the bodies of an MJCF tree.
#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/io/mjcf/bodies/mjcf_tree.h"
#include "clench/spec/plausibility.h"

namespace clench {

void MjcfTreeReader::read_inertial(const XmlElement& element, int link, const Pose& X_frame) {
  document_.unused().attributes(element, {"pos", "quat", "axisangle", "euler", "xyaxes", "zaxis",
                                          "mass", "diaginertia", "fullinertia"});
  BodySpec& body = tree_.model.links[link].body;
  const XmlValues values(element);
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  if (values.has("fullinertia")) {
    const auto v = values.numbers("fullinertia", 6, 6);
    inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  } else if (values.has("diaginertia")) {
    inertia.diagonal() = values.vec3("diaginertia", {0, 0, 0});
  }
  const Pose X = X_frame * document_.pose(values);
  const double mass = values.number("mass");
  if (mass == 0) {
    set_massless(link);
    return;
  }
  if (const auto wrong = fault(mass_rule, mass); !wrong.empty()) {
    cache_.diagnostics().warn(element.place().of("body '{}'", excerpt(body.name)),
                              "mass: {}; it is computed from the geometry", wrong);
    return;
  }
  const MjcfSettings& settings = document_.settings(element);
  const Eigen::Vector3d d = inertia.diagonal();
  const bool impossible = 2 * d.maxCoeff() > d.sum() && !values.has("fullinertia");
  if (settings.balance_inertia && impossible) inertia = d.mean() * Eigen::Matrix3d::Identity();
  const Inertial inertial = set_inertial(body, mass, X, inertia);
  const bool given = values.has("fullinertia") || values.has("diaginertia");
  tree_.faults.add(given ? inertial : Inertial::not_given, element.place(), body.name);
  tree_.pieces[link].has_inertial = true;
}

/// Sets mass, center of mass and inertia of a body from its <inertial>, otherwise from its geoms,
/// within the compiler's bounds.
void MjcfTreeReader::weigh(const XmlElement& element, int link) {
  using FromGeoms = MjcfSettings::FromGeoms;
  const FromGeoms rule = document_.settings(element).inertia_from_geoms;
  const bool given = tree_.pieces[link].has_inertial;
  const auto& geoms = tree_.geoms[link];
  const bool any = std::ranges::any_of(geoms, &MjcfGeom::weighed);
  if ((rule == FromGeoms::always && (any || !given)) || (!given && rule == FromGeoms::missing)) {
    if (!weigh_geoms(link) && !given) return;  // its mass is computed from its shape later
  } else if (!given) {
    set_massless(link);
  }
  bound_inertia(element, link);
}

/// A mass of 0 is replaced by the smallest valid mass of a body.
void MjcfTreeReader::set_massless(int link) {
  constexpr double point = 1e-6;  // inertia per mass [m^2]
  const auto& geoms = tree_.geoms[link];
  BodySpec& body = tree_.model.links[link].body;
  body.mass = mass_rule.min;
  body.com = Eigen::Vector3d::Zero();
  if (!geoms.empty() && geoms.front().solid.centroid.allFinite())
    body.com = geoms.front().piece.X_LG * geoms.front().solid.centroid;
  body.inertia_per_mass = point * Eigen::Matrix3d::Identity();
  tree_.pieces[link].has_inertial = true;
  massless_[link] = true;
}

/// Sums mass, center of mass and inertia over the geoms of a body.
/// returns  false if the sum is not valid for a body
bool MjcfTreeReader::weigh_geoms(int link) {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  std::vector<const MjcfGeom*> parts;
  for (const MjcfGeom& geom : tree_.geoms[link]) {
    if (!(geom.mass > 0)) continue;
    parts.push_back(&geom);
    if (!geom.solid.centroid.allFinite()) return false;
    mass += geom.mass;
    moment += geom.mass * (geom.piece.X_LG * geom.solid.centroid);
  }
  if (parts.empty()) {
    set_massless(link);
    return true;
  }
  if (!mass_rule.allows(mass)) return false;
  const Eigen::Vector3d com = moment / mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const MjcfGeom* geom : parts) {
    const Eigen::Matrix3d R = geom->piece.X_LG.matrix();
    const Eigen::Vector3d off = geom->piece.X_LG * geom->solid.centroid - com;
    inertia +=
        geom->mass * (R * geom->solid.inertia * R.transpose() +
                      off.squaredNorm() * Eigen::Matrix3d::Identity() - off * off.transpose());
  }
  BodySpec with = tree_.model.links[link].body;
  if (set_inertial(with, mass, Pose::translation(com), inertia) == Inertial::not_definite)
    return false;
  tree_.model.links[link].body = std::move(with);
  tree_.pieces[link].has_inertial = true;
  massless_[link] = false;
  return true;
}

/// Raises the mass and the principal moments to the compiler's bounds.
void MjcfTreeReader::bound_inertia(const XmlElement& element, int link) {
  const MjcfSettings& settings = document_.settings(element);
  BodySpec& body = tree_.model.links[link].body;
  const bool bounded = settings.min_mass > 0 || settings.min_inertia > 0;
  if (!bounded || !tree_.pieces[link].has_inertial) return;
  const double before = massless_[link] ? 0 : body.mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  if (!massless_[link] && body.inertia_per_mass) inertia = before * *body.inertia_per_mass;
  const InertiaAxes axes = inertia_axes(inertia);
  const bool light = before < settings.min_mass;
  const bool small = axes.moments.minCoeff() < settings.min_inertia;
  if (!light && !small) return;
  const double mass = std::max(before, settings.min_mass);
  if (!mass_rule.allows(mass)) return;
  raised_.push_back(body.name);
  const Eigen::Vector3d moments =
      axes.moments.cwiseMax(Eigen::Vector3d::Constant(settings.min_inertia));
  if (!(moments.maxCoeff() > 0)) {
    body.mass = mass;
    massless_[link] = false;
    return;
  }
  set_inertial(body, mass, {axes.rotation, body.com.value_or(Eigen::Vector3d::Zero())},
               moments.asDiagonal());
  massless_[link] = false;
}

/// Checks that each moving body, or a body fixed to it, has mass.
void MjcfTreeReader::check_moving_masses() {
  constexpr double least = 1e-3;  // [kg]
  auto& links = tree_.model.links;
  const int count = static_cast<int>(links.size());
  const auto moves = [&](int l) { return !links[l].joints.empty() || free_.contains(l); };
  std::vector<int> carrier(count);  // per link: the moving link to which it is fixed
  std::vector<bool> heavy(count);
  for (int l = 0; l < count; ++l) {
    carrier[l] = moves(l) || links[l].parent < 0 ? l : carrier[links[l].parent];
    if (!massless_[l]) heavy[carrier[l]] = true;
  }
  for (int l = 0; l < count; ++l) {
    if (!moves(l) || heavy[l]) continue;
    links[l].body.mass = least;
    Diagnostic massless(tree_.pieces[l].place,
                        fmt::format("body '{}' moves and has no mass; {} kg is used",
                                    excerpt(links[l].body.name), least));
    if (tree_.geoms[l].empty())
      cache_.diagnostics().note(std::move(massless));  // a frame
    else
      document_.losses().add("massless", std::move(massless));
  }
}

MjcfTree MjcfTreeReader::take() {
  check_moving_masses();
  if (!raised_.empty())
    cache_.diagnostics().note(Place(document_.file()),
                              "boundmass and boundinertia raise the mass or inertia of: {}",
                              some_names(raised_));
  return std::move(tree_);
}

}  // namespace clench
