// SPDX-License-Identifier: Apache-2.0
// Which extensions a glTF may require and use.
#include "scene/gltf/document/extensions.h"

#include <gtest/gtest.h>

#include "scene/gltf_testing.h"

namespace sobb {
namespace {

using namespace gltf_testing;

GltfFile requiring(const std::string& extension) {
  GltfFile file = square();
  file.document["extensionsUsed"] = {extension};
  file.document["extensionsRequired"] = {extension};
  return file;
}

// The object of an extension, held where `pointer` says.
GltfFile holding(const std::string& extension, const std::string& pointer) {
  GltfFile file = requiring(extension);
  file.document[json::json_pointer(pointer + "/extensions")] = {{extension, json::object()}};
  return file;
}

TEST(Extensions, ThatMoveNoTriangleArePassedOverWithANote) {
  for (const char* extension : {"KHR_animation_pointer",
                                "KHR_audio",
                                "KHR_audio_emitter",
                                "KHR_environment_map",
                                "KHR_gaussian_splatting",
                                "KHR_implicit_shapes",
                                "KHR_interactivity",
                                "KHR_lights_punctual",
                                "KHR_materials_clearcoat",
                                "KHR_materials_pbrSpecularGlossiness",
                                "KHR_materials_unlit",
                                "KHR_materials_variants",
                                "KHR_node_hoverability",
                                "KHR_node_selectability",
                                "KHR_physics_rigid_bodies",
                                "KHR_technique_webgl",
                                "KHR_techniques_webgl",
                                "KHR_texture_basisu",
                                "KHR_texture_transform",
                                "KHR_xmp",
                                "KHR_xmp_json_ld",
                                "EXT_feature_metadata",
                                "EXT_instance_features",
                                "EXT_lights_ies",
                                "EXT_lights_image_based",
                                "EXT_mesh_features",
                                "EXT_mesh_manifold",
                                "EXT_structural_metadata",
                                "EXT_texture_avif",
                                "EXT_texture_webp",
                                "ADOBE_materials_thin_transparency",
                                "AGI_stk_metadata",
                                "CESIUM_primitive_outline",
                                "FB_geometry_metadata",
                                "FB_ngon_encoding",
                                "GODOT_single_root",
                                "MOZ_hubs_components",
                                "MPEG_audio_spatial",
                                "MPEG_texture_video",
                                "MSFT_audio_emitter",
                                "MSFT_lod",
                                "MSFT_packing_occlusionRoughnessMetallic",
                                "MSFT_texture_dds",
                                "NEEDLE_components",
                                "NV_materials_mdl",
                                "OMI_physics_body",
                                "VRM",
                                "VRMC_springBone",
                                "VRMC_vrm"}) {
    SCOPED_TRACE(extension);
    const Scene scene = read(requiring(extension));
    expect_square(scene, 1);
    expect_note(scene, SOBB_NOTE_EXTENSION, 1,
                "the required extension " + std::string(extension) + " was not read");
    expect_square(read(holding(extension, "/nodes/0")), 1);
    expect_square(read(holding(extension, "")), 1);
  }
}

TEST(Extensions, ThatAreReadNeedNoNote) {
  for (const char* extension :
       {"KHR_mesh_quantization", "KHR_draco_mesh_compression", "EXT_meshopt_compression",
        "KHR_meshopt_compression", "KHR_node_visibility"}) {
    SCOPED_TRACE(extension);
    expect_square(read(requiring(extension)));
  }
}

TEST(Extensions, ThatMoveTrianglesWhereTheyAreHeldAreRefusedThereOnly) {
  for (const char* extension : {"EXT_mesh_gpu_instancing", "CESIUM_RTC", "AGI_articulations",
                                "MPEG_mesh_linking", "MPEG_accessor_timed"}) {
    SCOPED_TRACE(extension);
    const Scene scene = read(requiring(extension));
    expect_square(scene, 1);
    expect_note(scene, SOBB_NOTE_EXTENSION, 1, extension);
    for (const char* holder : {"", "/nodes/0", "/meshes/0", "/meshes/0/primitives/0",
                               "/accessors/0", "/bufferViews/0", "/scenes/0"}) {
      expect_error(holding(extension, holder), SOBB_ERROR_SCENE_UNSUPPORTED, extension);
    }
  }
}

TEST(Extensions, OfInstancesMustBeReadWhereTheyAreHeld) {
  GltfFile file = square();
  file.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  expect_square(read(file));
  file.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", {}}};
  expect_error(file, SOBB_ERROR_SCENE_UNSUPPORTED, "EXT_mesh_gpu_instancing");
}

TEST(Extensions, ThatAreUnknownAreRefusedWhereTheyMayMoveTriangles) {
  constexpr const char* kUnknown = "ACME_surprise";
  expect_error(requiring(kUnknown), SOBB_ERROR_SCENE_UNSUPPORTED,
               "requires the extension ACME_surprise");
  for (const char* holder : {"", "/nodes/0", "/meshes/0", "/meshes/0/primitives/0", "/accessors/0",
                             "/bufferViews/0", "/scenes/0"}) {
    expect_error(holding(kUnknown, holder), SOBB_ERROR_SCENE_UNSUPPORTED, kUnknown);
  }
  for (const char* holder :
       {"/materials/0", "/textures/0", "/images/0", "/samplers/0", "/skins/0",
        "/animations/0/channels/0/target", "/cameras/0", "/materials/0/normalTexture"}) {
    SCOPED_TRACE(holder);
    const Scene scene = read(holding(kUnknown, holder));
    EXPECT_EQ(area(scene), 1);
    expect_note(scene, SOBB_NOTE_EXTENSION, 1, kUnknown);
  }
  // Whoever only uses one gives triangles without it too.
  GltfFile used = holding(kUnknown, "/nodes/0");
  used.document.erase("extensionsRequired");
  expect_square(read(used));
}

TEST(Extensions, AreCountedOneByOne) {
  GltfFile file = square();
  file.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform",
                                         "KHR_mesh_quantization"};
  const Scene scene = read(file);
  expect_square(scene, 1);
  expect_note(scene, SOBB_NOTE_EXTENSION, 2, "KHR_materials_unlit");
}

TEST(Extensions, HideNodesAndThoseBelow) {
  GltfFile file = square();
  file.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  file.document["nodes"][0]["children"] = {1};
  file.add_root({{"mesh", 0}, {"translation", {0, 9, 0}}});
  const auto show = [&](size_t node, const json& visibility) {
    file.document["nodes"][node]["extensions"]["KHR_node_visibility"] = visibility;
  };
  EXPECT_EQ(read(file).meshes.size(), 3U);
  show(0, {{"visible", true}});
  EXPECT_EQ(read(file).meshes.size(), 3U);
  show(0, json::object());
  EXPECT_EQ(read(file).meshes.size(), 3U);
  show(0, {{"visible", false}});
  const Scene scene = read(file);
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.bounds_min[1], 9);
  // A node below cannot show itself.
  show(1, {{"visible", true}});
  EXPECT_EQ(read(file).meshes.size(), 1U);
  file.document.erase("scenes");
  EXPECT_EQ(read(file).meshes.size(), 1U);
}

}  // namespace
}  // namespace sobb
