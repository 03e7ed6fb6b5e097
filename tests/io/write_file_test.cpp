#include "io/write_file.h"

#include <sys/stat.h>

#include "base/error.h"
#include "base/text.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("a file is written whole, an older one is replaced, and nothing else is left") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt";
  write_file(path, "one");
  write_file(path, "two\n");
  CHECK(read_text(path) == "two\n");
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("a link is followed, not replaced") {
  TemporaryFolder folder;
  const fs::path file = folder.write("a.txt", "old"), link = folder.path() / "b.txt";
  fs::create_symlink(file, link);
  write_file(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK(read_text(file) == "new");
}

TEST_CASE("what cannot be written is told, and the old file stays") {
  TemporaryFolder folder;
  const std::string base = folder.path().generic_string();
  CHECK_THROWS_WITH_AS(
      write_file(folder.path() / "no" / "a.txt", "x"),
      (base + "/no/a.txt: the file cannot be written: no such folder: " + base + "/no").c_str(),
      Error);
  CHECK_THROWS_WITH_AS(write_file(folder.path(), "x"),
                       (base + ": wanted a file to write, got a folder").c_str(), Error);
  // where a folder has the name that is written first, nothing can stand there
  const fs::path path = folder.write("a.txt", "old");
  fs::create_directories(fmt::format("{}.{}.part/in", path.string(), getpid()));
  CHECK_THROWS_WITH_AS(
      write_file(path, "new"),
      (path.generic_string() + ": the file cannot be written: no permission, or no space").c_str(),
      Error);
  CHECK(read_text(path) == "old");
}

TEST_CASE("what is no regular file is not replaced, and a file keeps its permissions") {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH_AS(write_file(pipe, "text"),
                       (pipe.generic_string() + ": wanted a file to write, got a special file").c_str(),
                       Error);
  CHECK(fs::is_fifo(pipe));
  const auto secret = folder.write("secret", "old");
  fs::permissions(secret, fs::perms::owner_read | fs::perms::owner_write);
  write_file(secret, "new");
  CHECK(fs::status(secret).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}
