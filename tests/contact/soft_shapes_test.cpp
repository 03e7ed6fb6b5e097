// Soft patches of shapes with known curvatures at every point, with irregular meshes.
#include <algorithm>

#include "clench/contact/soft_patch.h"
#include "clench/math/decompositions.h"
#include "support/cases.h"
#include "support/curved.h"

using namespace clench;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double near = 5e-5;  // within the contact threshold [m]
constexpr double soft_modulus = 1.5e6;
constexpr double flat_cap = 0.02;

/// Ball of unit directions, with unequal edges of 1/8 to 1/25: moved at random and concentrated
/// towards one pole.
Mesh uneven_sphere(Random& random, int subdivisions) {
  Mesh mesh = test::icosphere(1, subdivisions);
  const double edge = 1.1 / std::exp2(subdivisions);
  const Vector3d pole = test::random_direction(random);
  for (Vector3d& p : mesh.vertices)
    p = (p + 0.3 * edge * test::random_direction(random) + 0.4 * pole).normalized();
  return mesh;
}

/// Breaks the regular pattern of diagonals: swaps every third diagonal between two neighbors.
void turn_diagonals(Mesh& mesh, Random& random) {
  for (size_t t = 0; t + 1 < mesh.triangles.size(); t += 2) {
    auto& [a, b, c] = mesh.triangles[t];
    auto& [d, e, f] = mesh.triangles[t + 1];
    // both triangles of one cell: a b c and a c f
    if (a != d || c != e || random.uniform(0, 1) > 0.33) continue;
    const Triangle one = {a, b, f}, two = {b, c, f};
    mesh.triangles[t] = one, mesh.triangles[t + 1] = two;
  }
}

/// about z, with the centers of its cells displaced
Mesh uneven_torus(Random& random, double ring, double tube, int around, int along) {
  Mesh mesh = test::torus(ring, tube, around, along);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double u = 2 * std::numbers::pi * (i + random.uniform(-0.3, 0.3)) / around;
      const double v = 2 * std::numbers::pi * (j + random.uniform(-0.3, 0.3)) / along;
      const double r = ring + tube * std::cos(v);
      mesh.vertices[i * along + j] = {r * std::cos(u), r * std::sin(u), tube * std::sin(v)};
    }
  turn_diagonals(mesh, random);
  return mesh;
}

/// Second fundamental form of a surface, as a form on space: 0 along its normal [1/m].
Matrix3d bend(const Vector3d& direction, double curvature, const Vector3d& other,
              double curvature2) {
  return curvature * direction * direction.transpose() + curvature2 * other * other.transpose();
}

/// of the surface x^T D x = 1 at the point with outward normal n
Matrix3d ellipsoid_bend(const Vector3d& semi_axes, const Vector3d& n) {
  const Matrix3d D = semi_axes.cwiseAbs2().cwiseInverse().asDiagonal();
  const Vector3d p = semi_axes.cwiseAbs2().cwiseProduct(n) / semi_axes.cwiseProduct(n).norm();
  const Matrix3d across = Matrix3d::Identity() - n * n.transpose();
  return across * D * across / (D * p).norm();
}

struct Errors {
  double radius = 0, angle = 0, torsion = 0;  // relative, [rad], relative
  void add(const Errors& e) {
    radius = std::max(radius, e.radius), angle = std::max(angle, e.angle);
    torsion = std::max(torsion, e.torsion);
  }
  void check(double max_radius, double max_angle, double max_torsion) const {
    CHECK(radius < max_radius);
    CHECK(angle < max_angle);
    CHECK(torsion < max_torsion);
  }
};

/// Errors of a patch compared with the form of the gap in the frame of a; radii are capped beyond 1
/// m.
Errors errors_of(const SoftPatch& patch, const Matrix3d& form, double force = 5) {
  const auto [values, vectors] = eigensystem(form);  // ascending: 0, then the lesser one
  const double first = 1 / values[2];
  const double second = values[1] > 1 ? 1 / values[1] : std::max(first, flat_cap);
  Errors out;
  out.radius = std::max(std::abs(patch.relative_radii[0] / first - 1),
                        std::abs(patch.relative_radii[1] / second - 1));
  if (values[2] > 1.3 * values[1])
    out.angle = std::acos(std::min(1.0, std::abs(patch.directions.col(0).dot(vectors.col(2)))));
  const double d =
      std::sqrt(force * 0.003 / (soft_modulus * std::numbers::pi * std::sqrt(first * second)));
  const double torsion = 8 * std::sqrt(2 * d * std::sqrt(first * second)) / 15;
  out.torsion = std::abs(torsion_radius(patch, force) / torsion - 1);
  CHECK(!patch.at_edge);
  return out;
}

SoftPatch press_soft(const Mesh& a, const Mesh& b, const Pose& X_AB) {
  const auto shape_a = Shape::make(a), shape_b = Shape::make(b);
  const auto touches = contact_set(*shape_a, *shape_b, X_AB);
  REQUIRE(!touches.empty());
  return soft_patch(*soft_sites(shape_a, shape_b, X_AB, {}, {.modulus = soft_modulus}, touches)[0]);
}

/// a turned body, lowered onto a board
SoftPatch land(const Mesh& body, const Pose& turn) {
  const Mesh turned = test::moved(body, turn);
  const Mesh board = test::moved(test::box(0.3, 0.3, 0.02), Pose::translation({0, 0, -0.01}));
  return press_soft(board, turned,
                    Pose::translation({0, 0, near - Shape::make(turned)->bounds().low.z()}));
}

Matrix3d turned_form(const Pose& turn, const Matrix3d& form) {
  const Matrix3d r = turn.rotation.toRotationMatrix();
  return r * form * r.transpose();
}

}  // namespace

TEST_CASE(
    "ellipsoids with uneven meshes have the curvatures of the formula, at any contact point") {
  Random random(11);
  Errors coarse, fine;
  for (int trial = 0; trial < test::cases(40); ++trial) {
    const Vector3d semi_axes(random.uniform(0.015, 0.03), random.uniform(0.015, 0.03),
                             random.uniform(0.015, 0.03));
    const Pose turn = Pose::turn(test::random_turn(random));
    const Matrix3d form =
        turned_form(turn, ellipsoid_bend(semi_axes, turn.rotation.inverse() * -Vector3d::UnitZ()));
    for (const int subdivisions : {3, 4}) {
      Mesh mesh = uneven_sphere(random, subdivisions);
      for (Vector3d& p : mesh.vertices) p = p.cwiseProduct(semi_axes);
      (subdivisions == 3 ? coarse : fine).add(errors_of(land(mesh, turn), form));
    }
  }
  // the measured errors plus a half: edges of 3 mm and 1.5 mm, with a neighborhood of 3.5 mm. Radii
  // enter the torsion with the power 1/8
  coarse.check(0.1, 0.08, 0.013);
  fine.check(0.045, 0.05, 0.008);
}

TEST_CASE(
    "a tilted torus with an uneven mesh has the radii of its tube and of the ring at the contact") {
  Random random(12);
  Errors all;
  for (int trial = 0; trial < test::cases(20); ++trial) {
    const double ring = 0.03, tube = random.uniform(0.008, 0.015), v = random.uniform(0, 1.2);
    const Mesh mesh = uneven_torus(random, ring, tube, 72, 36);
    // its axis is inclined until it touches at the height v on the tube
    const Pose turn{shortest_rotation(Vector3d(std::cos(v), 0, std::sin(v)), -Vector3d::UnitZ()),
                    Vector3d::Zero()};
    const Vector3d along(-std::sin(v), 0, std::cos(v));
    const Matrix3d form =
        bend(along, 1 / tube, Vector3d::UnitY(), std::cos(v) / (ring + tube * std::cos(v)));
    all.add(errors_of(land(mesh, turn), turned_form(turn, form)));
  }
  all.check(0.12, 0.05, 0.017);
}

TEST_CASE("a ball on the flank of a cone adds its curvature to that across the flank") {
  Random random(13);
  Errors all;
  for (int trial = 0; trial < test::cases(20); ++trial) {
    const double half_angle = random.uniform(0.1, 0.6), middle = random.uniform(0.015, 0.03);
    // a frustum about z, with uneven rings and segments
    Mesh cone;
    const int rings = 9, segments = 48;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < segments; ++j) {
        const double z = (i - 4 + (i % 8 ? random.uniform(-0.3, 0.3) : 0)) * 0.004;
        const double a = 2 * std::numbers::pi * (j + random.uniform(-0.3, 0.3)) / segments;
        const double r = middle + z * std::tan(half_angle);
        cone.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
      }
    for (int i = 0; i + 1 < rings; ++i)
      for (int j = 0; j < segments; ++j) {
        const int p = i * segments + j, q = i * segments + (j + 1) % segments;
        cone.triangles.push_back({p, q, q + segments});
        cone.triangles.push_back({p, q + segments, p + segments});
      }
    turn_diagonals(cone, random);
    const double radius = random.uniform(0.008, 0.03), a = random.uniform(0, 6);
    const Vector3d out(std::cos(a), std::sin(a), 0), across(-std::sin(a), std::cos(a), 0);
    const Vector3d normal = std::cos(half_angle) * out - std::sin(half_angle) * Vector3d::UnitZ();
    const Vector3d along = normal.cross(across);
    Mesh ball = uneven_sphere(random, 4);
    for (Vector3d& p : ball.vertices) p *= radius;
    // down to the mesh, whose chords lie within the cone
    const Vector3d start = middle * out + (radius + 0.002) * normal;
    const Distance apart =
        distance(*Shape::make(cone), *Shape::make(ball), Pose::translation(start));
    const Pose X_AB = Pose::translation(start - (apart.distance - near) * normal);
    const Matrix3d form =
        bend(across, 1 / radius + std::cos(half_angle) / middle, along, 1 / radius);
    all.add(errors_of(press_soft(cone, ball, X_AB), form));
  }
  all.check(0.045, 0.08, 0.008);
}

TEST_CASE("a box rounded by 12 mm touches with balls at its corners and cylinders at its edges") {
  Random random(14);
  Errors corners, edges;
  for (int trial = 0; trial < test::cases(40); ++trial) {
    const double round = 0.012;
    const Vector3d half(random.uniform(0.008, 0.03), random.uniform(0.005, 0.03),
                        random.uniform(0.005, 0.03));
    Mesh mesh = uneven_sphere(random, 5);
    for (Vector3d& p : mesh.vertices) p = half.cwiseProduct(p.cwiseSign()) + round * p;
    const bool corner = trial % 2;
    Vector3d n = test::random_direction(random).cwiseAbs();
    if (!corner) n.x() = 0;
    n.normalize();
    // the neighborhood spans 17 degrees, which must belong to one ball or cylinder
    if ((corner ? n.minCoeff() : std::min(n.y(), n.z())) < 0.35) continue;
    const Pose turn{shortest_rotation(n, -Vector3d::UnitZ()), Vector3d::Zero()};
    const Matrix3d round_form = (Matrix3d::Identity() - n * n.transpose()) / round;
    if (corner) {
      corners.add(errors_of(land(mesh, turn), turned_form(turn, round_form)));
      continue;
    }
    // a ball at the middle of the edge, where the triangles of the edge are long
    const double radius = random.uniform(0.01, 0.03);
    const Vector3d foot(random.uniform(-0.4, 0.4) * half.x(), half.y(), half.z());
    const Vector3d start = foot + (round + radius + 0.002) * n;
    Mesh ball = uneven_sphere(random, 4);
    for (Vector3d& p : ball.vertices) p *= radius;
    const Distance apart =
        distance(*Shape::make(mesh), *Shape::make(ball), Pose::translation(start));
    const Matrix3d ball_form = (Matrix3d::Identity() - n * n.transpose()) / radius;
    const Matrix3d form =
        ball_form + round_form - Vector3d::UnitX() * Vector3d::UnitX().transpose() / round;
    const Pose X_AB = Pose::translation(start - (apart.distance - near) * n);
    edges.add(errors_of(press_soft(mesh, ball, X_AB), form));
  }
  corners.check(0.003, 0.01, 0.0005);
  edges.check(0.02, 0.07, 0.003);
}
