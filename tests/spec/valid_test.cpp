#include "clench/spec/valid.h"

#include <functional>

#include "clench/base/error.h"
#include "clench/spec/check_robot.h"
#include "clench/spec/inertia.h"
#include "clench/spec/world_spec.h"
#include "support/chains.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

static const double hostile_numbers[] = {NAN,    INFINITY, -INFINITY, 1e308, -1e308,
                                         5e-324, 0,        -1,        0.3,   1};

/// The message of the thrown error; empty if nothing is thrown.
static std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

static void check_verdicts(const Quantity& rule, const char* name,
                           const std::function<void(double)>& give) {
  for (const double x : hostile_numbers) {
    INFO(name << " " << x);
    const std::string sentence = refusal_of([&] { give(x); });
    CHECK(sentence.empty() == rule.allows(x));
    if (rule.allows(x)) continue;
    CHECK(sentence.find("expected ") != std::string::npos);
    CHECK(sentence.find(", got ") != std::string::npos);
  }
}

TEST_CASE("no rule allows NaN or infinite numbers") {
  for (const Quantity& rule :
       {mass_rule, density_rule, coordinate_rule, length_rule, scale_rule, angle_rule,
        elastic_modulus_rule, soft_layer_rule, poisson_ratio_rule, friction_rule,
        contact_threshold_rule, share_rule, limit_rule, number_rule, positive_rule,
        not_negative_rule}) {
    INFO(rule.name);
    for (const double x : {double(NAN), double(INFINITY), -double(INFINITY), 1e308, -1e308}) {
      CHECK_FALSE(rule.allows(x));
      CHECK_FALSE(fault(rule, x).empty());
    }
    CHECK(rule.allows(rule.min));
    CHECK(rule.allows(rule.max));
  }
}

TEST_CASE("a rejected number is reported with its bounds, in the unit of the caller") {
  CHECK(fault(mass_rule, 0) == "expected a number from 1e-12 to 1e+12 [kg], got 0");
  CHECK(fault(mass_rule.in("g", 1e-3), -1) == "expected a number from 1e-09 to 1e+15 [g], got -1");
  CHECK(fault(number_rule, -double(NAN)) == "expected a number from -1e+30 to 1e+30, got nan");
  CHECK_THROWS_WITH_AS(check(coordinate_rule.called("com"), Eigen::Vector3d(0, 0, 2e9), "cup"),
                       "cup: com: expected a number from -1e+09 to 1e+09 [m], got 2000000000",
                       Error);
}

TEST_CASE("each number of a body has one rule") {
  const auto body = [](auto set) {
    return [set](double x) {
      BodySpec spec;
      set(spec, x);
      check_body(spec, "body");
    };
  };
  check_verdicts(mass_rule, "mass", body([](BodySpec& s, double x) { s.mass = x; }));
  check_verdicts(coordinate_rule, "com", body([](BodySpec& s, double x) { s.com = {0, x, 0}; }));
  check_verdicts(elastic_modulus_rule, "elastic modulus",
                 body([](BodySpec& s, double x) { s.elastic_modulus = x; }));
  check_verdicts(soft_layer_rule, "soft layer",
                 body([](BodySpec& s, double x) { s.soft_layer = x; }));
  check_verdicts(poisson_ratio_rule, "Poisson's ratio",
                 body([](BodySpec& s, double x) { s.poisson_ratio = x; }));
  check_verdicts(positive_rule, "inertia", body([](BodySpec& s, double x) {
                   s.inertia_per_mass = x * Eigen::Matrix3d::Identity();
                 }));
  // a float cannot distinguish the smallest number from 0, which is allowed
  check_verdicts(share_rule, "color", [](double x) {
    Appearance looks;
    looks.color[1] = static_cast<float>(x);
    check_appearance(looks, "body");
  });
  check_verdicts(share_rule, "transparency", [](double x) {
    Appearance looks;
    looks.transparency = static_cast<float>(x);
    check_appearance(looks, "body");
  });
}

static RobotSpec one_joint() {
  RobotSpec robot;
  robot.name = "arm";
  robot.dofs.resize(1);
  robot.links.resize(1);
  robot.links[0].joints.resize(1);
  joint_of(robot, 0, 0).min = -largest_number;
  joint_of(robot, 0, 0).max = largest_number;
  return robot;
}

TEST_CASE("each number of a robot has one rule") {
  const auto robot = [](auto set) {
    return [set](double x) {
      RobotSpec spec = one_joint();
      set(spec, x);
      check_robot(spec);
    };
  };
  const auto joint = [&](double JointSpec::*number) {
    return robot([number](RobotSpec& r, double x) { joint_of(r, 0, 0).*number = x; });
  };
  const auto dof = [&](double DofSpec::*number) {
    return robot([number](RobotSpec& r, double x) { r.dofs[0].*number = x; });
  };
  check_verdicts(limit_rule, "min", joint(&JointSpec::min));
  check_verdicts(limit_rule, "max", joint(&JointSpec::max));
  check_verdicts(limit_rule, "rest", joint(&JointSpec::rest));
  check_verdicts(not_negative_rule, "viscous", joint(&JointSpec::viscous));
  check_verdicts(not_negative_rule, "coulomb", joint(&JointSpec::coulomb));
  check_verdicts(not_negative_rule, "spring", joint(&JointSpec::spring));
  check_verdicts(positive_rule, "ratio", robot([](RobotSpec& r, double x) {
                   // negative ones reverse the direction
                   joint_of(r, 0, 0).ratio = std::copysign(x, -1);
                   if (x < 0) joint_of(r, 0, 0).ratio = 0;
                 }));
  check_verdicts(number_rule, "default velocity", dof(&DofSpec::default_velocity));
  check_verdicts(limit_rule, "default value", dof(&DofSpec::default_value));
  check_verdicts(number_rule, "Kp", dof(&DofSpec::kp));
  check_verdicts(number_rule, "Kd", dof(&DofSpec::kd));
  check_verdicts(number_rule, "dragger scale", dof(&DofSpec::dragger_scale));
  check_verdicts(not_negative_rule, "max effort", dof(&DofSpec::max_effort));
  check_verdicts(not_negative_rule, "max velocity", dof(&DofSpec::max_velocity));
  check_verdicts(not_negative_rule, "breakaway torque", dof(&DofSpec::breakaway_torque));
  check_verdicts(mass_rule, "mass of a link",
                 robot([](RobotSpec& r, double x) { link_of(r, 0, 0).body.mass = x; }));
}

TEST_CASE("each frame and part of a robot has one rule") {
  const auto at = [](auto frame) {
    return [frame](double x) {
      RobotSpec robot = one_joint();
      frame(robot) = Pose::translation({0, 0, x});
      check_robot(robot);
    };
  };
  check_verdicts(coordinate_rule, "joint",
                 at([](RobotSpec& r) -> Pose& { return joint_of(r, 0, 0).X_PJ; }));
  check_verdicts(coordinate_rule, "link",
                 at([](RobotSpec& r) -> Pose& { return link_of(r, 0, 0).X_JL; }));
  check_verdicts(coordinate_rule, "approach",
                 at([](RobotSpec& r) -> Pose& { return r.X_BA.emplace(); }));
  check_verdicts(coordinate_rule, "tracker",
                 at([](RobotSpec& r) -> Pose& { return r.tracker.emplace().X_BS; }));
  const auto part = [](auto set) {
    return [set](double x) {
      RobotSpec robot = one_joint();
      set(robot, x);
      check_robot(robot);
    };
  };
  check_verdicts(not_negative_rule, "stiffness of a tendon",
                 part([](RobotSpec& r, double x) { r.tendons.emplace_back().stiffness = x; }));
  check_verdicts(not_negative_rule, "length of a tendon",
                 part([](RobotSpec& r, double x) { r.tendons.emplace_back().rest_length = x; }));
  check_verdicts(coordinate_rule, "point of a tendon", part([](RobotSpec& r, double x) {
                   r.tendons.emplace_back().points.emplace_back().p_L.x() = x;
                 }));
  check_verdicts(friction_rule, "friction of a tendon", part([](RobotSpec& r, double x) {
                   r.tendons.emplace_back().points.emplace_back().friction = x;
                 }));
  check_verdicts(not_negative_rule, "radius of a wrapper",
                 part([](RobotSpec& r, double x) { r.wrappers.emplace_back().radius = x; }));
  check_verdicts(coordinate_rule, "corner of a sensor",
                 part([](RobotSpec& r, double x) { r.tactile.emplace_back().low_L.y() = x; }));
  check_verdicts(
      number_rule, "slope of a glove", part([](RobotSpec& r, double x) {
        r.glove = GloveCalibration{Eigen::MatrixXd::Constant(1, 2, x), Eigen::VectorXd::Zero(1)};
      }));
}

TEST_CASE("each number of virtual contacts, eigengrasps and cameras has one rule") {
  check_verdicts(friction_rule, "mu", [](double x) {
    VirtualContactSpec contact;
    contact.mu = x;
    check_virtual_contact(contact, "s");
  });
  check_verdicts(coordinate_rule, "frame", [](double x) {
    VirtualContactSpec contact;
    contact.X_LC.position.z() = x;
    check_virtual_contact(contact, "s");
  });
  check_verdicts(number_rule, "friction edge", [](double x) {
    VirtualContactSpec contact;
    contact.edges.setConstant(6, 1, x);
    check_virtual_contact(contact, "s");
  });
  check_verdicts(number_rule, "eigenvalue", [](double x) {
    EigengraspSet set = identity_eigengrasps(2);
    set.grasps[0].eigenvalue = x;
    check_eigengrasps(set, "s");
  });
  check_verdicts(number_rule, "origin", [](double x) {
    EigengraspSet set = identity_eigengrasps(2);
    set.origin = Eigen::VectorXd::Constant(2, x);
    check_eigengrasps(set, "s");
  });
  check_verdicts(length_rule, "focal distance",
                 [](double x) { check_camera({.X_WC = {}, .focal_distance = x}); });
  check_verdicts(coordinate_rule, "camera", [](double x) {
    check_camera({.X_WC = Pose::translation({x, 0, 0})});
  });
}

TEST_CASE("a position is close enough for queries, and its quaternion is normalized") {
  CHECK(is_place({}));
  CHECK(is_place(Pose::translation({1e9, -1e9, 0})));
  CHECK_THROWS_WITH_AS(check_place(Pose::translation({0, 0, 1e308}), "arm"),
                       "arm: expected a position within 1e+09 m of the origin, got (0, 0, 1e+308)",
                       Error);
  CHECK_THROWS_WITH_AS(check_place(Pose::turn(Eigen::Quaterniond(2, 0, 0, 0)), "arm"),
                       "arm: expected a unit quaternion, got one of length 2", Error);
  CHECK_THROWS_AS(check_place(Pose::turn(Eigen::Quaterniond(NAN, 0, 0, 0)), "arm"), Error);
}

// --- names ---

TEST_CASE("a name has no control characters, is UTF-8 and not too long") {
  for (const char* name : {"", "cup", "left hand",
                           "Gr\xC3\xBC\xC3\x9F"
                           "e",
                           "\xE6\x9D\xAF", "a'b\"c"})
    CHECK(name_fault(name).empty());
  CHECK(name_fault(std::string(250, 'x')).empty());
  CHECK_THROWS_WITH_AS(check_name("a\nb", "body"),
                       "body: name: expected no control characters, got 'a?b'", Error);
  for (const char* name : {"\x1b[2J", "a\tb", "\x7f", "\xC2\x9B"})
    CHECK(name_fault(name).starts_with("expected no control characters, got "));
  CHECK(name_fault("\xFF").starts_with("expected text in UTF-8, got "));
  CHECK(name_fault(std::string(251, 'x')) == "expected at most 250 bytes, got 251");
}

TEST_CASE("a name from a file is repaired to a valid name") {
  CHECK(repaired_name("a\nb\xFF"
                      "c\xC2\x9B"
                      "d") == "a?b?c?d");
  // one '?' per control character, surrogate, and byte that begins no character
  CHECK(repaired_name("a\xE2\x80\xAE"
                      "b\xED\xA0\x80"
                      "c\xE2\x80") == "a?b?c?");
  CHECK(repaired_name("\x80\x80") == "??");
  CHECK(repaired_name("Gr\xC3\xBC\xC3\x9F"
                      "e") ==
        "Gr\xC3\xBC\xC3\x9F"
        "e");
  // no character is cut in two
  std::string name;
  for (int i = 0; i < 200; ++i) name += "\xC3\xBC";
  CHECK(repaired_name(" " + name).size() == 249);
  CHECK(name_fault(repaired_name(" " + name)).empty());
}

// --- inertia ---

static Eigen::Matrix3d diagonal_inertia(double x, double y, double z) {
  return Eigen::Vector3d(x, y, z).asDiagonal();
}

TEST_CASE("an inertia is symmetric and positive definite, and no moment exceeds the others' sum") {
  CHECK(inertia_fault(diagonal_inertia(1, 1, 1)) == InertiaFault::none);
  CHECK(inertia_fault(diagonal_inertia(1, 1, 2)) == InertiaFault::none);     // a disc
  CHECK(inertia_fault(diagonal_inertia(1, 1, 2.02)) == InertiaFault::none);  // one of three digits
  CHECK(inertia_fault(diagonal_inertia(1, 1, 2.03)) == InertiaFault::breaks_triangle);
  CHECK(inertia_fault(diagonal_inertia(100, 1, 1)) == InertiaFault::breaks_triangle);
  for (const auto& none :
       {diagonal_inertia(0, 0, 0), diagonal_inertia(1, 1, 0), diagonal_inertia(-1, 1, 1),
        diagonal_inertia(NAN, 1, 1), diagonal_inertia(INFINITY, 1, 1),
        diagonal_inertia(1e21, 1e21, 1e21), diagonal_inertia(1e-25, 1e-25, 1e-25)})
    CHECK(inertia_fault(none) == InertiaFault::not_definite);
  Eigen::Matrix3d skew = diagonal_inertia(1, 1, 1);
  skew(0, 1) = 0.1;
  CHECK(inertia_fault(skew) == InertiaFault::not_symmetric);
  CHECK_THROWS_WITH_AS(check_inertia(skew, "cup"),
                       "cup: inertia: expected a symmetric matrix, got one that is not", Error);
  CHECK_THROWS_WITH_AS(check_inertia(diagonal_inertia(1, 1, -1), "cup"),
                       "cup: inertia: expected a positive definite matrix with moments of 1e-24 to "
                       "1e+20 m^2 per kilogram, got another",
                       Error);
  CHECK_THROWS_WITH_AS(
      check_inertia(diagonal_inertia(1, 1, 100), "cup"),
      "cup: inertia: expected no moment above the sum of the others, got one of 50 "
      "times that sum",
      Error);
}

TEST_CASE("if one moment is too large, the others are raised") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d repaired =
      with_triangle(turn * diagonal_inertia(1, 2, 5) * turn.transpose());
  CHECK(inertia_fault(repaired) == InertiaFault::none);
  CHECK((repaired - turn * diagonal_inertia(2, 3, 5) * turn.transpose()).cwiseAbs().maxCoeff() <
        1e-14);
}

TEST_CASE("the inertia of a shape is always valid") {
  BodySpec spec;
  spec.shape = Shape::make(box(1, 1, 1), "box");
  for (const double far : {0.0, 1.0, 1e3, 1e9}) {
    spec.com = Eigen::Vector3d(far, 0, 0);
    CHECK(inertia_fault(inertia_of(spec)) == InertiaFault::none);
  }
}
