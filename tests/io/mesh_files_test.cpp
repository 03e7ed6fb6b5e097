#include "clench/io/mesh/mesh_files.h"

#include <fmt/format.h>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/geometry/mesh/triangulate.h"
#include "clench/io/mesh/geometry_builder.h"
#include "mesh_writers.h"
#include "support/listening.h"
#include "support/meshes.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

namespace {

/// Compares corner by corner, independent of the vertices' numbers.
void check_same_surface(const Mesh& a, const Mesh& b) {
  REQUIRE(a.triangles.size() == b.triangles.size());
  int different = 0;
  for (size_t i = 0; i < a.triangles.size(); ++i)
    different += a.corners(static_cast<int>(i)) != b.corners(static_cast<int>(i));
  CHECK(different == 0);
}

Mesh stretched_box() { return in_32_bits(box(0.25, 0.5, 0.125)); }

/// A box whose faces share no vertices.
Mesh box_of_loose_faces() {
  const Mesh joined = stretched_box();
  Mesh out;
  for (size_t i = 0; i < joined.triangles.size(); ++i) {
    const int first = static_cast<int>(out.vertices.size());
    for (const auto& p : joined.corners(static_cast<int>(i))) out.vertices.push_back(p);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

Geometry read_file_of(const TemporaryFolder& folder, const MeshFile& file,
                      const ReadOptions& options = {}) {
  return read_mesh_file(folder.write(file.name, file.content), options);
}

}  // namespace

TEST_CASE("a mesh is the same to the bit in every format, and closed") {
  const TemporaryFolder folder;
  Random random(5);
  for (const Mesh& mesh : {stretched_box(), in_32_bits(potato(random, 0.5, 8))})
    for (const MeshFile& file : in_every_format(mesh)) {
      INFO(file.name);
      const Geometry geometry = read_file_of(folder, file);
      check_same_surface(geometry.mesh, mesh);
      CHECK(geometry.mesh.vertices.size() == mesh.vertices.size());
      CHECK(find_faults(geometry.mesh).none());
      CHECK(geometry.report.triangles_read == static_cast<int>(mesh.triangles.size()));
      CHECK(geometry.report.dropped_triangles == 0);
      CHECK(geometry.report.unit == 1);
    }
}

TEST_CASE("line ends of every system are read alike") {
  const TemporaryFolder folder;
  const Mesh mesh = stretched_box();
  for (const MeshFile& file : in_every_format(mesh)) {
    if (file.name == "binary.stl" || file.name == "solid.stl" || file.name == "a.glb") continue;
    for (const std::string end : {"\r\n", "\r"}) {
      const bool ply = file.name.find(".ply") != std::string::npos;
      const size_t text_end = ply && file.name != "ascii.ply"
                                  ? file.content.find("end_header\n") + 11
                                  : file.content.size();
      std::string changed;
      for (const char c : file.content.substr(0, text_end))
        changed += c == '\n' ? end : std::string(1, c);
      INFO(file.name);
      check_same_surface(
          read_file_of(folder, {file.name, changed + file.content.substr(text_end)}).mesh, mesh);
    }
  }
}

TEST_CASE("a mark of UTF-8 before a text changes nothing") {
  const TemporaryFolder folder;
  const Mesh mesh = stretched_box();
  for (const MeshFile& file : in_every_format(mesh)) {
    if (file.name == "binary.stl" || file.name == "solid.stl" || file.name == "a.glb") continue;
    INFO(file.name);
    check_same_surface(read_file_of(folder, {file.name, "\xEF\xBB\xBF" + file.content}).mesh, mesh);
  }
}

TEST_CASE("vertices that faces do not share are welded, and counted") {
  const TemporaryFolder folder;
  const Mesh loose = box_of_loose_faces();
  for (const MeshFile& file : in_every_format(loose)) {
    INFO(file.name);
    const Geometry geometry = read_file_of(folder, file);
    CHECK(geometry.mesh.vertices.size() == 8);
    CHECK(find_faults(geometry.mesh).none());
    CHECK(geometry.report.vertices_read == 36);
    CHECK(geometry.report.welded_vertices == 28);
  }
}

TEST_CASE("what a file connects into closed surfaces stays as it is, though places are equal") {
  // two boxes that touch in an edge: after welding, four faces would meet there
  const TemporaryFolder folder;
  const Mesh two =
      joined(box(1, 1, 1), moved(box(1, 1, 1), {Eigen::Quaterniond::Identity(), {1, 1, 0}}));
  const Geometry geometry = read_file_of(folder, {"two.obj", obj_text(two)});
  CHECK(geometry.mesh.vertices.size() == 16);
  CHECK(find_faults(geometry.mesh).none());
  CHECK(geometry.report.welded_vertices == 0);

  // a sliver whose ends coincide connects its neighbors
  Mesh pinched = ball(0.5);
  const Triangle cut = pinched.triangles[40];
  pinched.vertices[cut[1]] = pinched.vertices[cut[0]];
  const Geometry kept = read_file_of(folder, {"pinched.off", off_text(pinched)});
  CHECK(kept.mesh.triangles.size() == pinched.triangles.size());
  CHECK(kept.report.dropped_triangles == 0);
  CHECK(find_faults(kept.mesh).closed());
}

TEST_CASE("triangles without area go, and are counted, unless the surface needs them") {
  const TemporaryFolder folder;
  const Mesh whole = stretched_box();
  // a vertex twice, two vertices at one place, three in a line
  const std::string bad = obj_text(whole) + "v -0.125 -0.25 -0.0625\nv 0 -0.25 -0.0625\nv 9 9 9\n" +
                          "f 1 1 2\nf 1 2 9\nf 1 2 10\n";
  const Geometry geometry = read_file_of(folder, {"bad.obj", bad});
  check_same_surface(geometry.mesh, whole);
  CHECK(geometry.report.triangles_read == 15);
  CHECK(geometry.report.dropped_triangles == 3);
  CHECK(geometry.report.unused_vertices == 1);
  CHECK(geometry.report.welded_vertices == 2);
  // a sliver that fills a gap without width is kept
  Mesh seam = whole;
  seam.vertices.push_back(0.5 * (seam.vertices[0] + seam.vertices[2]));
  const Triangle t = seam.triangles[0];  // 0 2 3
  seam.triangles[0] = {8, t[1], t[2]};
  seam.triangles.push_back({t[0], 8, t[2]});
  CHECK_FALSE(find_faults(seam).closed());
  seam.triangles.push_back({t[0], t[1], 8});
  CHECK(find_faults(seam).closed());
  const Geometry closed = read_file_of(folder, {"seam.obj", obj_text(seam)});
  CHECK(closed.mesh.triangles.size() == 14);
  CHECK(find_faults(closed.mesh).closed());
}

TEST_CASE("triangles that lie on each other go, a fold whole and a double one once") {
  const TemporaryFolder folder;
  const Mesh whole = stretched_box();
  const Triangle t = whole.triangles[3];
  // a fin on an edge, front and back; and one face twice
  Mesh folded = whole;
  folded.vertices.emplace_back(1, 1, 1);
  folded.triangles.push_back({t[0], t[1], 8});
  folded.triangles.push_back({t[1], t[0], 8});
  folded.triangles.push_back({t[1], t[2], t[0]});
  const Geometry geometry = read_file_of(folder, {"folded.ply", ascii_ply(folded)});
  check_same_surface(geometry.mesh, whole);
  CHECK(geometry.mesh.vertices.size() == 8);
  CHECK(geometry.report.dropped_triangles == 3);
  // a sheet with two sides is closed without repairs
  const Geometry sheet =
      read_file_of(folder, {"sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n"});
  CHECK(sheet.mesh.triangles.size() == 2);
  CHECK(sheet.report.dropped_triangles == 0);
}

TEST_CASE("a mesh of nothing but lines in disguise is kept rather than emptied") {
  const TemporaryFolder folder;
  CHECK(read_file_of(folder, {"a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"})
            .mesh.triangles.size() == 1);
  CHECK_THROWS_WITH_AS(read_file_of(folder, {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n"}),
                       "a.obj: expected triangles, got none", Error);
}

TEST_CASE("colors follow their triangles when others are dropped") {
  const TemporaryFolder folder;
  folder.write("p.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\n";
  const Geometry geometry = read_file_of(
      folder, {"p.obj", "mtllib p.mtl\n" + points +
                            "usemtl red\nf 1 3 2\nf 1 5 2\nf 1 2 2\nusemtl blue\nf 1 2 4\nf 1 "
                            "4 3\nf 2 3 4\n"});
  REQUIRE(geometry.mesh.triangles.size() == 4);
  REQUIRE(geometry.appearance.triangle_colors.size() == 4);
  CHECK(geometry.appearance.triangle_colors[0] == Eigen::Vector3f(1, 0, 0));
  for (int i = 1; i < 4; ++i)
    CHECK(geometry.appearance.triangle_colors[i] == Eigen::Vector3f(0, 0, 1));
}

TEST_CASE("a closed mesh that is inside out is turned, with a warning and a word in the report") {
  const TemporaryFolder folder;
  for (const MeshFile& file : in_every_format(inverted(stretched_box()))) {
    Warnings warnings;
    const Geometry geometry = read_file_of(folder, file, warnings.options());
    CHECK(geometry.report.flipped);
    CHECK(solid_mass(geometry.mesh).volume == doctest::Approx(0.25 * 0.5 * 0.125));
    REQUIRE(warnings.list.size() == 1);
    CHECK(warnings.list[0] == file.name + ": its triangles face inward; flipped to face outward");
  }
}

TEST_CASE("the unit is the option's, else the file's, else the caller's, else guessed and noted") {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  ReadOptions options;
  options.diagnostics = Listening{.note = [&](const std::string& note) { notes.push_back(note); }};
  const auto size = [&](const MeshFile& file) {
    const Geometry g = read_file_of(folder, file, options);
    return g.mesh.bounds().size().x();
  };
  const MeshFile meters{"a.obj", obj_text(box(10, 1, 1))},
      mug{"mug.stl", ascii_stl(box(150, 80, 80))};
  CHECK(size(meters) == 10);
  CHECK(size(mug) == 0.15);
  REQUIRE(notes.size() == 2);
  CHECK(notes[0] ==
        "a.obj: it names no unit; its size, 10 x 1 x 1, is taken for m (the option unit overrides "
        "this)");
  CHECK(notes[1] ==
        "mug.stl: it names no unit; its size, 150 x 80 x 80, is taken for mm (the option unit "
        "overrides this)");
  notes.clear();
  options.silent_mesh_unit = 1;
  CHECK(size(mug) == 150);
  const MeshFile inches{
      "a.dae", collada_text(box(2, 1, 1), "", "<unit meter=\"0.0254\"/><up_axis>Z_UP</up_axis>")};
  CHECK(size(inches) == doctest::Approx(0.0508));
  options.mesh_scale = 0.01;
  CHECK(size(mug) == doctest::Approx(1.5));
  CHECK(size(inches) == doctest::Approx(0.02));
  CHECK(notes.empty());
}

TEST_CASE("the guess turns from meters to millimeters beyond ten units") {
  CHECK(guess_mesh_unit(0.1) == 1);
  CHECK(guess_mesh_unit(10) == 1);
  CHECK(guess_mesh_unit(10.1) == 1e-3);
  CHECK(guess_mesh_unit(1500) == 1e-3);
}

TEST_CASE("what a file calls up becomes z, unless its axes are to stay") {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  ReadOptions options;
  options.diagnostics = Listening{.note = [&](const std::string& note) { notes.push_back(note); }};
  const Mesh tall = box(1, 2, 4);
  const auto size = [&](const std::string& up) {
    const std::string asset = "<up_axis>" + up + "</up_axis>";
    return Eigen::Vector3d(read_file_of(folder, {"a.dae", collada_text(tall, "", asset)}, options)
                               .mesh.bounds()
                               .size());
  };
  CHECK(size("Z_UP") == Eigen::Vector3d(1, 2, 4));
  CHECK(notes.empty());
  CHECK(size("Y_UP") == Eigen::Vector3d(1, 4, 2));
  CHECK(size("X_UP") == Eigen::Vector3d(2, 4, 1));
  REQUIRE(notes.size() == 2);
  CHECK(notes[0] == "a.dae: its y axis is up, and was turned to z");
  options.turn_mesh_up = false;
  CHECK(size("Y_UP") == Eigen::Vector3d(1, 2, 4));
  CHECK(notes.size() == 2);
  // a rotation, not a reflection
  options.turn_mesh_up = true;
  for (const std::string up : {"X_UP", "Y_UP", "Z_UP"})
    CHECK_FALSE(read_file_of(folder,
                             {"a.dae", collada_text(tall, "", "<up_axis>" + up + "</up_axis>")},
                             options)
                    .report.flipped);
}

TEST_CASE("a body keeps the report, which describes itself") {
  const TemporaryFolder folder;
  const BodySpec body = read_body(folder.write("crate.stl", ascii_stl(box(200, 100, 100))));
  REQUIRE(body.mesh_report);
  CHECK(body.name == "crate");
  CHECK(describe(*body.mesh_report, *body.shape) ==
        std::vector<std::string>{
            "ascii STL: 12 triangles of 36 vertices", "unit mm, inferred from the size",
            "28 vertices welded", "watertight, 0.2 x 0.1 x 0.1 m, no faults",
            "volume 0.002 m^3, center of mass (0, 0, 0) m",
            "inertia per kg: xx 0.001667, yy 0.004167, zz 0.004167, xy 0, xz 0, yz 0 m^2"});
}

TEST_CASE("scanned objects load with every triangle that their files hold") {
  REQUIRE_SHARED();
  for (const char* name : {"003_cracker_box", "006_mustard_bottle", "011_banana", "065-c_cups"}) {
    INFO(name);
    const Geometry geometry =
        read_mesh_file(shared() / "data/ycb" / (std::string(name) + ".obj"), {});
    CHECK(geometry.mesh.triangles.size() == 16384);
    CHECK(geometry.report.triangles_read == 16384);
    CHECK(geometry.report.unit == 1);
  }
}

TEST_CASE("faces that take long to cut have an end, however many there are") {
  Random random(5);
  GeometryBuilder builder;
  std::vector<int> face;
  for (int i = 0; i < max_concave_corners; ++i)
    face.push_back(builder.add_vertex({random.normal(), random.normal(), 0}));
  CHECK_THROWS_WITH_AS(for (int i = 0; i < 10'000; ++i) builder.add_face(face, {1, 1, 1}, 0),
                       "expected fewer faces of many corners that are not convex", Error);
}

TEST_CASE(
    "a face with more corners than can be cut is an error of the kind limit in every format") {
  const int count = max_concave_corners + 1;
  std::string rows, obj_rows, from_0, from_1;
  for (int i = 0; i < count; ++i) {
    // a comb, which is not convex
    const std::string row =
        fmt::format("{} {} 0\n", i < count - 1 ? i : 0, i % 2 + 2 * (i == count - 1));
    rows += row;
    obj_rows += "v " + row;
    from_0 += fmt::format(" {}", i);
    from_1 += fmt::format(" {}", i + 1);
  }
  const std::string files[][2] = {
      {"comb.off", fmt::format("OFF\n{} 1 0\n{}{}{}\n", count, rows, count, from_0)},
      {"comb.obj", obj_rows + "f" + from_1 + "\n"},
      {"comb.ply", fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 1\n"
                               "property list ushort int vertex_indices\nend_header\n{}{}{}\n",
                               count, rows, count, from_0)}};
  const TemporaryFolder folder;
  for (const auto& [name, text] : files) {
    INFO(name);
    try {
      read_body(folder.write(name, text));
      FAIL_CHECK("expected an error");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::limit);
      CHECK(std::string(error.what()).find(name + ":") != std::string::npos);
    }
  }
}
