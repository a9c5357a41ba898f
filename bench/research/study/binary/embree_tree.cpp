// SPDX-License-Identifier: Apache-2.0
#include "study/binary/embree_tree.h"

#ifdef SOBB_EMBREE_MAJOR

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include "builder/boxes/box.h"
#include "builder/boxes/references.h"
#include "embree_calls.h"
#include "format/layout.h"

namespace sobb::study {
namespace {

// A node or leaf in Embree's memory.
struct EmbreeNode {
  EmbreeNode* child[2];  // null for a leaf
  uint32_t count;        // of a leaf
  uint32_t* primitives;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned /*count*/, void* /*user*/) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(EmbreeNode), 16)) EmbreeNode{};
}

void set_children(void* node, void** children, unsigned count, void* /*user*/) {
  for (unsigned i = 0; i < count; ++i) {
    static_cast<EmbreeNode*>(node)->child[i] = static_cast<EmbreeNode*>(children[i]);
  }
}

void set_bounds(void* /*node*/, const RTCBounds** /*bounds*/, unsigned /*count*/, void* /*user*/) {}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  size_t count, void* /*user*/) {
  const size_t size = sizeof(EmbreeNode) + count * sizeof(uint32_t);
  auto* leaf = new (rtcThreadLocalAlloc(allocator, size, 16)) EmbreeNode{};
  leaf->count = static_cast<uint32_t>(count);
  leaf->primitives = new (leaf + 1) uint32_t[count];
  for (size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
  std::sort(leaf->primitives, leaf->primitives + count);
  return leaf;
}

void add(const EmbreeNode& node, BinaryTree& tree) {
  const size_t at = tree.nodes.size();
  const auto first = static_cast<uint32_t>(tree.references.size());
  tree.nodes.push_back({{0, 0}, first, node.count});
  for (uint32_t i = 0; i < node.count; ++i) tree.references.push_back({node.primitives[i]});
  if (node.child[0] == nullptr) return;
  for (int side = 0; side < 2; ++side) {
    tree.nodes[at].child[side] = static_cast<uint32_t>(tree.nodes.size());
    add(*node.child[side], tree);
  }
  tree.nodes[at].count = static_cast<uint32_t>(tree.references.size()) - first;
}

}  // namespace

BinaryTree embree_tree(const Mesh& mesh) {
  // The device has one thread: with more, the order of siblings would depend on them.
  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice("threads=1"),
                                                                         rtcReleaseDevice);
  if (device == nullptr) throw std::runtime_error("Embree has no device");
  const std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)> bvh(rtcNewBVH(device.get()),
                                                                rtcReleaseBVH);
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(mesh.triangle_count());
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const Box box = box_of(mesh, i, Frame());
    primitives.push_back(
        {box.lower[0], box.lower[1], box.lower[2], 0, box.upper[0], box.upper[1], box.upper[2], i});
  }
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = kMaxDepth;
  arguments.sahBlockSize = 4;
  arguments.maxLeafSize = kMaxLeafReferences;
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  const auto* root = static_cast<const EmbreeNode*>(rtcBuildBVH(&arguments));
  if (root == nullptr) throw std::runtime_error("Embree failed to build the hierarchy");
  BinaryTree tree;
  add(*root, tree);
  return tree;
}

}  // namespace sobb::study

#endif
