// SPDX-License-Identifier: Apache-2.0
// The threads that this process has.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace sobb::test {

inline std::set<std::string> process_threads() {
  std::set<std::string> threads;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    threads.insert(entry.path().filename());
  }
  return threads;
}

// Looks for threads that were not there when it was made.
class ThreadWatch {
 public:
  ThreadWatch() : before_(process_threads()) {}

  void look() {
    ++looks_;
    for (const std::string& thread : process_threads()) {
      if (before_.count(thread) == 0) started_.insert(thread);
    }
  }
  uint64_t looks() const { return looks_; }
  size_t started() const { return started_.size(); }

 private:
  std::set<std::string> before_;
  std::set<std::string> started_;
  uint64_t looks_ = 0;
};

}  // namespace sobb::test
