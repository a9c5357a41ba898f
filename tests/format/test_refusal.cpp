// SPDX-License-Identifier: Apache-2.0
// Each cause of a refusal has its status, and a message that names the file, the place and the
// cause.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "format/reader/reader.h"
#include "format/small_file.h"

namespace sobb {
namespace {

using test::SmallFile;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Refusal {
  const char* name;
  sobb_status status;
  const char* message;  // how it goes on after the file's name
  std::function<void(SmallFile&)> damage;
  bool sealed = true;  // checksums are made to fit the damage

  friend std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
    return out << refusal.name;
  }
};

Node<4>& node(SmallFile& file, int index) { return file.node<4>(index); }

class FormatRefusal : public testing::TestWithParam<Refusal> {};

// The file is the 4-wide SOBB file of small_file.h.
TEST_P(FormatRefusal, HasStatusAndMessage) {
  const Refusal& refusal = GetParam();
  SmallFile file = test::make_small_file(SOBB_VOLUME_SOBB, 4);
  refusal.damage(file);
  if (refusal.sealed) test::reseal(file.bytes());
  const auto error = test::error_of(file.bytes(), "folder/scene.sobb");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->status, refusal.status) << error->what();
  EXPECT_EQ(std::string(error->what()).find(std::string("folder/scene.sobb: ") + refusal.message),
            0u)
      << error->what();
}

template <class... R>
auto refusals(R... list) {
  return testing::Values(Refusal(list)...);
}

std::string name_of(const testing::TestParamInfo<Refusal>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Header, FormatRefusal,
    refusals(
        Refusal{"Magic", SOBB_ERROR_FORMAT_MAGIC, "not a sobb file",
                [](SmallFile& f) { f.header().magic[4] = 'b'; }},
        Refusal{"Version", SOBB_ERROR_FORMAT_VERSION, "format version 2, this library reads",
                [](SmallFile& f) { f.header().version = 2; }},
        Refusal{"VersionZero", SOBB_ERROR_FORMAT_VERSION, "format version 0",
                [](SmallFile& f) { f.header().version = 0; }},
        Refusal{"TotalSizeLarger", SOBB_ERROR_FORMAT_SIZE,
                "truncated: ", [](SmallFile& f) { f.header().total_size = ~uint64_t{0}; }},
        Refusal{"TotalSizeSmaller", SOBB_ERROR_FORMAT_SIZE,
                "bytes after its end: ", [](SmallFile& f) { f.header().total_size -= 1; }},
        Refusal{"HeaderSize", SOBB_ERROR_FORMAT_HEADER, "header: header_size is 192",
                [](SmallFile& f) { f.header().header_size = 192; }},
        Refusal{"SectionCount", SOBB_ERROR_FORMAT_HEADER, "header: section_count is 4294967295",
                [](SmallFile& f) { f.header().section_count = ~0u; }},
        Refusal{"SectionCountBeyondFile", SOBB_ERROR_FORMAT_HEADER, "header: section_count is 64:",
                [](SmallFile& f) { f.header().section_count = 64; }},
        Refusal{"HeaderChecksum", SOBB_ERROR_FORMAT_HEADER, "header: its checksum differs",
                [](SmallFile& f) { f.header().radius *= 2; }, false},
        Refusal{"TableChecksum", SOBB_ERROR_FORMAT_HEADER, "header: its checksum differs",
                [](SmallFile& f) { f.sections()[1].id = 7; }, false},
        Refusal{"Feature", SOBB_ERROR_FORMAT_FEATURE, "needs features 0x80000002",
                [](SmallFile& f) { f.header().must_understand = 0x80000002; }},
        Refusal{"Volume", SOBB_ERROR_FORMAT_HEADER, "header: volume is 3",
                [](SmallFile& f) { f.header().volume = 3; }},
        Refusal{"Width", SOBB_ERROR_FORMAT_HEADER, "header: width is 5",
                [](SmallFile& f) { f.header().width = 5; }},
        Refusal{"WidthZero", SOBB_ERROR_FORMAT_HEADER, "header: width is 0",
                [](SmallFile& f) { f.header().width = 0; }},
        Refusal{"DirectionCount", SOBB_ERROR_FORMAT_HEADER,
                "header: direction_count of SOBBs is 17",
                [](SmallFile& f) { f.header().direction_count = 17; }},
        Refusal{"AabbOfManyDirections", SOBB_ERROR_FORMAT_HEADER,
                "header: direction_count of AABBs is 16",
                [](SmallFile& f) { f.header().volume = SOBB_VOLUME_AABB; }},
        Refusal{"Centre", SOBB_ERROR_FORMAT_HEADER, "header: centre is nan",
                [](SmallFile& f) { f.header().centre[1] = kNaN; }},
        Refusal{"CentreFar", SOBB_ERROR_FORMAT_HEADER, "header: centre is 2.30584e+18",
                [](SmallFile& f) { f.header().centre[2] = 0x1p61f; }},
        Refusal{"Radius", SOBB_ERROR_FORMAT_HEADER, "header: radius is inf",
                [](SmallFile& f) { f.header().radius = kInfinity; }},
        Refusal{"RadiusNegative", SOBB_ERROR_FORMAT_HEADER, "header: radius is -1",
                [](SmallFile& f) { f.header().radius = -1; }},
        Refusal{"NoTriangle", SOBB_ERROR_FORMAT_HEADER, "header: triangle_count is 0",
                [](SmallFile& f) { f.header().triangle_count = 0; }},
        Refusal{"TooManyTriangles", SOBB_ERROR_FORMAT_HEADER, "header: triangle_count is 4.29497e",
                [](SmallFile& f) { f.header().triangle_count = uint64_t{SOBB_MAX_TRIANGLES} + 1; }},
        Refusal{"Reserved0", SOBB_ERROR_FORMAT_HEADER, "header: reserved0 is 1",
                [](SmallFile& f) { f.header().reserved0 = 1; }},
        Refusal{"Reserved1", SOBB_ERROR_FORMAT_HEADER, "header: reserved1 is 1",
                [](SmallFile& f) { f.header().reserved1[4] = 1; }},
        Refusal{"DepthZero", SOBB_ERROR_FORMAT_DEPTH, "header: depth is 0, not 1 to 96",
                [](SmallFile& f) { f.header().depth = 0; }},
        Refusal{"DepthBeyondTheStack", SOBB_ERROR_FORMAT_DEPTH, "header: depth is 97",
                [](SmallFile& f) { f.header().depth = 97; }}),
    name_of);

// The sections in the file's order: directions, record, nodes, blocks.
INSTANTIATE_TEST_SUITE_P(
    Sections, FormatRefusal,
    refusals(
        Refusal{"Reserved", SOBB_ERROR_FORMAT_SECTION, "section 1 (id 4): its reserved field",
                [](SmallFile& f) { f.sections()[1].reserved = 1; }},
        Refusal{"Misaligned", SOBB_ERROR_FORMAT_SECTION, "section 2 (id 2): not aligned",
                [](SmallFile& f) { f.sections()[2].offset += 16; }},
        Refusal{"OffsetBeyond", SOBB_ERROR_FORMAT_SECTION, "section 2 (id 2): beyond the end",
                [](SmallFile& f) { f.sections()[2].offset = uint64_t{1} << 63; }},
        Refusal{"SizeBeyond", SOBB_ERROR_FORMAT_SECTION, "section 3 (id 3): beyond the end",
                [](SmallFile& f) { f.sections()[3].size += 1; }},
        Refusal{"SizeWraps", SOBB_ERROR_FORMAT_SECTION, "section 3 (id 3): beyond the end",
                [](SmallFile& f) { f.sections()[3].size = ~uint64_t{0} - 63; }},
        Refusal{"OverHeader", SOBB_ERROR_FORMAT_SECTION,
                "the section at offset 0 (id 2) overlaps what is before it",
                [](SmallFile& f) { f.sections()[2].offset = 0; }},
        Refusal{"Overlap", SOBB_ERROR_FORMAT_SECTION, "the section at offset 512 (id 2) overlaps",
                [](SmallFile& f) { f.sections()[1].size += 1; }},
        Refusal{"Missing", SOBB_ERROR_FORMAT_SECTION, "0 sections of the nodes (id 2), not one",
                [](SmallFile& f) { f.sections()[2].id = 9; }},
        Refusal{"Twice", SOBB_ERROR_FORMAT_SECTION, "0 sections of the build record (id 4)",
                [](SmallFile& f) { f.sections()[1].id = 3; }},
        Refusal{"TwiceOne", SOBB_ERROR_FORMAT_SECTION, "2 sections of the direction table (id 1)",
                [](SmallFile& f) { f.sections()[3].id = 1; }},
        Refusal{"TableSize", SOBB_ERROR_FORMAT_SECTION, "the direction table (section id 1) has",
                [](SmallFile& f) { f.header().direction_count = 24; }},
        Refusal{"NodesOfOtherWidth", SOBB_ERROR_FORMAT_SECTION, "the nodes (section id 2) has",
                [](SmallFile& f) { f.header().width = 8; }},
        Refusal{"Gap", SOBB_ERROR_FORMAT_SECTION, "byte 448 is in no section and not zero",
                [](SmallFile& f) {
                  f.sections()[1].offset = 64 * (f.bytes().size() / 64);
                  f.sections()[1].size = 0;
                }},
        Refusal{"Checksum", SOBB_ERROR_FORMAT_CHECKSUM,
                "the checksum of the section at offset 448 (id 4) differs",
                [](SmallFile& f) { f.parts.record->source_hash ^= 1; }, false}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Tables, FormatRefusal,
    refusals(Refusal{"Short", SOBB_ERROR_FORMAT_TABLE,
                     "direction 2: (0, 0, 0.9999) is not of length 1",
                     [](SmallFile& f) { f.parts.directions[2].z = 0.9999f; }},
             Refusal{"NotFinite", SOBB_ERROR_FORMAT_TABLE, "direction 0: (1, nan, 0) is not",
                     [](SmallFile& f) { f.parts.directions[0].y = kNaN; }},
             Refusal{"Quality", SOBB_ERROR_FORMAT_RECORD, "build record: quality is 0",
                     [](SmallFile& f) { f.parts.record->quality = 0; }},
             Refusal{"Strategy", SOBB_ERROR_FORMAT_RECORD, "build record: strategy is 4",
                     [](SmallFile& f) { f.parts.record->strategy = 4; }},
             Refusal{"Degenerate", SOBB_ERROR_FORMAT_RECORD, "build record: degenerate_count is 13",
                     [](SmallFile& f) { f.parts.record->degenerate_count = 13; }},
             Refusal{"References", SOBB_ERROR_FORMAT_RECORD,
                     "build record: reference_count is 13, leaves have 12",
                     [](SmallFile& f) { f.parts.record->reference_count = 13; }},
             Refusal{"Bounds", SOBB_ERROR_FORMAT_RECORD, "build record: bounds_max is -100",
                     [](SmallFile& f) { f.parts.record->bounds_max[0] = -100; }},
             Refusal{"BoundsNotFinite", SOBB_ERROR_FORMAT_RECORD,
                     "build record: bounds_min is -inf",
                     [](SmallFile& f) { f.parts.record->bounds_min[2] = -kInfinity; }},
             Refusal{"RecordReserved", SOBB_ERROR_FORMAT_RECORD, "build record: reserved is 1",
                     [](SmallFile& f) { f.parts.record->reserved[1] = 1; }}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Nodes, FormatRefusal,
    refusals(
        Refusal{"NoChildren", SOBB_ERROR_FORMAT_NODE, "node 1: 0 children, not 1 to 4",
                [](SmallFile& f) { node(f, 1).meta[0] &= ~kChildCountMask; }},
        Refusal{"TooManyChildren", SOBB_ERROR_FORMAT_NODE, "node 1: 15 children, not 1 to 4",
                [](SmallFile& f) { node(f, 1).meta[0] |= kChildCountMask; }},
        Refusal{"UnusedLane", SOBB_ERROR_FORMAT_NODE, "node 0, child 3: unused, but not zero",
                [](SmallFile& f) { node(f, 0).slab[2][1][3] = -0.0f; }},
        Refusal{"UnusedReference", SOBB_ERROR_FORMAT_NODE, "node 0, child 2: unused, but not zero",
                [](SmallFile& f) { node(f, 0).reference[2] = 1; }},
        Refusal{"MetaBits", SOBB_ERROR_FORMAT_NODE,
                "node 2, child 0: undefined bits in meta word 0x8244",
                [](SmallFile& f) { node(f, 2).meta[0] |= 0x40; }},
        Refusal{"MetaOfTheNodeElsewhere", SOBB_ERROR_FORMAT_NODE,
                "node 2, child 1: undefined bits in meta word 0x9002",
                [](SmallFile& f) { node(f, 2).meta[1] |= kSharedBit; }},
        Refusal{"EmptyLeaf", SOBB_ERROR_FORMAT_NODE, "node 2, child 1: leaf of 0 triangles",
                [](SmallFile& f) { node(f, 2).meta[1] = kLeafBit; }},
        Refusal{"InnerWithTriangles", SOBB_ERROR_FORMAT_NODE,
                "node 2, child 1: inner child of 2 triangles",
                [](SmallFile& f) { node(f, 2).meta[1] = 2; }},
        Refusal{"SlabNaN", SOBB_ERROR_FORMAT_NODE, "node 1, child 1: slab 2 [nan, ",
                [](SmallFile& f) { node(f, 1).slab[2][0][1] = kNaN; }},
        Refusal{"SlabInfinite", SOBB_ERROR_FORMAT_NODE, "node 1, child 0: slab 0 [",
                [](SmallFile& f) { node(f, 1).slab[0][1][0] = kInfinity; }},
        Refusal{"SlabInverted", SOBB_ERROR_FORMAT_NODE,
                "node 0, child 1: slab 1 has min 0.5 > max 0.25",
                [](SmallFile& f) {
                  node(f, 0).slab[1][0][1] = 0.5f;
                  node(f, 0).slab[1][1][1] = 0.25f;
                }},
        Refusal{"BasisBit15", SOBB_ERROR_FORMAT_NODE, "node 0, child 1: basis 0x902F is not three",
                [](SmallFile& f) { node(f, 0).basis[1] |= 0x8000; }},
        Refusal{"BasisBeyondTable", SOBB_ERROR_FORMAT_NODE,
                "node 0, child 1: basis 0x0430 is not three of 16 directions",
                [](SmallFile& f) { node(f, 0).basis[1] = make_basis(16, 1, 1); }},
        Refusal{"BasisTwiceTheSame", SOBB_ERROR_FORMAT_NODE, "node 0, child 1: basis 0x0C23 is not",
                [](SmallFile& f) { node(f, 0).basis[1] = make_basis(3, 1, 3); }},
        Refusal{"BasisNotShared", SOBB_ERROR_FORMAT_NODE,
                "node 1, child 1: basis 0x0820 differs from the shared one",
                [](SmallFile& f) { node(f, 1).basis[1] = make_basis(0, 1, 2); }}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    References, FormatRefusal,
    refusals(
        Refusal{"ToItself", SOBB_ERROR_FORMAT_REFERENCE, "node 1, child 0: refers back, to node 1",
                [](SmallFile& f) { node(f, 1).reference[0] = 1; }},
        Refusal{"Cycle", SOBB_ERROR_FORMAT_REFERENCE, "node 1, child 0: refers back, to node 0",
                [](SmallFile& f) { node(f, 1).reference[0] = 0; }},
        Refusal{"NodeBeyond", SOBB_ERROR_FORMAT_REFERENCE, "node 1, child 0: node 3 of 3",
                [](SmallFile& f) { node(f, 1).reference[0] = 3; }},
        Refusal{"NodeFarBeyond", SOBB_ERROR_FORMAT_REFERENCE, "node 0, child 0: node 4294967295",
                [](SmallFile& f) { node(f, 0).reference[0] = ~0u; }},
        Refusal{"NodeNever", SOBB_ERROR_FORMAT_REFERENCE, "node 1 is no node's child",
                [](SmallFile& f) { node(f, 0).reference[0] = 2; }},
        Refusal{"NodeTwice", SOBB_ERROR_FORMAT_REFERENCE, "node 1, child 1: node 2 has two parents",
                [](SmallFile& f) {
                  node(f, 1).meta[1] = 0;
                  node(f, 1).reference[1] = 2;
                }},
        Refusal{"BlockBeyond", SOBB_ERROR_FORMAT_REFERENCE,
                "node 0, child 1: triangle blocks 4 to 5 of 5",
                [](SmallFile& f) { node(f, 0).reference[1] = 4; }},
        Refusal{"BlockFarBeyond", SOBB_ERROR_FORMAT_REFERENCE,
                "node 0, child 1: triangle blocks 4294967295 to 4294967296 of 5",
                [](SmallFile& f) { node(f, 0).reference[1] = ~0u; }},
        Refusal{"BlockTwice", SOBB_ERROR_FORMAT_REFERENCE,
                "node 1, child 1: triangle block 1 is in two leaves",
                [](SmallFile& f) { node(f, 1).reference[1] = 1; }},
        Refusal{"BlockNever", SOBB_ERROR_FORMAT_REFERENCE, "triangle block 4 is in no leaf",
                [](SmallFile& f) {
                  node(f, 2) = {};
                  node(f, 2).meta[0] = kLeafBit | 4 | 1 << kChildCountShift;
                  node(f, 2).basis[0] = kAxesBasis;
                  node(f, 2).reference[0] = 3;
                }},
        Refusal{"DepthDiffers", SOBB_ERROR_FORMAT_DEPTH, "3 nodes deep, the header says 4",
                [](SmallFile& f) { f.header().depth = 4; }}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Triangles, FormatRefusal,
    refusals(Refusal{"VertexNaN", SOBB_ERROR_FORMAT_TRIANGLE,
                     "triangle block 3, lane 2: coordinate is not finite or beyond 2^60 (nan)",
                     [](SmallFile& f) { f.parts.blocks[3].vertex[1][2][2] = kNaN; }},
             Refusal{
                 "VertexFar", SOBB_ERROR_FORMAT_TRIANGLE,
                 "triangle block 0, lane 0: coordinate is not finite or beyond 2^60 (-2.30584e+18)",
                 [](SmallFile& f) { f.parts.blocks[0].vertex[0][0][0] = -0x1p61f; }},
             Refusal{"PrimitiveBeyond", SOBB_ERROR_FORMAT_TRIANGLE,
                     "triangle block 3, lane 1: no such primitive (12)",
                     [](SmallFile& f) { f.parts.blocks[3].primitive[1] = 12; }},
             Refusal{"PaddingNotZero", SOBB_ERROR_FORMAT_TRIANGLE,
                     "triangle block 2, lane 3: unused, but not zero (1)",
                     [](SmallFile& f) { f.parts.blocks[2].vertex[0][0][3] = 1; }},
             Refusal{"HoleInBlock", SOBB_ERROR_FORMAT_TRIANGLE,
                     "triangle block 3, lane 1: unused before a used lane",
                     [](SmallFile& f) { f.parts.blocks[3].primitive[1] = kNoPrimitive; }},
             Refusal{"EmptyBlock", SOBB_ERROR_FORMAT_TRIANGLE, "triangle block 2 is empty",
                     [](SmallFile& f) {
                       f.parts.blocks[2] = {};
                       for (uint32_t& p : f.parts.blocks[2].primitive) p = kNoPrimitive;
                     }},
             Refusal{"LeafOfMore", SOBB_ERROR_FORMAT_TRIANGLE,
                     "node 2, child 1: leaf of 3 triangles, but triangle block 4 has 2, not 3",
                     [](SmallFile& f) { node(f, 2).meta[1] = kLeafBit | 3; }},
             Refusal{"LeafOfFewer", SOBB_ERROR_FORMAT_TRIANGLE,
                     "node 2, child 1: leaf of 1 triangles, but triangle block 4 has 2, not 1",
                     [](SmallFile& f) { node(f, 2).meta[1] = kLeafBit | 1; }}),
    name_of);

// The rules for AABBs alone.
TEST(FormatRefusalAabb, DirectionsAndBasesAreTheAxes) {
  SmallFile turned = test::make_small_file(SOBB_VOLUME_AABB, 8);
  std::swap(turned.parts.directions[0], turned.parts.directions[1]);
  turned.seal();
  const auto table = test::error_of(turned.bytes());
  ASSERT_TRUE(table);
  EXPECT_EQ(table->status, SOBB_ERROR_FORMAT_TABLE) << table->what();

  SmallFile permuted = test::make_small_file(SOBB_VOLUME_AABB, 8);
  permuted.node<8>(2).basis[1] = make_basis(1, 0, 2);
  permuted.seal();
  const auto basis = test::error_of(permuted.bytes());
  ASSERT_TRUE(basis);
  EXPECT_EQ(basis->status, SOBB_ERROR_FORMAT_NODE);
  EXPECT_STREQ(basis->what(),
               "scene.sobb: node 2, child 1: basis 0x0801 of an AABB is not the axes");
}

// The chain is deeper than a header may say, so its header lies; the walk over the tree notices.
TEST(FormatRefusalTree, AChainTooDeepIsNoticed) {
  SmallFile chain = test::make_chain(kMaxDepth + 1);
  chain.fields.depth = kMaxDepth;
  chain.seal();
  const auto error = test::error_of(chain.bytes());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->status, SOBB_ERROR_FORMAT_DEPTH);
  EXPECT_STREQ(error->what(), "scene.sobb: node 95, child 0: more than 96 nodes deep");
}

// The message names the fault with the lowest index, whichever thread meets its own first.
TEST(FormatRefusalOrder, DoesNotDependOnThreads) {
  SmallFile chain = test::make_chain(20000);
  chain.fields.depth = 1;
  for (const int index : {19999, 12000, 3001, 3000}) chain.node<4>(index).slab[0][0][0] = kNaN;
  chain.seal();
  for (const uint32_t threads : {0u, 1u, 2u, 3u}) {
    for (int round = 0; round < 5; ++round) {
      try {
        Progress progress(nullptr, nullptr);
        read_image(chain.bytes(), "scene.sobb", Scheduler(threads, nullptr),
                   *std::pmr::get_default_resource(), progress);
        FAIL();
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("scene.sobb: node 3000, child 0: slab 0 [nan"), 0u)
            << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace sobb
