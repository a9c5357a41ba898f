// SPDX-License-Identifier: Apache-2.0
// Builds, saves, opens, traces and releases random scenes from several threads, for as long as
// asked. Fails where a hit differs, an allocation is left, or memory has grown. usage: sobb_soak
// MINUTES [SEED]
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support/sanitized.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kThreads = 4;
// What malloc and TBB keep for later may differ by so much.
constexpr int64_t kSlack = int64_t{16} << 20;

struct Totals {
  std::atomic<uint64_t> builds{0};
  std::atomic<uint64_t> saves{0};
  std::atomic<uint64_t> opens{0};
  std::atomic<uint64_t> rays{0};
  std::atomic<int64_t> held{0};  // bytes of the library's, by the allocator given to it
};

void* allocate(void* user, size_t size, size_t alignment) {
  void* block = nullptr;
  if (posix_memalign(&block, std::max(alignment, sizeof(void*)), size) != 0) return nullptr;
  static_cast<Totals*>(user)->held += static_cast<int64_t>(size);
  return block;
}

void deallocate(void* user, void* block, size_t size, size_t) {
  static_cast<Totals*>(user)->held -= static_cast<int64_t>(size);
  std::free(block);
}

int64_t resident_bytes() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  int64_t all = 0;
  int64_t resident = 0;
  file >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

void require(sobb_status status) {
  if (status != SOBB_OK) throw std::runtime_error(sobb_last_error());
}

struct Release {
  void operator()(sobb_hierarchy* hierarchy) const { sobb_release(hierarchy); }
};
using Handle = std::unique_ptr<sobb_hierarchy, Release>;

Soup random_scene(Random& random) {
  const uint64_t seed = random.bits();
  const uint32_t size = 1 + random.below(20'000);
  switch (random.below(4)) {
    case 0:
      return random_soup(seed, size);
    case 1:
      return sliver_soup(seed, 1 + size / 10);
    case 2:
      return degenerate_soup(seed, size);
    default:
      return turned_boxes(seed, 1 + size / 12);
  }
}

Handle build(const Soup& soup, Random& random, const sobb_allocator& allocator) {
  sobb_build_options options = {};
  options.struct_size = sizeof options;
  options.volume = random.below(3);
  options.quality = random.below(4);
  options.width = random.below(2) == 0 ? 4 : 8;
  options.threads = random.below(4);
  options.allocator = &allocator;
  const sobb_triangles triangles = soup.view();
  sobb_hierarchy* hierarchy = nullptr;
  require(sobb_build(&triangles, &options, &hierarchy));
  return Handle(hierarchy);
}

std::vector<sobb_hit> trace(const Handle& hierarchy, const std::vector<sobb_ray>& rays,
                            Random& random) {
  sobb_trace_options options = {};
  options.struct_size = sizeof options;
  options.flags = random.below(2);
  options.threads = random.below(4);
  std::vector<sobb_hit> hits(rays.size());
  require(sobb_intersect(hierarchy.get(), rays.data(), rays.size(), hits.data(), &options));
  return hits;
}

// One scene's life: what was built, and what was saved and opened, return the same hits.
void one_life(Random& random, const std::string& path, Totals& totals) {
  const sobb_allocator allocator = {&totals, allocate, deallocate};
  const Soup soup = random_scene(random);
  const Handle built = build(soup, random, allocator);
  ++totals.builds;
  require(sobb_save(built.get(), path.c_str()));
  ++totals.saves;
  sobb_open_options options = {};
  options.struct_size = sizeof options;
  options.flags = random.below(2);  // mapped or not
  options.threads = random.below(4);
  options.allocator = &allocator;
  sobb_hierarchy* handle = nullptr;
  require(sobb_open(path.c_str(), &options, &handle));
  const Handle opened(handle);
  ++totals.opens;
  const std::vector<sobb_ray> rays = mixed_rays(soup, random.bits(), 1 + random.below(5000));
  const auto expected = trace(built, rays, random);
  const auto found = trace(opened, rays, random);
  totals.rays += 2 * rays.size();
  if (std::memcmp(expected.data(), found.data(), found.size() * sizeof found[0]) != 0) {
    throw std::runtime_error("a file that was saved and opened returns other hits");
  }
}

// Returns false where a thread failed.
bool run_until(Clock::time_point end, uint64_t seed, const std::string& folder, Totals& totals) {
  std::atomic<bool> good{true};
  std::vector<std::thread> threads;
  for (int id = 0; id < kThreads; ++id) {
    threads.emplace_back([&, id] {
      Random random(seed + static_cast<uint64_t>(id));
      const std::string path = folder + "/" + std::to_string(id) + ".sobb";
      try {
        do {
          one_life(random, path, totals);
        } while (good && Clock::now() < end);
      } catch (const std::exception& error) {
        std::printf("thread %d: %s\n", id, error.what());
        good = false;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return good;
}

int soak(double minutes, uint64_t seed) {
  std::string folder = std::filesystem::temp_directory_path() / "sobb-soak-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  Totals totals;
  const auto start = Clock::now();
  const std::chrono::duration<double, std::ratio<60>> length(minutes);
  // The first tenth fills what malloc and TBB keep; what comes after may not add to it.
  const auto warm = start + std::chrono::duration_cast<Clock::duration>(length * 0.1);
  const auto end = start + std::chrono::duration_cast<Clock::duration>(length);
  std::printf("seed %" PRIu64 ", %d threads, %g minutes\n", seed, kThreads, minutes);
  bool good = run_until(warm, seed, folder, totals);
  const int64_t before = resident_bytes();
  const int64_t held_before = totals.held;
  good = good && run_until(end, seed + kThreads, folder, totals);
  const int64_t after = resident_bytes();
  std::filesystem::remove_all(folder);

  std::printf("builds %" PRIu64 ", saves %" PRIu64 ", opens %" PRIu64 ", rays %" PRIu64 "\n",
              totals.builds.load(), totals.saves.load(), totals.opens.load(), totals.rays.load());
  std::printf("resident at the start %.1f MiB, at the end %.1f MiB\n",
              static_cast<double>(before) / (1 << 20), static_cast<double>(after) / (1 << 20));
  std::printf("held by the library at the start %" PRId64 " bytes, at the end %" PRId64 "\n",
              held_before, totals.held.load());
  // A sanitizer keeps what was freed; AddressSanitizer tells of leaks by itself.
  const bool grew = !kSanitized && after > before + kSlack;
  if (grew) std::printf("memory has grown, by more than the slack of 16 MiB\n");
  return good && !grew && totals.held == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sobb::test

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: sobb_soak MINUTES [SEED]\n");
    return 2;
  }
  try {
    return sobb::test::soak(std::atof(argv[1]), argc > 2 ? std::strtoull(argv[2], nullptr, 10)
                                                         : std::random_device()());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
