// SPDX-License-Identifier: Apache-2.0
// choose_one() finds by its pruned search what trying every triple finds, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <string>
#include <vector>

#include "bounds/area.h"
#include "bounds/bounds_kernels.h"
#include "support/soups.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

// The axes and random directions.
std::vector<Direction> random_directions(Random& random, uint32_t count) {
  std::vector<Direction> directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  while (directions.size() < count) {
    const double at[3] = {2 * random.uniform() - 1, 2 * random.uniform() - 1, random.uniform()};
    const double square = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
    if (square > 1 || square < 0.01) continue;
    const double length = std::sqrt(square);
    directions.push_back({static_cast<float>(at[0] / length), static_cast<float>(at[1] / length),
                          static_cast<float>(at[2] / length)});
  }
  return directions;
}

struct Table {
  std::vector<Direction> directions;
  BasisTable basis;

  explicit Table(std::vector<Direction> of)
      : directions(std::move(of)), basis(directions, *std::pmr::get_default_resource()) {}
};

// The widths of a randomly turned ellipsoid, from a ball (`elongation` 0) to needles and sheets,
// rounded to few digits so that there are ties.
std::vector<float> random_widths(Random& random, const Table& table, double elongation) {
  double axis[3][3];
  for (auto& row : axis) {
    const double length = std::exp(-elongation * random.uniform());
    for (double& value : row) value = length * (2 * random.uniform() - 1);
  }
  std::vector<float> width(table.basis.stride(), 0.0F);
  for (uint32_t k = 0; k < table.basis.count(); ++k) {
    const Direction& n = table.directions[k];
    double square = 0;
    for (const auto& row : axis) {
      const double along = n.x * row[0] + n.y * row[1] + n.z * row[2];
      square += along * along;
    }
    width[k] = static_cast<float>(std::sqrt(square));
  }
  return width;
}

// One volume in three has few distinct widths, one in three has slabs without width.
void make_ties(Random& random, const Table& table, std::vector<float>& width) {
  const uint32_t kind = random.below(3);
  for (uint32_t k = 0; k < table.basis.count(); ++k) {
    if (kind == 0) width[k] = 1 + std::round(4 * width[k]);
    if (kind == 1 && random.below(4) == 0) width[k] = 0;
  }
}

struct EveryTriple {
  const Table& table;
  const std::vector<float>& width;
  TripleChoice best;

  // The area from the narrowest slab and the two others, as one_volume-inl.h defines it.
  void try_triple(uint32_t i, uint32_t j, uint32_t l) {
    float d[3] = {width[i], width[j], width[l]};
    std::sort(d, d + 3);
    const float faces = d[1] * d[2] + d[0] * (d[1] + d[2]);
    const float area = 2 * (faces * table.basis.inverse_determinants(i, j)[l]);
    if (!(area < best.area)) return;
    best = {{i, j, l}, area};
  }

  uint32_t narrowest() const {
    return static_cast<uint32_t>(
        std::min_element(width.begin(), width.begin() + table.basis.count()) - width.begin());
  }

  uint32_t second(uint32_t first) const {
    uint32_t found = 0;
    float least = INFINITY;
    for (uint32_t j = 0; j < table.basis.count(); ++j) {
      const float extent = width[j] * width[j] * table.basis.inverse_sine_squares(first)[j];
      if (j == first || !(extent < least)) continue;
      least = extent;
      found = j;
    }
    return found;
  }
};

bool among(uint32_t wanted, uint32_t i, uint32_t j, uint32_t l) {
  return i == wanted || j == wanted || l == wanted;
}

// Tries triples by rising indices, so that the first of equals stays.
TripleChoice try_all(const Table& table, const std::vector<float>& width, sobb_strategy strategy) {
  EveryTriple search{table, width, {}};
  const uint32_t first = search.narrowest();
  const uint32_t second = search.second(first);
  for (uint32_t i = 0; i < table.basis.count(); ++i) {
    for (uint32_t j = i + 1; j < table.basis.count(); ++j) {
      for (uint32_t l = j + 1; l < table.basis.count(); ++l) {
        if (strategy != SOBB_STRATEGY_K3 && !among(first, i, j, l)) continue;
        if (strategy == SOBB_STRATEGY_K && !among(second, i, j, l)) continue;
        search.try_triple(i, j, l);
      }
    }
  }
  return search.best;
}

void check(const Table& table, const std::vector<float>& width, const std::string& what) {
  for (const sobb_strategy strategy : {SOBB_STRATEGY_K, SOBB_STRATEGY_K2, SOBB_STRATEGY_K3}) {
    const TripleChoice expected = try_all(table, width, strategy);
    for (const sobb_isa isa : supported_isas()) {
      const TripleChoice choice =
          bounds_kernels(isa).choose_one(table.basis, width.data(), strategy);
      ASSERT_EQ(choice.area, expected.area) << what << " strategy " << strategy << " isa " << isa;
      for (int j = 0; j < 3; ++j) {
        ASSERT_EQ(choice.direction[j], expected.direction[j])
            << what << " strategy " << strategy << " isa " << isa;
      }
    }
  }
}

TEST(OneVolume, FindsWhatTryingEveryTripleFinds) {
  constexpr uint64_t kSeed = 95;
  Random random(kSeed);
  for (const uint32_t count : {3U, 16U, 24U, 32U, 64U, 128U}) {
    const Table table(random_directions(random, count));
    const int rounds = count > 64 ? 20 : count > 32 ? 60 : 300;
    for (int round = 0; round < rounds; ++round) {
      std::vector<float> width = random_widths(random, table, round % 5);
      make_ties(random, table, width);
      check(table, width,
            "seed " + std::to_string(kSeed) + " directions " + std::to_string(count) + " round " +
                std::to_string(round));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(OneVolume, FindsTheDefaultSetsBases) {
  constexpr uint64_t kSeed = 96;
  Random random(kSeed);
  for (const uint32_t k : {32U, 48U, 64U, 128U, 256U}) {
    const auto directions = default_directions(k);
    const Table table({directions.begin(), directions.end()});
    for (int round = 0; round < (k > 64 ? 20 : 200); ++round) {
      std::vector<float> width = random_widths(random, table, round % 5);
      make_ties(random, table, width);
      check(table, width,
            "seed " + std::to_string(kSeed) + " k " + std::to_string(k) + " round " +
                std::to_string(round));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(OneVolume, OfAPointAreTheAxes) {
  const auto directions = default_directions(64);
  const Table table({directions.begin(), directions.end()});
  const std::vector<float> width(table.basis.stride(), 0.0F);
  for (const sobb_strategy strategy : {SOBB_STRATEGY_K, SOBB_STRATEGY_K2, SOBB_STRATEGY_K3}) {
    const TripleChoice choice =
        bounds_kernels(SOBB_ISA_SSE4).choose_one(table.basis, width.data(), strategy);
    EXPECT_EQ(choice.area, 0);
    for (uint32_t j = 0; j < 3; ++j) EXPECT_EQ(choice.direction[j], j);
  }
}

TEST(OneVolume, IsNeverNearlySingular) {
  constexpr uint64_t kSeed = 97;
  Random random(kSeed);
  std::vector<Direction> directions = random_directions(random, 30);
  // Two of the directions are nearly equal to others.
  directions.push_back(directions[3]);
  directions.push_back({directions[5].x, directions[5].y, std::nextafter(directions[5].z, 2.0F)});
  const Table table(directions);
  for (int round = 0; round < 300; ++round) {
    std::vector<float> width = random_widths(random, table, round % 5);
    for (float& d : width) d *= static_cast<float>(random.below(2));
    for (const sobb_strategy strategy : {SOBB_STRATEGY_K, SOBB_STRATEGY_K2, SOBB_STRATEGY_K3}) {
      const TripleChoice choice =
          bounds_kernels(SOBB_ISA_SSE4).choose_one(table.basis, width.data(), strategy);
      const double det =
          std::fabs(determinant(directions[choice.direction[0]], directions[choice.direction[1]],
                                directions[choice.direction[2]]));
      ASSERT_GE(det, kSmallestDeterminant)
          << "seed " << kSeed << " round " << round << " strategy " << strategy;
    }
  }
}

TEST(OneVolume, RefusesMoreDirectionsThanItSearches) {
  const std::vector<Direction> directions(kMaxSearchedDirections + 1, Direction{1, 0, 0});
  EXPECT_ANY_THROW(BasisTable(directions, *std::pmr::get_default_resource()));
}

// Where a cube's diagonal is a little narrower than its sides, strategy k takes the diagonal,
// though the frame has less area.
TEST(OrFrame, IsTakenWhereItHasLessArea) {
  const float kThird = std::sqrt(1.0F / 3);
  const Direction directions[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {kThird, kThird, kThird}};
  const BasisTable table(directions, *std::pmr::get_default_resource());
  const float width[8] = {1, 1, 1, 0.99F};
  const TripleChoice chosen =
      bounds_kernels(SOBB_ISA_SSE4).choose_one(table, width, SOBB_STRATEGY_K);
  EXPECT_EQ(chosen.direction[2], 3U);
  const TripleChoice better = or_frame(table, width, chosen);
  EXPECT_EQ(better.direction[2], 2U);
  EXPECT_FLOAT_EQ(better.area, 6);
  const float thin[8] = {1, 1, 1, 0.01F};
  const TripleChoice right = bounds_kernels(SOBB_ISA_SSE4).choose_one(table, thin, SOBB_STRATEGY_K);
  EXPECT_EQ(or_frame(table, thin, right).direction[2], 3U);
}

}  // namespace
}  // namespace sobb::test
