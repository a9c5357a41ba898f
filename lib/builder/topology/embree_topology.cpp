// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/embree_topology.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <vector>

#include "format/layout.h"

#if SOBB_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 15;

struct EmbreeNode {
  uint64_t reference_count;  // below it
  bool is_leaf;
};

struct EmbreeInner : EmbreeNode {
  const EmbreeNode* child[2];
  Box box[2];  // the children's
};

struct EmbreeLeaf : EmbreeNode {
  uint32_t* primitives;  // rising
};

Box to_box(const RTCBounds& bounds) {
  return {{bounds.lower_x, bounds.lower_y, bounds.lower_z},
          {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

RTCBuildPrimitive to_primitive(const Box& box, uint32_t index) {
  return {box.lower[0], box.lower[1], box.lower[2], 0,
          box.upper[0], box.upper[1], box.upper[2], index};
}

// One build by Embree, as its callbacks see it. They run on several threads at once and may not
// throw.
struct EmbreeBuilder {
  const Mesh& mesh;
  const Frame frame;
  Memory& memory;
  Progress& progress;
  double progress_end;
  RTCDevice device = nullptr;
  RTCBVH bvh = nullptr;
  std::atomic<bool> limit_met{false};  // the memory limit refused Embree an allocation
  std::atomic<bool> starved{false};    // a node or leaf got no memory, and is missing

  EmbreeBuilder(const Mesh& mesh, const Frame& frame, Memory& memory, Progress& progress,
                double progress_end)
      : mesh(mesh), frame(frame), memory(memory), progress(progress), progress_end(progress_end) {}
  ~EmbreeBuilder() {
    if (bvh != nullptr) rtcReleaseBVH(bvh);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  EmbreeBuilder(const EmbreeBuilder&) = delete;
  EmbreeBuilder& operator=(const EmbreeBuilder&) = delete;

  // Allocates a node or leaf; null without memory. Embree goes on with a null node, which all
  // callbacks must bear, until on_progress() stops the build.
  void* allocate(RTCThreadLocalAllocator allocator, size_t size, size_t alignment) {
    void* at = rtcThreadLocalAlloc(allocator, size, alignment);
    if (at == nullptr) starved = true;
    return at;
  }

  static void* create_node(RTCThreadLocalAllocator allocator, unsigned, void* user) {
    void* at = static_cast<EmbreeBuilder*>(user)->allocate(allocator, sizeof(EmbreeInner),
                                                           alignof(EmbreeInner));
    if (at == nullptr) return nullptr;
    auto* node = new (at) EmbreeInner;
    node->is_leaf = false;
    return static_cast<EmbreeNode*>(node);
  }

  static EmbreeInner* inner(void* node) {
    return static_cast<EmbreeInner*>(static_cast<EmbreeNode*>(node));
  }

  // Called when the children are complete.
  static void set_children(void* node, void** children, unsigned count, void*) {
    EmbreeInner* parent = inner(node);
    if (parent == nullptr) return;
    parent->reference_count = 0;
    for (unsigned i = 0; i < count; ++i) {
      if (children[i] == nullptr) return;
      parent->child[i] = static_cast<const EmbreeNode*>(children[i]);
      parent->reference_count += parent->child[i]->reference_count;
    }
  }

  static void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    if (node == nullptr) return;
    for (unsigned i = 0; i < count; ++i) inner(node)->box[i] = to_box(*bounds[i]);
  }

  static void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                           size_t count, void* user) {
    void* at = static_cast<EmbreeBuilder*>(user)->allocate(
        allocator, sizeof(EmbreeLeaf) + count * sizeof(uint32_t), alignof(EmbreeLeaf));
    if (at == nullptr) return nullptr;
    auto* leaf = new (at) EmbreeLeaf;
    leaf->primitives = new (leaf + 1) uint32_t[count];
    for (size_t i = 0; i < count; ++i) leaf->primitives[i] = primitives[i].primID;
    // Embree's order depends on its threads.
    std::sort(leaf->primitives, leaf->primitives + count);
    leaf->reference_count = count;
    leaf->is_leaf = true;
    return static_cast<EmbreeNode*>(leaf);
  }

  static bool on_progress(void* user, double fraction) {
    auto* self = static_cast<EmbreeBuilder*>(user);
    return !self->starved && self->progress.report(0, self->progress_end, std::min(fraction, 1.0));
  }

  static bool on_memory(void* user, ssize_t bytes, bool) {
    auto* self = static_cast<EmbreeBuilder*>(user);
    if (self->memory.count_foreign(bytes)) return true;
    self->limit_met = true;
    return false;
  }

  // Throws the library's error for Embree's failure.
  [[noreturn]] void fail_build() {
    if (limit_met) {
      fail(SOBB_ERROR_MEMORY_LIMIT, "memory limit: the topology builder needs more than %llu bytes",
           static_cast<unsigned long long>(memory.limit()));
    }
    const RTCError error = rtcGetDeviceError(device);
    if (starved || error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error == RTC_ERROR_CANCELLED) fail(SOBB_ERROR_CANCELLED, "the build was cancelled");
    fail(SOBB_ERROR_INTERNAL, "Embree's builder failed with error %d", static_cast<int>(error));
  }

  const EmbreeNode* build(const Scheduler& scheduler) {
    device = rtcNewDevice(nullptr);
    if (device == nullptr) {
      fail(SOBB_ERROR_INTERNAL, "Embree's device: error %d",
           static_cast<int>(rtcGetDeviceError(nullptr)));
    }
    rtcSetDeviceMemoryMonitorFunction(device, on_memory, this);
    bvh = rtcNewBVH(device);
    if (bvh == nullptr) fail_build();

    const uint64_t count = mesh.triangle_count();
    std::pmr::vector<RTCBuildPrimitive> primitives(count, &memory);
    scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
      for (uint64_t i = begin; i < end; ++i) {
        primitives[i] = to_primitive(Corners(mesh, i, frame).box(), static_cast<uint32_t>(i));
      }
    });

    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_LOW;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = kMaxDepth;
    // Morton order has no cost model: its leaves are one block.
    arguments.minLeafSize = 4;
    arguments.maxLeafSize = kMaxLeafReferences;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.buildProgress = on_progress;
    arguments.userPtr = this;
    const void* root = nullptr;
    scheduler.within_arena([&] { root = rtcBuildBVH(&arguments); });
    if (root == nullptr || starved) fail_build();
    return static_cast<const EmbreeNode*>(root);
  }
};

// Copies Embree's nodes, depth first.
class Flattening {
 public:
  explicit Flattening(BinaryNodes& to) : to_(to) {}

  void add(const EmbreeNode& node, const Box& box, TopologyNode& made) {
    made.box = box;
    made.count = static_cast<uint32_t>(std::min<uint64_t>(node.reference_count, INT32_MAX));
    made.is_leaf = node.is_leaf;
    if (node.is_leaf) return add_leaf(static_cast<const EmbreeLeaf&>(node), made);
    const auto& inner = static_cast<const EmbreeInner&>(node);
    made.first = static_cast<uint32_t>(pairs_);
    NodePair& pair = to_.pairs[pairs_++];
    for (int side = 0; side < 2; ++side) {
      add(*inner.child[side], inner.box[side], pair.child[side]);
    }
  }

 private:
  void add_leaf(const EmbreeLeaf& leaf, TopologyNode& made) {
    made.first = static_cast<uint32_t>(references_);
    for (uint64_t i = 0; i < leaf.reference_count; ++i, ++references_) {
      to_.primitives[references_] = leaf.primitives[i];
    }
  }

  BinaryNodes& to_;
  uint64_t pairs_ = 0;
  uint64_t references_ = 0;
};

uint64_t count_pairs(const EmbreeNode& node) {
  if (node.is_leaf) return 0;
  const auto& inner = static_cast<const EmbreeInner&>(node);
  return 1 + count_pairs(*inner.child[0]) + count_pairs(*inner.child[1]);
}

Box root_box(const EmbreeNode& root, const Mesh& mesh, const Frame& frame) {
  if (!root.is_leaf) {
    const auto& inner = static_cast<const EmbreeInner&>(root);
    Box box = inner.box[0];
    box.grow(inner.box[1]);
    return box;
  }
  Box box = box_of(mesh, 0, frame);
  for (uint64_t i = 1; i < root.reference_count; ++i) box.grow(box_of(mesh, i, frame));
  return box;
}

}  // namespace

BinaryNodes embree_topology(const Mesh& mesh, const Scheduler& scheduler, Memory& memory,
                            Progress& progress, double progress_end, const Frame& frame) {
  EmbreeBuilder builder(mesh, frame, memory, progress, progress_end);
  const EmbreeNode& root = *builder.build(scheduler);
  BinaryNodes nodes;
  nodes.pairs = Array<NodePair>(count_pairs(root), memory);
  nodes.primitives = Array<uint32_t>(root.reference_count, memory);
  Flattening(nodes).add(root, root_box(root, mesh, frame), nodes.root);
  return nodes;
}

}  // namespace sobb
