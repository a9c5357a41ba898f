// SPDX-License-Identifier: Apache-2.0
// Saving leaves the old file or the new one, never a part of it, and nothing else behind.
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "format/temporary_folder.h"
#include "format/writer/writer.h"

namespace sobb {
namespace {

using test::TemporaryFolder;

std::vector<std::byte> bytes_of(size_t size, char value) {
  return std::vector<std::byte>(size, static_cast<std::byte>(value));
}

void save(const std::string& path, size_t size, char value) {
  save_atomically(bytes_of(size, value), path.c_str());
}

// The message of a save that must fail.
std::string failure(const std::string& path, size_t size = 1000) {
  try {
    save(path, size, 'n');
  } catch (const Error& error) {
    EXPECT_EQ(error.status, SOBB_ERROR_FILE_WRITE);
    return error.what();
  }
  ADD_FAILURE() << "saved " << path;
  return "";
}

mode_t mode_of(const std::string& path) {
  struct stat status;
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 0777;
}

TEST(Save, CreatesAndReplaces) {
  const TemporaryFolder folder;
  save(folder.path("scene.sobb"), 100000, 'a');
  EXPECT_EQ(folder.read("scene.sobb"), std::string(100000, 'a'));
  save(folder.path("scene.sobb"), 10, 'b');
  EXPECT_EQ(folder.read("scene.sobb"), std::string(10, 'b'));
  EXPECT_EQ(folder.count(), 1);
}

TEST(Save, TakesAPathWithoutFolderAndTheLongestName) {
  const TemporaryFolder folder;
  const auto old = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  save("scene.sobb", 10, 'a');
  std::filesystem::current_path(old);
  EXPECT_EQ(folder.read("scene.sobb"), std::string(10, 'a'));
  const std::string longest(255, 'x');
  save(folder.path(longest), 10, 'b');
  EXPECT_EQ(folder.read(longest), std::string(10, 'b'));
}

TEST(Save, FollowsALink) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("below"));
  save(folder.path("below/real"), 10, 'a');
  std::filesystem::create_symlink("below/real", folder.path("link"));
  save(folder.path("link"), 20, 'b');
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link")));
  EXPECT_EQ(folder.read("below/real"), std::string(20, 'b'));
}

TEST(Save, KeepsPermissionsAndTheUmask) {
  const TemporaryFolder folder;
  const mode_t old = umask(027);
  save(folder.path("new"), 10, 'a');
  EXPECT_EQ(mode_of(folder.path("new")), 0640u);
  chmod(folder.path("new").c_str(), 0600);
  save(folder.path("new"), 10, 'a');
  EXPECT_EQ(mode_of(folder.path("new")), 0600u);
  umask(old);
}

TEST(Save, ManyAtOnce) {
  const TemporaryFolder folder;
  const std::string path = folder.path("scene.sobb");
  {
    std::vector<std::jthread> threads;
    for (const char value : {'a', 'b', 'c', 'd'}) {
      threads.emplace_back([&path, value] {
        for (int i = 0; i < 10; ++i) save(path, 50000, value);
      });
    }
  }
  const std::string text = folder.read("scene.sobb");
  ASSERT_EQ(text.size(), 50000u);
  EXPECT_EQ(text, std::string(50000, text[0]));
  EXPECT_EQ(folder.count(), 1);
}

TEST(Save, ImpossiblePlacesAreNamed) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "old");
  std::filesystem::create_directory(folder.path("below"));
  EXPECT_EQ(failure(folder.path("missing/scene.sobb")),
            folder.path("missing/scene.sobb: cannot open its folder: No such file or directory"));
  EXPECT_EQ(failure(file + "/scene.sobb"),
            file + "/scene.sobb: cannot open its folder: Not a directory");
  EXPECT_EQ(failure(folder.path("below")), folder.path("below: not a regular file"));
  EXPECT_EQ(failure(folder.path(std::string(256, 'x'))),
            folder.path(std::string(256, 'x')) + ": cannot be replaced: File name too long");
  EXPECT_EQ(failure("/dev/null"), "/dev/null: not a regular file");
  failure("");
  EXPECT_EQ(folder.read("file"), "old");
  EXPECT_EQ(folder.count(), 2);
}

// Runs in a child process, which becomes another user: root may write to any folder.
TEST(Save, AReadOnlyFolderIsNamed) {
  constexpr uid_t kNobody = 65534;
  const TemporaryFolder folder;
  folder.write("scene.sobb", "old");
  chmod(folder.path("").c_str(), 0555);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (geteuid() == 0 && setuid(kNobody) != 0) _exit(2);
    const std::string message = failure(folder.path("scene.sobb"));
    _exit(message.find("Permission denied") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  chmod(folder.path("").c_str(), 0700);
  EXPECT_EQ(folder.read("scene.sobb"), "old");
  EXPECT_EQ(folder.count(), 1);
}

// Runs in a child process, since a limit on the size of files holds for all that a process writes.
TEST(Save, AFileSizeLimitLeavesTheOldFile) {
  const TemporaryFolder folder;
  folder.write("scene.sobb", "old");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{65536, 65536};
    setrlimit(RLIMIT_FSIZE, &limit);
    _exit(failure(folder.path("scene.sobb"), 100000) ==
                  folder.path("scene.sobb: cannot write: File too large")
              ? 0
              : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(folder.read("scene.sobb"), "old");
  EXPECT_EQ(folder.count(), 1);
}

TEST(Save, AFullDiskLeavesTheOldFile) {
  const TemporaryFolder folder;
  const std::string disk = folder.path("disk");
  std::filesystem::create_directory(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "may not mount a small disk here";
  }
  folder.write("disk/scene.sobb", "old");
  EXPECT_EQ(failure(disk + "/scene.sobb", 100000),
            disk + "/scene.sobb: cannot write: No space left on device");
  EXPECT_EQ(folder.read("disk/scene.sobb"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk), {}), 1);
  save(disk + "/scene.sobb", 1000, 'a');
  EXPECT_EQ(folder.read("disk/scene.sobb"), std::string(1000, 'a'));
  EXPECT_EQ(umount(disk.c_str()), 0);
}

}  // namespace
}  // namespace sobb
