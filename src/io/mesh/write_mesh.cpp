#include "clench/io/mesh/write_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/io/text/byte_writer.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t lines_between_checks = 1 << 12;

/// Appends a line per vertex and per triangle, each after its prefix.
/// first  number of the first vertex
void append_lines(std::string& out, const Mesh& mesh, std::string_view vertex,
                  std::string_view triangle, int first) {
  const auto to = std::back_inserter(out);
  StopCheck check(lines_between_checks);
  for (const auto& p : mesh.vertices) {
    check();
    fmt::format_to(to, "{}{} {} {}\n", vertex, p.x(), p.y(), p.z());
  }
  for (const auto& t : mesh.triangles) {
    check();
    fmt::format_to(to, "{}{} {} {}\n", triangle, t[0] + first, t[1] + first, t[2] + first);
  }
}

std::string obj_text(const Mesh& mesh) {
  std::string out = "# meters\n";
  append_lines(out, mesh, "v ", "f ", 1);
  return out;
}

std::string ply_bytes(const Mesh& mesh) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment meters\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const auto& p : mesh.vertices)
    for (const double x : p) append_little_endian(out, x);
  for (const auto& t : mesh.triangles) {
    out += '\3';
    for (const int v : t) append_little_endian(out, v);
  }
  return out;
}

// of three points; along z if they span no area
Eigen::Vector3d normal_of(const std::array<Eigen::Vector3d, 3>& p) {
  const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
  const double length = n.norm();
  return length > 0 && std::isfinite(length) ? Eigen::Vector3d(n / length)
                                             : Eigen::Vector3d::UnitZ();
}

std::string stl_bytes(const Mesh& mesh, const std::string& file) {
  constexpr double largest = std::numeric_limits<float>::max();
  for (const auto& p : mesh.vertices)
    if (p.cwiseAbs().maxCoeff() > largest)
      fail("{}: expected coordinates within {:.4g} m, as .stl holds them, got {}", file, largest,
           p.cwiseAbs().maxCoeff());
  // a header that begins with "solid" would mark a text file
  std::string out = "meters, by clench";
  out.resize(80, ' ');
  append_little_endian(out, static_cast<uint32_t>(mesh.triangles.size()));
  StopCheck check(lines_between_checks);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    check();
    const auto corners = mesh.corners(static_cast<int>(i));
    for (const double x : normal_of(corners)) append_little_endian(out, static_cast<float>(x));
    for (const auto& p : corners)
      for (const double x : p) append_little_endian(out, static_cast<float>(x));
    append_little_endian(out, uint16_t{0});
  }
  return out;
}

constexpr std::string_view written_endings[] = {".obj", ".off", ".ply", ".stl"};

}  // namespace

std::string off_text(const Mesh& mesh) {
  std::string out = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  append_lines(out, mesh, "", "3 ", 0);
  return out;
}

bool is_mesh_ending(std::string_view ending) {
  return std::ranges::count(written_endings, ending) > 0;
}

void write_mesh(const Mesh& mesh, const fs::path& path) {
  const std::string ending = lower_case(path.extension().string()), file = path.filename().string();
  if (ending == ".obj")
    write_file(path, obj_text(mesh));
  else if (ending == ".off")
    write_file(path, off_text(mesh));
  else if (ending == ".ply")
    write_file(path, ply_bytes(mesh));
  else if (ending == ".stl")
    write_file(path, stl_bytes(mesh, file));
  else
    fail("{}: expected a mesh to .obj, .off, .ply or .stl, got {}", file, in_quotes(ending));
}

}  // namespace clench
