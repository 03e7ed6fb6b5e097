#include "clench/scene/force_arrows.h"

#include <fmt/format.h>

#include <algorithm>

#include "clench/scene/cones.h"
#include "clench/scene/palette.h"

namespace clench {

// fraction of the largest force below which forces are left out
static constexpr double invisible = 1e-3;
// position of the label with the force in newtons, in lengths of the arrow
static constexpr double beyond = 1.15;
static constexpr size_t max_labels = 8;  // more labels would hide the arrows
// radius of the longest arrow, as a fraction of its length
static constexpr double slender = 0.035;

static double largest_force(std::span<const PlacedForce> forces) {
  double largest = 0;
  for (const PlacedForce& force : forces) largest = std::max(largest, force.f_W.norm());
  return largest;
}

static std::vector<PlacedForce> visible_forces(std::span<const PlacedForce> forces) {
  const double largest = largest_force(forces);
  std::vector<PlacedForce> visible;
  for (const PlacedForce& force : forces)
    if (force.f_W.norm() > invisible * largest) visible.push_back(force);
  return visible;
}

static bool is_of(const TouchPatch& patch, const Contact& contact) {
  return std::ranges::any_of(patch.contacts, [&](const Contact& c) {
    return c.body == contact.body && c.other == contact.other && c.p_W == contact.p_W &&
           c.n_W == contact.n_W;
  });
}

std::vector<PlacedForce> patch_forces(std::span<const Contact> contacts,
                                      std::span<const PlacedForce> forces) {
  std::vector<PlacedForce> out;
  for (const TouchPatch& patch : touch_patches(contacts)) {
    PlacedForce sum;
    Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
    double weight = 0;
    for (size_t i = 0; i < contacts.size(); ++i) {
      if (!is_of(patch, contacts[i])) continue;
      const double pressed = std::max(0.0, forces[i].f_W.dot(contacts[i].n_W));
      sum.f_W += forces[i].f_W;
      weighted += pressed * contacts[i].p_W;
      weight += pressed;
    }
    sum.p_W = weight > 0 ? Eigen::Vector3d(weighted / weight) : patch.p_W;
    out.push_back(sum);
  }
  return out;
}

std::vector<DrawArrow> force_arrows(std::span<const PlacedForce> forces, double meters_per_newton) {
  const double largest = largest_force(forces);
  std::vector<DrawArrow> arrows;
  for (const PlacedForce& force : visible_forces(forces))
    arrows.push_back({.tail = force.p_W - meters_per_newton * force.f_W,
                      .tip = force.p_W,
                      .radius = slender * meters_per_newton * largest,
                      .color = palette::force});
  return arrows;
}

std::vector<DrawLabel> force_labels(std::span<const PlacedForce> forces, double meters_per_newton) {
  std::vector<PlacedForce> visible = visible_forces(forces);
  std::ranges::stable_sort(visible, std::greater(), [](const auto& f) { return f.f_W.norm(); });
  visible.resize(std::min(visible.size(), max_labels));
  std::vector<DrawLabel> labels;
  for (const PlacedForce& force : visible)
    labels.push_back({.p_W = force.p_W - beyond * meters_per_newton * force.f_W,
                      .text = fmt::format("{:.3g} N", force.f_W.norm()),
                      .color = palette::force});
  return labels;
}

double force_scale(std::span<const PlacedForce> forces, double longest) {
  const double largest = largest_force(forces);
  return largest > 0 ? longest / largest : 1;
}

}  // namespace clench
