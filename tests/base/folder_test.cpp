#include "clench/base/folder.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "clench/base/error.h"
#include "support/folder.h"
#include "support/plain_user.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;
using Names = std::vector<std::string>;

TEST_CASE("a folder lists folders and everything else, sorted, with links and special files") {
  const TemporaryFolder folder;
  for (const char* name : {"b.iv", "a.iv", ".hidden", "ü.iv", "in/x.iv"}) folder.write(name, "");
  fs::create_directory(folder.path() / "Empty");
  fs::create_directory_symlink(folder.path() / "in", folder.path() / "link");
  fs::create_symlink(folder.path() / "gone", folder.path() / "dangling");
  REQUIRE(::mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
  const FolderContents contents = list_folder(folder.path());
  CHECK(contents.folders == Names{"Empty", "in", "link"});
  CHECK(contents.files == Names{".hidden", "a.iv", "b.iv", "dangling", "pipe", "ü.iv"});
  CHECK(list_folder(folder.path() / "link").files == Names{"x.iv"});
  CHECK(list_folder(folder.path() / "Empty").files.empty());
}

TEST_CASE("a folder is created with those above it, or its reason is reported") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", ""), deep = folder.path() / "a/b/c";
  for (int i = 0; i < 2; ++i) {
    make_folder(deep);
    CHECK(fs::is_directory(deep));
  }
  CHECK_THROWS_WITH_AS(make_folder(file),
                       (file.string() + ": the folder cannot be created: Not a directory").c_str(),
                       Error);
  CHECK_THROWS_WITH_AS(
      make_folder(file / "in"),
      (file.string() + "/in: the folder cannot be created: Not a directory").c_str(), Error);
}

TEST_CASE("a path that is no readable folder is rejected with the reason") {
  const TemporaryFolder folder;
  const std::string place = folder.path().string();
  folder.write("file", "");
  folder.write("closed/file", "");
  CHECK_THROWS_WITH_AS(list_folder(place + "/none"), ("no such folder: " + place + "/none").c_str(),
                       Error);
  CHECK_THROWS_WITH_AS(list_folder(place + "/file"),
                       (place + "/file: expected a folder, got a file").c_str(), Error);
  CHECK_THROWS_WITH_AS(list_folder(place + "/file/in"),
                       ("no such folder: " + place + "/file/in").c_str(), Error);
  fs::permissions(folder.path(), fs::perms(0777));
  fs::permissions(folder.path() / "closed", fs::perms::none);
  std::string fault;
  {
    const test::PlainUser user;
    try {
      list_folder(place + "/closed");
    } catch (const Error& error) {
      fault = error.what();
    }
  }
  fs::permissions(folder.path() / "closed", fs::perms(0777));
  CHECK(fault == place + "/closed: the folder cannot be read: Permission denied");
  CHECK_THROWS_WITH_AS(
      list_folder(std::string(300, 'x')),
      (std::string(300, 'x') + ": the folder cannot be read: File name too long").c_str(), Error);
}
