// Parts shared by GraspIt!'s text and XML worlds: values of DOFs, connections, cameras.
#pragma once
#include <optional>
#include <string>

#include "clench/base/diagnostic.h"
#include "clench/base/text.h"
#include "clench/io/text/find_file.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// Values of the robot's DOFs in order [rad or mm]. The value of a breakaway DOF is followed, for
/// each of its joints, by 0, or by 1 and the DOF value at which the joint broke away. A line with
/// exactly one value per DOF is accepted, too; DOFs with missing values start at their defaults.
/// throws Error at the line's place
void read_dof_values(const Line& line, PlacedRobot& placed, const Diagnostics& diagnostics);
std::string dof_values(const PlacedRobot& placed);

/// A connection in a file: the parent's chain, to whose last link the child is attached.
struct ConnectionPlace {
  Place place;
  int chain = 0;
};
/// Finds the links of the world's connections after all robots are read.
/// places  one per connection
/// throws  Error, beginning with the connection's place, if its robots or chain do not exist,
///         connections form a cycle, or a robot is attached twice
void find_connections(WorldSpec& world, const std::vector<ConnectionPlace>& places);
/// The parent's chain of a connection, for files.
/// throws  Error "...: 'hand' is carried by a link ... that ends no chain"
int chain_of(const WorldSpec& world, const Connection& connection);

/// Orientation of a camera, in Inventor's order x y z w; empty, with a warning, if it is not a
/// rotation.   subject  begins the message: "mug.wld:7: camera orientation"
std::optional<Eigen::Quaterniond> camera_orientation(const Eigen::Vector4d& xyzw,
                                                     const Place& subject,
                                                     const ReadOptions& options);

/// Empty, with a warning, if check_camera rejects the camera.
std::optional<Camera> checked_camera(const Camera& camera, const Place& place,
                                     const ReadOptions& options);

/// The shortest decimal that gives exactly this value after multiplication by `unit` and then by
/// `factor`; if there is none, the nearest.
std::string number_in(double value, double unit, double factor = 1);

/// "(w x y z)[x y z]", in millimeters.
std::string full_transform(const Pose& pose);
std::string transform_element(const Pose& pose);       ///< <transform>, indented by four
std::string millimeters(const Eigen::Vector3d& p);     ///< "x y z"
std::string orientation(const Eigen::Quaterniond& q);  ///< "x y z w"

}  // namespace clench
