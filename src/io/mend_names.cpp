#include "io/mend_names.h"

#include "base/error.h"
#include "base/text.h"

namespace clench {

static void mend_name(std::string& name, const std::string& place, const ReadOptions& options) {
  const std::string wrong = name_fault(name);
  if (wrong.empty()) return;
  name = mended_name(name);
  options.mended(fmt::format("{}: name: {}; it becomes '{}'", place, wrong, excerpt(name)));
}

void mend_names(BodySpec& body, const std::string& place, const ReadOptions& options) {
  mend_name(body.name, place, options);
}

static void mend_robot_names(RobotSpec& robot, const std::string& place,
                             const ReadOptions& options) {
  const auto mend = [&](std::string& name) { mend_name(name, place, options); };
  for (std::string* name : {&robot.name, &robot.class_name, &robot.database_name, &robot.base.name})
    mend(*name);
  for (DofSpec& dof : robot.dofs) mend(dof.name);
  for (ChainSpec& chain : robot.chains) {
    for (JointSpec& joint : chain.joints) mend(joint.name);
    for (LinkSpec& link : chain.links) mend(link.body.name);
  }
  for (TendonSpec& tendon : robot.tendons) mend(tendon.name);
  for (TendonWrapper& wrapper : robot.wrappers) {
    for (std::string& name : wrapper.exempt) mend(name);
    for (TendonWrapper::Side& side : wrapper.sides) mend(side.tendon);
  }
}

void check_read_robot(RobotSpec& robot, const std::string& place, const ReadOptions& options) {
  mend_robot_names(robot, place, options);
  try {
    check_robot(robot);
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
}

}  // namespace clench
