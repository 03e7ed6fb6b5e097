#include "clench/scene/force_arrows.h"

#include <tuple>

using namespace clench;
using Eigen::Vector3d;

TEST_CASE(
    "a force's arrow ends at its point of application, with a length proportional to the force") {
  const PlacedForce forces[] = {
      {{0.1, 0, 0}, {-2, 0, 0}}, {{0, 0.1, 0}, {0, -1, 0}}, {{0, 0, 1}, {0, 0, 1e-4}}};
  const double scale = force_scale(forces, 0.05);
  CHECK(scale == doctest::Approx(0.025));
  const auto arrows = force_arrows(forces, scale);
  REQUIRE(arrows.size() == 2);  // the third one would be invisible
  for (int i = 0; i < 2; ++i) {
    CHECK((arrows[i].tip - forces[i].p_W).norm() == 0);
    CHECK((arrows[i].tail - (forces[i].p_W - scale * forces[i].f_W)).norm() < 1e-15);
    CHECK(arrows[i].radius > 0);
  }
  CHECK(force_arrows({}, 1).empty());
  CHECK(force_scale({}, 0.05) == 1);
}

TEST_CASE(
    "labels beyond the tails give the forces of the longest arrows in newtons, the largest first") {
  std::vector<PlacedForce> forces;
  for (int i = 1; i <= 12; ++i) forces.push_back({{0, 0, 0.1 * i}, {0.25 * i, 0, 0}});
  forces.push_back({{0, 0, 0}, {1e-4, 0, 0}});
  const double scale = 0.1;
  const auto labels = force_labels(forces, scale);
  REQUIRE(labels.size() == 8);
  CHECK(labels[0].text == "3 N");
  CHECK(labels[1].text == "2.75 N");
  for (int i = 0; i < 8; ++i) {
    const PlacedForce& force = forces[11 - i];
    const Vector3d tail = force.p_W - scale * force.f_W;
    CHECK(labels[i].p_W.x() < tail.x());
    CHECK(labels[i].p_W.x() > 1.2 * tail.x());
    CHECK(labels[i].p_W.z() == force.p_W.z());
  }
  CHECK(force_labels({}, 1).empty());
}

TEST_CASE("a patch of many points has one arrow with the same force and torque") {
  std::vector<Contact> contacts;
  std::vector<PlacedForce> forces;
  // the corners of a square face, pressed unevenly along +z
  for (const auto& [x, y, f] : {std::tuple(0.0, 0.0, 1.0), std::tuple(0.02, 0.0, 2.0),
                                std::tuple(0.02, 0.02, 3.0), std::tuple(0.0, 0.02, 0.5)}) {
    Contact contact;
    contact.p_W = {x, y, 0};
    contact.n_W = Vector3d::UnitZ();
    contacts.push_back(contact);
    forces.push_back({contact.p_W, {0, 0, f}});
  }
  // and another contact far away, on another side
  Contact other;
  other.p_W = {0.01, 0.01, 0.05};
  other.n_W = -Vector3d::UnitZ();
  contacts.push_back(other);
  forces.push_back({other.p_W, {0.3, 0, -6.5}});

  const auto resultants = patch_forces(contacts, forces);
  REQUIRE(resultants.size() == 2);
  Vector3d sum = Vector3d::Zero(), torque = sum;
  for (size_t i = 0; i < 4; ++i) {
    sum += forces[i].f_W;
    torque += forces[i].p_W.cross(forces[i].f_W);
  }
  CHECK((resultants[0].f_W - sum).norm() < 1e-15);
  CHECK((resultants[0].p_W.cross(resultants[0].f_W) - torque).norm() < 1e-15);
  CHECK(resultants[1].p_W == other.p_W);
  CHECK(resultants[1].f_W == forces[4].f_W);
  // a patch without force
  for (PlacedForce& force : forces) force.f_W.setZero();
  CHECK((patch_forces(contacts, forces)[0].p_W - Vector3d(0.01, 0.01, 0)).norm() < 1e-15);
}
