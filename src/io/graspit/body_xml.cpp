#include "clench/io/graspit/body_xml.h"

#include <algorithm>
#include <array>

#include "clench/base/units.h"
#include "clench/io/graspit/transform_tags.h"
#include "clench/io/inventor/read_geometry.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/repairs.h"
#include "clench/spec/inertia.h"
#include "clench/spec/material_names.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

const XmlKnown known_elements = {
    .once = {"material", "youngs", "normalCompliance", "shearCompliance", "useFlockOfBirds",
             "geometryFile", "geometryScaling", "geometryScalingX", "geometryScalingY",
             "geometryScalingZ", "geometryOffset", "mass", "cog", "inertia_matrix"}};

/// absent  value used instead of 0; 0: no replacement
double number_of(const XmlElement& element, const Quantity& quantity, Repairs& repairs,
                 double absent = 0) {
  const Place subject = element.place().of(element.name());
  double value = repairs.magnitude(element.number(), subject);
  if (absent > 0) value = repairs.not_zero(value, absent, subject);
  if (const auto wrong = fault(quantity, value); !wrong.empty())
    element.fail("{}: {}", element.name(), wrong);
  return value;
}

/// Factors along x, y and z.
Eigen::Vector3d read_scaling(const XmlElement& body, Repairs& repairs) {
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
  const XmlElement all = body.child("geometryScaling");
  if (all) scaling.setConstant(number_of(all, scale_rule, repairs));
  constexpr const char* names[] = {"geometryScalingX", "geometryScalingY", "geometryScalingZ"};
  for (int i = 0; i < 3; ++i)
    if (const XmlElement one = body.child(names[i])) {
      if (all)
        repairs.add("scaling", one.place(),
                    "{} and geometryScaling are given; {} is used for its axis", names[i],
                    names[i]);
      scaling[i] = number_of(one, scale_rule, repairs);
    }
  return scaling;
}

/// Format by the file's ending; if that is unknown, by the attribute `type`.
GeometryFormat read_format(const XmlElement& file, const ReadOptions& options) {
  const GeometryFormat format = geometry_format(ending_of(file.text()));
  const auto type = file.attribute("type");
  if (!type) return format;
  const std::string word = lower_case(*type);
  const GeometryFormat said =
      word == "inventor" ? GeometryFormat::inventor : geometry_format("." + word);
  if (format == GeometryFormat::none && said == GeometryFormat::none)
    file.fail("geometryFile: expected type Inventor, off, ply or that of another mesh, got {}",
              in_quotes(*type));
  if (format == GeometryFormat::none) return said;
  if (said != format)
    options.diagnostics.warn(file.place().of("geometryFile"),
                             "type {} does not fit {}; the ending of the file is used",
                             in_quotes(*type), in_quotes(file.text()));
  return format;
}

/// Triangles in the body frame; coordinates in the file are in millimeters.
Geometry read_scaled(const XmlElement& element, const PlacedFile& file, FileCache& cache) {
  Eigen::Vector3d scaling = file.scaling;
  ReadOptions options = cache.options();
  options.mesh_scale.reset();
  if (file.format != GeometryFormat::inventor) {
    // unit and scale combined into one factor: meters scaled by 1000 lose no digits
    options.mesh_scale = units::millimeter * scaling.x();
    scaling /= scaling.x();
  }
  Geometry geometry =
      errors_at(element, [&] { return read_geometry(file.path, options, file.format); });
  if (scaling != Eigen::Vector3d::Ones())
    for (auto& v : geometry.mesh.vertices) v = scaling.cwiseProduct(v);
  if (file.X_BG)
    for (auto& v : geometry.mesh.vertices) v = *file.X_BG * v;
  return geometry;
}

void read_compliance(const XmlElement& body, const FileCache& cache, Repairs& repairs) {
  const std::array both = {body.child("normalCompliance"), body.child("shearCompliance")};
  for (int i = 0; i < 2; ++i) {
    if (!both[i]) continue;
    number_of(both[i], positive_rule, repairs);
    if (i == 0 || !both[0])
      cache.diagnostics().warn(both[i].place(),
                               "normalCompliance and shearCompliance are not used");
  }
}

void read_mass(const XmlElement& body, const FileCache& cache, Repairs& repairs, BodySpec& out) {
  if (const XmlElement mass = body.child("mass")) {
    out.mass =
        number_of(mass, mass_rule.in("g", units::gram), repairs, BodySpec().mass / units::gram) *
        units::gram;
    out.mass_from = Origin::file;
  }
  if (const XmlElement cog = body.child("cog")) {
    out.com = cog.vector() * units::millimeter;
    check(coordinate_rule.called("cog"), *out.com, cog.place().text());
  }
  if (const XmlElement inertia = body.child("inertia_matrix")) {
    const auto x = inertia.numbers(9);
    Eigen::Matrix3d rows;
    for (int i = 0; i < 9; ++i) rows(i / 3, i % 3) = x[i] * units::square_millimeter;
    out.inertia_per_mass = checked_inertia(rows, inertia.place(), cache.diagnostics());
  }
}

void read_matter(const XmlElement& body, const FileCache& cache, Repairs& repairs, BodySpec& out) {
  if (const XmlElement material = body.child("material")) {
    out.material = material.text();
    out.material_from = Origin::file;
    errors_at(material, [&] { check_material(out.material); });
  }
  if (const XmlElement youngs = body.child("youngs")) {
    out.elastic_modulus = number_of(youngs, elastic_modulus_rule, repairs);
    if (const std::string doubt = doubt_modulus(*out.elastic_modulus); !doubt.empty())
      cache.diagnostics().suspected(youngs.place(), "youngs {}", doubt);
  }
  if (const XmlElement bird = body.child("useFlockOfBirds"))
    out.tracker = repairs.count(bird.text(), bird.place().of("useFlockOfBirds"));
  read_compliance(body, cache, repairs);
}

}  // namespace

std::optional<PlacedFile> read_placed_file(const XmlElement& body, const fs::path& path,
                                           const ReadOptions& options) {
  const XmlElement element = body.child("geometryFile");
  if (!element) return {};
  element.check({.attributes = {"type"}}, options.diagnostics);
  PlacedFile out;
  out.format = read_format(element, options);
  Repairs repairs(options.diagnostics);
  out.scaling = read_scaling(body, repairs);
  repairs.tell();
  out.path = errors_at(element, [&] { return find_file(element.text(), path, options); });
  if (const XmlElement offset = body.child("geometryOffset")) {
    out.X_BG = read_transform_of(offset, options.diagnostics);
    offset.check({.once = {"transform"}}, options.diagnostics);
  }
  return out;
}

BodySpec read_body_element(const XmlElement& element, const fs::path& path, FileCache& cache) {
  element.check(known_elements, cache.diagnostics());
  BodySpec body;
  Repairs repairs(cache.diagnostics());
  read_matter(element, cache, repairs, body);
  read_mass(element, cache, repairs, body);
  repairs.tell();
  const XmlElement file = element.child("geometryFile");
  if (!file) {
    cache.diagnostics().suspected(element.place(),
                                  "no <geometryFile>: the body is a frame without a surface");
    return body;
  }
  Geometry geometry = read_scaled(file, *read_placed_file(element, path, cache.options()), cache);
  body.appearance = std::move(geometry.appearance);
  body.mesh_report = std::move(geometry.report);
  if (geometry.mesh.triangles.empty()) {
    cache.diagnostics().suspected(file.place(),
                                  "no surface in {}: the body is a frame, which touches nothing",
                                  in_quotes(file.text()));
    return body;
  }
  body.shape = errors_at(file, [&] {
    return Shape::make(std::move(geometry.mesh), path.filename().string(),
                       cache.options().progress);
  });
  return body;
}

void check_body_root(const XmlFile& file) {
  for (const char* other : {"robot", "world", "mujoco", "EigenGrasps", "virtual_contacts"})
    if (file.root().name() == other)
      file.root().fail("expected a body, got <{}>", excerpt(file.root().name()));
  const auto children = file.root().children();
  if (std::ranges::none_of(children, [](const XmlElement& e) {
        return std::ranges::count(known_elements.once, e.name());
      }))
    file.root().fail(
        "expected a body with elements such as geometryFile or mass, got <{}> without any",
        excerpt(file.root().name()));
}

BodySpec read_body_xml(const fs::path& path, FileCache& cache) {
  const XmlFile file(path);
  check_body_root(file);
  return read_body_element(file.root(), path, cache);
}

}  // namespace clench
