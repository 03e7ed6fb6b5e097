#include "clench/motion/virtual_contacts.h"

#include <algorithm>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/contact/cone.h"
#include "clench/contact/friction_edges.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// v(p) = linear + angular x p
struct Motion {
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();

  Vector3d at(const Vector3d& p) const { return linear + angular.cross(p); }
  bool none() const { return linear.isZero(0) && angular.isZero(0); }
};

/// A small piece of surface that moves forward.
struct Piece {
  Vector3d center, normal;  // center of the volume that it sweeps
  double swept;             // volume per unit of time
};

constexpr double fineness = 1.0 / 16;  // longest edge of a piece, as a fraction of the mesh's size
constexpr int deepest = 5;             // maximum depth; each step splits a triangle into four
// radius of averaging the normal, as a fraction of the swept area's size
constexpr double around = 0.25;

// frames of the hand with closing DOFs fully open and the others as near zero as possible; in the
// base frame
RobotFrames frames_opened(const Robot& robot) {
  std::vector<double> q;
  for (const Joint& joint : robot.joints) {
    const double v = robot.dofs[joint.dof].default_velocity;
    const auto [low, high] = robot.limits[joint.dof];
    q.push_back(joint.ratio * (v > 0 ? low : v < 0 ? high : std::clamp(0.0, low, high)));
  }
  RobotFrames out;
  find_frames(robot, {}, q, out);
  return out;
}

// velocity of a link while the hand closes, in its own frame
Motion closing_motion(const Robot& robot, const RobotFrames& frames, int link) {
  Motion motion;
  const Pose X_LB = frames.links[link].inverse();
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
    const Joint& joint = robot.joints[j];
    const double speed = joint.ratio * robot.dofs[joint.dof].default_velocity;
    if (speed == 0 || !joint_moves_link(robot, j, link)) continue;
    const Vector3d axis = X_LB.rotation * frames.axis(robot, j) * speed;
    if (joint.kind == JointKind::prismatic) {
      motion.linear += axis;
    } else {
      motion.angular += axis;
      motion.linear -= axis.cross(X_LB * frames.joints[j].position);
    }
  }
  return motion;
}

void cut(const std::array<Vector3d, 3>& corners, const Vector3d& normal, const Motion& motion,
         double longest, int depth, std::vector<Piece>& pieces) {
  const auto& [a, b, c] = corners;
  const double edge = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  if (edge > longest && depth < deepest) {
    const Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    for (const auto& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      cut(part, normal, motion, longest, depth + 1, pieces);
    return;
  }
  // the swept volume is linear over a triangle: its sum and its center are exact, unless part of
  // the triangle moves backward
  Vector3d speeds;
  for (int i = 0; i < 3; ++i) speeds[i] = std::max(0.0, normal.dot(motion.at(corners[i])));
  const double all = speeds.sum(), swept = 0.5 * (b - a).cross(c - a).norm() * all / 3;
  if (!(swept > 0)) return;
  const Vector3d center =
      0.25 * (a + b + c + (speeds[0] * a + speeds[1] * b + speeds[2] * c) / all);
  pieces.push_back({center, normal, swept});
}

std::vector<Piece> forward_pieces(const Shape& shape, const Motion& motion) {
  std::vector<Piece> pieces;
  const double longest = fineness * shape.bounds().size().norm();
  const int count = static_cast<int>(shape.mesh().triangles.size());
  for (int t = 0; t < count; ++t) {
    const auto corners = shape.mesh().corners(t);
    const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double size = across.norm();
    if (size > 0) cut(corners, across / size, motion, longest, 0, pieces);
  }
  return pieces;
}

// parts of equal swept volume, along the direction in which the pieces are spread most
std::vector<std::vector<Piece>> shares(std::vector<Piece> pieces, int count) {
  if (count == 1 || pieces.empty()) return {std::move(pieces)};
  Vector3d mean = Vector3d::Zero();
  double all = 0;
  for (const Piece& p : pieces) mean += p.swept * p.center, all += p.swept;
  mean /= all;
  Matrix3d spread = Matrix3d::Zero();
  for (const Piece& p : pieces)
    spread += p.swept / all * (p.center - mean) * (p.center - mean).transpose();
  const Vector3d along = eigensystem(spread).vectors.col(2);
  std::stable_sort(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
    return along.dot(a.center) < along.dot(b.center);
  });
  std::vector<std::vector<Piece>> out(count);
  double before = 0;
  for (const Piece& p : pieces) {
    const double middle = (before + 0.5 * p.swept) / all;
    out[floor_between(middle * count, 0, count - 1)].push_back(p);
    before += p.swept;
  }
  std::erase_if(out, [](const auto& share) { return share.empty(); });
  return out;
}

Vector3d mean_normal(const std::vector<Piece>& pieces) {
  Vector3d mean = Vector3d::Zero();
  for (const Piece& p : pieces) mean += p.swept * p.normal;
  return mean;
}

// frame at the first surface point hit by a ray against `direction` through p, or at the piece
// nearest to p
Pose site(const Shape& shape, const std::vector<Piece>& pieces, const Vector3d& p,
          const Vector3d& direction) {
  const double size = shape.bounds().size().norm();
  const Piece* nearest = &pieces.front();
  for (const Piece& piece : pieces)
    if ((piece.center - p).squaredNorm() < (nearest->center - p).squaredNorm()) nearest = &piece;
  Vector3d point = nearest->center, normal = nearest->normal;
  if (const auto hit = cast_ray(shape, p + 2 * size * direction, -direction, 4 * size)) {
    const auto corners = shape.mesh().corners(hit->triangle);
    const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (across.dot(direction) > 0) point = hit->point, normal = across.normalized();
  }

  // the normal is an average over the surrounding surface, not that of a single triangle
  Vector3d mean = Vector3d::Zero();
  Vector3d low = pieces.front().center, high = low;
  for (const Piece& piece : pieces)
    low = low.cwiseMin(piece.center), high = high.cwiseMax(piece.center);
  Vector3d sides = high - low;
  std::sort(sides.data(), sides.data() + 3);
  const double radius = std::max(around * sides[1], fineness * size);
  for (const Piece& piece : pieces)
    if ((piece.center - point).norm() < radius && piece.normal.dot(normal) > 0.5)
      mean += piece.swept * piece.normal;
  if (mean.norm() > 0) normal = mean.normalized();
  return {Eigen::Quaterniond(contact_frame(normal)).normalized(), point};
}

std::vector<Pose> link_sites(const Shape& shape, const Motion& motion, int count) {
  std::vector<Pose> out;
  for (const auto& share : shares(forward_pieces(shape, motion), count)) {
    const Vector3d direction = mean_normal(share);
    if (share.empty() || !(direction.norm() > 0)) continue;
    Vector3d center = Vector3d::Zero();
    double all = 0;
    for (const Piece& p : share) center += p.swept * p.center, all += p.swept;
    out.push_back(site(shape, share, center / all, direction.normalized()));
  }
  return out;
}

/// A body that does not move while the hand closes.
struct Still {
  int link;  // -1: the base
  const Body* body;
  Pose X_LA;  // approach frame relative to it
};

std::optional<Pose> palm_site(const Still& palm) {
  const Vector3d forward = palm.X_LA.rotation * Vector3d::UnitZ();
  const auto pieces =
      forward_pieces(*palm.body->shape, {.linear = forward, .angular = Vector3d::Zero()});
  if (pieces.empty()) return {};
  return site(*palm.body->shape, pieces, palm.X_LA.position, forward);
}

// the palm is the still body nearest to the approach point
const Still* palm_of(const std::vector<Still>& still) {
  const Still* palm = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Still& s : still) {
    const double distance = closest_point(*s.body->shape, s.X_LA.position).distance;
    if (distance < nearest) palm = &s, nearest = distance;
  }
  return palm;
}

}  // namespace

std::vector<VirtualContactSpec> find_virtual_contacts(const World& world, Id<Robot> id,
                                                      const FindSitesOptions& options) {
  if (options.count_per_link < 1 || options.count_per_link > 100)
    fail("virtual contacts: count_per_link: expected 1 to 100, got {}", options.count_per_link);
  const int against = world.materials().index(options.object_material);
  const Robot& robot = world.robot(id);
  const auto frames = frames_opened(robot);
  const bool closes = std::any_of(robot.dofs.begin(), robot.dofs.end(),
                                  [](const DofSpec& dof) { return dof.default_velocity != 0; });
  std::vector<VirtualContactSpec> out;
  const auto add = [&](int link, const Body& body, const Pose& X_LC) {
    const double mu = world.materials().friction(body.material, against).statics;
    out.push_back({link, X_LC, mu, friction_edges()});
  };
  std::vector<Still> still;
  if (const Body& base = world.body(robot.base); base.shape)
    still.push_back({-1, &base, robot.X_BA});
  for (int l = 0; closes && l < static_cast<int>(robot.links.size()); ++l) {
    const Body& body = world.body(robot.links[l].body);
    if (!body.shape) continue;
    const Motion motion = closing_motion(robot, frames, l);
    if (motion.none()) {
      still.push_back({l, &body, frames.links[l].inverse() * robot.X_BA});
      continue;
    }
    for (const Pose& X_LC : link_sites(*body.shape, motion, options.count_per_link))
      add(l, body, X_LC);
  }
  if (const Still* palm = closes && options.palm ? palm_of(still) : nullptr)
    if (const auto X_LC = palm_site(*palm)) add(palm->link, *palm->body, *X_LC);
  return out;
}

std::vector<VirtualContactSpec> virtual_contacts(const World& world, Id<Robot> id) {
  const Robot& robot = world.robot(id);
  return robot.virtual_contacts ? *robot.virtual_contacts : find_virtual_contacts(world, id);
}

VirtualContactSpec marked(const World& world, Id<Robot> id, const Contact& contact) {
  for (const bool touched : {false, true}) {
    const auto part = touched ? contact.body : contact.other;
    const Body& body = world.body(part);
    if (body.robot != id || (body.kind != BodyKind::link && body.kind != BodyKind::base)) continue;
    // out of the link: along the normal, which points into the touched body
    const Vector3d n_W = touched ? Vector3d(-contact.n_W) : contact.n_W;
    const Vector3d p_W = touched ? contact.p_W : Vector3d(contact.p_W - contact.gap * contact.n_W);
    const Pose X_WC{Eigen::Quaterniond(contact_frame(n_W)).normalized(), p_W};
    return {body.link, world.pose(part).inverse() * X_WC, contact.friction.statics,
            friction_edges()};
  }
  fail("virtual contacts: the contact of '{}' and '{}' is on no link of '{}'",
       excerpt(world.body(contact.other).name), excerpt(world.body(contact.body).name),
       excerpt(world.robot(id).name));
}

}  // namespace clench
