// SPDX-License-Identifier: Apache-2.0
// This file compiles the nodes of every volume for every instruction set.
#include "volumes/nodes.h"

#include "base/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volumes/nodes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "volumes/aabb-inl.h"
#include "volumes/dop14-inl.h"
#include "volumes/nodes_of-inl.h"
#include "volumes/obb-inl.h"
#include "volumes/sobb_direct-inl.h"
#include "volumes/sobb_indexed-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {

template <int W>
std::unique_ptr<Hierarchy::Nodes> make_nodes_of(const SharedTopology& topology,
                                                const ConvertSettings& settings, sobb_isa isa) {
  const auto of = [&](auto volume) -> std::unique_ptr<Hierarchy::Nodes> {
    return std::make_unique<NodesOf<decltype(volume), W>>(topology, settings, isa);
  };
  switch (settings.method.volume) {
    case VolumeKind::kAabb:
      return of(Aabb());
    case VolumeKind::kDop14:
      return of(Dop14());
    case VolumeKind::kObb:
      return of(Obb());
    case VolumeKind::kSobbIndexed:
      return of(SobbIndexed());
    case VolumeKind::kSobbDirect:
      break;
  }
  if (settings.method.k <= 64) return of(SobbDirect<32>());
  if (settings.method.k <= 128) return of(SobbDirect<64>());
  return of(SobbDirect<128>());
}

std::unique_ptr<Hierarchy::Nodes> make_nodes(const SharedTopology& topology,
                                             const ConvertSettings& settings, sobb_isa isa) {
  return settings.width == 2 ? make_nodes_of<2>(topology, settings, isa)
                             : make_nodes_of<8>(topology, settings, isa);
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb::study {

std::unique_ptr<Hierarchy::Nodes> Hierarchy::Nodes::make(const SharedTopology& topology,
                                                         const ConvertSettings& settings,
                                                         sobb_isa isa) {
  return SOBB_DISPATCH(isa, make_nodes)(topology, settings, isa);
}

}  // namespace sobb::study
#endif
