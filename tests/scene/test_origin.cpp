// SPDX-License-Identifier: Apache-2.0
// An origin is subtracted in double, before positions are rounded to float: from the vertices of
// every format, from what a glTF's nodes place, from cameras and views.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/gltf_testing.h"
#include "scene/load_testing.h"
#include "scene/model/measure.h"

namespace {

using namespace sobb;
using namespace sobb::gltf_testing;

// A point of UTM zone 33: float has steps of 0.03 m there in x, 0.5 m in y.
constexpr Vec3 kUtm{448251.795, 5411932.678, 207.25};

// A triangle at kUtm, as text; its corners relative to kUtm are kCorners.
constexpr const char* kFar[3] = {"448251.795 5411932.678 207.25", "448252.295 5411932.678 207.25",
                                 "448251.795 5411932.803 208.25"};
const std::vector<float> kCorners{0, 0, 0, 0.5F, 0, 0, 0, 0.125F, 1};

class Origin : public test::LoadingFiles {
 protected:
  static Scene load_at(const std::string& source, Vec3 origin, const char* views = nullptr) {
    return load_scene(source, views, 0, nullptr, origin);
  }

  // Loads a file of the triangle with kUtm as origin and without, which loses what float cannot
  // hold. Decimal numbers in double are themselves rounded, by some nanometres here.
  void expect_triangle(const std::string& name, const std::string& bytes) const {
    SCOPED_TRACE(name);
    const std::string file = write(name, bytes);
    const Scene scene = load_at(file, kUtm);
    ASSERT_EQ(scene.vertices.size(), kCorners.size());
    for (size_t i = 0; i < kCorners.size(); ++i) {
      EXPECT_NEAR(scene.vertices[i], kCorners[i], 2e-9) << i;
    }
    EXPECT_NEAR(scene.bounds_max[1], 0.125, 2e-9);
    EXPECT_EQ(load(file).bounds_max[1] - load(file).bounds_min[1], 0.5F);
  }
};

std::string lines(const std::string& before, const std::string& after) {
  std::string text;
  for (const char* corner : kFar) text += before + corner + after + "\n";
  return text;
}

std::string binary_ply() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\n"
      "property double y\nproperty double z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (size_t i = 0; i < 9; ++i) {
    const double wide[3] = {kUtm.x, kUtm.y, kUtm.z};
    const double value = wide[i % 3] + double(kCorners[i]);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  bytes += '\3';
  const int32_t corners[3] = {0, 1, 2};
  return bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
}

TEST_F(Origin, IsSubtractedFromEveryFormat) {
  expect_triangle("a.obj", lines("v ", "") + "f 1 2 3\n");
  expect_triangle("a.off", "OFF\n3 1 0\n" + lines("", "") + "3 0 1 2\n");
  expect_triangle("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\n" + lines("vertex ", "") +
                               "endloop\nendfacet\nendsolid a\n");
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expect_triangle("a.ply", header + lines("", "") + "3 0 1 2\n");
  expect_triangle("b.ply", binary_ply());
}

TEST_F(Origin, NotationsThatNeedASecondLookAreDoublesToo) {
  expect_triangle("plus.obj",
                  "v +448251.795 +5411932.678 +207.25\nv 4.48252295E5 5.411932678e+06 2.0725E+2\n"
                  "v 4.48251795D+05 5.411932803D6 208.25d0\nf 1 2 3\n");
}

TEST_F(Origin, IsSubtractedFromWhatNodesPlace) {
  GltfFile file;
  const size_t mesh = file.add_mesh(file.add_positions(kCorners));
  file.document["nodes"] = {{{"mesh", mesh}, {"translation", {kUtm.x, kUtm.y, kUtm.z}}},
                            {{"camera", 0}, {"translation", {kUtm.x, kUtm.y, kUtm.z + 10}}}};
  file.document["scenes"] = {{{"nodes", {0, 1}}}};
  file.document["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  expect_triangle("a.glb", file.glb());
  const Scene scene = load_at(path("a.glb"), kUtm);
  ASSERT_EQ(scene.views.size(), 1U);
  EXPECT_EQ(scene.views[0].eye[0], 0);
  EXPECT_EQ(scene.views[0].eye[1], 0);
  EXPECT_EQ(scene.views[0].eye[2], 10);
}

TEST_F(Origin, IsSubtractedFromViews) {
  const std::string file = write("a.obj", lines("v ", "") + "f 1 2 3\n");
  const std::string views = write(
      "v.json",
      R"({"a": [{"eye": [448251.795, 5411932.678, 217.25], "target": [448252.795, 5411932.678, 207.25],
          "up": [0, 1, 0], "vfov_degrees": 40}]})");
  const Scene scene = load_at(file, kUtm, views.c_str());
  ASSERT_EQ(scene.views.size(), 1U);
  EXPECT_EQ(scene.views[0].eye[2], 10);
  EXPECT_EQ(scene.views[0].eye[1], 0);
  EXPECT_EQ(scene.views[0].target[0], 1);
  EXPECT_EQ(scene.views[0].up[1], 1);  // a direction
}

// The turn goes through the centre of the box, wherever the origin is.
TEST_F(Origin, TurnedScenesAndViewsMoveByIt) {
  const Vec3 origin{8, -16, 32};  // small sums are exact
  write("a.obj", "v 0 0 0\nv 4 0 0\nv 0 2 0\nf 1 2 3\n");
  for (const std::string& source : {path("a.obj@90"), std::string("builtin:city:1000@40")}) {
    SCOPED_TRACE(source);
    const Scene at_zero = load(source);
    const Scene moved = load_at(source, origin);
    ASSERT_EQ(moved.vertices.size(), at_zero.vertices.size());
    const double wide[3] = {origin.x, origin.y, origin.z};
    const double near = 1e-6 * (half_diagonal(at_zero) + 32);
    for (size_t i = 0; i < moved.vertices.size(); ++i) {
      ASSERT_NEAR(moved.vertices[i], double(at_zero.vertices[i]) - wide[i % 3], near) << i;
    }
    ASSERT_EQ(moved.views.size(), at_zero.views.size());
    for (size_t view = 0; view < moved.views.size(); ++view) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(moved.views[view].eye[k], at_zero.views[view].eye[k] - wide[k], near);
        EXPECT_NEAR(moved.views[view].target[k], at_zero.views[view].target[k] - wide[k], near);
        EXPECT_EQ(moved.views[view].up[k], at_zero.views[view].up[k]);
      }
    }
  }
}

// Rounding twice, to double and then to float, would give other bits.
TEST_F(Origin, OfZeroLeavesNumbersRoundedOnce) {
  // Halfway between two floats but for its last digit, which a double loses.
  const std::string file =
      write("a.obj", "v 1.000000059604644775390625000001 0 0\nv 1 1 0\nv 0 0 -0\nf 1 2 3\n");
  EXPECT_EQ(load(file).vertices[0], std::nextafter(1.0F, 2.0F));
  EXPECT_EQ(load_at(file, {0, 0, 0}).vertices, load(file).vertices);
  EXPECT_TRUE(std::signbit(load(file).vertices[8]));
}

TEST_F(Origin, HasToBeFinite) {
  sobb_scene_options options = SOBB_SCENE_OPTIONS_INIT;
  options.origin[1] = std::numeric_limits<double>::quiet_NaN();
  sobb_scene* scene = nullptr;
  EXPECT_EQ(sobb_scene_load("builtin:city:1000", &options, &scene), SOBB_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(sobb_last_error(), "sobb_scene_options: origin[1] is nan");
  options.origin[1] = 3;
  ASSERT_EQ(sobb_scene_load("builtin:city:1000", &options, &scene), SOBB_OK);
  sobb_scene_info info = SOBB_SCENE_INFO_INIT;
  ASSERT_EQ(sobb_scene_get_info(scene, &info), SOBB_OK);
  EXPECT_EQ(info.bounds_min[1], load("builtin:city:1000").bounds_min[1] - 3);
  sobb_scene_release(scene);
}

}  // namespace
