#include "io/tree_links.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "math/decompositions.h"

namespace clench {

static constexpr double water = 1000;       // [kg/m^3]
static constexpr double frame_mass = 1e-3;  // [kg]

Inertial set_inertial(BodySpec& body, double mass, const Pose& X_LC,
                      const Eigen::Matrix3d& inertia_C) {
  body.mass = mass;
  body.com = X_LC.position;
  const Eigen::Matrix3d R = X_LC.matrix(), inertia = R * inertia_C * R.transpose() / mass;
  const Eigen::Vector3d moments = eigenvalues(inertia);
  if (!inertia.allFinite() || !(moments[0] > 0)) return Inertial::not_definite;
  body.inertia_per_mass = inertia;
  // no body has a moment above the sum of the others; files round
  return moments[2] > 1.01 * (moments[0] + moments[1]) ? Inertial::no_body : Inertial::sound;
}

/// "'a', 'b' and 7 more"
static std::string some_names(const std::vector<std::string>& names) {
  constexpr size_t most = 6;
  std::string out;
  for (size_t i = 0; i < names.size() && i < most; ++i)
    out += fmt::format("{}'{}'", i ? ", " : "", names[i].substr(0, 60));
  if (names.size() > most) out += fmt::format(" and {} more", names.size() - most);
  return out;
}

void InertialFaults::add(Inertial fault, const std::string& place, const std::string& link) {
  if (fault == Inertial::sound) return;
  const int kind = fault == Inertial::no_body ? 0 : 1;
  if (links_[kind].empty()) places_[kind] = place;
  links_[kind].push_back(link);
}

void InertialFaults::tell(const Library& library) const {
  if (!links_[0].empty())
    library.warn(
        fmt::format("{}: inertia that no body has, as one moment exceeds the sum of the "
                    "others; it is used as it stands: {}",
                    places_[0], some_names(links_[0])));
  if (!links_[1].empty())
    library.warn(
        fmt::format("{}: inertia that is not positive definite; it is computed from the "
                    "geometry: {}",
                    places_[1], some_names(links_[1])));
}

static void guess_mass(BodySpec& body, bool& guessed, bool& frame) {
  const ShapePtr& shape = body.shape ? body.shape : body.appearance.visual;
  frame = !shape;
  guessed = true;
  const double volume = shape && shape->closed() ? std::abs(shape->solid().volume) : 0;
  body.mass = volume > 0 && std::isfinite(water * volume) ? std::max(water * volume, frame_mass)
                                                          : frame_mass;
}

/// A file may name one surface for both, coloured once.
static bool same_surface(const ShapePtr& a, const ShapePtr& b) {
  return a == b || (a && b && a->hash() == b->hash());
}

void dress_links(TreeModel& tree, const std::vector<LinkPieces>& pieces, TreeGeometry& geometry,
                 const std::string& file, const Library& library) {
  const bool any = std::any_of(pieces.begin(), pieces.end(),
                               [](const LinkPieces& p) { return !p.collision.empty(); });
  const bool any_visual = std::any_of(pieces.begin(), pieces.end(),
                                      [](const LinkPieces& p) { return !p.visual.empty(); });
  std::vector<std::string> ghosts, weightless;
  for (size_t i = 0; i < tree.links.size(); ++i) {
    BodySpec& body = tree.links[i].body;
    const std::string subject = fmt::format("{}: link '{}'", file, body.name);
    const auto visual = geometry.merge(pieces[i].visual, subject);
    const auto collision = any ? geometry.merge(pieces[i].collision, subject) : visual;
    body.shape = collision.shape;
    body.mesh_report = collision.report;
    body.appearance = visual.shape ? visual.appearance : collision.appearance;
    if (!same_surface(visual.shape, collision.shape)) body.appearance.visual = visual.shape;
    body.material = "plastic";
    if (visual.shape && !collision.shape) ghosts.push_back(body.name);
    if (pieces[i].has_inertial) continue;
    bool guessed = false, frame = false;
    guess_mass(body, guessed, frame);
    if (guessed && !frame) weightless.push_back(body.name);
  }
  if (!any && any_visual)
    library.note(fmt::format(
        "{}: no link has geometry to collide with; that for pictures is used for both", file));
  if (!ghosts.empty())
    library.note(
        fmt::format("{}: links that have geometry for pictures only collide with nothing: {}", file,
                    some_names(ghosts)));
  if (!weightless.empty())
    library.note(fmt::format("{}: links without a mass weigh what their volume of water does: {}",
                             file, some_names(weightless)));
  library.note(fmt::format("{}: says nothing of friction; all links count as plastic", file));
}

}  // namespace clench
