// XML files cut at any position and with words exchanged at random give a spec or an Error that
// names the file, never a crash or a hang.
#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/io/read/read.h"
#include "support/mutate.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string xml_body = R"(<?xml version="1.0" ?>
<root>
  <material>rubber</material><youngs>1500000</youngs><mass>20</mass><cog>0 1 2</cog>
  <inertia_matrix>1 0 0 0 1 0 0 0 1</inertia_matrix><useFlockOfBirds>1</useFlockOfBirds>
  <normalCompliance>1</normalCompliance><shearCompliance>1</shearCompliance>
  <geometryFile type="Inventor">box.iv</geometryFile><geometryScalingX>2</geometryScalingX>
  <geometryOffset><transform><translation>1 2 3</translation><rotation>90 x</rotation>
    <rotationMatrix>0 1 0 -1 0 0 0 0 1</rotationMatrix><fullTransform>(1 0 0 0)[1 2 3]</fullTransform>
  </transform></geometryOffset>
</root>
)";

const std::string xml_robot = R"(<robot type="HumanHand" DBName="x">
  <palm>box.iv</palm>
  <dof type="r"><defaultVelocity>1</defaultVelocity><maxEffort>5e9</maxEffort><Kp>1e9</Kp></dof>
  <dof type="b"><defaultVelocity>1</defaultVelocity><breakAwayTorque>0.5</breakAwayTorque></dof>
  <chain><transform><translation>1 2 3</translation></transform>
    <joint type="Revolute"><theta>d0+90</theta><d>0</d><a>10</a><alpha>90</alpha><minValue>-10</minValue>
      <maxValue>90</maxValue><viscousFriction>5e7</viscousFriction><restValue>1</restValue></joint>
    <joint type="Prismatic"><theta>0</theta><d>d1*-2+5</d><a>10</a><alpha>0</alpha><minValue>5</minValue>
      <maxValue>-10</maxValue><springStiffness>16</springStiffness></joint>
    <link dynamicJointType="Revolute" collisionRule="Off">box.iv</link>
    <link dynamicJointType="Prismatic" collisionRule="OverlappingPair" targetChain="0" targetLink="0">box.iv</link>
    <link dynamicJointType="Fixed">box.iv</link>
    <filter params="0,0,0,1,1,1">1</filter>
  </chain>
  <disableCollision body1_chain="0" body1_link="1" body2_chain="-1" body2_link="0"/>
  <tendon name="t"><stiffness>1</stiffness>
    <insertionPoint><chain>-1</chain><link>-1</link><position>0 0 0</position></insertionPoint>
    <insertionPoint><chain>0</chain><link>1</link><position>0 0 0</position></insertionPoint></tendon>
  <tendonWrapper><chain>0</chain><link>0</link><position>0 0 0</position><orientation>0 0 1</orientation>
    <radius>5</radius><exemption tendon="t"/></tendonWrapper>
  <approachDirection><referenceLocation>0 0 0</referenceLocation><direction>0 0 1</direction></approachDirection>
  <flockOfBirds number="1"><transform><translation>0 0 1</translation></transform></flockOfBirds>
</robot>
)";

const std::string xml_world = R"(<world>
  <obstacle><filename>box.iv</filename><transform><fullTransform>(+1 0 0 0)[+1 2 3]</fullTransform></transform></obstacle>
  <graspableBody><body><mass>3</mass><geometryFile>box.iv</geometryFile></body></graspableBody>
  <robot><filename>hand.xml</filename><dofValues>0.1 2 1 3</dofValues></robot>
  <robot><filename>hand.xml</filename><dofValues>0 0 0</dofValues></robot>
  <connection><parentRobot>0</parentRobot><parentChain>0</parentChain><childRobot>1</childRobot>
    <mountFilename>box.iv</mountFilename></connection>
  <camera><position>1 2 3</position><orientation>0 0 0 1</orientation><focalDistance>100</focalDistance></camera>
</world>
)";

const test::Oddities odd_xml = {
    {"-1",   "999999999", "1e308", "nan", "<",    ">",    "/",   "</chain>",
     "<a>",  "\"",        "'",     "&",   "&lt;", "<!--", "-->", "<![CDATA[",
     "base", "d0",        "d5*0",  "]]>", "",     "0",    "=",   "(0 0 0 0)[0 0 0]"},
    " \n<>\""};

/// The folder with the files that others name, and a reader for texts of each kind.
class XmlBench {
 public:
  XmlBench() {
    for (const auto* name : {"box.iv", "iv/box.iv"})
      folder_.write(name, "#Inventor V2.1 ascii\nCube { }\n");
    folder_.write("hand.xml", xml_robot);
  }
  /// returns  true if it was rejected   the test fails if the message does not name the file
  bool refused(const std::string& kind, const std::string& text) {
    const fs::path file = folder_.write("a.xml", text);
    try {
      if (kind == "robot")
        read_robot(file);
      else if (kind == "world")
        read_world(file);
      else
        read_body(file);
      return false;
    } catch (const Error& error) {
      CHECK_MESSAGE(std::string(error.what()).starts_with("a.xml"), error.what());
      return true;
    }
  }

 private:
  TemporaryFolder folder_;
};

void try_all(const std::string& kind, const std::string& text, int times) {
  XmlBench bench;
  CHECK_FALSE(bench.refused(kind, text));
  // without its last tag the root element is incomplete
  for (size_t n = 0; n + 8 < text.size(); n += 7) CHECK(bench.refused(kind, text.substr(0, n)));
  for (int i = 0; i < times; ++i) {
    Random random(17, static_cast<uint64_t>(i));
    const std::string bad = test::mutated(text, odd_xml, random);
    INFO(bad);
    bench.refused(kind, bad);
  }
}

}  // namespace

TEST_CASE("an XML body cut short or changed at random is an Error or a body") {
  try_all("body", xml_body, 150);
}
TEST_CASE("an XML robot cut short or changed at random is an Error or a robot") {
  try_all("robot", xml_robot, 200);
}
TEST_CASE("an XML world cut short or changed at random is an Error or a world") {
  try_all("world", xml_world, 60);
}
