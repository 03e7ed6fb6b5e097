#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/error.h"
#include "clench/io/mesh/mesh_files.h"
#include "mesh_writers.h"
#include "support/meshes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

static Geometry read_collada(const std::string& content, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_mesh_file(folder.write("q.dae", content), options);
}

TEST_CASE("the unit and the upward axis of a COLLADA file are its own") {
  const auto read_with = [](const std::string& asset) {
    return read_collada(collada_text(box(100, 200, 400), "", asset));
  };
  const Geometry cm =
      read_with("<unit name=\"centimeter\" meter=\"0.01\"/><up_axis>Z_UP</up_axis>");
  CHECK((cm.mesh.bounds().size() - Eigen::Vector3d(1, 2, 4)).norm() < 1e-12);  // rounding of 0.01
  CHECK(cm.report.unit_source == UnitSource::file);
  CHECK(cm.appearance.color == Eigen::Vector3f(1, 0.5f, 0));
  // meters and y up are the defaults of the format
  const Geometry silent = read_with("");
  CHECK(silent.mesh.bounds().size() == Eigen::Vector3d(100, 400, 200));
  CHECK(silent.report.unit_source == UnitSource::format);
}

TEST_CASE("the transformations of a COLLADA node multiply in their order") {
  const auto center = [](const std::string& node) {
    return Eigen::Vector3d(read_collada(collada_text(box(1, 1, 1), node)).mesh.bounds().center());
  };
  CHECK(center("<translate>1 2 3</translate>") == Eigen::Vector3d(1, 2, 3));
  CHECK(center("<scale>2 2 2</scale><translate>1 0 0</translate>") == Eigen::Vector3d(2, 0, 0));
  CHECK(center("<translate>1 0 0</translate><scale>2 2 2</scale>") == Eigen::Vector3d(1, 0, 0));
  CHECK((center("<rotate>0 0 1 90</rotate><translate>1 0 0</translate>") - Eigen::Vector3d(0, 1, 0))
            .norm() < 1e-15);  // cosine of a right angle
  CHECK(center("<matrix>1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1</matrix>") == Eigen::Vector3d(5, 6, 7));
  Warnings warnings;
  CHECK_FALSE(read_collada(collada_text(box(1, 1, 1), "<scale>1 -1 1</scale>"), warnings.options())
                  .report.flipped);
}

TEST_CASE("counts of a COLLADA file that are not what stands there are told") {
  const auto told = [](const std::string& was, const std::string& is) {
    Warnings warnings;
    const std::string text = collada_text(box(1, 1, 1));
    REQUIRE(text.find(was) != std::string::npos);
    CHECK(read_collada(replaced(text, was, is), warnings.options()).mesh.triangles.size() == 12);
    return warnings.list;
  };
  const auto unused = [](const char* name) {
    return std::vector<std::string>{std::string("q.dae: counts of <") + name +
                                    "> that differ from its contents are not used"};
  };
  CHECK(told("count=\"24\"", "count=\"23\"") == unused("float_array"));
  CHECK(told("count=\"12\"", "count=\"7\"") == unused("triangles"));
}

TEST_CASE("polygons of every kind of COLLADA element are cut alike") {
  const std::string good = collada_text(box(1, 1, 1));
  const size_t first = good.find("<triangles"), last = good.find("</triangles>") + 12;
  const std::string inputs =
      "<input semantic=\"VERTEX\" source=\"#v\" offset=\"1\"/>"
      "<input semantic=\"NORMAL\" source=\"#n\" offset=\"0\"/>";
  const auto with = [&](const std::string& element) {
    return read_collada(good.substr(0, first) + element + good.substr(last)).mesh;
  };
  const auto corners = [](const Mesh& mesh) {
    std::vector<std::array<Eigen::Vector3d, 3>> out;
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
      out.push_back(mesh.corners(static_cast<int>(i)));
    return out;
  };
  const auto two =
      corners(with("<triangles>" + inputs + "<p>0 0 0 1 0 3 0 0 0 3 0 2</p></triangles>"));
  REQUIRE(two.size() == 2);
  CHECK(corners(with("<polylist>" + inputs +
                     "<vcount>4</vcount><p>0 0 0 1 0 3 0 2</p></polylist>")) == two);
  CHECK(corners(with("<polygons>" + inputs + "<p>0 0 0 1 0 3 0 2</p></polygons>")) == two);
  CHECK(corners(with("<polygons>" + inputs +
                     "<ph><p>0 0 0 1 0 3 0 2</p><h>0 4 0 5 0 6</h></ph></polygons>")) == two);
  CHECK(corners(with("<trifans>" + inputs + "<p>0 0 0 1 0 3 0 2</p></trifans>")) == two);
  const auto strip = corners(with("<tristrips>" + inputs + "<p>0 0 0 1 0 2 0 3</p></tristrips>"));
  const auto same =
      corners(with("<triangles>" + inputs + "<p>0 0 0 1 0 2 0 2 0 1 0 3</p></triangles>"));
  CHECK(strip == same);
}

TEST_CASE("nodes and skins are found by their names, and circles are refused") {
  const std::string good = collada_text(box(1, 1, 1));
  const std::string node =
      "<node id=\"twice\"><translate>3 0 0</translate><instance_geometry url=\"#g\"/></node>";
  std::string used = replaced(good, "<library_visual_scenes>",
                              "<library_nodes>" + node + "</library_nodes><library_visual_scenes>");
  used = replaced(used, "<visual_scene id=\"s\">",
                  "<visual_scene id=\"s\"><node><instance_node url=\"#twice\"/></node>");
  CHECK(read_collada(used).mesh.triangles.size() == 24);
  Warnings warnings;
  std::string skin = replaced(
      good, "<library_visual_scenes>",
      "<library_controllers><controller id=\"c\"><skin source=\"#g\"><bind_shape_matrix>1 0 0 0 0 "
      "1 0 0 0 0 1 9 0 0 0 "
      "1</bind_shape_matrix></skin></controller></library_controllers><library_visual_scenes>");
  skin = replaced(skin, "<instance_geometry url=\"#g\">", "<instance_controller url=\"#c\">");
  skin = replaced(skin, "</instance_geometry>", "</instance_controller>");
  CHECK(read_collada(skin, warnings.options()).mesh.bounds().center() == Eigen::Vector3d(0, 0, 9));
  CHECK(warnings.list ==
        std::vector<std::string>{
            "q.dae: skins and morphs are not used: their meshes keep their shape at rest"});
  const std::string circle = replaced(good, "<node>", "<node id=\"a\"><instance_node url=\"#a\"/>");
  CHECK_THROWS_WITH_AS(
      read_collada(circle),
      "q.dae:20: node: expected at most 200 nodes in each other, and none in itself", Error);
}

TEST_CASE("what is wrong in a COLLADA file is told by line") {
  const std::string good = collada_text(box(1, 1, 1));
  const auto refused = [&](const std::string& what, const std::string& by,
                           const std::string& sentence) {
    INFO(by);
    try {
      read_collada(replaced(good, what, by));
      FAIL("not refused");
    } catch (const Error& error) {
      const std::string text = error.what();
      const size_t line = text.find(':') + 1, colon = text.find(':', line);
      CHECK(text.substr(0, line) == "q.dae:");
      CHECK(text.substr(colon + 2) == sentence);
    }
  };
  CHECK_THROWS_WITH_AS(read_collada("<a/>"), "q.dae:1: expected an element <COLLADA>, got <a>",
                       Error);
  refused("meter=\"1\"", "meter=\"-1\"", "unit: expected a length > 0 [m], got -1");
  refused("Z_UP", "W_UP", "up_axis: expected X_UP, Y_UP or Z_UP, got 'W_UP'");
  refused("url=\"#s\"", "url=\"#t\"",
          "instance_visual_scene: expected an element with the id 't', got none");
  refused("url=\"#g\"", "url=\"b.dae#g\"",
          "instance_geometry: expected '#' and the id of an element of this file, got 'b.dae#g'");
  refused("<instance_geometry", "<skew>1</skew><instance_geometry",
          "skew: expected matrix, translate, rotate, scale or lookat");
  refused("<instance_geometry", "<lookat>1 2 3 1 2 9 0 0 1</lookat><instance_geometry",
          "lookat: expected an upward direction across the view");
  refused("<instance_geometry", "<scale>1 x 1</scale><instance_geometry",
          "scale: expected a number, got 'x'");
  refused("<instance_geometry", "<scale>1 1</scale><instance_geometry",
          "scale: expected 3 numbers, got 2");
  refused("count=\"8\"", "count=\"9\"", "accessor: expected 9 points, got 8");
  refused("<float_array id=\"pa\"", "<int_array id=\"x\"/><float_array id=\"pb\"",
          "accessor: expected an element with the id 'pa', got none");
  refused("semantic=\"POSITION\"", "semantic=\"NORMAL\"",
          "vertices: expected an input POSITION, got none");
  refused("semantic=\"VERTEX\"", "semantic=\"COLOR\"",
          "triangles: expected an input VERTEX, got none");
  refused("offset=\"0\"", "offset=\"-1\"",
          "input: offset: expected a whole number from 0 to 64, got '-1'");
  refused("<p>0 0 ", "<p>8 0 ", "p: expected a vertex from 0 to 7, got 8");
  refused("<p>0 0 ", "<p>0 0 0 ", "p: expected 2 numbers per corner, got 73 in total");
  refused("<p>0 0 ", "<p>0 0 0 0 ", "triangles: expected 3 corners of a face, got 1");
  refused("1 0.5 0 1", "1 0.5", "color: expected three or four numbers, got 2");
  CHECK_THROWS_WITH_AS(
      read_collada(replaced(replaced(good, "<triangles", "<lines"), "</triangles", "</lines")),
      "q.dae: expected triangles, got none", Error);
}
