// What a URDF cannot say, written as the element that urdf/urdf_clench reads.
#pragma once
#include "clench/io/urdf_plan.h"

namespace clench {

/// Names of files beside, from the robot's folder on; empty: there is none.
struct UrdfBeside {
  std::string eigengrasps = {}, virtual_contacts = {}, glove = {};
};

/// <clench> ... </clench>, indented by two; empty when all of it is as a reader would have it anyway.
std::string clench_element(const RobotSpec& robot, const UrdfPlan& plan, const UrdfBeside& beside);

}  // namespace clench
