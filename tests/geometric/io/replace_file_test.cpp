#include "scratch_files.h"

#include <handway/geometric/io/replace_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

using test::input_error_of;
using test::ScratchFiles;
using testing::HasSubstr;

std::ptrdiff_t file_count(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(ReplaceFile, WritesNewAndOldFiles) {
  const ScratchFiles files;
  const fs::path file = files.folder() / "a.txt";
  replace_file(file, "one");
  EXPECT_EQ(ScratchFiles::read(file), "one");
  replace_file(file, "two");
  EXPECT_EQ(ScratchFiles::read(file), "two");
  EXPECT_EQ(file_count(files.folder()), 1);
}

TEST(ReplaceFile, KeepsPermissionsAndLinks) {
  const ScratchFiles files;
  const fs::path file = files.write("a.txt", "one");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("a.txt", files.folder() / "link.txt");
  replace_file(files.folder() / "link.txt", "two");
  EXPECT_TRUE(fs::is_symlink(files.folder() / "link.txt"));
  EXPECT_EQ(ScratchFiles::read(file), "two");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(ReplaceFile, RemovesWhatKilledWritersHaveLeft) {
  const ScratchFiles files;
  const fs::path file = files.folder() / "a.txt";
  // The kernel kills the process while it writes.
  const pid_t writer = ::fork();
  if (writer == 0) {
    const rlimit small{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    replace_file(file, std::string(5000, 'x'));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(writer, &status, 0), writer);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(file_count(files.folder()), 1) << "the test needs a leftover";
  const fs::path left = fs::directory_iterator(files.folder())->path();

  // One of a program that still runs, and a file of the user's that looks alike.
  std::string name = left.filename().string();
  name.replace(name.find(std::to_string(writer)), std::to_string(writer).size(),
               std::to_string(::getppid()));
  files.write(name, "being written");
  files.write(".handway-write-notes-1", "mine");

  replace_file(file, "whole");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(ScratchFiles::read(file), "whole");
  EXPECT_EQ(ScratchFiles::read(files.folder() / name), "being written");
  EXPECT_EQ(ScratchFiles::read(files.folder() / ".handway-write-notes-1"), "mine");
}

TEST(ReplaceFile, LeavesTheOldFileWhenTheDiskIsFull) {
  const ScratchFiles files;
  const fs::path file = files.write("a.txt", "one");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = input_error_of([&] { replace_file(file, std::string(5000, 'x')); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_THAT(message, HasSubstr("as it was before"));
  EXPECT_EQ(ScratchFiles::read(file), "one");
  EXPECT_EQ(file_count(files.folder()), 1) << "no temporary file stays";
}

TEST(ReplaceFile, RefusesPlacesThatCanNotBeWrittenTo) {
  const ScratchFiles files;
  const auto refusal = [](const fs::path& file) {
    return input_error_of([&] { replace_file(file, "x"); });
  };
  EXPECT_THAT(refusal(files.folder()), HasSubstr("directory"));
  EXPECT_THAT(refusal(files.folder() / "no" / "a.txt"), HasSubstr("No such file"));
  if (::geteuid() != 0) {  // root may write everywhere
    const fs::path file = files.write("a.txt", "one");
    fs::permissions(file, fs::perms::owner_read);
    EXPECT_THAT(refusal(file), HasSubstr("denied"));
  }
}

TEST(ReplaceFile, WritesToDevices) {
  EXPECT_NO_THROW(replace_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(input_error_of([] { replace_file("/dev/full", "x"); }), HasSubstr("No space"));
}

}  // namespace
}  // namespace handway::geometric
