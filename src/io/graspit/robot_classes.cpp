#include "clench/io/graspit/robot_classes.h"

#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/text.h"

namespace clench {

void check_class(const std::string& name, const std::string& place,
                 const std::function<void(const std::string&)>& warn) {
  static const std::vector<std::string> classes = {
      "Robot", "Hand",   "Puma560",   "Barrett", "Robonaut", "Pr2Gripper", "Pr2Gripper2010",
      "M7",    "M7Tool", "HumanHand", "Shadow",  "McGrip",   "RobotIQ"};
  if (!warn || std::ranges::find(classes, name) != classes.end()) return;
  warn(fmt::format("{}: robot: unknown type {} has no meaning{}", place, in_quotes(name),
                   did_you_mean(name, classes)));
}

}  // namespace clench
