// Motions of MJCF scenes, compared with those of MuJoCo at small steps.
#include <doctest/doctest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <memory>

#include "clench/base/random.h"
#include "clench/dynamics/stepper.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "support/cases.h"
#include "support/folder.h"
#include "support/listening.h"
#include "support/mujoco.h"

using namespace clench;
using clench::test::cases;

namespace {

// A scene in both engines, from one file.
struct Both {
  test::MujocoModel model;
  test::MujocoData data;
  World world;

  Both(const std::string& mjcf, double step) {
    const test::TemporaryFolder folder;
    const auto path = folder.write("scene.xml", mjcf);
    std::array<char, 1000> error = {};
    model.reset(mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    INFO(std::string(error.data()));
    REQUIRE(model);
    data.reset(mj_makeData(model.get()));
    ReadOptions options;
    options.diagnostics =
        test::Listening{.warn = [](const std::string&) {}, .note = [](const std::string&) {}};
    world = build_world(read_world(path, options));
    DynamicSettings settings = world.dynamic_settings();
    settings.step = step;
    for (const auto id : world.robots()) settings.robots[id].gravity_compensation = false;
    world.set_dynamic_settings(settings);
    for (DofControl& control : world.edit_dynamics().controls) control.mode = ControlMode::effort;
  }
  // the same effort of a joint's motor in both engines, with joints and motors in the same order
  void push(int joint, double effort) {
    world.edit_dynamics().controls[joint].effort = effort;
    data->ctrl[joint] = effort;
  }
  void run(double seconds) {
    Stepper(world).run(seconds);
    while (data->time < seconds - 1e-9) mj_step(model.get(), data.get());
  }
  Eigen::VectorXd joints() const {
    const auto q = world.dofs(world.robots()[0]);
    return Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
  }
  Eigen::VectorXd their_joints() const {
    return Eigen::Map<const Eigen::VectorXd>(data->qpos, model->nq);
  }
  // of the first free body
  Eigen::Vector3d position() const {
    for (const auto id : world.bodies())
      if (world.body(id).kind == BodyKind::object) return world.pose(id).position;
    return Eigen::Vector3d::Constant(NAN);
  }
  Eigen::Vector3d their_position() const {
    for (int j = 0; j < model->njnt; ++j)
      if (model->jnt_type[j] == mjJNT_FREE)
        return Eigen::Map<const Eigen::Vector3d>(data->qpos + model->jnt_qposadr[j]);
    return Eigen::Vector3d::Constant(NAN);
  }
};

constexpr double step = 2e-4;  // [s]

// MuJoCo contacts that are almost rigid, and cones that almost never slip
std::string scene_of(const std::string& world, const std::string& more = "") {
  return "<mujoco><compiler angle='radian'/><option timestep='0.0002' integrator='implicit' "
         "cone='elliptic' impratio='100' noslip_iterations='0'/><default><geom condim='3' "
         "solref='0.002 1' solimp='0.98 0.999 0.0001'/></default><worldbody>" +
         world + "</worldbody>" + more + "</mujoco>";
}

std::string vec(Random& random, double size) {
  return fmt::format("{:.4f} {:.4f} {:.4f}", random.uniform(-size, size),
                     random.uniform(-size, size), random.uniform(-size, size));
}

// A chain of capsules on joints with springs, dampers and rotors, one motor per joint.
std::string random_chain(Random& random, int links) {
  std::string open, close, motors;
  for (int i = 0; i < links; ++i) {
    const bool slides = random.uniform() < 0.3;
    open += fmt::format(
        "<body pos='{}'><joint name='j{}' type='{}' axis='{}' damping='{:.4f}' stiffness='{:.4f}' "
        "springref='{:.3f}' armature='{:.4f}'/><geom type='capsule' contype='0' conaffinity='0' "
        "size='0.02' mass='{:.3f}' fromto='0 0 0 {}'/>",
        vec(random, 0.2), i, slides ? "slide" : "hinge", vec(random, 1),
        random.uniform() < 0.5 ? random.uniform(0, 0.3) : 0,
        random.uniform() < 0.5 ? random.uniform(0, 20) : 0, random.uniform(-0.5, 0.5),
        random.uniform(0.001, 0.02), random.uniform(0.1, 1.5), vec(random, 0.3));
    close += "</body>";
    motors += fmt::format("<motor joint='j{}'/>", i);
  }
  return scene_of(open + close, "<actuator>" + motors + "</actuator>");
}

}  // namespace

TEST_CASE("random chains, passive and driven, swing as in MuJoCo") {
  Random random(21);
  for (int round = 0; round < cases(24); ++round) {
    const int links = 1 + round % 4;
    const std::string mjcf = random_chain(random, links);
    Eigen::VectorXd efforts = Eigen::VectorXd::Zero(links);
    if (round % 2 == 1)
      for (double& effort : efforts) effort = random.uniform(-1, 1);
    // Clench is of first order in the step; the extrapolation of two steps is of second order
    std::array<Eigen::VectorXd, 2> ours;
    Eigen::VectorXd theirs;
    for (const int half : {0, 1}) {
      Both both(mjcf, half ? step / 2 : step);
      REQUIRE(both.world.robots().size() == 1);
      REQUIRE(both.joints().size() == links);
      both.model->opt.integrator = mjINT_RK4;
      for (int i = 0; i < links; ++i) both.push(i, efforts[i]);
      both.run(0.25);
      ours[half] = both.joints();
      theirs = both.their_joints();
    }
    CAPTURE(round);
    const Eigen::VectorXd limit = 2 * ours[1] - ours[0];
    CHECK((limit - theirs).cwiseAbs().maxCoeff() < 1e-4 * (1 + theirs.cwiseAbs().maxCoeff()));
  }
}

TEST_CASE("boxes and balls slide, roll, stop and tip to the same final poses as in MuJoCo") {
  Random random(22);
  for (int round = 0; round < cases(12); ++round) {
    // avoids the angle at which a box begins to slide, where both engines creep
    const double mu = random.uniform(0.2, 0.6), angle = std::atan(mu) * (round % 2 ? 0.6 : 1.6);
    const bool ball = round % 3 == 0;
    const std::string shape =
        ball ? "type='sphere' size='0.03'"
             : fmt::format("type='box' size='{:.3f} {:.3f} {:.3f}'", random.uniform(0.03, 0.06),
                           random.uniform(0.03, 0.06), random.uniform(0.01, 0.02));
    const double height = ball ? 0.03 : 0.03;
    Both both(scene_of(fmt::format(
                  "<geom type='box' size='5 1 0.1' pos='0 0 -0.1' friction='{0:.4f} 0 0'/>"
                  "<body pos='0 0 {1}'><freejoint/><geom {2} mass='0.3' friction='{0:.4f} 0 0'/>"
                  "</body>",
                  mu, height, shape)),
              step);
    const Eigen::Vector3d gravity = 9.81 * Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
    both.world.set_gravity(gravity);
    for (int k = 0; k < 3; ++k) both.model->opt.gravity[k] = gravity[k];
    both.run(0.3);
    CAPTURE(round);
    CHECK((both.position() - both.their_position()).norm() < 3e-3);
  }
}

TEST_CASE("jaws hold and drop the same objects as in MuJoCo") {
  Random random(23);
  int held = 0, rounds = cases(12);
  for (int round = 0; round < rounds; ++round) {
    const double mu = random.uniform(0.3, 0.8), half = random.uniform(0.01, 0.02),
                 mass = random.uniform(0.1, 0.5);
    // 2 mu F compared with m g, 1.5 times as large or as small: near equality the engines may
    // differ
    const double force = mass * 9.81 / (2 * mu) * (round % 2 ? 1.5 : 1 / 1.5);
    const auto jaw = [&](const char* name, int side) {
      return fmt::format(
          "<body name='{0}' pos='{1} 0 0'><joint name='{0}' type='slide' axis='{2} 0 0' "
          "limited='true' range='-0.05 0.05' damping='5'/><geom type='box' size='0.01 0.02 0.02' "
          "mass='0.2' "
          "friction='{3:.4f} 0 0'/></body>",
          name, side * (half + 0.0101), -side, mu);
    };
    Both both(scene_of("<body name='hand' pos='0 0 0.5'>" + jaw("left", -1) + jaw("right", 1) +
                           fmt::format("</body><body name='thing' pos='0 0 0.5'><freejoint/><geom "
                                       "type='box' size='{0:.4f} 0.015 0.015' mass='{1:.4f}' "
                                       "friction='{2:.4f} 0 0'/></body>",
                                       half, mass, mu),
                       "<actuator><motor joint='left'/><motor joint='right'/></actuator>"),
              step);
    both.push(0, force), both.push(1, force);
    both.run(0.4);
    CAPTURE(round);
    const bool ours = both.position().z() > 0.45, theirs = both.their_position().z() > 0.45;
    CHECK(ours == theirs);
    CHECK(ours == (round % 2 == 1));
    held += ours;
  }
  CHECK(held == rounds / 2);
}
