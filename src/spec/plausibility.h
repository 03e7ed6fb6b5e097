// What is used as it stands and looks like a unit mistaken for another: one rule each.
#pragma once
#include "clench/base/listeners.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// Ten times denser than any metal, or lighter than air, by the volume of its surface?   returns  a
/// sentence; "" when it is plausible
std::string doubt_mass(double mass, const Shape* shape);
/// Is a modulus that of nothing that is grasped?   [Pa]   returns  likewise, "1.5 Pa is ..."
std::string doubt_modulus(double modulus);
/// Is gravity ten times that of the earth?   [m/s^2]   returns  likewise
std::string doubt_gravity(const Eigen::Vector3d& gravity);

/// Of a body that is to be grasped: smaller than a millimetre or larger than 3 m, or without area;
/// a mass, a centre of mass or an inertia that contradicts its surface.
/// `place`: what the sentence begins with, "w.wld:3"
void check_plausible_object(const BodySpec& body, const std::string& place,
                            const Listeners& listeners);

/// Of a robot: the same of its parts, or one heavier than a tonne; joints that turn more than four
/// times; default values outside the limits.   `file`: what the sentences begin with
void check_plausible(const RobotSpec& robot, const std::string& file, const Listeners& listeners);

/// "'a', 'b' and 7 more"
std::string some_names(const std::vector<std::string>& names);

}  // namespace clench
