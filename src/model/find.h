// Who collides, how far apart, where they touch: queries over a world, which may be asked from many
// threads, each with a context of its own. Without one nothing is remembered; the answers are the
// same.
#pragma once
#include <span>
#include <vector>

#include "clench/contact/soft_patch.h"
#include "clench/model/near_bodies.h"

namespace clench {

/// Pairs that may collide and do, in creation order.
std::vector<BodyPair> colliding_pairs(const World& world, QueryContext* context = nullptr);
/// The first `max` of these pairs; uses memory for no more than that.
std::vector<BodyPair> first_colliding_pairs(const World& world, size_t max,
                                            QueryContext* context = nullptr);
/// Only pairs with one body from each group.
std::vector<BodyPair> colliding_pairs(const World& world, std::span<const Id<Body>> a,
                                      std::span<const Id<Body>> b, QueryContext* context = nullptr);
/// Does any? It ends at the first that is found.
bool collides(const World& world, QueryContext* context = nullptr);
/// Does one of these with anything?
bool collides(const World& world, std::span<const Id<Body>> bodies,
              QueryContext* context = nullptr);

struct BodyDistance {
  double distance = 0;       ///< [m]; 0 when colliding; infinite when a body has no geometry
  Eigen::Vector3d p_a, p_b;  ///< witness points in the world frame
  Id<Body> a, b;
};

/// Least distance between the bodies of two groups, if it is below `limit` [m]; infinite otherwise.
/// Switched-off pairs are measured too.
BodyDistance distance(const World& world, std::span<const Id<Body>> a, std::span<const Id<Body>> b,
                      double limit = std::numeric_limits<double>::infinity(),
                      QueryContext* context = nullptr);

/// soft: there is friction, and at least one of the bodies is elastic
enum class ContactKind { point, frictionless, soft };

/// A point where `other` touches `body`.
struct Contact {
  Id<Body> body, other;
  Eigen::Vector3d p_W;  ///< on the surface of body [m]
  Eigen::Vector3d n_W;  ///< unit, into body
  double gap = 0;       ///< [m], in (0, threshold]
  /// of the meshes of both, that the points nearest to each other lie on
  Feature feature, other_feature;
  Friction friction;
  ContactKind kind = ContactKind::point;
  /// what the patch of a soft contact follows from; null of others. Its a is the body of the two
  /// that was made first, which stood at X_WA
  SoftSitePtr site = nullptr;
  Pose X_WA = {};
  bool body_is_b = false;
  /// on body, of the last step of dynamics [N], and torque about the normal [N m]; 0 without one
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();
  double torsion = 0;
};

/// Contacts of all pairs that may collide; `body` is the later group's. As long as nobody places a
/// pair elsewhere, all that pressed in the last step are among them, and those of balls are the
/// step's, whose surface lies outside their facets.
std::vector<Contact> contacts(const World& world, QueryContext* context = nullptr);
std::vector<Contact> contacts(const World& world, std::span<const Id<Body>> others,
                              std::span<const Id<Body>> bodies, QueryContext* context = nullptr);

/// "DLR_chain0_link1 and flask, palm and flask"
std::string describe(const World& world, std::span<const BodyPair> pairs);

}  // namespace clench
