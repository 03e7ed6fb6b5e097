// Virtual contacts from and to files: the text files (.vgr) and the XML files of GraspIt!
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/chains.h"

namespace clench {

/// A file's virtual contacts. It names links by chain and number, of a robot that it does not know.
struct VirtualContactSet {
  std::string robot;                         ///< name of the hand that it was made for
  std::vector<ChainPlace> places;            ///< one per contact
  std::vector<VirtualContactSpec> contacts;  ///< whose `link` says nothing
};

/// As they are on a robot.
/// throws Error  "contact 2: chain 0 of 'hand' has no link 7"
std::vector<VirtualContactSpec> contacts_on(const RobotSpec& robot, VirtualContactSet set);
/// A robot's, for a file.   name  of the robot
VirtualContactSet contact_set(std::string name, const std::vector<Chain>& chains,
                              std::vector<VirtualContactSpec> contacts);

/// `path` as find_file gives it; text or XML, by what stands in it.
/// throws Error  "hand.vgr:7: contact 1: friction edge 3: expected a number, got 'x'"
VirtualContactSet read_virtual_contacts(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

/// The text of an .xml.
std::string virtual_contacts_xml(const VirtualContactSet& set);

/// The text of a file of that name, .vgr or .xml.   throws Error when the ending is another one
std::string virtual_contacts_text(const VirtualContactSet& set, const std::filesystem::path& path);
/// throws Error as virtual_contacts_text, or when the file cannot be written
void write_virtual_contacts(const VirtualContactSet& set, const std::filesystem::path& path);

/// A contact on an object, as the original stores them.
struct ObjectContact {
  Pose X_OC;           ///< contact frame in the object
  bool placed = true;  ///< false: the file leaves the point out, and X_OC is at the origin
  Eigen::Vector3d n_O = Eigen::Vector3d::UnitZ();  ///< unit normal
  double mu = 1;
  FrictionEdges edges;
};

/// Text: a count, then of each contact edges, quaternion, point, normal and coefficient. Files
/// without the points, as the original writes them, are read too, with a warning.
std::vector<ObjectContact> read_object_contacts(const std::filesystem::path& path,
                                                const ReadOptions& options = {});
/// throws Error for a contact that is not placed, or when the file cannot be written
void write_object_contacts(const std::vector<ObjectContact>& contacts,
                           const std::filesystem::path& path);

}  // namespace clench
