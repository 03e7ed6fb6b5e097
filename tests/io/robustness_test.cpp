// Files cut at any position, and files with bytes changed at random, give a spec or an Error, never
// a crash or a hang.
#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "support/mutate.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string inventor = R"(#Inventor V2.1 ascii
#mass 12
#inertia_matrix
#1 0 0
#0 1 0
#0 0 1
Separator { ShapeHints { vertexOrdering CLOCKWISE faceType UNKNOWN_FACE_TYPE }
 Material { diffuseColor [1 0 0, 0 1 0] } MaterialBinding { value PER_FACE_INDEXED } Normal { vector [0 0 1] }
 DEF C Coordinate3 { point [0 0 0, 1 0 0, 1 1 0, 0 1 0, 0.5 0.2 1] }
 IndexedFaceSet { coordIndex [0,1,2,3,-1,0,1,4,-1,1,2,4] materialIndex [0,1,1] normalIndex [0,5] }
 Transform { translation 1 2 3 rotation 0 1 0 0.5 scaleFactor 1 -2 3 } FaceSet { numVertices [3,-1] }
 FaceSet { vertexProperty VertexProperty { vertex [0 0 0, 1 0 0, 1 1 0] orderedRGBA [0xff00ffff] } }
 IndexedTriangleStripSet { coordIndex [0,1,2,3,4] } TriangleStripSet { numVertices [4] } QuadMesh { verticesPerRow 2 verticesPerColumn 2 }
 Group { DEF L Cube { width 2 } USE L } Sphere { } Cylinder { parts SIDES } Cone { } Switch { whichChild 0 Cube { } } Units { }
 Texture2 { filename "x.jpg" } Whirl { a 1 } MatrixTransform { matrix 1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1 } }
)";

const std::string vrml_body = R"(#VRML V2.0 utf8
DEF T Transform { translation 1 2 3 scale 1 2 3 children [
 Shape { appearance Appearance { material DEF M Material { diffuseColor 1 0 0 } texture ImageTexture { url "a.png" } }
  geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } coordIndex [0,1,2,3,-1] colorPerVertex FALSE
   color Color { color [1 0 0] } colorIndex [0] normal Normal { vector [0 0 1] } ccw FALSE } }
 Shape { geometry Box { size 1 2 3 } } Shape { geometry Cylinder { radius 1 } } Shape { geometry Sphere { } }
 Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [0,1,0,1] } }
 Shape { geometry Extrusion { crossSection [1 1, 1 -1, -1 -1, 1 1] spine [0 0 0, 0 1 0] } }
 Switch { whichChoice 0 choice [ Shape { geometry Cone { } } ] } ] }
PROTO P [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }
P { r 3 }
)";

const std::string cfg_robot = R"(Hand
box.iv
2
r 1 1e9 1e9 1e7 20
b 1 1e9 1e9 1e7 20 0.5
1
2
2
t 1 2 3
r 90 x
R
0 1 0
-1 0 0
0 0 1
d0+90 0 10 90 -10 90 5e7 0 1600 1
0 d1*2+-5 10 0 -10 90
Revolute
box.iv 0
Prismatic
box.iv
Approach
0 0 0
0 0 1
FlockOfBirds
1
t 0 0 1
)";

const std::string wld_world = R"(#GraspIt! version 2.0
Obstacle
box.iv
wood
T (+1 0 0 0)[+1 2 3]

Robot
hand.cfg
0.1 2 1 3
T (0.7 0.7 0 0)[0 0 0]

Robot
hand.cfg
0 0 0
T (1 0 0 0)[0 0 0]

Connection
0 0 1
box.iv
T (1 0 0 0)[0 0 5]

CameraFull
1 2 3 0 0 0 1 100
)";

const test::Oddities odd_texts = {
    {"-1", "999999999",  "-2147483648", "1e38",   "nan",    "1e-40", "{",    "}",    "[",
     "]",  "USE C",      "USE L",       "DEF C",  "\"",     "#",     "NULL", "Cube", "Separator { ",
     "-7", "PER_VERTEX", "OVERALL",     "CONVEX", "100000", ",",     "T",    "\n",   "d0",
     "r"}};

/// The folder with the files that others name, and a reader for texts of each format.
class TextBench {
 public:
  TextBench() {
    for (const auto* name : {"box.iv", "iv/box.iv"})
      folder_.write(name, "#Inventor V2.1 ascii\nCube { }\n");
    folder_.write("hand.cfg", cfg_robot);
  }
  /// returns  true if it was rejected   the test fails if the message does not name the file
  bool refused(const std::string& name, const std::string& text) {
    const fs::path file = folder_.write(name, text);
    try {
      if (name.ends_with(".cfg"))
        read_robot(file);
      else if (name.ends_with(".wld"))
        read_world(file);
      else
        read_body(file);
      return false;
    } catch (const Error& error) {
      CHECK_MESSAGE(std::string(error.what()).starts_with(name), error.what());
      return true;
    }
  }

 private:
  TemporaryFolder folder_;
};

void cut_text_everywhere(const std::string& name, const std::string& text, size_t step) {
  TextBench bench;
  int refused = 0;
  for (size_t n = 0; n <= text.size(); n += step) refused += bench.refused(name, text.substr(0, n));
  // most cuts are inside a token
  CHECK(refused * 2 > static_cast<int>(text.size() / step));
}

void change_text_at_random(const std::string& name, const std::string& text, int times) {
  TextBench bench;
  for (int i = 0; i < times; ++i) {
    Random random(11, static_cast<uint64_t>(i));
    const std::string bad = test::mutated(text, odd_texts, random);
    INFO(bad);
    bench.refused(name, bad);
  }
}

}  // namespace

TEST_CASE("the texts of this file are sound") {
  TextBench bench;
  CHECK_FALSE(bench.refused("a.iv", inventor));
  CHECK_FALSE(bench.refused("a.wrl", vrml_body));
  CHECK_FALSE(bench.refused("a.cfg", cfg_robot));
  CHECK_FALSE(bench.refused("a.wld", wld_world));
}

TEST_CASE("an Inventor file cut short anywhere is an Error or a body") {
  cut_text_everywhere("a.iv", inventor, 17);
}
TEST_CASE("a VRML file cut short anywhere is an Error or a body") {
  cut_text_everywhere("a.wrl", vrml_body, 17);
}
TEST_CASE("a robot file cut short anywhere is an Error or a robot") {
  cut_text_everywhere("a.cfg", cfg_robot, 1);
}
TEST_CASE("a world file cut short anywhere is an Error or a world") {
  cut_text_everywhere("a.wld", wld_world, 1);
}
TEST_CASE("an Inventor file changed at random is an Error or a body") {
  change_text_at_random("a.iv", inventor, 100);
}
TEST_CASE("a VRML file changed at random is an Error or a body") {
  change_text_at_random("a.wrl", vrml_body, 100);
}
TEST_CASE("a robot file changed at random is an Error or a robot") {
  change_text_at_random("a.cfg", cfg_robot, 300);
}
TEST_CASE("a world file changed at random is an Error or a world") {
  change_text_at_random("a.wld", wld_world, 200);
}
TEST_CASE("mesh files changed at random are Errors or bodies") {
  const std::string obj =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nusemtl x\nf 1//1 2//1 3//1\nf 1 "
      "2 4\nf 2 3 4 1\n";
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid a\n";
  cut_text_everywhere("a.stl", stl, 3);
  change_text_at_random("a.obj", obj, 200);
  change_text_at_random("a.stl", stl, 200);
}
TEST_CASE("noise is an Error in every format") {
  TextBench bench;
  for (uint64_t i = 0; i < 40; ++i) {
    Random random(13, i);
    const std::string noise = test::noise(random);
    for (const auto* name : {"a.iv", "a.wrl", "a.cfg", "a.wld", "a.stl"})
      CHECK(bench.refused(name, noise));
  }
}
