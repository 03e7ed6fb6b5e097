// Every entry of the API that opens files, with confined reading.
#include "command.h"

using namespace clench::test;

TEST_CASE("every entry that opens files stays within the folder of --confine, also through links") {
  const Folder folder;
  const std::string in = folder / "in", out = folder / "out";
  fs::create_directories(out + "/written");
  fs::create_directories(in);
  folder.file("out/file", "secret");
  fs::create_directory_symlink("../out", in + "/link");
  fs::create_symlink("../out/file", in + "/linked");
  fs::create_directory_symlink("../out", in + "/linked_files");
  fs::copy_file("models/objects/flask.iv", in + "/flask.iv");
  folder.file("in/world.lua", "error 'run'");
  const auto urdf = [&](const std::string& name, const std::string& mesh) {
    folder.file(name, "<robot name='r'><link name='a'>" +
                          (mesh.empty() ? ""
                                        : "<collision><geometry><mesh filename='" + mesh +
                                              "'/></geometry></collision>") +
                          "</link></robot>");
  };
  urdf("in/plain.urdf", "");
  urdf("in/names_file.urdf", "file");
  urdf("in/names_package.urdf", "package://p/file");
  const auto result =
      run("-q run --confine " + in + " tests/app/confined_entries.lua " + in + " " + out);
  CHECK_MESSAGE(result.code == 0, result.out);
  CHECK(has(result.out, "all confined"));
  // nothing was written through the links
  for (const auto& entry : fs::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    CHECK_MESSAGE((name == "file" || name == "written"), name);
  }
}
