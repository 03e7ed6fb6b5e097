// Determines the kind of a file by its ending and, for XML, by its root element. Contains the only
// list of supported endings.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clench {

enum class FileKind {
  body,
  robot,
  world,
  eigengrasps,
  virtual_contacts,
  object_contacts,
  pregrasps,
  planned_grasps,
  glove_calibration,
  glove_poses,
  grasps
};

/// path  an existing file. If its ending is unknown, the arrangement of its numbers determines the
///       kind.
/// throws Error  "notes.txt: expected a model, a world, or a file that goes with one, got '.txt'"
FileKind file_kind(const std::filesystem::path& path);

/// The kind of a text that consists only of numbers; empty if it has other contents or matches no
/// kind.
std::optional<FileKind> kind_of_numbers(const std::string& text);

/// "body", "robot", "world", "eigengrasps", "virtual contacts", "object contacts", "pre-grasps",
/// "planned grasps", "glove calibration", "glove poses", "grasps"
const char* kind_name(FileKind kind);

/// File formats of geometry.
enum class GeometryFormat { none, inventor, off, ply, obj, stl, gltf, collada };

/// In lower case: ".iv"; empty if the path has no ending.
std::string ending_of(const std::filesystem::path& path);

/// none: the ending is not one of a format for geometry alone
GeometryFormat geometry_format(std::string_view ending);

/// True for Inventor and VRML files.
bool is_inventor(const std::filesystem::path& path);

/// Endings of geometry files, in the order in which they are tried; those of bodies, .xml first.
std::vector<std::string> geometry_endings();
std::vector<std::string> body_endings();
/// Endings of one format.
std::vector<std::string> endings_of(GeometryFormat format);

/// For messages: ".iv, .wrl or .off"
std::string one_of(const std::vector<std::string>& endings);

}  // namespace clench
