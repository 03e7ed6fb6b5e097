#include "clench/scene/cones.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/scene/palette.h"

namespace clench {
namespace {

// height of a cone, as a fraction of the object's largest radius
constexpr double cone_size = 0.15;

// cosine of the largest angle between normals of a patch (20 degrees), and its maximum height as a
// fraction of its width
constexpr double same_patch_normal = 0.94, flatness = 0.35;

bool same_patch(const Contact& a, const Contact& b) {
  if (a.body != b.body || a.other != b.other || a.n_W.dot(b.n_W) < same_patch_normal) return false;
  const Eigen::Vector3d apart = b.p_W - a.p_W;
  return std::abs(apart.dot(a.n_W)) <= flatness * apart.norm();
}

void find_middle(TouchPatch& patch) {
  patch.p_W.setZero(), patch.n_W.setZero();
  for (const Contact& contact : patch.contacts) patch.p_W += contact.p_W, patch.n_W += contact.n_W;
  patch.p_W /= static_cast<double>(patch.contacts.size());
  patch.n_W.normalize();
}

// cones of neighboring patches are lowered until each stays on its own side of the midpoint, so
// that they can be counted; below a fifth of their height they would be invisible
void lower_crowded(std::vector<DrawCone>& cones) {
  constexpr double share = 0.45, lowest = 0.2;
  for (DrawCone& cone : cones) {
    if (cone.height <= 0) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const DrawCone& other : cones)
      if (&other != &cone) nearest = std::min(nearest, (other.apex - cone.apex).norm());
    const double reach = std::max(1.0, std::tan(cone.half_angle));  // radius of a cone 1 m high
    cone.height *= std::clamp(share * nearest / (reach * cone.height), lowest, 1.0);
  }
}

// the friction coefficient or force to which the height of a cone is proportional
double cone_measure(const TouchPatch& patch, const SceneOptions& options) {
  if (options.cone_sizes == ConeSizes::friction) return patch.contacts[0].friction.statics;
  if (options.cone_sizes != ConeSizes::force) return 1;
  double sum = 0;
  for (const Contact& contact : patch.contacts) {
    double most = 0;
    for (const ContactLoad& load : options.loads)
      if (load.p_W == contact.p_W) most = std::max(most, load.force);
    sum += most;
  }
  return sum;
}

// heights in proportion to the measure, the largest of the requested size
void scale_cones(std::span<const TouchPatch> patches, const SceneOptions& options,
                 std::vector<DrawCone>& cones) {
  double most = 0, height = options.cone_height;
  for (size_t i = 0; i < cones.size(); ++i) {
    most = std::max(most, cone_measure(patches[i], options));
    if (options.cone_height == 0) height = std::max(height, cones[i].height);
  }
  for (size_t i = 0; i < cones.size(); ++i)
    cones[i].height = most > 0 ? height * cone_measure(patches[i], options) / most : 0;
  std::erase_if(cones, [](const DrawCone& cone) { return !(cone.height > 0); });
}

double usual_height(const World& world, const TouchPatch& patch) {
  return cone_size * world.body(patch.contacts[0].body).max_radius();
}

}  // namespace

std::vector<TouchPatch> touch_patches(std::span<const Contact> contacts) {
  std::vector<TouchPatch> patches;
  for (const Contact& contact : contacts) {
    const auto holds = [&](const TouchPatch& patch) {
      return std::ranges::all_of(patch.contacts,
                                 [&](const Contact& c) { return same_patch(c, contact); });
    };
    auto patch = std::ranges::find_if(patches, holds);
    if (patch == patches.end()) patch = patches.insert(patches.end(), TouchPatch{});
    patch->contacts.push_back(contact);
  }
  for (TouchPatch& patch : patches) find_middle(patch);
  return patches;
}

std::vector<DrawCone> contact_cones(const World& world, std::span<const TouchPatch> patches,
                                    const SceneOptions& options) {
  if (!(options.cone_height >= 0 && std::isfinite(options.cone_height)))
    fail("picture: the height of cones must be >= 0 [m], got {}", options.cone_height);
  for (const ContactLoad& load : options.loads)
    if (!std::isfinite(load.force)) fail("picture: forces must be finite numbers");
  std::vector<DrawCone> cones;
  for (size_t i = 0; i < patches.size(); ++i) {
    const TouchPatch& patch = patches[i];
    const Contact& first = patch.contacts[0];
    const bool rubs = first.kind != ContactKind::frictionless && first.friction.statics > 0;
    cones.push_back({.apex = patch.p_W,
                     .axis = patch.n_W,
                     .half_angle = rubs ? std::atan(first.friction.statics) : 0,
                     .height = usual_height(world, patch),
                     .color = rubs ? palette::cone : palette::needle,
                     .shown = {.kind = Shown::Kind::contact,
                               .body = first.body,
                               .other = first.other,
                               .index = static_cast<int>(i)}});
  }
  if (options.cone_sizes != ConeSizes::apart) {
    scale_cones(patches, options, cones);
    return cones;
  }
  if (options.cone_height > 0)
    for (DrawCone& cone : cones) cone.height = options.cone_height;
  lower_crowded(cones);
  return cones;
}

std::vector<Eigen::Vector3d> patch_spots(const World& world, std::span<const TouchPatch> patches) {
  std::vector<Eigen::Vector3d> spots;
  for (const TouchPatch& patch : patches)
    for (const double part : {0.1, 0.4, 0.7, 1.0})
      spots.push_back(patch.p_W + part * usual_height(world, patch) * patch.n_W);
  return spots;
}

}  // namespace clench
