// States of a world as keys of a scene: positions of joints, and controls of motors.
#pragma once
#include <string>
#include <vector>

#include "clench/io/mjcf_write/written_actuators.h"
#include "clench/io/mjcf_write/written_carriage.h"

namespace clench {

/// The current state of the world as a key.
WrittenKey present_key(const WorldSpec& world, const std::string& name);
/// A keyframe of the world; bodies that it does not contain keep their current poses.
WrittenKey key_of(const WorldSpec& world, const KeyframeSpec& keyframe);

/// Positions of all joints if they follow their DOFs [rad or m].
std::vector<double> joints_at(const RobotSpec& robot, const std::vector<double>& dofs);

/// Positions in MuJoCo's order, body by body.
std::vector<double> positions_of(const WrittenKey& key, const WrittenScene& scene,
                                 const Carriage& carriage);
/// Controls with which the motors hold the posture and exert the efforts of the key.
std::vector<double> controls_of(const WrittenKey& key, const SceneRequest& request,
                                const WrittenDrives& drives, const Carriage& carriage);
/// Names of bodies that the key moves although the scene has no joint for them.
std::vector<std::string> unmoved_in(const WrittenKey& key, const WrittenScene& scene);

}  // namespace clench
