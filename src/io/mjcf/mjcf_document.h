// An MJCF file with all that it includes: its elements, the defaults of their classes, and the
// settings that tell how its numbers are meant.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clench/io/text/file_cache.h"
#include "clench/io/tree/tree_xml.h"
#include "clench/math/pose.h"

namespace clench {

/// An element with its children, those of included files among them.
struct MjcfNode {
  XmlElement element;
  std::vector<MjcfNode> children;

  std::string name() const { return std::string(element.name()); }
};

class MjcfDocument {
 public:
  /// throws  Error for malformed XML, circles of includes, unknown classes, settings we cannot
  ///         follow
  MjcfDocument(const std::filesystem::path& path, FileCache& cache);

  const MjcfNode& root() const { return root_; }
  const std::filesystem::path& path() const { return path_; }
  const std::string& file() const { return file_; }
  /// Children of all top-level sections of a name, "worldbody", in order.
  std::vector<const MjcfNode*> section(const std::string& name) const;

  /// Attributes of an element with the defaults of its class, else of `child_class`. Defaults stand
  /// under the element's own name, or `also`.
  XmlValues values(const XmlElement& element, const std::string& child_class = "",
                   const char* also = nullptr) const;
  /// Elements of these names that give the defaults of an element, the nearest first.
  std::vector<XmlElement> defaults(const XmlElement& element, const std::string& child_class,
                                   std::span<const std::string_view> names) const;
  void check_class(const XmlElement& element, const std::string& name) const;

  double angle(double value) const { return value * angle_unit_; }  ///< to [rad]
  double angle_unit() const { return angle_unit_; }
  bool autolimits() const { return autolimits_; }
  bool inertia_from_geoms() const { return inertia_from_geoms_; }
  /// quat, axisangle, euler, xyaxes or zaxis
  Eigen::Quaterniond orientation(const XmlValues& values) const;
  Pose pose(const XmlValues& values) const;  ///< pos and orientation
  /// The file of a mesh as its element names it.   throws  Error of find_file
  std::filesystem::path mesh_file(const std::string& name, const ReadOptions& options) const;

  UnusedXml& unused() { return unused_; }
  Repairs& repairs() { return repairs_; }

 private:
  struct DefaultClass {
    int parent = -1;
    std::vector<XmlElement> elements;
  };
  MjcfNode load(const XmlElement& element, int depth);
  void include(const XmlElement& element, std::vector<MjcfNode>& into, int depth);
  void read_defaults(const MjcfNode& node, int parent);
  void read_compiler(const MjcfNode& node);

  std::filesystem::path path_;
  std::string file_;
  FileCache& cache_;
  std::vector<std::unique_ptr<XmlFile>> files_;
  std::vector<std::filesystem::path> open_;  // the file and those that include one another
  MjcfNode root_;
  std::vector<DefaultClass> classes_;  // [0] is "main"
  std::map<std::string, int> class_numbers_;
  double angle_unit_ = 0;
  bool autolimits_ = true, strip_path_ = false, inertia_from_geoms_ = false;
  std::string euler_ = "xyz", mesh_dir_;
  UnusedXml unused_;
  Repairs repairs_;
};

}  // namespace clench
