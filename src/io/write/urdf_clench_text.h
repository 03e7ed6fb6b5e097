// Writes properties that URDF has no elements for as the element <clench>, which urdf/urdf_clench
// reads.
#pragma once
#include "clench/io/write/urdf_plan.h"

namespace clench {

/// Names of the additional files, relative to the robot's folder; empty if absent.
struct UrdfBeside {
  std::string eigengrasps = {}, virtual_contacts = {}, glove = {};
};

/// <clench> ... </clench>, indented by two; empty if all its contents are a reader's defaults.
std::string clench_element(const RobotSpec& robot, const UrdfPlan& plan, const UrdfBeside& beside);

}  // namespace clench
