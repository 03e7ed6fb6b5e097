// An MJCF file with all included and attached files: its elements, the defaults of their classes,
// and the settings for reading its numbers.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clench/io/mesh/texture_files.h"
#include "clench/io/mjcf/document/mjcf_settings.h"
#include "clench/io/text/file_cache.h"
#include "clench/math/pose.h"

namespace clench {

/// An element with its children, including those of included files and generated ones.
struct MjcfNode {
  XmlElement element;
  std::vector<MjcfNode> children;

  std::string name() const { return std::string(element.name()); }
};

/// The rotation given by three Euler angles, in the file's unit and sequence of axes.
Eigen::Quaterniond euler_turn(const MjcfSettings& settings, const std::vector<double>& angles);

/// Rotation of z to a unit vector along the shortest arc; for -z half a turn about x, as in MuJoCo.
Eigen::Quaterniond turn_z_to(const Eigen::Vector3d& direction);

class MjcfDocument {
 public:
  /// Reads the elements unexpanded; expand_mjcf replaces those that generate others.
  /// throws  Error for malformed XML, circular includes, unknown classes, unsupported settings
  MjcfDocument(const std::filesystem::path& path, FileCache& cache);

  const MjcfNode& root() const { return root_; }
  const std::filesystem::path& path() const { return path_; }
  const std::string& file() const { return file_; }
  /// Children of all top-level sections of a name, "worldbody", in order.
  std::vector<const MjcfNode*> section(const std::string& name) const;

  /// Attributes of an element with the defaults of its class, otherwise of `child_class`. Defaults
  /// are in elements with its name, or with the name `also`.
  XmlValues values(const XmlElement& element, const std::string& child_class = "",
                   const char* also = nullptr) const;
  /// Elements of these names that give the defaults of an element, the nearest first.
  std::vector<XmlElement> defaults(const XmlElement& element, const std::string& child_class,
                                   std::span<const std::string_view> names) const;
  void check_class(const XmlElement& element, const std::string& name) const;

  /// Settings of the file that contains an element.
  const MjcfSettings& settings(const XmlElement& element) const {
    return *settings_.at(element.file());
  }
  /// The orientation of the nearest element or class that gives axisangle, euler, xyaxes or zaxis,
  /// otherwise quat.
  Eigen::Quaterniond orientation(const XmlValues& values) const;
  Pose pose(const XmlValues& values) const;  ///< pos and orientation
  /// The mesh file that an element's attribute `file` names.   throws  Error of find_file
  std::filesystem::path mesh_file(const XmlValues& asset, const ReadOptions& options) const;

  /// The image that a texture's attribute `file` names; null, with a warning, if it cannot be read.
  std::shared_ptr<const Image> texture_image(const XmlValues& asset, const ReadOptions& options,
                                             TextureFiles& files,
                                             const TextureFiles::Warn& warn) const;

  UnusedXml& unused() { return unused_; }
  Repairs& repairs() { return repairs_; }
  /// Contents of the file that are not used, reported once per kind.
  Repairs& losses() { return losses_; }

 private:
  friend class MjcfExpander;
  struct DefaultClass {
    int parent = -1;
    /// By name, each with its number in the file.
    std::map<std::string, std::vector<std::pair<int, XmlElement>>, std::less<>> elements;
  };
  /// The file named by its attribute `file`, relative to a folder of the settings.
  std::string asset_file(const XmlValues& asset, const std::string& folder) const;
  /// The root element of a file with all included files.
  MjcfNode load_file(const std::filesystem::path& path);
  MjcfNode load(const XmlElement& element, int depth);
  void include(const XmlElement& element, std::vector<MjcfNode>& into, int depth);
  /// Reads the classes of a file and adds a prefix to their names; "main" is its global class.
  void add_classes(const MjcfNode& root, const std::string& prefix);
  void read_defaults(const MjcfNode& node, int parent, const std::string& prefix, int outermost);
  const XmlFile& open(const std::filesystem::path& path);

  std::filesystem::path path_;
  std::string file_;
  FileCache& cache_;
  std::vector<std::unique_ptr<XmlFile>> files_;
  std::vector<std::filesystem::path> open_;  // the file and the chain of files that include it
  std::vector<std::shared_ptr<MjcfSettings>> reading_;  // of the models being loaded
  std::map<const std::string*, std::shared_ptr<MjcfSettings>> settings_;  // by XmlElement::file
  XmlCopies copies_;
  MjcfNode root_;
  std::vector<DefaultClass> classes_;  // [0] is "main"
  std::map<std::string, int> class_numbers_;
  int default_elements_ = 0;
  UnusedXml unused_;
  Repairs repairs_, losses_;
};

}  // namespace clench
