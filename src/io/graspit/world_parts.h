// What the text worlds and the XML worlds write alike: values of DOFs, connections, cameras.
#pragma once
#include <optional>
#include <string>

#include "clench/base/diagnostic.h"
#include "clench/base/text.h"
#include "clench/io/text/find_file.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// Values of the robot's DOFs in their order [rad or mm]; after that of a breakaway DOF, for each
/// of its joints, 0, or 1 and the value of the DOF at which the joint broke away. One value per DOF
/// and nothing else is read too; DOFs whose values lack start at their defaults.
/// throws Error at the line's place
void read_dof_values(const Line& line, PlacedRobot& placed, const Diagnostics& diagnostics);
std::string dof_values(const PlacedRobot& placed);

/// What a file says of a connection: the parent's chain, whose last link it means.
struct ConnectionPlace {
  Place place;
  int chain = 0;
};
/// Finds the links of the world's connections, when all robots are known.
/// places  one per connection
/// throws  Error, begun by the connection's place, when its robots or chain do not exist, carry
///         themselves or one another in a circle, or are carried twice
void find_connections(WorldSpec& world, const std::vector<ConnectionPlace>& places);
/// The parent's chain of a connection, for files.
/// throws  Error "...: 'hand' is carried by a link ... that ends no chain"
int chain_of(const WorldSpec& world, const Connection& connection);

/// Orientation of a camera, in Inventor's order x y z w; empty when they are no rotation, which is
/// told.   `subject`  begins the sentence: "mug.wld:7: camera orientation"
std::optional<Eigen::Quaterniond> camera_orientation(const Eigen::Vector4d& xyzw,
                                                     const Place& subject,
                                                     const ReadOptions& options);

/// A camera that check_camera refuses is none, which is told.
std::optional<Camera> checked_camera(const Camera& camera, const Place& place,
                                     const ReadOptions& options);

/// The shortest decimal that a reader who multiplies it by `unit`, and then by `factor`, turns into
/// the value to the bit; where there is none, the nearest.
std::string number_in(double value, double unit, double factor = 1);

/// "(w x y z)[x y z]", millimeters.
std::string full_transform(const Pose& pose);
std::string transform_element(const Pose& pose);       ///< <transform>, indented by four
std::string millimeters(const Eigen::Vector3d& p);     ///< "x y z"
std::string orientation(const Eigen::Quaterniond& q);  ///< "x y z w"

}  // namespace clench
