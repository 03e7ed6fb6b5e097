#include "clench/base/file.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "clench/base/error.h"
#include "support/folder.h"
#include "support/plain_user.h"

using namespace clench;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

long entries(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

std::string fault_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Message of the error thrown while no file may exceed a size, as on a nearly full disk.
std::string fault_with_space(rlim_t bytes, const std::function<void()>& run) {
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{bytes, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string fault = fault_of(run);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  return fault;
}

}  // namespace

TEST_CASE("a file is written completely, an older one is replaced, and no other file remains") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt";
  write_file(path, "one");
  write_file(path, "two\n");
  CHECK(read_bytes(path) == "two\n");
  CHECK(read_start(path, 2) == "tw");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a link is followed, not replaced, also a link to a file that does not exist yet") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.txt", "old"), link = folder.path() / "b.txt",
                 early = folder.path() / "c.txt", to = folder.path() / "d.txt";
  fs::create_symlink("a.txt", link);
  write_file(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK(read_bytes(file) == "new");
  fs::create_symlink(to, early);
  write_file(early, "first");
  CHECK(fs::is_symlink(early));
  CHECK(read_bytes(to) == "first");
}

TEST_CASE("a failed write reports its reason, and the old file is kept") {
  const TemporaryFolder folder;
  const std::string base = folder.path().generic_string();
  CHECK_THROWS_WITH_AS(
      write_file(folder.path() / "no" / "a.txt", "x"),
      (base + "/no/a.txt: the file cannot be written: no such folder: " + base + "/no").c_str(),
      Error);
  CHECK_THROWS_WITH_AS(write_file(folder.path(), "x"),
                       (base + ": expected a file to write, got a folder").c_str(), Error);
  const fs::path path = folder.write("a.txt", "old");
  CHECK_THROWS_WITH_AS(write_file(path / "b.txt", "x"),
                       (base + "/a.txt/b.txt: the file cannot be written: Not a directory").c_str(),
                       Error);
  const fs::path long_name = folder.path() / std::string(300, 'a');
  CHECK_THROWS_WITH_AS(
      write_file(long_name, "x"),
      (long_name.string() + ": the file cannot be written: File name too long").c_str(), Error);
  CHECK(fault_with_space(2, [&] { write_file(path, "new"); }) ==
        path.string() + ": the file cannot be written: File too large");
  CHECK(read_bytes(path) == "old");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a planted link at the path of a draft is not followed") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt", victim = folder.write("victim", "mine");
  fs::create_symlink(victim, fmt::format("{}.{}.part", path.string(), getpid()));
  fs::create_symlink(victim, folder.path() / ".a.saving.txt");
  write_file(path, "new");
  const Draft draft(path, "draft");
  CHECK(read_bytes(victim) == "mine");
  CHECK(read_bytes(path) == "new");
}

TEST_CASE("a file name of the maximal length is written") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / fmt::format("{:a>235}.{:b>19}", "", "");
  write_file(path, "x");
  CHECK(read_bytes(path) == "x");
}

TEST_CASE("a full disk is reported as such") {
  // that device accepts no data
  CHECK_THROWS_WITH_AS(write_file("/dev/full", "x"),
                       "/dev/full: expected a file to write, got a special file", Error);
  CHECK(system_reason(ENOSPC) == "No space left on device");
}

TEST_CASE("a write without permission is reported as such") {
  const TemporaryFolder folder;
  const fs::path closed = folder.path() / "closed", shut = folder.write("closed/a.txt", "old"),
                 fixed = folder.path() / "fixed", old = folder.write("fixed/a.txt", "old"),
                 secret = folder.write("secret", "old"), kept = folder.write("kept", "old");
  fs::permissions(folder.path(), fs::perms(0777));
  fs::permissions(closed, fs::perms::none);
  fs::permissions(fixed, fs::perms(0555));
  fs::permissions(old, fs::perms(0666));
  fs::permissions(secret, fs::perms::none);
  fs::permissions(kept, fs::perms(0444));
  std::vector<std::string> faults, expected;
  {
    const test::PlainUser user;
    const auto check = [&](const fs::path& path, const char* what,
                           const std::function<void()>& run) {
      faults.push_back(fault_of(run));
      expected.push_back(
          fmt::format("{}: the file cannot be {}: Permission denied", path.string(), what));
    };
    for (const fs::path& path : {shut, secret}) check(path, "read", [&] { read_bytes(path); });
    for (const fs::path& path : {shut, closed / "new", fixed / "new", old, secret, kept})
      check(path, "written", [&] { write_file(path, "new"); });
  }
  CHECK(faults == expected);
  fs::permissions(closed, fs::perms(0777));
  fs::permissions(fixed, fs::perms(0777));
  CHECK(read_bytes(old) == "old");
  CHECK(read_bytes(kept) == "old");
}

TEST_CASE("a file that is not regular is neither read nor replaced") {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH_AS(
      write_file(pipe, "text"),
      (pipe.generic_string() + ": expected a file to write, got a special file").c_str(), Error);
  CHECK_THROWS_WITH_AS(read_bytes(pipe),
                       (pipe.generic_string() + ": expected a file, got a special file").c_str(),
                       Error);
  CHECK_THROWS_WITH_AS(read_bytes(folder.path()),
                       (folder.path().generic_string() + ": expected a file, got a folder").c_str(),
                       Error);
  CHECK(fs::is_fifo(pipe));
  const std::string base = folder.path().generic_string();
  CHECK_THROWS_WITH_AS(read_bytes(folder.path() / "no"), ("no such file: " + base + "/no").c_str(),
                       Error);
  fs::create_symlink("loop", folder.path() / "loop");
  CHECK_THROWS_WITH_AS(
      read_bytes(folder.path() / "loop"),
      (base + "/loop: the file cannot be read: Too many levels of symbolic links").c_str(), Error);
}

TEST_CASE("a text is appended on a separate line") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt", link = folder.path() / "b.txt";
  append_file(path, "one");
  append_file(path, "two\n");
  CHECK(read_bytes(path) == "one\ntwo\n");
  write_file(path, "cut");
  fs::create_symlink("a.txt", link);
  append_file(link, "three\nfour");
  CHECK(read_bytes(path) == "cut\nthree\nfour\n");
  CHECK(fs::is_symlink(link));
  const std::string base = folder.path().generic_string();
  CHECK_THROWS_WITH_AS(append_file(folder.path(), "x"),
                       (base + ": expected a file to write, got a folder").c_str(), Error);
  CHECK_THROWS_WITH_AS(append_file("/dev/full", "x"),
                       "/dev/full: expected a file to write, got a special file", Error);
}

TEST_CASE("no part of a text that does not fit on the disk is appended") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.txt", "12\n");
  const std::string text(20000, 'x');
  for (const rlim_t space : {3, 4, 4096, 20003}) {
    CHECK(fault_with_space(space, [&] { append_file(path, text); }) ==
          path.string() + ": the file cannot be written: File too large");
    CHECK(read_bytes(path) == "12\n");
  }
  CHECK(fault_with_space(20004, [&] { append_file(path, text); }).empty());
  CHECK(read_bytes(path) == "12\n" + text + "\n");
}

TEST_CASE("checking that a file can be written changes nothing") {
  const TemporaryFolder folder;
  const fs::path old = folder.write("old", "old"), empty = folder.write("empty", "");
  const std::string base = folder.path().generic_string();
  for (const fs::path& path : {old, empty, folder.path() / "new"}) check_writable(path);
  CHECK(read_bytes(old) == "old");
  CHECK(entries(folder.path()) == 2);
  const auto pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const auto fault = [](const fs::path& path) { return fault_of([&] { check_writable(path); }); };
  CHECK(fault(pipe) == base + "/pipe: expected a file to write, got a special file");
  CHECK(fault("/dev/null") == "/dev/null: expected a file to write, got a special file");
  CHECK(fault(folder.path()) == base + ": expected a file to write, got a folder");
  CHECK(fault(folder.path() / "no/a") ==
        base + "/no/a: the file cannot be written: no such folder: " + base + "/no");
  CHECK(fault("") == "expected the name of a file, got nothing");
  fs::permissions(folder.path(), fs::perms(0555));
  std::string closed, open;
  {
    const test::PlainUser user;
    closed = fault(folder.path() / "new");
    open = fault(old);
  }
  fs::permissions(folder.path(), fs::perms(0755));
  CHECK(closed == base + "/new: the file cannot be written: Permission denied");
  CHECK(open == base + "/old: the file cannot be written: Permission denied");
}

TEST_CASE("a file keeps its permissions, and a new one follows the umask") {
  const TemporaryFolder folder;
  const auto secret = folder.write("secret", "old");
  fs::permissions(secret, fs::perms::owner_read | fs::perms::owner_write);
  write_file(secret, "new");
  CHECK(fs::status(secret).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  // the set-user-ID bit is cleared, since the contents have changed
  fs::permissions(secret, fs::perms(04755));
  write_file(secret, "newer");
  CHECK(fs::status(secret).permissions() == fs::perms(0755));
  const mode_t before = umask(027);
  write_file(folder.path() / "new", "new");
  umask(before);
  CHECK(fs::status(folder.path() / "new").permissions() == fs::perms(0640));
}

TEST_CASE("a draft has a unique name next to its file, and is removed at the end") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "w.wld";
  {
    const Draft one(file, "1"), two(file, "2");
    CHECK(one.path() != two.path());
    CHECK(one.path().parent_path() == folder.path());
    CHECK(one.path().extension() == ".wld");
    CHECK(one.path().filename().string().starts_with(".w."));
    CHECK(read_bytes(one.path()) == "1");
    CHECK(entries(folder.path()) == 2);
  }
  CHECK(entries(folder.path()) == 0);
}

TEST_CASE("if one of several files that belong together cannot be written, none is kept") {
  const TemporaryFolder folder;
  const fs::path old = folder.write("old", "old"), same = folder.write("same", "same");
  fs::permissions(old, fs::perms::owner_read | fs::perms::owner_write);
  {
    FileSet files;
    files.write(folder.path() / "a/b/one", "1");
    files.write(old, "new");
    files.write(same, "same");
    CHECK(read_bytes(old) == "new");
    CHECK_THROWS_AS(files.write(old / "in", "x"), Error);
  }
  CHECK(read_bytes(old) == "old");
  CHECK(fs::status(old).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(read_bytes(same) == "same");
  CHECK(entries(folder.path()) == 2);
  const fs::path link = folder.path() / "link";
  fs::create_symlink("nowhere", link);
  {
    FileSet files;
    files.write(link, "1");
    CHECK(entries(folder.path()) == 4);
  }
  CHECK(fs::is_symlink(link));
  fs::remove(link);
  CHECK(entries(folder.path()) == 2);
  {
    FileSet files;
    files.write(folder.path() / "a/b/one", "1");
    files.write(old, "new");
    files.keep();
  }
  CHECK(read_bytes(folder.path() / "a/b/one") == "1");
  CHECK(read_bytes(old) == "new");
  CHECK(entries(folder.path()) == 3);
}
