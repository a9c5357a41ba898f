// SPDX-License-Identifier: Apache-2.0
// A mesh refuses bad triangles in words that name the place; its summary bounds and hashes all.
#include "builder/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory_resource>
#include <optional>
#include <string>

#include "base/error.h"
#include "support/more_threads.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::optional<Error> error_of(const sobb_triangles& triangles, uint32_t threads = 1) {
  try {
    const Mesh mesh(triangles, Scheduler(threads, nullptr));
    return std::nullopt;
  } catch (const Error& error) {
    return error;
  }
}

void expect_error(const sobb_triangles& triangles, sobb_status status, const std::string& message,
                  uint32_t threads = 1) {
  const auto error = error_of(triangles, threads);
  ASSERT_TRUE(error) << "no error, but " << message << " was expected";
  EXPECT_EQ(error->status, status);
  EXPECT_EQ(error->what(), message);
}

TEST(Mesh, RefusesWhatIsNoMesh) {
  const Soup soup = random_soup(1, 3);
  const auto changed = [&](const std::function<void(sobb_triangles&)>& change) {
    sobb_triangles triangles = soup.view();
    change(triangles);
    return triangles;
  };
  EXPECT_FALSE(error_of(soup.view()));
  expect_error(changed([](auto& t) { t.triangle_count = 0; }), SOBB_ERROR_EMPTY,
               "the mesh has no triangle");
  expect_error(changed([](auto& t) { t.triangle_count = 0xFFFFFFFE; }), SOBB_ERROR_TOO_LARGE,
               "4294967294 triangles, more than 4294967293");
  expect_error(changed([](auto& t) { t.triangle_count = UINT64_MAX; }), SOBB_ERROR_TOO_LARGE,
               "18446744073709551615 triangles, more than 4294967293");
  expect_error(changed([](auto& t) { t.vertices = nullptr; }), SOBB_ERROR_INVALID_ARGUMENT,
               "triangles: vertices is NULL");
  expect_error(changed([](auto& t) { t.indices = nullptr; }), SOBB_ERROR_INVALID_ARGUMENT,
               "triangles: indices is NULL");
  expect_error(changed([](auto& t) { t.reserved = 1; }), SOBB_ERROR_INVALID_ARGUMENT,
               "triangles: reserved is 1");
  for (const uint64_t stride : {1, 4, 8, 11, 13, 14}) {
    expect_error(
        changed([&](auto& t) { t.vertex_stride = stride; }), SOBB_ERROR_INVALID_ARGUMENT,
        "triangles: vertex_stride is " + std::to_string(stride) + ", not a multiple of 4 from 12");
  }
}

TEST(Mesh, NamesTriangleAndVertexOfABadIndex) {
  Soup soup = random_soup(2, 4);
  soup.indices[10] = 12;
  expect_error(soup.view(), SOBB_ERROR_INDEX,
               "triangle 3: vertex index 12, but there are 12 vertices");
  soup.indices[10] = 0xFFFFFFFF;
  expect_error(soup.view(), SOBB_ERROR_INDEX,
               "triangle 3: vertex index 4294967295, but there are 12 vertices");
  sobb_triangles none = soup.view();
  none.vertex_count = 0;
  expect_error(none, SOBB_ERROR_INDEX, "triangle 0: vertex index 0, but there are 0 vertices");
}

TEST(Mesh, NamesAxisAndVertexOfABadCoordinate) {
  const auto with = [](size_t at, float value) {
    Soup soup = random_soup(3, 4);
    soup.vertices[at] = value;
    return soup;
  };
  expect_error(with(3 * 7 + 0, kNan).view(), SOBB_ERROR_NOT_FINITE,
               "triangle 2: x of vertex 7 is nan");
  expect_error(with(3 * 7 + 1, kInfinity).view(), SOBB_ERROR_NOT_FINITE,
               "triangle 2: y of vertex 7 is inf");
  expect_error(with(3 * 7 + 2, -kInfinity).view(), SOBB_ERROR_NOT_FINITE,
               "triangle 2: z of vertex 7 is -inf");
  expect_error(with(3 * 11 + 2, 1e30F).view(), SOBB_ERROR_TOO_LARGE,
               "triangle 3: z of vertex 11 is 1e+30, beyond 2^60");
  expect_error(with(0, std::nextafter(-0x1p60F, -kInfinity)).view(), SOBB_ERROR_TOO_LARGE,
               "triangle 0: x of vertex 0 is -1.15292e+18, beyond 2^60");
  EXPECT_FALSE(error_of(with(0, 0x1p60F).view()));
  EXPECT_FALSE(error_of(with(0, -0x1p60F).view()));
}

TEST(Mesh, VerticesThatNoTriangleUsesMayBeAnything) {
  Soup soup = random_soup(4, 2);
  soup.vertices.insert(soup.vertices.end(), {kNan, kInfinity, 1e30F});
  EXPECT_FALSE(error_of(soup.view()));
  const Mesh mesh(soup.view(), Scheduler(1, nullptr));
  EXPECT_LT(summarise(mesh, Scheduler(1, nullptr), *std::pmr::get_default_resource()).upper.z, 2);
}

TEST(Mesh, ReportsTheFirstCulpritWhicheverThreadMeetsIt) {
  const MoreThreads more(8);
  Soup soup = identical_soup(500'000);
  soup.indices[3 * 70'001 + 1] = 3;
  soup.indices[3 * 70'002 + 1] = 4;
  soup.indices[3 * 200'000] = 5;
  soup.indices[3 * 499'999 + 2] = 6;
  for (int round = 0; round < 20; ++round) {
    expect_error(soup.view(), SOBB_ERROR_INDEX,
                 "triangle 70001: vertex index 3, but there are 3 vertices", 8);
  }
}

TEST(Mesh, ReadsAnyStride) {
  const Soup soup = random_soup(5, 10);
  for (const uint64_t stride : {0, 12, 16, 20, 32}) {
    const uint64_t floats = stride == 0 ? 3 : stride / 4;
    std::vector<float> vertices(soup.vertices.size() / 3 * floats, kNan);
    for (size_t i = 0; i < soup.vertices.size(); ++i) {
      vertices[i / 3 * floats + i % 3] = soup.vertices[i];
    }
    // The array ends with the last vertex: not a float lies beyond it.
    vertices.resize(vertices.size() - (floats - 3));
    sobb_triangles triangles = soup.view();
    triangles.vertices = vertices.data();
    triangles.vertex_stride = stride;
    const Mesh mesh(triangles, Scheduler(1, nullptr));
    for (uint64_t t = 0; t < mesh.triangle_count(); ++t) {
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh.corner(t, i).x, soup.corner(t, i)[0]);
        EXPECT_EQ(mesh.corner(t, i).z, soup.corner(t, i)[2]);
      }
    }
  }
}

MeshSummary summary_of(const Soup& soup, uint32_t threads = 1) {
  const Scheduler scheduler(threads, nullptr);
  const Mesh mesh(soup.view(), scheduler);
  return summarise(mesh, scheduler, *std::pmr::get_default_resource());
}

TEST(MeshSummary, BoundsCentreAndRadius) {
  for (const Soup& soup : {random_soup(6, 500), placed(random_soup(7, 500), 1e15, 0),
                           placed(random_soup(8, 500), 1, 1e6), identical_soup(3)}) {
    const MeshSummary summary = summary_of(soup);
    for (uint64_t t = 0; t < soup.indices.size() / 3; ++t) {
      for (int i = 0; i < 3; ++i) {
        const float* p = soup.corner(t, i);
        EXPECT_TRUE(summary.lower.x <= p[0] && p[0] <= summary.upper.x);
        EXPECT_TRUE(summary.lower.y <= p[1] && p[1] <= summary.upper.y);
        EXPECT_TRUE(summary.lower.z <= p[2] && p[2] <= summary.upper.z);
        const long double x = static_cast<long double>(p[0]) - summary.centre.x;
        const long double y = static_cast<long double>(p[1]) - summary.centre.y;
        const long double z = static_cast<long double>(p[2]) - summary.centre.z;
        const auto radius = static_cast<long double>(summary.radius);
        EXPECT_LE(x * x + y * y + z * z, radius * radius);
      }
    }
  }
}

TEST(MeshSummary, CountsTrianglesWithoutArea) {
  const Soup soup{"mixed",
                  {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 3, 3, 3},
                  {0, 1, 2, 0, 0, 0, 0, 1, 1, 0, 1, 3, 4, 4, 2, 1, 2, 4}};
  EXPECT_EQ(summary_of(soup).degenerate_count, 4u);
}

TEST(MeshSummary, IsTheSameForAnyThreadCount) {
  const MoreThreads more(8);
  const Soup soup = random_soup(9, 200'000);
  const MeshSummary one = summary_of(soup);
  for (const uint32_t threads : {2, 3, 8}) {
    const MeshSummary other = summary_of(soup, threads);
    EXPECT_EQ(other.source_hash, one.source_hash);
    EXPECT_EQ(other.radius, one.radius);
    EXPECT_EQ(other.degenerate_count, one.degenerate_count);
  }
}

TEST(MeshSummary, HashSeesEveryVertexAndIndex) {
  const Soup soup = random_soup(10, 20);
  const uint64_t hash = summary_of(soup).source_hash;
  for (size_t i = 0; i < soup.vertices.size(); ++i) {
    Soup changed = soup;
    changed.vertices[i] = std::nextafter(changed.vertices[i], 2.0F);
    EXPECT_NE(summary_of(changed).source_hash, hash) << "coordinate " << i;
  }
  Soup turned = soup;
  std::swap(turned.indices[0], turned.indices[1]);
  EXPECT_NE(summary_of(turned).source_hash, hash);
}

}  // namespace
}  // namespace sobb::test
