#include "clench/io/mesh/mesh_readers.h"

#include <algorithm>

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
  for (const std::string start : {"solid ", "solid a facet ", "solid part #3\n"}) {
    std::string all = start + line.substr(line.find('\n') + 1);
    CHECK(read_stl_text(all).shape->faults().none());
  }
  const Mesh other = moved(mesh, {Eigen::Quaterniond::Identity(), {3, 0, 0}});
  CHECK(read_stl_text(text + "\n" + ascii_stl(other)).shape->mesh().triangles.size() == 24);
  std::string both = text + " " + ascii_stl(other);
  std::ranges::replace(both, '\n', ' ');
  CHECK(read_stl_text(both).shape->mesh().triangles.size() == 24);
  std::string returns = text;
  for (size_t i = 0; (i = returns.find('\n', i)) != std::string::npos; i += 2)
    returns.insert(i, 1, '\r');
  CHECK(read_stl_text(returns).shape->faults().none());
}

TEST_CASE("an STL file has no colors") {
  CHECK_FALSE(read_stl_text(ascii_stl(box(1, 1, 1))).appearance.given);
}

TEST_CASE("what is wrong in an ascii STL file is told by line") {
  const std::string start = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const auto refused = [&](const std::string& text, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_stl_text(text), ("q.stl:" + sentence).c_str(), Error);
  };
  refused(start + "endloop", "6: expected three vertices per facet, got 2");
  refused(start + "vertex 1 1 0\nvertex 2 2 2", "7: expected three vertices per facet, got more");
  refused(start + "vertex 1 x 0", "6: expected three numbers after vertex, got 'x'");
  refused(start + "vertex 1 nan 0", "6: expected three numbers after vertex, got 'nan'");
  refused(start + "vertx 1 1 0", "6: expected 'vertex' or 'endloop', got 'vertx'");
  refused(start + "vertex 1 1 0\nendloop\nendsolid", "8: expected 'endfacet', got 'endsolid'");
  refused(start + "vertex 1 1 0\nendloop\nendfacet\nend",
          "9: expected 'facet' or 'endsolid', got 'end'");
  refused("solid\nfacet 0 0 1", "2: expected 'normal' after facet");
  refused("solid\nface normal", "2: expected 'facet' or 'endsolid', got 'face'");
  refused("solid\nendsolid\nmore", "3: expected 'solid', got 'more'");
  refused("solid\nendsolid", " expected triangles, got none");
}

TEST_CASE("text around the facets of an ASCII STL file may be missing or longer than expected") {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
      "endfacet\n";
  struct Case {
    std::string text;
    size_t triangles;
    std::vector<std::string> warnings;
  };
  const std::string ended = "expected 'endsolid', got the end of the file; the solid ends here";
  const std::string solid = "solid\n" + facet + "endsolid\n";
  const Case cases[] = {
      {"solid a\n" + facet, 1, {"q.stl:8: " + ended}},
      {"solid a\n" + facet + facet + "\n\n", 2, {"q.stl:15: " + ended}},
      {"solid a\n" + facet + "solid b\n" + facet + "endsolid b",
       2,
       {"q.stl:9: expected 'endsolid', got 'solid'; the solid ends here"}},
      {facet + "endsolid", 1, {"q.stl:1: expected 'solid', got 'facet'; the solid begins here"}},
      {solid + std::string(5, '\0'), 1, {}},
      {solid + std::string(512, '\0'), 1, {}},
      {solid + "\x1A", 1, {}},
      {"\n \t\r\n\n" + solid, 1, {}},
      {"\xEF\xBB\xBF" + solid, 1, {}},
      {"# made by hand\n#\n" + solid, 1, {}},
      {"solid\n// a\n# b\n" + facet + "// c\nendsolid // d", 1, {}},
      {"solid a\n\n" + facet.substr(0, 19) + "// n\n" + facet.substr(19) + "endsolid", 1, {}},
      {"\xEF\xBB\xBF\n#" + std::string(3000, '-') + "\n" + solid, 1, {}},
      {"// made by\n; a program\n" + solid, 1, {"q.stl:1: the text before 'solid' is not used"}},
  };
  for (const Case& c : cases) {
    CAPTURE(c.text);
    Warnings warnings;
    // a single triangle is not a solid, which is not reported here
    CHECK(read_stl_text(c.text, warnings.options()).shape->mesh().triangles.size() == c.triangles);
    CHECK(warnings.list == c.warnings);
  }
}

TEST_CASE("a binary STL file may begin as an ascii one does") {
  std::string content = binary_stl(box(1, 1, 1));
  for (const std::string start : {"solid", "solid a facet", "\nsolid", "# solid\nsolid b"}) {
    content.replace(0, start.size(), start);
    CHECK(read_stl_text(content).shape->mesh().triangles.size() == 12);
    Warnings warnings;
    CHECK(read_stl_text(content + std::string(7, '\0'), warnings.options())
              .shape->mesh()
              .triangles.size() == 12);
    CHECK(warnings.list ==
          std::vector<std::string>{"q.stl: 7 bytes after the last facet are not used"});
  }
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
