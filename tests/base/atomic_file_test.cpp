/// Files appear whole or not at all, whatever else lies in their folder.

#include "geometry/base/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "geometry/base/error.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

using test::TemporaryFolder;

/// The sentence of the Error that writing throws; empty when it throws none.
std::string problem_of_writing(const std::filesystem::path& path) {
  try {
    write_file(path, "new");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void expect_says(const std::filesystem::path& path, const std::string& part) {
  const std::string problem = problem_of_writing(path);
  EXPECT_NE(problem.find(part), std::string::npos) << problem;
}

TEST(AtomicFile, LeavesTheOldFileWhenWritingFails) {
  const TemporaryFolder folder;
  test::write_text(folder / "old.msh", "old");
  {
    AtomicFile file(folder / "old.msh");
    file.write("new");
  }
  EXPECT_EQ(test::file_text(folder / "old.msh"), "old");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(AtomicFile, ReplacesAFileAndKeepsItsPermissions) {
  const TemporaryFolder folder;
  test::write_text(folder / "old.msh", "a longer old text");
  ::chmod((folder / "old.msh").c_str(), 0640);
  EXPECT_EQ(problem_of_writing(folder / "old.msh"), "");
  EXPECT_EQ(test::file_text(folder / "old.msh"), "new");
  EXPECT_EQ(folder.file_count(), 1);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "old.msh").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
}

TEST(AtomicFile, WritesWhereLinksLead) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "deep");
  test::write_text(folder / "old.msh", "old");
  std::filesystem::create_symlink(folder / "old.msh", folder / "link.msh");
  // To a link to a file that is still to be made.
  std::filesystem::create_symlink("deep/second.msh", folder / "first.msh");
  std::filesystem::create_symlink("new.msh", folder / "deep" / "second.msh");
  for (const auto& [link, file] : {std::pair{"link.msh", "old.msh"}, {"first.msh", "deep/new.msh"}}) {
    EXPECT_EQ(problem_of_writing(folder / link), "");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / link));
    EXPECT_FALSE(std::filesystem::is_symlink(folder / file));
    EXPECT_EQ(test::file_text(folder / file), "new");
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "deep" / "second.msh"));
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
  const TemporaryFolder folder;
  expect_says(folder / "none" / "a.msh", "No such file or directory");
  expect_says(folder.path(), "Is a directory");
  std::filesystem::create_symlink("/dev/full", folder / "full.msh");
  expect_says(folder / "full.msh", "No space left on device");
  std::filesystem::create_symlink("circle.msh", folder / "circle.msh");
  expect_says(folder / "circle.msh", "Too many levels of symbolic links");
}

bool has_unnamed_files(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  return descriptor >= 0 && ::close(descriptor) == 0;
}

TEST(AtomicFile, AKillWhileWritingLeavesNothing) {
  const TemporaryFolder folder;
  if (!has_unnamed_files(folder.path())) GTEST_SKIP() << "NOT TESTED: no unnamed files in this file system";
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(folder / "a.msh");
    file.write("half of it");
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(folder.file_count(), 0);
}

/// In containers all processes have the same number: names made of it are in use, by others at work and by
/// those that were killed.
TEST(AtomicFile, NamesMadeOfTheProcessNumberAreNotNeeded) {
  const TemporaryFolder folder;
  constexpr int leftovers = 50;
  for (int i = 0; i < leftovers; ++i)
    test::write_text(folder / fmt::format(".quadrille-{}-{}.tmp", ::getpid(), i), "in use");
  for (int i = 0; i < leftovers; ++i) EXPECT_EQ(problem_of_writing(folder / "a.msh"), "");
  EXPECT_EQ(folder.file_count(), leftovers + 1);
}

}  // namespace
}  // namespace quadrille
