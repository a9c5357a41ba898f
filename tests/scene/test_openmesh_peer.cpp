// SPDX-License-Identifier: Apache-2.0
// Well-formed files give the same vertices and triangles as through OpenMesh's readers.
#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh adds vectors without values; GCC sees that when sanitizers change what is inlined.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <gtest/gtest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "scene/reader_testing.h"
#include "scene/text/obj.h"
#include "scene/text/off.h"
#include "scene/text/ply.h"
#include "scene/text/stl.h"

namespace sobb {
namespace {

using PeerMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

// A bumpy grid of triangles and convex quads: manifold, so that a half-edge mesh keeps all of it.
PeerMesh make_grid(uint32_t seed, bool quads) {
  constexpr int kSide = 12;
  std::mt19937 random(seed);
  const auto jitter = [&random] { return static_cast<float>(random() % 1000) / 3000.0F; };
  PeerMesh mesh;
  std::vector<PeerMesh::VertexHandle> grid;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      grid.push_back(mesh.add_vertex({static_cast<float>(x) + jitter(),
                                      static_cast<float>(y) + jitter(), -1e3F + jitter() / 8}));
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto at = [&](int dx, int dy) { return grid[(y + dy) * (kSide + 1) + x + dx]; };
      if (quads && random() % 2 == 0) {
        mesh.add_face(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
      } else {
        mesh.add_face(at(0, 0), at(1, 0), at(1, 1));
        mesh.add_face(at(0, 0), at(1, 1), at(0, 1));
      }
    }
  }
  return mesh;
}

// The position of every triangle's corners, in order: OpenMesh merges the vertices of an STL, and
// we do not.
std::vector<float> corner_positions(const PeerMesh& mesh) {
  std::vector<float> positions;
  for (const auto face : mesh.faces()) {
    const std::vector<PeerMesh::VertexHandle> corners(mesh.cfv_begin(face), mesh.cfv_end(face));
    for (size_t i = 2; i < corners.size(); ++i) {
      for (const auto corner : {corners[0], corners[i - 1], corners[i]}) {
        const PeerMesh::Point& point = mesh.point(corner);
        positions.insert(positions.end(), {point[0], point[1], point[2]});
      }
    }
  }
  return positions;
}

std::vector<float> corner_positions(const Scene& scene) {
  std::vector<float> positions;
  for (const uint32_t index : scene.indices) {
    for (int k = 0; k < 3; ++k) positions.push_back(scene.vertices[3 * size_t(index) + k]);
  }
  return positions;
}

struct Format {
  const char* ending;
  FormatReader reader;
  OpenMesh::IO::Options options;
  bool quads;
};

// Lets OpenMesh write the grid, and both read it back.
void check_format(const Format& format) {
  const uint32_t seed = std::random_device()();
  SCOPED_TRACE(std::string(format.ending) + ", seed " + std::to_string(seed));
  const PeerMesh mesh = make_grid(seed, format.quads);
  const std::string path = (std::filesystem::path(testing::TempDir()) /
                            ("sobb_peer_" + std::to_string(seed) + format.ending))
                               .string();
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path, format.options, 9));
  PeerMesh peer;
  OpenMesh::IO::Options options = format.options;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(peer, path, options));
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)),
                          std::istreambuf_iterator<char>());
  std::filesystem::remove(path);

  const Scene scene = reader_testing::read_scene(format.reader, bytes);
  const std::vector<float> expected = corner_positions(peer);
  EXPECT_EQ(corner_positions(scene), expected);
  EXPECT_EQ(expected.size(), corner_positions(mesh).size());
}

TEST(OpenMeshPeer, ReadsTheSameObj) { check_format({".obj", read_obj, {}, true}); }
TEST(OpenMeshPeer, ReadsTheSameOff) { check_format({".off", read_off, {}, true}); }
TEST(OpenMeshPeer, ReadsTheSamePlyAscii) { check_format({".ply", read_ply, {}, true}); }
TEST(OpenMeshPeer, ReadsTheSamePlyLittleEndian) {
  check_format({".ply", read_ply, OpenMesh::IO::Options::Binary, true});
}
TEST(OpenMeshPeer, ReadsTheSamePlyBigEndian) {
  using OpenMesh::IO::Options;
  check_format({".ply", read_ply, Options(Options::Binary | Options::MSB), true});
}
TEST(OpenMeshPeer, ReadsTheSameStlAscii) { check_format({".stl", read_stl, {}, false}); }
TEST(OpenMeshPeer, ReadsTheSameStlBinary) {
  check_format({".stl", read_stl, OpenMesh::IO::Options::Binary, false});
}

}  // namespace
}  // namespace sobb
