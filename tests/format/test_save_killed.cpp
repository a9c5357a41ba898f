// SPDX-License-Identifier: Apache-2.0
// A writer that is killed, at any of its system calls or at a random moment, leaves the old file or
// the new one, and abandoned files that do not pile up.
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "format/temporary_folder.h"
#include "format/writer/writer.h"

namespace sobb {
namespace {

using test::TemporaryFolder;

constexpr size_t kOldSize = 300'000;
constexpr size_t kNewSize = 500'000;

void save(const std::string& path, size_t size, char value) {
  const std::vector<std::byte> bytes(size, static_cast<std::byte>(value));
  save_atomically(bytes, path.c_str());
}

const std::string& old_text() {
  static const std::string text(kOldSize, 'o');
  return text;
}
const std::string& new_text() {
  static const std::string text(kNewSize, 'n');
  return text;
}

// Expects that a folder holds at most one abandoned temporary file besides the file itself.
void expect_little_left(const TemporaryFolder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder.path(""))) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(name == "scene.sobb" || name == "link" || name == ".sobb-0.tmp") << name;
  }
}

// Runs body in a child that stops before and after each of its system calls, and kills it at stop
// number `kill_at`. Returns false if the child ended before that stop.
template <class Body>
bool kill_at_stop(int kill_at, const Body& body) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(2);
    raise(SIGSTOP);
    body();
    _exit(0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  for (int stop = 0; WIFSTOPPED(status); ++stop) {
    if (stop == kill_at) {
      kill(child, SIGKILL);
      EXPECT_EQ(waitpid(child, &status, 0), child);
      return true;
    }
    ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    EXPECT_EQ(waitpid(child, &status, 0), child);
  }
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return false;
}

bool may_trace() {
  const pid_t child = fork();
  if (child == 0) _exit(ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0 ? 0 : 1);
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

struct Way {
  const char* name;
  bool has_old;
  bool by_link;
  bool has_left;  // the temporary of a writer that was killed before
};

class SaveKilled : public testing::TestWithParam<Way> {};

TEST_P(SaveKilled, AtEachSystemCall) {
  if (!may_trace()) GTEST_SKIP() << "processes may not be traced here";
  const TemporaryFolder folder;
  const std::string real = folder.path("scene.sobb");
  const std::string target = GetParam().by_link ? folder.path("link") : real;
  if (GetParam().by_link) std::filesystem::create_symlink("scene.sobb", target);
  int killed = 0;
  int found_new = 0;
  for (bool ended = false; !ended;) {
    std::filesystem::remove(real);
    std::filesystem::remove(folder.path(".sobb-0.tmp"));
    if (GetParam().has_left) folder.write(".sobb-0.tmp", "abandoned");
    if (GetParam().has_old) folder.write("scene.sobb", old_text());
    ended = !kill_at_stop(killed, [&] { save(target, kNewSize, 'n'); });
    if (ended) break;
    ++killed;
    const std::string text = folder.read("scene.sobb");
    const bool is_new = text == new_text();
    found_new += is_new ? 1 : 0;
    ASSERT_TRUE(is_new || text == (GetParam().has_old ? old_text() : ""))
        << "half a file of " << text.size() << " bytes, killed at stop " << killed;
    expect_little_left(folder);
  }
  EXPECT_EQ(folder.read("scene.sobb"), new_text());
  EXPECT_EQ(folder.count(), GetParam().by_link ? 2 : 1) << "a save removes what was left";
  EXPECT_GT(found_new, 0);
  EXPECT_LT(found_new, killed);
  std::printf("%s: killed at %d stops, the new file was there at %d\n", GetParam().name, killed,
              found_new);
}

INSTANTIATE_TEST_SUITE_P(Ways, SaveKilled,
                         testing::Values(Way{"Replacing", true, false, false},
                                         Way{"New", false, false, false},
                                         Way{"ThroughALink", true, true, false},
                                         Way{"WithATemporaryLeft", true, false, true}),
                         [](const auto& way) { return std::string(way.param.name); });

TEST(SaveKilledAnywhere, AtRandomMoments) {
  constexpr int kKills = 200;
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const TemporaryFolder folder;
  const std::string path = folder.path("scene.sobb");
  save(path, kOldSize, 'o');
  for (int i = 0; i < kKills; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      for (;;) {
        save(path, kNewSize, 'n');
        save(path, kOldSize, 'o');
      }
    }
    usleep(random() % 6000);
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    const std::string text = folder.read("scene.sobb");
    ASSERT_TRUE(text == old_text() || text == new_text()) << text.size() << " bytes";
    expect_little_left(folder);
  }
  save(path, kNewSize, 'n');
  EXPECT_EQ(folder.read("scene.sobb"), new_text());
  EXPECT_EQ(folder.count(), 1);
}

TEST(SaveKilledAnywhere, WhatOthersLeftIsRemovedAndWhatTheyWriteIsNot) {
  const TemporaryFolder folder;
  folder.write(".sobb-0.tmp", "abandoned");
  save(folder.path("scene.sobb"), 10, 'a');
  EXPECT_EQ(folder.count(), 1);
  // Another process is stopped in the middle of a save.
  const pid_t child = fork();
  if (child == 0) {
    ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    raise(SIGSTOP);
    save(folder.path("other.sobb"), kNewSize, 'n');
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  if (!WIFSTOPPED(status)) GTEST_SKIP() << "processes may not be traced here";
  const auto size_of_temporary = [&] {
    std::error_code error;
    const auto size = std::filesystem::file_size(folder.path(".sobb-0.tmp"), error);
    return error ? 0 : size;
  };
  while (WIFSTOPPED(status) && size_of_temporary() == 0) {
    ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    ASSERT_EQ(waitpid(child, &status, 0), child);
  }
  save(folder.path("scene.sobb"), 20, 'b');
  EXPECT_EQ(folder.read("scene.sobb"), std::string(20, 'b'));
  ptrace(PTRACE_DETACH, child, nullptr, nullptr);
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(folder.read("other.sobb"), new_text());
  EXPECT_EQ(folder.count(), 2);
}

}  // namespace
}  // namespace sobb
