// What a file describes, told from its ending and, in XML, from its outermost element. The one list
// of the endings that are read.
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

/// path  of a file that exists. One whose ending says nothing is known by how its numbers stand.
/// throws Error  "notes.txt: expected a model, a world, or a file that goes with one, got '.txt'"
FileKind file_kind(const std::filesystem::path& path);

/// What a text of nothing but numbers describes; empty when it is no such text, or fits none.
std::optional<FileKind> kind_of_numbers(const std::string& text);

/// "body", "robot", "world", "eigengrasps", "virtual contacts", "object contacts", "pre-grasps",
/// "planned grasps", "glove calibration", "glove poses", "grasps"
const char* kind_name(FileKind kind);

/// Who reads a file of geometry.
enum class GeometryFormat { none, inventor, off, ply, obj, stl, gltf, collada };

/// In small letters: ".iv"; empty when there is none.
std::string ending_of(const std::filesystem::path& path);

/// none: no file of that ending holds geometry alone
GeometryFormat geometry_format(std::string_view ending);

/// Is it an Inventor or VRML file?
bool is_inventor(const std::filesystem::path& path);

/// Endings of files of geometry, in the order in which they are tried; of a body's, .xml first.
std::vector<std::string> geometry_endings();
std::vector<std::string> body_endings();
/// Those of one format.
std::vector<std::string> endings_of(GeometryFormat format);

/// For a sentence: ".iv, .wrl or .off"
std::string one_of(const std::vector<std::string>& endings);

}  // namespace clench
