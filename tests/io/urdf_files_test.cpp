// Mesh files named by a URDF in all kinds of spelling.
#include "clench/io/urdf/urdf_files.h"

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;
namespace fs = std::filesystem;

static std::string robot_with_mesh(const std::string& name) {
  return "<robot name='r'><link name='a'><collision><geometry><mesh filename='" + name +
         "'/></geometry></collision></link></robot>";
}

TEST_CASE("a mesh is found in any case and with either slash, by every scheme") {
  const TemporaryFolder folder;
  const std::string obj = read_text("tests/data/urdf/finger.obj");
  folder.write("arm_description/meshes/base_link.obj", obj);
  const char* spellings[] = {
      "meshes/base_link.obj",    "meshes/base_link.OBJ",   "Meshes/Base_Link.obj",
      "meshes\\base_link.obj",   "MESHES\\BASE_LINK.OBJ",  "meshes//base_link.obj",
      "meshes\\\\base_link.obj", "meshes/base%5Flink.obj", "./meshes/../meshes/base_link.obj "};
  ReadOptions within, above, named;
  within.packages[""] = folder.path() / "arm_description";
  above.packages[""] = folder.path();
  named.packages["arm_description"] = folder.path() / "arm_description";
  named.packages["Arm_Description"] = folder.path() / "arm_description";
  for (const std::string spelling : spellings)
    for (const std::string scheme :
         {"arm_description/", "file://arm_description/", "package://arm_description/",
          "package://Arm_Description/", "PACKAGE://arm_description/", "model://arm_description/",
          "package:\\\\arm_description\\"})
      for (const char* place :
           {"r.urdf", "arm_description/r.urdf", "arm_description/urdf/r.urdf"}) {
        const bool is_package = scheme[0] != 'a' && scheme[0] != 'f';
        if (!is_package && std::string(place) != "r.urdf") continue;
        const fs::path file = folder.write(place, robot_with_mesh(scheme + spelling));
        CAPTURE(place);
        CAPTURE(scheme + spelling);
        for (const ReadOptions& options : {ReadOptions(), within, above, named})
          CHECK(ToldRobot(file, options).robot.base.shape);
        fs::remove(file);
      }
}

TEST_CASE("file:// names an absolute path, with a host or without") {
  const TemporaryFolder folder;
  folder.write("a b/part.obj", "");
  const std::string path = fs::absolute(folder.path() / "a b/part.obj").string();
  std::string escaped = path;
  escaped.replace(escaped.find(' '), 1, "%20");
  for (const std::string scheme : {"file://", "file:", "FILE://", "file://localhost", "file:///"})
    for (const std::string& name : {path, escaped}) {
      CAPTURE(scheme + name);
      CHECK(fs::equivalent(find_robot_file(scheme + name, "r.urdf", {}), path));
    }
}

TEST_CASE("a path behind a package stays within the package") {
  const TemporaryFolder folder;
  folder.write("arm/part.obj", "");
  const std::string outside = fs::absolute(folder.write("part.stl", "")).string();
  const fs::path file = folder.path() / "r.urdf";
  CHECK_THROWS_WITH_AS(find_robot_file("package://arm/" + outside, file, {}),
                       doctest::Contains("no such file in package 'arm': "), Error);
  ReadOptions given;
  given.packages["Arm"] = folder.path() / "arm";
  CHECK(fs::equivalent(find_robot_file("package://arm//part.obj", file, given),
                       folder.path() / "arm/part.obj"));
  CHECK_THROWS_WITH_AS(find_robot_file("package:///", file, {}),
                       "expected package://PACKAGE/FILE, got 'package:///'", Error);
}

TEST_CASE("an exact name goes before one in another case, wherever it lies") {
  const TemporaryFolder folder;
  folder.write("deep/Arm/part.obj", "");
  folder.write("arm/part.obj", "");
  CHECK(fs::weakly_canonical(
            find_robot_file("package://arm/part.obj", folder.path() / "deep/r.urdf", {})) ==
        fs::weakly_canonical(folder.path() / "arm/part.obj"));
  CHECK(fs::weakly_canonical(
            find_robot_file("package://ARM/part.obj", folder.path() / "deep/r.urdf", {})) ==
        fs::weakly_canonical(folder.path() / "deep/Arm/part.obj"));
}

TEST_CASE("a missing mesh of a package is refused with the package's name as the file has it") {
  const TemporaryFolder folder;
  folder.write("arm/part.obj", "");
  const fs::path file = folder.path() / "r.urdf";
  CHECK_THROWS_WITH_AS(find_robot_file("package://ARM/none.obj", file, {}),
                       "no package 'ARM' with 'none.obj' beside or above the file; the option "
                       "'package' names its folder",
                       Error);
  CHECK_THROWS_WITH_AS(find_robot_file("package://arm/none.obj", file, {}),
                       "no such file in package 'arm': none.obj", Error);
}
