#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/error.h"
#include "mesh_writers.h"
#include "support/meshes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

static BodySpec read_stl_text(const std::string& content, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_body(folder.write("q.stl", content), options);
}

TEST_CASE("an STL file in capitals, in one line, or of several solids is read") {
  const Mesh mesh = box(1, 1, 1);
  std::string text = ascii_stl(mesh);
  std::string capitals = text;
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  CHECK(read_stl_text(capitals).shape->faults().none());
  std::string line = text;
  for (size_t i = line.find('\n') + 1; i < line.size(); ++i)
    if (line[i] == '\n') line[i] = ' ';
  CHECK(read_stl_text(line).shape->faults().none());
  const Mesh other = moved(mesh, {Eigen::Quaterniond::Identity(), {3, 0, 0}});
  CHECK(read_stl_text(text + "\n" + ascii_stl(other)).shape->mesh().triangles.size() == 24);
}

TEST_CASE("an STL file has no colours") {
  CHECK_FALSE(read_stl_text(ascii_stl(box(1, 1, 1))).appearance.given);
}

TEST_CASE("what is wrong in an ascii STL file is told by line") {
  const std::string start = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const auto refused = [&](const std::string& text, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_stl_text(text), ("q.stl:" + sentence).c_str(), Error);
  };
  refused(start + "endloop", "6: expected three vertices a facet, got 2");
  refused(start + "vertex 1 1 0\nvertex 2 2 2", "7: expected three vertices a facet, got more");
  refused(start + "vertex 1 x 0", "6: expected three numbers after vertex, got 'x'");
  refused(start + "vertex 1 nan 0", "6: expected three numbers after vertex, got 'nan'");
  refused(start + "vertx 1 1 0", "6: expected 'vertex' or 'endloop', got 'vertx'");
  refused(start + "vertex 1 1 0\nendloop\nendsolid", "8: expected 'endfacet', got 'endsolid'");
  refused(start + "vertex 1 1 0\nendloop\nendfacet\n",
          "8: expected facet or endsolid, got the end of the file");
  refused("solid\nfacet 0 0 1", "2: expected 'normal' after facet");
  refused("solid\nface normal", "2: expected 'facet' or 'endsolid', got 'face'");
  refused("solid\nendsolid\nmore", "3: expected 'solid', got 'more'");
  refused("solid\nendsolid", " expected triangles, got none");
}

TEST_CASE("what is wrong in a binary STL file is told by facet") {
  std::string content = binary_stl(box(1, 1, 1));
  CHECK_THROWS_WITH_AS(read_stl_text(content.substr(0, 84 + 50 * 7 + 3)),
                       "q.stl: facet 8 of 12: expected 50 bytes, got the end of the file", Error);
  std::string nan;
  append_bytes(nan, std::numeric_limits<float>::quiet_NaN());
  std::string bad = content;
  bad.replace(84 + 50 * 2 + 12, 4, nan);
  CHECK_THROWS_WITH_AS(read_stl_text(bad),
                       "q.stl: facet 3 of 12: expected finite coordinates, got nan", Error);
  Warnings warnings;
  content[84 + 48] = 1;
  read_stl_text(content + "more", warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"q.stl: the attribute words of 1 facets are not used",
                                 "q.stl: 4 bytes after the last facet are not used"});
}
