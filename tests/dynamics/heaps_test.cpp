// Islands of many bodies: solved by their trees, at rest, and audited step by step.
#include <cmath>
#include <cstring>

#include "clench/base/random.h"
#include "clench/dynamics/mechanics.h"
#include "clench/dynamics/solve/friction_residual.h"
#include "clench/dynamics/solve/solve_friction.h"
#include "clench/dynamics/solve/solve_trees.h"
#include "clench/dynamics/stepper.h"
#include "support/meshes.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Vector3d direction_in(Random& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// Bodies of one to three kilograms in layers of four, each on some body below it or on the ground,
/// with random initial velocities; some contacts have torsion, some rows have bounds.
TreeFriction random_heap(Random& random, int bodies) {
  TreeFriction heap;
  heap.clear();
  VectorXd z(6 * bodies);
  for (int b = 0; b < bodies; ++b) heap.add_tree(6);
  for (double& x : z) x = random.normal();
  std::vector<double> q;
  const auto add = [&](TreeFriction::Block block, int a, int b, const MatrixXd& J) {
    block.row = static_cast<int>(q.size());
    heap.blocks.push_back(block);
    VectorXd u = VectorXd::Zero(block.size());
    for (const int body : {a, b})
      if (body >= 0) {
        const MatrixXd Y = (body == a ? -1.0 : 1.0) / std::sqrt(1 + 2.0 * (body % 7) / 6) * J;
        heap.add_side(body, Y);
        u += Y.transpose() * z.segment(6 * body, 6);
      }
    q.insert(q.end(), u.begin(), u.end());
  };
  for (int b = 0; b < bodies; ++b)
    for (int k = 0; k < 3; ++k) {
      const int below = b < 4 ? -1 : b - 1 - static_cast<int>(random.uniform() * 4);
      TreeFriction::Block block;
      block.tangents = random.uniform() < 0.2 ? 3 : 2;
      block.mu = random.uniform(0.2, 0.8);
      block.pair = 8 * b + below;
      const Vector3d normal = (Vector3d::UnitZ() + 0.5 * direction_in(random)).normalized(),
                     t = normal.unitOrthogonal(), p = direction_in(random);
      MatrixXd J(6, block.size());
      J.leftCols<3>() << normal, t, normal.cross(t), p.cross(normal), p.cross(t),
          p.cross(normal.cross(t));
      if (block.tangents == 3) J.col(3) << Vector3d::Zero(), 0.1 * normal;
      add(block, below, b, J);
    }
  for (int b = 0; b < bodies; b += 5) {
    TreeFriction::Block row;
    row.low = -0.1, row.high = 0.1;
    row.compliance = 0.01 * (b % 2);
    add(row, -1, b, direction_in(random).replicate(2, 1));
  }
  heap.q = Eigen::Map<const VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
  heap.finish();
  return heap;
}

/// A floor at z = 0, with boxes on it or overlapping it.
struct HeapWorld {
  World world;
  std::vector<Id<Body>> boxes;

  explicit HeapWorld(double mu) {
    world.set_gravity({0, 0, -9.81});
    world.set_friction("wood", "wood", {mu, mu});
    world.add_body(body_spec("floor", moved(box(2, 2, 0.1), {0, 0, -0.05})), BodyKind::obstacle,
                   {});
  }
  void add(const Vector3d& size, double mass, const Pose& X_W) {
    BodySpec spec = body_spec("box", box(size.x(), size.y(), size.z()));
    spec.mass = mass;
    boxes.push_back(world.add_body(spec, BodyKind::object, X_W));
  }
  double fastest() const {
    double out = 0;
    for (const auto id : boxes)
      out = std::max({out, world.twist(id).linear.norm(), world.twist(id).angular.norm()});
    return out;
  }
};

// gap of bodies at rest: a quarter of the contact threshold [m]
constexpr double rest_at = 2.5e-5;

HeapWorld bin(int count) {
  HeapWorld out(0.5);
  for (const double side : {-1.0, 1.0}) {
    out.world.add_body(body_spec("wall", box(0.04, 0.4, 0.6)), BodyKind::obstacle,
                       Pose::translation({0.14 * side, 0, 0.3}));
    out.world.add_body(body_spec("wall", box(0.24, 0.04, 0.6)), BodyKind::obstacle,
                       Pose::translation({0, 0.14 * side, 0.3}));
  }
  Random random(5);
  for (int i = 0; i < count; ++i)
    out.add(
        {0.05, 0.04, 0.06}, 0.1,
        {random_turn(random), {i & 1 ? 0.06 : -0.06, i & 2 ? 0.06 : -0.06, 0.06 + 0.1 * (i / 4)}});
  return out;
}

}  // namespace

TEST_CASE("products by trees equal those of the assembled matrix") {
  Random random(6);
  const TreeFriction heap = random_heap(random, 9);
  const FrictionProblem problem = heap.assembled();
  VectorXd r(heap.rows()), z, u;
  for (double& x : r) x = random.normal();
  heap.move(r, z);
  heap.velocities(r, z, u);
  CHECK((u - problem.W * r - problem.q).norm() < 1e-12 * u.norm());
  for (const auto& block : heap.blocks)
    CHECK(block.d == doctest::Approx(block_admittance(problem, block)));
}

TEST_CASE("heaps solved by their trees satisfy the laws of the assembled problem") {
  TreeFrictionSolver by_trees;
  FrictionSolver by_matrix;
  for (int number = 0; number < 25; ++number) {
    Random random(7, number);
    const TreeFriction heap = random_heap(random, 6 + number);
    const FrictionProblem problem = heap.assembled();
    const FrictionSolution solution = by_trees.solve(heap, {});
    REQUIRE(solution.solved);
    CHECK(friction_residual(problem, solution.r) < 1e-11);
    CHECK((solution.u - problem.W * solution.r - problem.q).norm() < 1e-11);
    // the solution is not unique: each method accepts the solution of the other
    CHECK(by_matrix.solve(problem, solution.r).iterations == 0);
    CHECK(by_trees.solve(heap, by_matrix.solve(problem, {}).r).iterations == 0);
  }
}

TEST_CASE("a heap with a number that is not finite is not solved") {
  Random random(8);
  TreeFriction heap = random_heap(random, 8);
  heap.q[3] = NAN;
  const FrictionSolution solution = TreeFrictionSolver().solve(heap, {});
  CHECK_FALSE(solution.solved);
  CHECK(std::isinf(solution.residual));
  CHECK(solution.r.isZero(0));
}

TEST_CASE("boxes that fall into a bin conserve momentum and gain no energy") {
  HeapWorld heap = bin(16);
  Stepper stepper(heap.world);
  const double mass = 1.6, h = heap.world.dynamic_settings().step;
  const auto energy = [&] {
    const MechanicalEnergy e = mechanical_energy(heap.world);
    return e.kinetic + e.potential;
  };
  int audited = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d before = momentum(heap.world).linear;
    const double had = energy(), began = heap.world.time();
    REQUIRE(stepper.step(10));
    const DynamicState& state = *heap.world.dynamics();
    // a step of constant force gains m g^2 h^2 / 2; bodies that were too close to each other
    // separate with at most 0.1 m/s
    CHECK(energy() - had < 0.5 * mass * 9.81 * 9.81 * h * h + 1e-4);
    if (std::abs(heap.world.time() - began - h) > 1e-9) continue;
    Vector3d force = {0, 0, -9.81 * mass};
    for (const Manifold& m : state.manifolds)
      for (const ManifoldPoint& p : m.points) {
        const Vector3d f_W = heap.world.pose(m.a).rotation * p.force;
        if (heap.world.body(m.a).kind == BodyKind::obstacle) force += f_W;
        if (heap.world.body(m.b).kind == BodyKind::obstacle) force -= f_W;
      }
    ++audited;
    CHECK((momentum(heap.world).linear - before - h * force).norm() < 1e-9);
  }
  CHECK(audited > 300);
  CHECK(heap.world.dynamics()->report.max_residual < 1e-9);
  CHECK(heap.world.dynamics()->report.overlaps == 0);
  for (const auto id : heap.boxes) CHECK(heap.world.pose(id).position.z() > 0.019);
}

TEST_CASE("a heap moves bit-identically with a new stepper") {
  HeapWorld one = bin(12), other = bin(12);
  Stepper stepper(one.world);
  for (int i = 0; i < 25; ++i) {
    stepper.run(0.01);
    Stepper(other.world).run(0.01);
  }
  for (size_t i = 0; i < one.boxes.size(); ++i) {
    const Pose &a = one.world.pose(one.boxes[i]), &b = other.world.pose(other.boxes[i]);
    CHECK(std::memcmp(a.position.data(), b.position.data(), sizeof(double[3])) == 0);
    CHECK(a.rotation.coeffs() == b.rotation.coeffs());
  }
}

TEST_CASE("a tower of planks is bit-exactly at rest") {
  HeapWorld tower(0.5);
  for (int layer = 0; layer < 10; ++layer)
    for (int i = -1; i <= 1; ++i) {
      const double across = 0.026 * i, z = rest_at + layer * (0.015 + rest_at) + 0.0075;
      const bool along_x = layer % 2 == 0;
      tower.add(along_x ? Vector3d(0.075, 0.025, 0.015) : Vector3d(0.025, 0.075, 0.015), 0.02,
                Pose::translation(along_x ? Vector3d(0, across, z) : Vector3d(across, 0, z)));
    }
  Stepper stepper(tower.world);
  stepper.run(0.02);
  CHECK(tower.fastest() == 0);
  CHECK(tower.world.dynamics()->report.failures == 0);
}

// Each card of a pair carries half the weight w of the plank in addition to its own, m g: at its
// foot H = (w / 2 + m g / 2) tan(lean) against N = w / 2 + m g.
TEST_CASE("a house of cards stands with enough friction, and falls with too little") {
  constexpr double thick = 0.002, length = 0.09, lean = 0.3, card = 0.005, plank = 0.012;
  const double needed =
      (plank / 4 + card / 2) / (plank / 4 + card) * std::tan(lean);  // two pairs carry the plank
  for (const double share : {0.6, 1.4}) {
    HeapWorld house(share * needed);
    const double reach = length / 2 * std::sin(lean) + thick / 2 * std::cos(lean),
                 rise = length / 2 * std::cos(lean) + thick / 2 * std::sin(lean);
    for (const double middle : {-0.03, 0.03})
      for (const double side : {-1.0, 1.0})
        house.add({thick, 0.06, length}, card,
                  Pose::translation({middle + side * (reach + rest_at / 2), 0, rest_at + rise}) *
                      Pose::turn(-side * lean, Vector3d::UnitY()));
    const double top = 2 * rise + 2 * rest_at;
    house.add({0.12, 0.06, thick}, plank, Pose::translation({0, 0, top + thick / 2}));
    Stepper(house.world).run(0.2);
    const double height = house.world.pose(house.boxes.back()).position.z();
    if (share > 1) {
      CHECK(height == doctest::Approx(top + thick / 2).epsilon(1e-3));
      CHECK(house.fastest() < 1e-6);
    } else {
      CHECK(height < 0.9 * top);
    }
  }
}
