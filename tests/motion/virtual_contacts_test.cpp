#include "clench/motion/virtual_contacts.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/motion/drive.h"
#include "support/chains.h"
#include "support/meshes.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

struct Stage {
  World world;
  Id<Robot> hand;
};

Stage stage(const RobotSpec& spec = two_finger()) {
  Stage s;
  s.hand = s.world.add_robot(spec, {});
  return s;
}

Vector3d normal_of(const VirtualContactSpec& c) { return c.X_LC.rotation * Vector3d::UnitZ(); }

}  // namespace

TEST_CASE("each link of a gripper gets one virtual contact, on the inner side, and the palm one") {
  const Stage s = stage();
  const auto sites = find_virtual_contacts(s.world, s.hand);
  REQUIRE(sites.size() == 5);
  for (int i = 0; i < 4; ++i) {
    CHECK(sites[i].link == i);
    // the fingers turn about z, counter-clockwise from +y in their own frames: +y is inward
    CHECK((normal_of(sites[i]) - Vector3d::UnitY()).norm() < 1e-12);
    CHECK(sites[i].X_LC.position.y() == doctest::Approx(0.005));
    CHECK(sites[i].edges.cols() == 8);
  }
  CHECK(sites[4].link == -1);
  // the palm's face towards +y, at the approach point
  CHECK((normal_of(sites[4]) - Vector3d::UnitY()).norm() < 1e-12);
  CHECK((sites[4].X_LC.position - Vector3d(0, -0.006, 0)).norm() < 1e-12);
}

TEST_CASE("a virtual contact is at the center of the volume that its link sweeps") {
  // A face that turns about an axis sweeps in proportion to the distance r from it. Of the two end
  // faces, half of the height h moves forward, in proportion to the height. Per width, over r from
  // `near` to `far`:
  const Stage s = stage();
  const auto sites = find_virtual_contacts(s.world, s.hand);
  const double near = 0.003, far = 0.047, h = 0.005;
  const double swept = (far * far - near * near) / 2 + 2 * h * h / 2;
  const double moment = (far * far * far - near * near * near) / 3 + (near + far) * h * h / 2;
  // triangles of the end faces that move forward only in part are approximated
  CHECK(std::abs(sites[0].X_LC.position.x() - (moment / swept - 0.05)) < 1e-5);
  CHECK(std::abs(sites[0].X_LC.position.z()) < 1e-12);
}

TEST_CASE(
    "virtual contacts lie on the surface with outward normals, also for round links and in any "
    "pose of the hand") {
  RobotSpec spec = two_finger();
  link_of(spec, 0, 1).body = body_spec("gripper_chain0_link1", moved(ball(0.01, 3), {-0.02, 0, 0}));
  Random random(2, 0);
  std::vector<VirtualContactSpec> first;
  for (int i = 0; i < 5; ++i) {
    Stage s;
    s.hand = s.world.add_robot(spec, random_pose(random, 1));
    const auto& limits = s.world.robot(s.hand).limits;
    s.world.set_dofs(s.hand, Eigen::Vector2d(random.uniform(limits[0][0], limits[0][1]), 0.2));
    const auto sites = find_virtual_contacts(s.world, s.hand, {.count_per_link = 3});
    REQUIRE(sites.size() == 13);
    for (const auto& site : sites) {
      const Shape& shape = *s.world.body(s.world.robot(s.hand).body_of(site.link)).shape;
      const Vector3d p = site.X_LC.position;
      CHECK(closest_point(shape, p).distance < 1e-9);
      CHECK(contains(shape, p - 1e-4 * normal_of(site)));
      CHECK_FALSE(contains(shape, p + 1e-4 * normal_of(site)));
    }
    // neither pose nor posture matter
    if (i == 0) first = sites;
    for (size_t k = 0; k < sites.size(); ++k) {
      CHECK(sites[k].X_LC == first[k].X_LC);
    }
  }
}

TEST_CASE("several virtual contacts of a link lie in a row along it, in equal shares") {
  const Stage s = stage();
  const auto sites = find_virtual_contacts(s.world, s.hand, {.count_per_link = 3, .palm = false});
  REQUIRE(sites.size() == 12);
  for (int i = 0; i < 12; i += 3) {
    const double a = sites[i].X_LC.position.x(), b = sites[i + 1].X_LC.position.x(),
                 c = sites[i + 2].X_LC.position.x();
    CHECK((b - a) * (c - b) > 0);
    CHECK(std::abs(c - a) > 0.02);
  }
}

TEST_CASE("fixed links have no virtual contact, and a robot that does not close has none at all") {
  RobotSpec spec = two_finger();
  spec.dofs[1].default_velocity = 0;
  Stage s = stage(spec);
  CHECK(find_virtual_contacts(s.world, s.hand).size() == 3);
  spec.dofs[0].default_velocity = 0;
  s = stage(spec);
  CHECK(find_virtual_contacts(s.world, s.hand).empty());
  spec = two_finger();
  link_of(spec, 0, 0).body.shape = nullptr;
  s = stage(spec);
  CHECK(find_virtual_contacts(s.world, s.hand).size() == 4);
}

TEST_CASE("the palm may be a link: the fixed one nearest to the approach point") {
  // the base becomes an arm: a forearm below the palm, connected by a wrist that does not close
  RobotSpec spec = two_finger();
  JointSpec joint;
  joint.dof = 2;
  joint.min = -1;
  joint.max = 1;
  LinkSpec palm;
  palm.joints.push_back(joint);
  palm.body = spec.base;
  palm.body.name = "gripper_palm";
  spec.base = body_spec("gripper_base", moved(box(0.04, 0.2, 0.04), {0, -0.2, 0}));
  for (LinkSpec& link : spec.links) ++link.parent;
  spec.links.insert(spec.links.begin(), palm);
  spec.dofs.push_back(DofSpec{});
  const Stage s = stage(spec);
  const auto sites = find_virtual_contacts(s.world, s.hand);
  REQUIRE(sites.size() == 5);
  CHECK(sites[4].link == 0);
  CHECK((sites[4].X_LC.position - Vector3d(0, -0.006, 0)).norm() < 1e-12);
}

TEST_CASE(
    "a finger that closes in the other direction has its virtual contacts on the other side") {
  RobotSpec spec = two_finger();
  for (auto& dof : spec.dofs) dof.default_velocity = -1;
  const Stage s = stage(spec);
  const auto sites = find_virtual_contacts(s.world, s.hand, {.palm = false});
  REQUIRE(sites.size() == 4);
  CHECK((normal_of(sites[0]) + Vector3d::UnitY()).norm() < 1e-12);
}

TEST_CASE("a sliding jaw has its virtual contact at the center of its front face") {
  RobotSpec spec = two_finger();
  spec.links = {spec.links[0], spec.links[2]};
  for (const int l : {0, 1}) {
    JointSpec& joint = spec.links[l].joints[0];
    joint = {.kind = JointKind::prismatic, .X_PJ = joint.X_PJ, .dof = l, .max = 0.02};
    spec.links[l].X_JL = {};
  }
  const Stage s = stage(spec);
  const auto sites = find_virtual_contacts(s.world, s.hand, {.palm = false});
  REQUIRE(sites.size() == 2);
  CHECK((normal_of(sites[0]) - Vector3d::UnitZ()).norm() < 1e-12);
  CHECK((sites[0].X_LC.position - Vector3d(-0.025, 0, 0.005)).norm() < 1e-12);
}

TEST_CASE("mu is that of the materials of the link and of the grasped object") {
  Stage s = stage();
  const auto mu = [&](const char* against) {
    return find_virtual_contacts(s.world, s.hand, {.object_material = against})[0].mu;
  };
  CHECK(mu("wood") == 0.4);
  CHECK(mu("rubber") == 1.0);
  CHECK_THROWS_AS(mu("cheese"), Error);
  CHECK_THROWS_WITH_AS(find_virtual_contacts(s.world, s.hand, {.count_per_link = 0}),
                       "virtual contacts: count_per_link: expected 1 to 100, got 0", Error);
}

TEST_CASE("virtual contacts are found if none were given, and otherwise those given are used") {
  Stage s = stage();
  CHECK(virtual_contacts(s.world, s.hand).size() == 5);
  s.world.set_virtual_contacts(s.hand, std::make_shared<std::vector<VirtualContactSpec>>());
  CHECK(virtual_contacts(s.world, s.hand).empty());
}

TEST_CASE("a real contact is marked on the link's side, facing the touched body") {
  Stage s = stage();
  BodySpec cube = body_spec("cube", box(0.03, 0.03, 0.03));
  const auto object = s.world.add_body(cube, BodyKind::object, Pose::translation({0, 0.06, 0}));
  autograsp(s.world, s.hand);
  const std::vector<Id<Body>> bodies = s.world.bodies_of(s.hand), other = {object};
  for (const bool swapped : {false, true}) {
    const auto found =
        swapped ? contacts(s.world, other, bodies) : contacts(s.world, bodies, other);
    REQUIRE(!found.empty());
    for (const Contact& c : found) {
      const auto site = marked(s.world, s.hand, c);
      const auto id = s.world.robot(s.hand).body_of(site.link);
      const Body& link = s.world.body(id);
      // at most one contact threshold from its link; the outward normal points into the cube
      CHECK(closest_point(*link.shape, site.X_LC.position).distance <= 1e-9);
      const Vector3d p_W = s.world.pose(id) * site.X_LC.position,
                     n_W = s.world.pose(id).rotation * normal_of(site);
      CHECK(n_W.dot(Vector3d(0, 0.06, 0) - p_W) > 0);
      CHECK(site.mu == 0.4);
    }
  }
  Contact none;
  none.body = none.other = object;
  CHECK_THROWS_WITH_AS(
      marked(s.world, s.hand, none),
      "virtual contacts: the contact of 'cube' and 'cube' is on no link of 'gripper'", Error);
}
