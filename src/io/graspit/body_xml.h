// Reads bodies from the XML files of GraspIt! 2.1 and later.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/text/file_kind.h"
#include "clench/io/text/xml.h"

namespace clench {

/// A body from a file whose root element, with any name, contains elements such as material, mass
/// and geometryFile.
/// throws Error  "mug.xml:4: mass: expected a number > 0 [g], got -2"
BodySpec read_body_xml(const std::filesystem::path& path, FileCache& cache);

/// The geometry file of a body and its placement: v_B = X_BG * (scaling .* v).
struct PlacedFile {
  std::filesystem::path path;
  GeometryFormat format = GeometryFormat::none;
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
  std::optional<Pose> X_BG = {};
};

/// Empty if the body has none.
/// throws Error at the element's place
std::optional<PlacedFile> read_placed_file(const XmlElement& body,
                                           const std::filesystem::path& path,
                                           const ReadOptions& options);

/// throws Error  "hand.xml:2: expected a body, got <robot>"
void check_body_root(const XmlFile& file);

/// A body from an element with such children; geometry files are looked up relative to `path`. The
/// caller sets name, source and file.
BodySpec read_body_element(const XmlElement& element, const std::filesystem::path& path,
                           FileCache& cache);

}  // namespace clench
