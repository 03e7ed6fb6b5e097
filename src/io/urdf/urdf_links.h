// Links of a URDF: masses, geometry and colors.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clench/io/tree/tree_links.h"
#include "clench/io/tree/tree_xml.h"

namespace clench {

/// Links of a robot in the file's order, without their parents.
struct UrdfLinks {
  std::vector<TreeLink> links;
  std::vector<LinkPieces> pieces;      ///< one per link
  std::map<std::string, int> numbers;  ///< indices by name
};

class UrdfLinkReader {
 public:
  /// unused, repairs  records of the reader of the file, which outlive this one
  UrdfLinkReader(const std::filesystem::path& path, FileCache& cache, UnusedXml& unused,
                 Repairs& repairs)
      : path_(path),
        cache_(cache),
        unused_(unused),
        repairs_(repairs),
        geometry_(cache.options()) {}

  /// Reads the materials of the robot, to which those of links may refer by name.
  void read_materials(const XmlElement& robot);
  /// throws  Error for an invalid link. An invalid inertial and a missing visual mesh are reported
  void read_link(const XmlElement& element);
  /// The links that were read.
  UrdfLinks take() { return std::move(given_); }
  TreeGeometry& geometry() { return geometry_; }
  /// Reports invalid inertias and missing visual meshes, each kind in one message.
  void report() const;

 private:
  void read_inertial(const XmlElement& element, BodySpec& body, LinkPieces& pieces);
  std::optional<GeometryPiece> read_piece(const XmlElement& element, const std::string& link,
                                          bool visual);
  XmlElement shape_of(const XmlElement& geometry, const std::string& link);
  std::optional<GeometryPiece> read_shape(const XmlElement& shape, bool visual);
  std::optional<GeometryPiece> read_mesh(const XmlElement& shape, bool visual);
  std::optional<PieceColor> read_color(const XmlElement& material);
  void warn_of_undrawn() const;

  const std::filesystem::path& path_;
  FileCache& cache_;
  UnusedXml& unused_;
  Repairs& repairs_;
  TreeGeometry geometry_;
  InertialFaults inertial_faults_;
  std::map<std::string, PieceColor> materials_;
  UrdfLinks given_;
  size_t piece_count_ = 0;
  int undrawn_ = 0;  // visual meshes that are missing
  Diagnostic first_undrawn_;
};

/// The pose in the element <origin> of a link's part or a joint; the identity without one.
Pose read_urdf_origin(const XmlElement& element, UnusedXml& unused);

}  // namespace clench
