// Rules for values that are used unchanged, but look like errors of unit.
#pragma once
#include "clench/base/diagnostic.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// Is it ten times denser than any metal, or lighter than air, given the volume of its surface?
/// returns  a sentence; "" if it is plausible
std::string doubt_mass(double mass, const Shape* shape);
/// Is a modulus outside the range of graspable materials? [Pa]
/// returns  likewise, "1.5 Pa is ..."
std::string doubt_modulus(double modulus);
/// Is gravity ten times that of the earth? [m/s^2]
/// returns  likewise
std::string doubt_gravity(const Eigen::Vector3d& gravity);

/// For a body to be grasped: smaller than a millimeter or larger than 3 m, or without area; a mass,
/// a center of mass or an inertia that contradicts its surface.
/// `place`: beginning of the sentence, w.wld:3
void check_plausible_object(const BodySpec& body, const Place& place,
                            const Diagnostics& diagnostics);

/// For a robot: the same for its parts, or heavier than a tonne; joints that turn more than four
/// times; default values outside the limits.
/// `file`: beginning of the sentences
void check_plausible(const RobotSpec& robot, const Place& file, const Diagnostics& diagnostics);

/// "'a', 'b' and 7 more"
std::string some_names(const std::vector<std::string>& names);

}  // namespace clench
