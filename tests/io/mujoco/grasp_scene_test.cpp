// Grasps in scenes written by grasp:save, lifted in MuJoCo.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "clench/script/host/state.h"
#include "support/folder.h"
#include "support/mujoco.h"

using namespace clench;
using namespace clench::test;

namespace {

/// Runs a scene from the key "grasp" to the key "lift", and holds it there for a while.
class SceneLift {
 public:
  explicit SceneLift(const std::filesystem::path& path) {
    char error[1000] = "";
    model_.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
    REQUIRE_MESSAGE(model_, error);
    data_.reset(mj_makeData(model_.get()));
    grasp_ = key("grasp"), lift_ = key("lift");
    for (int j = 0; j < model_->njnt; ++j)
      if (model_->jnt_type[j] == mjJNT_FREE) object_ = model_->jnt_bodyid[j];
    base_ = model_->jnt_bodyid[mj_name2id(model_.get(), mjOBJ_JOINT, "carriage_x")];
    mj_resetDataKeyframe(model_.get(), data_.get(), grasp_);
    mj_forward(model_.get(), data_.get());
  }

  /// Distance that the object moves in the hand, and height by which the object rises [m].
  std::pair<double, double> run() {
    const Eigen::Vector3d held = in_hand();
    const double height = data_->xipos[3 * object_ + 2];
    steps(0.5, [](double) { return 0.0; });
    steps(1.5, [](double s) { return s * s * (3 - 2 * s); });
    steps(1, [](double) { return 1.0; });
    return {(in_hand() - held).norm(), data_->xipos[3 * object_ + 2] - height};
  }

 private:
  int key(const char* name) const {
    const int out = mj_name2id(model_.get(), mjOBJ_KEY, name);
    REQUIRE(out >= 0);
    return out;
  }
  // center of mass of the object in the hand's base
  Eigen::Vector3d in_hand() const {
    const double* q = data_->xquat + 4 * base_;
    const Eigen::Vector3d p =
        Eigen::Vector3d(data_->xipos + 3 * object_) - Eigen::Vector3d(data_->xpos + 3 * base_);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * p;
  }
  // controls interpolated from one key to the other
  template <class Share>
  void steps(double seconds, Share share) {
    const int count = static_cast<int>(std::lround(seconds / model_->opt.timestep));
    for (int i = 1; i <= count; ++i) {
      const double s = share(static_cast<double>(i) / count);
      for (int a = 0; a < model_->nu; ++a)
        data_->ctrl[a] = (1 - s) * model_->key_ctrl[grasp_ * model_->nu + a] +
                         s * model_->key_ctrl[lift_ * model_->nu + a];
      mj_step(model_.get(), data_.get());
    }
  }

  MujocoModel model_;
  MujocoData data_;
  int grasp_ = 0, lift_ = 0, object_ = 0, base_ = 0;
};

// a planned grasp saved as it is, and without friction; returns our verdicts
constexpr const char* save_script = R"(
local clench = require "clench"
local folder, hand_file, object_file = ...
local world = clench.world()
local hand = world:add_robot("models/hands/" .. hand_file)
local object = world:add_object("models/objects/" .. object_file)
local run = clench.plan.sample {hand = hand, object = object, count = 1, seed = 3}
local grasp = run.grasps[1]:apply(world)
grasp:save(folder .. "/held.xml")
local held = clench.study.lift {hand = hand, object = object}.survived
for _, body in ipairs(hand.bodies) do
  world:set_friction(body.material, object.material, {static = 0, kinetic = 0})
end
grasp:save(folder .. "/slippery.xml")
local slippery = clench.study.lift {hand = hand, object = object}.survived
return tostring(held), tostring(slippery)
)";

}  // namespace

TEST_CASE("grasps that hold here hold in MuJoCo, and those that slip here slip there") {
  struct Case {
    const char *hand, *object;
  };
  const Case lifted[] = {{"barrett/barrett.cfg", "cylinder.iv"},
                         {"barrett/barrett.cfg", "sphere.iv"},
                         {"parallel_jaw/parallel_jaw.cfg", "box.iv"},
                         {"parallel_jaw/parallel_jaw.cfg", "cube.iv"}};
  int lost = 0;
  for (const auto& [hand, object] : lifted) {
    CAPTURE(std::string(hand));
    CAPTURE(std::string(object));
    const TemporaryFolder folder;
    State state;
    state.set_quiet();
    const std::string code = fmt::format("return load([==[{}]==])('{}', '{}', '{}')", save_script,
                                         folder.path().string(), hand, object);
    const auto result = state.run_code(code, "lift");
    REQUIRE_MESSAGE(result.ok, result.error);
    REQUIRE(result.values.size() == 2);
    CHECK(result.values[0] == "true");
    const auto [moved, risen] = SceneLift(folder.path() / "held.xml").run();
    CHECK(moved < 0.002);
    CHECK(risen == doctest::Approx(0.1).epsilon(0.02));
    // a hand may hold by its shape alone
    const bool rises = SceneLift(folder.path() / "slippery.xml").run().second > 0.05;
    CHECK((result.values[1] == "true") == rises);
    lost += !rises;
  }
  CHECK(lost >= 2);
}
