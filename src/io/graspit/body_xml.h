// Bodies from the XML files of GraspIt! 2.1 and later.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/text/file_kind.h"
#include "clench/io/text/xml.h"

namespace clench {

/// A file whose outermost element, of any name, holds material, mass, geometryFile and the like.
/// throws Error  "mug.xml:4: mass: expected a number > 0 [g], got -2"
BodySpec read_body_xml(const std::filesystem::path& path, FileCache& cache);

/// The file of a body's geometry, and where it stands: v_B = X_BG * (scaling .* v).
struct PlacedFile {
  std::filesystem::path path;
  GeometryFormat format = GeometryFormat::none;
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
  std::optional<Pose> X_BG = {};
};

/// Empty when the body has none.
/// throws Error at the element's place
std::optional<PlacedFile> read_placed_file(const XmlElement& body,
                                           const std::filesystem::path& path,
                                           const ReadOptions& options);

/// throws Error  "hand.xml:2: expected a body, got <robot>"
void check_body_root(const XmlFile& file);

/// An element with such children; geometry is looked for beside `path`. Leaves name, source and
/// file to the caller.
BodySpec read_body_element(const XmlElement& element, const std::filesystem::path& path,
                           FileCache& cache);

}  // namespace clench
