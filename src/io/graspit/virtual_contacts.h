// Reads and writes virtual contacts: the text files (.vgr) and the XML files of GraspIt!
#pragma once
#include <filesystem>

#include "clench/io/text/find_file.h"
#include "clench/spec/chains.h"

namespace clench {

/// Virtual contacts of a file. It identifies links by chain and number, without reference to a
/// robot's links.
struct VirtualContactSet {
  std::string robot;                         ///< name of the hand for which it was made
  std::vector<ChainPlace> places;            ///< one per contact
  std::vector<VirtualContactSpec> contacts;  ///< their `link` is not set
};

/// The contacts with the links of a robot.
/// throws Error  "contact 2: chain 0 of 'hand' has no link 7"
std::vector<VirtualContactSpec> contacts_on(const RobotSpec& robot, VirtualContactSet set);
/// Contacts of a robot, converted for a file.   name  of the robot
VirtualContactSet contact_set(std::string name, const std::vector<Chain>& chains,
                              std::vector<VirtualContactSpec> contacts);

/// `path` as returned by find_file; the contents determine whether it is text or XML.
/// throws Error  "hand.vgr:7: contact 1: friction edge 3: expected a number, got 'x'"
VirtualContactSet read_virtual_contacts(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

/// The text of an .xml file.
std::string virtual_contacts_xml(const VirtualContactSet& set);

/// The text of a file of that name, .vgr or .xml.   throws Error if the ending is another one
std::string virtual_contacts_text(const VirtualContactSet& set, const std::filesystem::path& path);
/// throws Error as virtual_contacts_text, or if the file cannot be written
void write_virtual_contacts(const VirtualContactSet& set, const std::filesystem::path& path);

/// A contact on an object, as stored by GraspIt!
struct ObjectContact {
  Pose X_OC;           ///< contact frame in the object
  bool placed = true;  ///< false: the file has no point for it, and X_OC is at the origin
  Eigen::Vector3d n_O = Eigen::Vector3d::UnitZ();  ///< unit normal
  double mu = 1;
  FrictionEdges edges;
};

/// Text: a count, then for each contact edges, quaternion, point, normal and coefficient. Files
/// without points, as written by GraspIt!, are accepted with a warning.
std::vector<ObjectContact> read_object_contacts(const std::filesystem::path& path,
                                                const ReadOptions& options = {});
/// throws Error for a contact without a point, or if the file cannot be written
void write_object_contacts(const std::vector<ObjectContact>& contacts,
                           const std::filesystem::path& path);

}  // namespace clench
