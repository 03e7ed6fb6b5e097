#include "clench/io/tree/tree_links.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/spec/plausibility.h"

namespace clench {

static constexpr double water = 1000;       // [kg/m^3]
static constexpr double frame_mass = 1e-3;  // [kg]

Inertial set_inertial(BodySpec& body, double mass, const Pose& X_LC,
                      const Eigen::Matrix3d& inertia_C) {
  body.mass = mass;
  body.com = X_LC.position;
  const Eigen::Matrix3d R = X_LC.matrix();
  Eigen::Matrix3d inertia = R * inertia_C * R.transpose() / mass;
  const Inertial fault = repair_inertia(inertia);
  if (fault != Inertial::not_definite) body.inertia_per_mass = inertia;
  return fault;
}

void InertialFaults::add(Inertial fault, const Place& place, const std::string& link) {
  if (fault == Inertial::sound) return;
  const int kind = static_cast<int>(fault) - static_cast<int>(Inertial::no_body);
  if (links_[kind].empty()) places_[kind] = place;
  links_[kind].push_back(link);
}

void InertialFaults::tell(const FileCache& cache) const {
  if (!links_[0].empty())
    cache.diagnostics().repaired(places_[0], "{}: {}", raised_moments, some_names(links_[0]));
  if (!links_[1].empty())
    cache.diagnostics().warn(
        places_[1], "inertia that is not positive definite; it is computed from the geometry: {}",
        some_names(links_[1]));
  if (!links_[2].empty())
    cache.diagnostics().note(places_[2],
                             "a mass without an inertia, which is computed from the geometry: {}",
                             some_names(links_[2]));
}

/// False for an open surface, which has no volume.   `pieces`  of the shape
static bool guess_mass(BodySpec& body, const ShapePtr& shape,
                       const std::vector<GeometryPiece>& pieces) {
  body.mass = frame_mass;
  if (!shape || !shape->closed()) return !shape;
  double volume = std::abs(shape->solid().volume);
  // round shapes have larger volumes than their meshes
  for (const GeometryPiece& piece : pieces)
    if (piece.solid) volume += piece.solid->volume - solid_mass(piece.geometry->mesh).volume;
  if (!(volume > 0 && std::isfinite(water * volume))) return false;
  body.mass = std::clamp(water * volume, frame_mass, mass_rule.max);
  return true;
}

/// A file may use one surface for both purposes, with colors in one of them.
static bool same_surface(const ShapePtr& a, const ShapePtr& b) {
  return a == b || (a && b && a->hash() == b->hash());
}

void dress_links(TreeModel& tree, const std::vector<LinkPieces>& pieces, TreeGeometry& geometry,
                 const std::string& file, const FileCache& cache, bool contacts_known) {
  const bool any_collision = std::any_of(pieces.begin(), pieces.end(),
                                         [](const LinkPieces& p) { return !p.collision.empty(); });
  const bool any = any_collision || contacts_known;
  const bool any_visual = std::any_of(pieces.begin(), pieces.end(),
                                      [](const LinkPieces& p) { return !p.visual.empty(); });
  std::vector<std::string> ghosts, weightless, open;
  Place first_open;
  for (size_t i = 0; i < tree.links.size(); ++i) {
    BodySpec& body = tree.links[i].body;
    const Place subject = Place(file).of("link '{}'", excerpt(body.name));
    const auto visual = geometry.merge(pieces[i].visual, subject);
    const auto collision = any ? geometry.merge(pieces[i].collision, subject) : visual;
    body.shape = collision.shape;
    body.mesh_report = collision.report;
    body.appearance = visual.shape ? visual.appearance : collision.appearance;
    if (!same_surface(visual.shape, collision.shape)) body.appearance.visual = visual.shape;
    body.material = "plastic";
    body.assumptions_told = body.inertia_told = true;  // reported below
    if (visual.shape && !collision.shape) ghosts.push_back(body.name);
    if (pieces[i].has_inertial) {
      body.mass_from = Origin::file;
      continue;
    }
    const bool seen = !body.shape;  // it has only visual pieces
    const ShapePtr& shape = seen ? visual.shape : body.shape;
    const bool has_volume =
        guess_mass(body, shape, seen || !any ? pieces[i].visual : pieces[i].collision);
    if (shape && !has_volume && open.empty()) first_open = pieces[i].place;
    if (shape) (has_volume ? weightless : open).push_back(body.name);
  }
  if (contacts_known && !any_collision && any_visual)
    cache.diagnostics().note(Place(file), "nothing collides because of contype and conaffinity");
  else if (!any && any_visual)
    cache.diagnostics().note(
        Place(file), "no link has collision geometry; the visual geometry is used for both");
  if (!ghosts.empty() && any_collision)
    cache.diagnostics().note(Place(file),
                             "links that have geometry for pictures only collide with nothing: {}",
                             some_names(ghosts));
  if (!weightless.empty())
    cache.diagnostics().note(Place(file),
                             "links without a mass get the mass of their volume of water: {}",
                             some_names(weightless));
  if (!open.empty())
    cache.diagnostics().note(
        first_open,
        "links without a mass whose surface is open, and so bounds no volume, weigh {} kg: {}",
        frame_mass, some_names(open));
  if (!contacts_known)
    cache.diagnostics().note(Place(file), "it gives no friction; all links count as plastic");
}

}  // namespace clench
