#include "clench/io/text/repair_names.h"

#include "clench/base/text.h"
#include "clench/io/text/file_errors.h"
#include "clench/spec/check_robot.h"

namespace clench {

static void repair_name(std::string& name, const Place& place, const ReadOptions& options) {
  const std::string wrong = name_fault(name);
  if (wrong.empty()) return;
  name = repaired_name(name);
  options.diagnostics.repaired(place.of("name"), "{}; it becomes '{}'", wrong, excerpt(name));
}

void repair_names(BodySpec& body, const Place& place, const ReadOptions& options) {
  repair_name(body.name, place, options);
}

static void repair_robot_names(RobotSpec& robot, const Place& place, const ReadOptions& options) {
  const auto repair = [&](std::string& name) { repair_name(name, place, options); };
  for (std::string* name : {&robot.name, &robot.class_name, &robot.database_name, &robot.base.name})
    repair(*name);
  for (DofSpec& dof : robot.dofs) repair(dof.name);
  for (LinkSpec& link : robot.links) {
    for (JointSpec& joint : link.joints) repair(joint.name);
    repair(link.body.name);
  }
  for (TendonSpec& tendon : robot.tendons) repair(tendon.name);
  for (JointTendonSpec& tendon : robot.joint_tendons) repair(tendon.name);
  for (ActuatorSpec& actuator : robot.actuators)
    for (std::string* name : {&actuator.name, &actuator.kind, &actuator.joint, &actuator.tendon})
      repair(*name);
  for (ActuatorSpec& actuator : robot.actuators)
    for (TendonPull& pull : actuator.pulls) repair(pull.joint);
  for (TendonWrapper& wrapper : robot.wrappers) {
    for (std::string& name : wrapper.exempt) repair(name);
    for (TendonWrapper::Side& side : wrapper.sides) repair(side.tendon);
  }
}

void check_read_robot(RobotSpec& robot, const Place& place, const ReadOptions& options) {
  repair_robot_names(robot, place, options);
  errors_at(place, [&] { check_robot(robot); });
}

}  // namespace clench
