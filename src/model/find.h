// Queries over a world: collisions, distances, contacts. They may be called from many threads, each
// with its own context. Without a context nothing is cached; the answers are the same.
#pragma once
#include <span>
#include <vector>

#include "clench/contact/soft_patch.h"
#include "clench/model/near_bodies.h"

namespace clench {

/// Pairs that may collide and do, in creation order.
std::vector<BodyPair> colliding_pairs(const World& world, QueryContext* context = nullptr);
/// The first `max` of these pairs; uses memory for no more.
std::vector<BodyPair> first_colliding_pairs(const World& world, size_t max,
                                            QueryContext* context = nullptr);
/// Only pairs with one body from each group.
std::vector<BodyPair> colliding_pairs(const World& world, std::span<const Id<Body>> a,
                                      std::span<const Id<Body>> b, QueryContext* context = nullptr);
/// Does any pair collide? Ends at the first that is found.
bool collides(const World& world, QueryContext* context = nullptr);
/// Does one of these bodies collide with anything?
bool collides(const World& world, std::span<const Id<Body>> bodies,
              QueryContext* context = nullptr);

struct BodyDistance {
  double distance = 0;       ///< [m]; 0 if colliding; infinite if a body has no geometry
  Eigen::Vector3d p_a, p_b;  ///< witness points in the world frame
  Id<Body> a, b;
};

/// Smallest distance between the bodies of two groups, if it is below `limit` [m]; otherwise
/// infinite. Switched-off pairs are measured, too.
BodyDistance distance(const World& world, std::span<const Id<Body>> a, std::span<const Id<Body>> b,
                      double limit = std::numeric_limits<double>::infinity(),
                      QueryContext* context = nullptr);

/// soft: there is friction, and at least one of the bodies is elastic
enum class ContactKind { point, frictionless, soft };

/// A contact point of `other` on `body`.
struct Contact {
  Id<Body> body, other;
  Eigen::Vector3d p_W;  ///< on the surface of body [m]
  Eigen::Vector3d n_W;  ///< unit, into body
  double gap = 0;       ///< [m], in (0, threshold]
  /// features of the meshes of both on which the nearest points lie
  Feature feature, other_feature;
  Friction friction;
  ContactKind kind = ContactKind::point;
  /// data from which the patch of a soft contact is computed; null for others. Its a is the body
  /// that was created first; the pose of a was X_WA
  SoftSitePtr site = nullptr;
  Pose X_WA = {};
  bool body_is_b = false;
  /// on body, in the last step of dynamics [N], and torque about the normal [N m]; 0 without one
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();
  double torsion = 0;
};

/// Contacts of all pairs that may collide; `body` is the later group's. Until a pair is placed from
/// outside, all points that pressed in the last step are among them, and those of balls are the
/// step's, whose surface lies outside their facets.
std::vector<Contact> contacts(const World& world, QueryContext* context = nullptr);
std::vector<Contact> contacts(const World& world, std::span<const Id<Body>> others,
                              std::span<const Id<Body>> bodies, QueryContext* context = nullptr);

/// "DLR_chain0_link1 and flask, palm and flask"
std::string describe(const World& world, std::span<const BodyPair> pairs);

}  // namespace clench
