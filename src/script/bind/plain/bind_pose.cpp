#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "clench/math/axes.h"
#include "clench/math/rpy.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/spec/valid.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// --- from a table ---

static Quaterniond read_quat(Table& t) {
  const auto q = t.numbers("quat", 4);
  const Quaterniond quat(q[0], q[1], q[2], q[3]);
  const double length = quat.coeffs().stableNorm();
  // files hold about six digits; a vector that is unit up to rounding is not changed
  if (!(std::abs(length - 1) < 1e-3))
    fail("{}: quat: expected a unit quaternion {{w, x, y, z}}, got one of length {:.6g}",
         t.subject(), length);
  if (std::abs(length - 1) < 1e-15) return quat;
  return Quaterniond(quat.coeffs() / length);
}

// beyond these, degrees and millimeters are more likely
static constexpr double max_turn = 2 * std::numbers::pi, max_distance = 10;

static void suspect_degrees(lua_State* L, const Table& t, const char* key, double angle) {
  static const char told = 0;
  if (std::abs(angle) > max_turn)
    warn_once(L, &told,
              fmt::format("{}: {} is {:.6g}: radians? clench.rad({:.6g}) is {:.4g}", t.subject(),
                          key, angle, angle, angle * std::numbers::pi / 180));
}

void suspect_millimeters(lua_State* L, const std::string& subject, double distance) {
  static const char told = 0;
  const double far = std::abs(distance);
  if (far > max_distance)
    warn_once(L, &told,
              fmt::format("{}: it is {:.6g} m away: meters? clench.mm({:.6g}) is {:.4g}", subject,
                          far, far, far / 1000));
}

static Quaterniond read_rpy(lua_State* L, Table& t) {
  const Vector3d rpy = t.vec3("rpy");
  for (const double angle : rpy) suspect_degrees(L, t, "rpy", angle);
  using Turn = Eigen::AngleAxisd;
  return Turn(rpy.z(), Vector3d::UnitZ()) * Turn(rpy.y(), Vector3d::UnitY()) *
         Turn(rpy.x(), Vector3d::UnitX());
}

static Quaterniond axis_angle_of(lua_State* L, Table& t) {
  const Vector3d axis = t.vec3("axis");
  const double angle = t.number("angle"), length = axis.stableNorm();
  if (!(length > 1e-9)) fail("{}: axis: expected a direction, got zero", t.subject());
  suspect_degrees(L, t, "angle", angle);
  return Quaterniond(Eigen::AngleAxisd(angle, axis / length));
}

static constexpr const char* axis_names[] = {"x_axis", "y_axis", "z_axis"};

static int count_axes(Table& t) {
  int count = 0;
  for (const char* name : axis_names) count += t.has(name);
  return count;
}

// the smallest rotation that turns the single given axis to its direction
static Quaterniond axis_of(Table& t) {
  const int i = t.has("z_axis") ? 2 : t.has("y_axis") ? 1 : 0;
  const Vector3d direction = t.vec3(axis_names[i]);
  const double length = direction.stableNorm();
  if (!(length > 1e-9)) fail("{}: {}: expected a direction, got zero", t.subject(), axis_names[i]);
  const Vector3d unit = direction / length, axis = Vector3d::Unit(i);
  // half a turn about the next axis, although any axis at a right angle is possible
  if (unit.dot(axis) < -1 + 1e-14) {
    const Vector3d next = Vector3d::Unit((i + 1) % 3);
    return Quaterniond(0, next.x(), next.y(), next.z());
  }
  return Quaterniond::FromTwoVectors(axis, unit);
}

static Quaterniond axes_of(Table& t) {
  if (count_axes(t) == 3)
    fail("{}: expected one or two of x_axis, y_axis and z_axis, got all three", t.subject());
  if (count_axes(t) == 1) return axis_of(t);
  const int i = t.has("z_axis") ? 2 : 0, j = i == 2 && t.has("x_axis") ? 0 : 1;
  const Vector3d a = t.vec3(axis_names[i]), b = t.vec3(axis_names[j]);
  const auto rotation = rotation_from_axes(i, a, j, b);
  if (!rotation)
    fail("{}: expected two directions that are not parallel, got ({}, {}, {}) and ({}, {}, {})",
         t.subject(), a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
  return *rotation;
}

static Pose matrix_of(Table& t) {
  const auto rows = t.rows("matrix");
  const size_t columns = rows.empty() ? 0 : rows[0].size();
  bool even = rows.size() == 3 || (rows.size() == 4 && columns == 4);
  for (const auto& row : rows) even = even && row.size() == columns;
  if (!even || (columns != 3 && columns != 4))
    fail(
        "{}: matrix: expected 3 rows of 3 or 4 numbers, or 4 rows of 4, got {} rows, the first of "
        "{}",
        t.subject(), rows.size(), columns);
  if (rows.size() == 4 && rows[3] != std::vector<double>{0, 0, 0, 1})
    fail("{}: matrix: the last row must be 0 0 0 1", t.subject());
  Matrix3d R;
  Vector3d p = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const auto& row = rows[static_cast<size_t>(i)];
    for (int j = 0; j < 3; ++j) R(i, j) = row[static_cast<size_t>(j)];
    if (columns == 4) p[i] = row[3];
  }
  const double skew = (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(skew < 1e-3) || !(R.determinant() > 0))
    fail("{}: matrix: expected a rotation, got columns that are not orthonormal and right-handed",
         t.subject());
  if (columns == 4 && t.has("xyz"))
    fail("{}: expected the position once, got it from matrix and xyz", t.subject());
  return {Quaterniond(R).normalized(), p};
}

Pose pose_from_table(lua_State* L, int index, const std::string& subject) {
  if (lua_istable(L, index) && lua_rawlen(L, index) > 0)
    fail_expected({L, subject, ""}, "a pose {xyz = {x, y, z}, rpy = ..}", index);
  Table t(L, index, subject);
  const bool turned = t.has("axis") || t.has("angle"), aligned = count_axes(t) > 0;
  const int rotations = t.has("rpy") + t.has("quat") + t.has("matrix") + turned + aligned;
  if (rotations > 1)
    fail("{}: expected one of rpy, quat, matrix, axis with angle, and two axes, got {}", subject,
         rotations);
  Pose pose;
  if (t.has("matrix")) pose = matrix_of(t);
  if (t.has("quat")) pose.rotation = read_quat(t);
  if (t.has("rpy")) pose.rotation = read_rpy(L, t);
  if (turned) pose.rotation = axis_angle_of(L, t);
  if (aligned) pose.rotation = axes_of(t);
  pose.position = t.vec3("xyz", pose.position);
  t.done();
  check_place(pose, t.subject());
  suspect_millimeters(L, t.subject(), pose.position.cwiseAbs().maxCoeff());
  return pose;
}

// --- entries ---

static int make_pose(lua_State* L) {
  if (const Pose* pose = to<Pose>(L, 1)) return push(L, *pose);
  return push(L, pose_from_table(L, 1, subject(L)));
}

static int look_at(lua_State* L) {
  const Vector3d eye = check_vec3(L, 1, "eye"), target = check_vec3(L, 2, "target");
  const Vector3d up = given(L, 3) ? check_vec3(L, 3, "up") : Vector3d(0, 0, 1);
  return push(L, camera_pose(eye, target, up, subject(L)));
}

static std::array<double, 4> quat_of(const Pose& pose) {
  const Quaterniond& q = pose.rotation;
  return {q.w(), q.x(), q.y(), q.z()};
}

static Eigen::Matrix4d homogeneous(const Pose& pose) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = pose.matrix();
  M.topRightCorner<3, 1>() = pose.position;
  return M;
}

static int rotate(lua_State* L) {
  return push(L, self<Pose>(L).rotation * check_vec3(L, 2, "direction"));
}

static int interpolate_to(lua_State* L) {
  const Pose& from = self<Pose>(L);
  const double t = check_number(L, 3, "t");
  if (t < 0 || t > 1) fail("{}: t: expected a number from 0 to 1, got {}", subject(L), t);
  return push(L, interpolate(from, check_pose(L, 2, "other"), t));
}

static int pose_multiply(lua_State* L) {
  const Pose& left = check_object<Pose>(L, 1, "left of *");
  if (const Pose* right = to<Pose>(L, 2)) return push(L, left * *right);
  if (lua_type(L, 2) != LUA_TTABLE && !to<Vector3d>(L, 2))
    fail_expected({L, {}, "right of *"}, "a pose, a vec3 or {x, y, z}", 2);
  return push(L, left * check_vec3(L, 2, "right of *"));
}

static std::string pose_text(const Pose& pose) {
  const Vector3d& p = pose.position;
  const Quaterniond& q = pose.rotation;
  return fmt::format(
      "pose{{xyz = {{{:.6g}, {:.6g}, {:.6g}}}, quat = {{{:.6g}, {:.6g}, {:.6g}, {:.6g}}}}}",
      p.x() + 0.0, p.y() + 0.0, p.z() + 0.0, q.w() + 0.0, q.x() + 0.0, q.y() + 0.0, q.z() + 0.0);
}

static int pose_as_json(lua_State* L) {
  const Pose pose = self<Pose>(L);
  return push_record(
      L, {{"xyz", std::span<const double>(pose.position.data(), 3)}, {"quat", quat_of(pose)}});
}

static const Entry pose_functions[] = {
    {"pose", guarded<make_pose>, R"(
A rigid transform: the pose of one frame in another, within 1e9 m of it. The rotation is given in at most one form.
@param options? table  position and orientation
@option xyz? vec3 [m]  position
@option rpy? number[] [rad]  rotations about the fixed x, y and z axes, in this order
@option quat? number[]  unit quaternion, w x y z
@option matrix? number[][]  3 rows of 3 or 4, or 4 rows of 4
@option axis? vec3  of a rotation by `angle`, of any length
@option angle? number [rad]  about `axis`
@option x_axis? vec3  direction of this axis of the frame
@option y_axis? vec3  direction of this axis of the frame
@option z_axis? vec3  direction of this axis of the frame. Of two axes, z_axis, else x_axis, is matched exactly, the other as nearly as a right angle allows; one axis: by the smallest rotation (by half a turn about the next axis if it points backward)
@return pose
@effect reads
> clench.deg(clench.pose{axis = {0, 0, 2}, angle = clench.rad(90)}:angle())  --> 90.0
> clench.pose{z_axis = {1, 0, 0}}:rotate{0, 1, 0}  --> (0, 1, 0)
> clench.pose{z_axis = {0, 0, -1}, x_axis = {1, 0, 0.5}}:rotate{0, 1, 0}  --> (0, -1, 0)
> clench.pose{xyz = {1, 2, 3}}  --> pose{xyz = {1, 2, 3}, quat = {1, 0, 0, 0}}
> clench.pose{rpy = {0, 0, clench.rad(90)}} * {1, 0, 0}  --> (2.22045e-16, 1, 0)
> clench.pose{quat = {2, 0, 0, 0}}  --> error: expected a unit quaternion
> clench.pose{xyz = {0, 0, 1e308}}  --> error: expected a position within 1e+09 m of the origin)"},
    {"look_at", guarded<look_at>, R"(
The pose of a camera at `eye` that sees `target`: it looks along its -z, with y up, as `world.camera.pose`.
@param eye vec3 [m]  position of the camera
@param target vec3 [m]  point that it looks at
@param up? vec3  {0, 0, 1} by default
@return pose
@effect reads
> clench.look_at({1, 0, 0}, {0, 0, 0}):rotate{0, 0, -1}  --> (-1, 0, 0)
> clench.look_at({0, 0, 1}, {0, 0, 0})  --> error: expected different eye and target, and up in another direction than the view)"},
};

static const Entry pose_fields[] = {
    {"position", getter<[](const Pose& x) { return x.position; }>, R"(
Position of the frame's origin.
@type vec3  [m]
> clench.pose{xyz = {1, 2, 3}}.position  --> (1, 2, 3))"},
    {"quat", getter<quat_of>, R"(
The rotation as a unit quaternion, w x y z.
@type number[]
> clench.pose{}.quat  --> {1.0, 0.0, 0.0, 0.0})"},
    {"rpy", getter<[](const Pose& x) { return rpy_of(x.matrix()); }>, R"(
The rotation as turns about the fixed x, y and z axes, in this order.
@type vec3  [rad]
> clench.pose{rpy = {0.1, 0.2, 0.3}}.rpy  --> (0.1, 0.2, 0.3))"},
};

static const Entry pose_methods[] = {
    {"inverse", method<[](const Pose& x) { return x.inverse(); }>, R"(
The inverse: `p:inverse() * p` is the identity.
@return pose
@effect reads
> clench.pose{xyz = {1, 2, 3}}:inverse().position  --> (-1, -2, -3))"},
    {"angle", method<[](const Pose& x) { return x.angle(); }>, R"(
Angle of the rotation, from 0 to pi.
@return number  [rad]
@effect reads
> clench.deg(clench.pose{quat = {0, 1, 0, 0}}:angle())  --> 180.0)"},
    {"matrix", method<homogeneous>, R"(
The homogeneous matrix.
@return number[][]  4 rows of 4
@effect reads
> clench.pose{xyz = {1, 2, 3}}:matrix()[1]  --> {1.0, 0.0, 0.0, 1.0})"},
    {"rotate", guarded<rotate>, R"(
A direction transformed by the rotation only.
@param direction vec3  direction in the frame of the pose
@return vec3
@effect reads
> clench.pose{xyz = {1, 2, 3}, quat = {0, 0, 0, 1}}:rotate{1, 0, 0}  --> (-1, 0, 0))"},
    {"interpolate", guarded<interpolate_to>, R"(
The pose between this one (t = 0) and another (t = 1): straight line, shortest turn.
@param other pose  pose at t = 1
@param t number  part of the path from this pose to the other
@return pose
@effect reads
> clench.pose{}:interpolate(clench.pose{xyz = {4, 0, 0}}, 0.25).position  --> (1, 0, 0))"},
};

static const Entry pose_operators[] = {
    {"__mul", guarded<pose_multiply>, ""},
    {"__eq", equality<Pose>, ""},
    {"__tostring", method<pose_text>, ""},
    {"__json", guarded<pose_as_json>, ""},
};

const Library pose_library{.name = "clench", .doc = "", .functions = pose_functions};

const Class pose_class{.name = "pose",
                       .variable = "pose",
                       .doc =
                           "An immutable rigid transform. `a * b` composes two of them, `a * v` "
                           "transforms a point, `==` compares bit-exactly. Wherever a pose is "
                           "expected, the table that `clench.pose` takes is accepted.",
                       .fields = pose_fields,
                       .methods = pose_methods,
                       .operators = pose_operators};

}  // namespace clench
