#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "support/plain_user.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE(
    "a name is looked up beside the referrer, below the root, below the referrer's parent folder") {
  const TemporaryFolder folder;
  const fs::path world = folder.write("home/worlds/w.wld", "");
  const fs::path beside = folder.write("home/worlds/models/a.iv", ""),
                 root = folder.write("root/models/a.iv", ""),
                 parent = folder.write("home/models/a.iv", "");
  ReadOptions options;
  options.root = folder.path() / "root";
  CHECK(find_file("models/a.iv", world, options) == beside);
  fs::remove(beside);
  CHECK(find_file("models/a.iv", world, options) == root);
  fs::remove(root);
  CHECK(find_file("models/a.iv", world, options) == parent);
  fs::remove(parent);
  CHECK_THROWS_WITH_AS(find_file("models/a.iv", world, options), "no such file: models/a.iv",
                       Error);
}

TEST_CASE("what the user names is looked up where we stand, then below the root") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.iv", "");
  ReadOptions options;
  options.root = folder.path();
  CHECK(find_file("a.iv", "", options) == file);
  CHECK(find_file(file.string(), "", {}) == file);
  CHECK(find_file("tests/CMakeLists.txt", "", options) == "tests/CMakeLists.txt");
}

TEST_CASE("back-slashes and another case are understood, an exact name goes first") {
  const TemporaryFolder folder;
  const fs::path mug = folder.write("Models/Mug.IV", ""), upper = folder.write("B.iv", ""),
                 lower = folder.write("b.iv", "");
  const fs::path referrer = folder.path() / "w.wld";
  CHECK(find_file("models\\mug.iv", referrer, {}) == mug);
  CHECK(find_file("b.iv", referrer, {}) == lower);
  CHECK(find_file("B.iv", referrer, {}) == upper);
  CHECK(find_file("./Models/../b.iv", referrer, {}) == lower);
}

TEST_CASE("a file whose own name has a backslash is found before one in a folder") {
  const TemporaryFolder folder;
  folder.write("b\\c.off", "");
  CHECK(find_file("b\\c.off", folder.path() / "x", {}) == folder.path() / "b\\c.off");
  folder.write("b/c.off", "");
  CHECK(find_file("b\\c.off", folder.path() / "x", {}) == folder.path() / "b\\c.off");
  CHECK(find_file("b/c.off", folder.path() / "x", {}) == folder.path() / "b/c.off");
}

TEST_CASE("a near name in the same folder is suggested") {
  const TemporaryFolder folder;
  folder.write("models/flask.iv", "");
  const fs::path referrer = folder.path() / "w.wld";
  CHECK_THROWS_WITH_AS(find_file("models/flsk.iv", referrer, {}),
                       "no such file: models/flsk.iv; did you mean 'flask.iv'?", Error);
  CHECK_THROWS_WITH_AS(find_file("no/such.wld", "", {}), "no such file: no/such.wld", Error);
}

TEST_CASE("a folder, an empty name and a monstrous one are no files") {
  CHECK_THROWS_WITH_AS(find_file("tests", "", {}), "expected a file, got a folder: tests", Error);
  CHECK_THROWS_WITH_AS(find_file("/dev/zero", "", {}),
                       "expected a file, got a special file: /dev/zero", Error);
  CHECK_THROWS_WITH_AS(find_file(" ", "", {}), "expected the name of a file, got nothing", Error);
  CHECK_THROWS_AS(find_file(std::string(100000, 'x'), "", {}), Error);
  CHECK_THROWS_AS(find_file(std::string("a\0b", 3), "", {}), Error);
}

TEST_CASE("what may be there and cannot be seen is told with the reason") {
  const TemporaryFolder folder;
  folder.write("closed/a.iv", "");
  const fs::path closed = folder.path() / "closed", world = folder.path() / "w.wld";
  fs::permissions(closed, fs::perms::none);
  std::string fault;
  {
    const test::PlainUser user;
    try {
      find_file("closed/a.iv", world, {});
    } catch (const Error& error) {
      fault = error.what();
    }
  }
  fs::permissions(closed, fs::perms(0777));
  CHECK(fault == "closed/a.iv: the file cannot be read: Permission denied");
  CHECK_THROWS_WITH_AS(
      find_file(std::string(300, 'a'), world, {}),
      (excerpt(std::string(300, 'a')) + ": the file cannot be read: File name too long").c_str(),
      Error);
  folder.write("plain", "");
  CHECK_THROWS_WITH_AS(find_file("plain/a.iv", world, {}), "no such file: plain/a.iv", Error);
}

TEST_CASE("links that lead in a circle, or to nothing, are called what they are") {
  const TemporaryFolder folder;
  fs::create_symlink("b.iv", folder.path() / "a.iv");
  fs::create_symlink("a.iv", folder.path() / "b.iv");
  fs::create_symlink("gone.iv", folder.path() / "c.iv");
  const fs::path world = folder.path() / "w.wld";
  CHECK_THROWS_WITH_AS(find_file("a.iv", world, {}),
                       "a.iv: the file cannot be read: Too many levels of symbolic links", Error);
  CHECK_THROWS_WITH_AS(find_file("c.iv", world, {}),
                       "no such file: c.iv, a link that leads to nothing", Error);
}
