// SPDX-License-Identifier: Apache-2.0
// choose() finds what each strategy's description says, on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

#include "bounds/area.h"
#include "bounds/bounds_kernels.h"
#include "bounds/same_bits.h"
#include "support/soups.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

constexpr sobb_strategy kStrategies[] = {SOBB_STRATEGY_K, SOBB_STRATEGY_K2, SOBB_STRATEGY_K3};

struct Table {
  std::vector<Direction> directions;
  DirectionTable soa;
  BasisTable basis;

  explicit Table(uint32_t k)
      : directions(default_directions(k).begin(), default_directions(k).end()),
        soa(make_direction_table(directions)),
        basis(directions, *std::pmr::get_default_resource()) {}

  double determinant_of(uint16_t of) const {
    return std::fabs(determinant(directions[basis_direction(of, 0)],
                                 directions[basis_direction(of, 1)],
                                 directions[basis_direction(of, 2)]));
  }
};

// The k-DOP of a randomly turned box of random shape: a needle, a sheet, a lump.
Kdop random_kdop(Random& random, const Table& table) {
  std::vector<RelativePoint> points;
  float axis[3][3];
  for (auto& row : axis) {
    const double length = std::exp(-6 * random.uniform());
    for (float& value : row) value = static_cast<float>(length * (2 * random.uniform() - 1));
  }
  for (int i = 0; i < 12; ++i) {
    float at[3] = {};
    for (const auto& row : axis) {
      const double s = random.uniform();
      for (int k = 0; k < 3; ++k) at[k] += static_cast<float>(s * row[k]);
    }
    points.push_back({at[0], at[1], at[2]});
  }
  Kdop kdop;
  bounds_kernels(SOBB_ISA_SSE4).fit(table.soa, points.data(), points.size(), kdop);
  return kdop;
}

// The Gram matrix of one to eight volumes.
Gram random_gram(Random& random, const Table& table) {
  Gram gram = {};
  for (uint32_t i = 1 + random.below(8); i > 0; --i) {
    bounds_kernels(SOBB_ISA_SSE4)
        .add_to_gram(random_kdop(random, table), 0.5F, random.between(0.5, 4), gram);
  }
  return gram;
}

// A matrix whose entries have few distinct values, as volumes along the axes have.
void make_ties(Random& random, Gram& gram) {
  const float step = random.between(0.05, 0.5);
  for (auto& row : gram.sum) {
    for (float& entry : row) entry = step * std::round(entry / step);
  }
}

struct Scalar {
  const Table& table;
  const Gram& gram;
  float least = INFINITY;
  uint16_t basis = kAxesBasis;

  float sum(uint32_t i, uint32_t j) const { return gram.sum[i][j]; }

  // The entries in rising order, as defined in gram-inl.h.
  void try_triple(uint32_t i, uint32_t j, uint32_t l) {
    float entry[3] = {sum(i, j), sum(j, l), sum(i, l)};
    std::sort(entry, entry + 3);
    const float area =
        ((entry[0] + entry[1]) + entry[2]) * table.basis.inverse_determinants(i, j)[l];
    if (!(area < least)) return;
    least = area;
    basis = make_basis(i, j, l);
  }

  uint32_t narrowest() const {
    uint32_t best = 0;
    for (uint32_t i = 1; i < table.basis.count(); ++i) {
      if (sum(i, i) < sum(best, best)) best = i;
    }
    return best;
  }

  uint32_t best_second(uint32_t i) const {
    uint32_t best = i;
    float extent = INFINITY;
    for (uint32_t j = 0; j < table.basis.count(); ++j) {
      if (j == i) continue;
      const double cosine = dot(table.directions[i], table.directions[j]);
      const float across = sum(j, j) * static_cast<float>(1 / (1 - cosine * cosine));
      if (across < extent) {
        extent = across;
        best = j;
      }
    }
    return best;
  }
};

// Tries every triple that the strategy describes, by rising indices; the first of equals stays.
BasisChoice choose_scalar(const Table& table, const Gram& gram, sobb_strategy strategy) {
  Scalar search{table, gram};
  const uint32_t count = table.basis.count();
  const uint32_t first = search.narrowest();
  const uint32_t second = search.best_second(first);
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = i + 1; j < count; ++j) {
      for (uint32_t l = j + 1; l < count; ++l) {
        const auto has = [&](uint32_t k) { return i == k || j == k || l == k; };
        if (strategy != SOBB_STRATEGY_K3 && !has(first)) continue;
        if (strategy == SOBB_STRATEGY_K && !has(second)) continue;
        search.try_triple(i, j, l);
      }
    }
  }
  return {search.basis, 2 * search.least};
}

// Tries each triple in double: the area that k^3 has to find, within rounding.
double least_area(const Table& table, const Gram& gram) {
  double least = INFINITY;
  for (uint32_t i = 0; i < table.basis.count(); ++i) {
    for (uint32_t j = i + 1; j < table.basis.count(); ++j) {
      for (uint32_t l = j + 1; l < table.basis.count(); ++l) {
        const double det =
            std::fabs(determinant(table.directions[i], table.directions[j], table.directions[l]));
        if (det < kSmallestDeterminant) continue;
        const double sum = static_cast<double>(gram.sum[i][j]) + gram.sum[j][l] + gram.sum[i][l];
        least = std::min(least, 2 * sum / det);
      }
    }
  }
  return least;
}

TEST(Basis, EachStrategyFindsWhatItDescribes) {
  constexpr uint64_t kSeed = 91;
  Random random(kSeed);
  for (const uint32_t k : {32U, 48U, 64U}) {
    const Table table(k);
    for (int round = 0; round < 200; ++round) {
      Gram gram = random_gram(random, table);
      if (round % 4 == 0) make_ties(random, gram);
      float area[4] = {};
      for (const sobb_strategy strategy : kStrategies) {
        const BasisChoice expected = choose_scalar(table, gram, strategy);
        for (const sobb_isa isa : supported_isas()) {
          const BasisChoice choice = bounds_kernels(isa).choose(table.basis, gram, strategy);
          ASSERT_EQ(choice.basis, expected.basis)
              << "seed " << kSeed << " k " << k << " round " << round << " strategy " << strategy;
          ASSERT_EQ(choice.area, expected.area);
          ASSERT_EQ(choice.area, area_in_basis(table.basis, gram, choice.basis));
        }
        area[strategy] = expected.area;
      }
      const double least = least_area(table, gram);
      ASSERT_NEAR(area[SOBB_STRATEGY_K3], least, 1e-5 * least);
      ASSERT_LE(area[SOBB_STRATEGY_K3], area[SOBB_STRATEGY_K2]);
      ASSERT_LE(area[SOBB_STRATEGY_K2], area[SOBB_STRATEGY_K]);
    }
  }
}

TEST(Basis, EqualAreasGoToTheLowestIndices) {
  const Table table(64);
  Gram zero = {};
  for (const sobb_isa isa : supported_isas()) {
    for (const sobb_strategy strategy : kStrategies) {
      const BasisChoice choice = bounds_kernels(isa).choose(table.basis, zero, strategy);
      EXPECT_EQ(choice.basis, kAxesBasis) << "strategy " << strategy;
      EXPECT_EQ(choice.area, 0);
    }
  }
}

TEST(Basis, IsNeverNearlySingularHoweverFlatTheInput) {
  constexpr uint64_t kSeed = 92;
  Random random(kSeed);
  for (const uint32_t k : {32U, 48U, 64U}) {
    const Table table(k);
    for (int round = 0; round < 200; ++round) {
      // Some slabs have no width at all: with two of them, any third direction makes an area of 0.
      Kdop kdop = random_kdop(random, table);
      for (uint32_t i = 0; i < table.basis.count(); ++i) {
        if (random.below(2) == 0) kdop.lower[i] = kdop.upper[i];
      }
      Gram gram = {};
      bounds_kernels(SOBB_ISA_SSE4).add_to_gram(kdop, 1, 1, gram);
      for (const sobb_strategy strategy : kStrategies) {
        const BasisChoice choice =
            bounds_kernels(SOBB_ISA_SSE4).choose(table.basis, gram, strategy);
        ASSERT_GE(table.determinant_of(choice.basis), kSmallestDeterminant)
            << "seed " << kSeed << " k " << k << " round " << round << " strategy " << strategy;
        ASSERT_LT(basis_direction(choice.basis, 0), basis_direction(choice.basis, 1));
        ASSERT_LT(basis_direction(choice.basis, 1), basis_direction(choice.basis, 2));
      }
    }
  }
}

TEST(Basis, GramSumsTheAreasOfItsVolumes) {
  constexpr uint64_t kSeed = 93;
  constexpr float kScale = 0.25F;
  Random random(kSeed);
  const Table table(64);
  for (int round = 0; round < 200; ++round) {
    Gram gram = {};
    double expected = 0;
    const uint32_t count = table.basis.count();
    uint32_t index[3] = {random.below(count), random.below(count), random.below(count)};
    std::sort(index, index + 3);
    const uint16_t basis = make_basis(index[0], index[1], index[2]);
    if (table.determinant_of(basis) < kSmallestDeterminant) continue;
    for (uint32_t i = 1 + random.below(8); i > 0; --i) {
      const Kdop kdop = random_kdop(random, table);
      const float weight = random.between(0.5, 4);
      bounds_kernels(SOBB_ISA_SSE4).add_to_gram(kdop, kScale, weight, gram);
      Direction normal[3];
      double width[3];
      for (int j = 0; j < 3; ++j) {
        normal[j] = table.directions[index[j]];
        width[j] = kScale * (static_cast<double>(kdop.upper[index[j]]) - kdop.lower[index[j]]);
      }
      expected += weight * slab_area(normal, width);
    }
    ASSERT_NEAR(area_in_basis(table.basis, gram, basis) / expected, 1, 1e-5)
        << "seed " << kSeed << " round " << round;
  }
}

TEST(Basis, GramIsTheSameFromEveryInstructionSet) {
  Random random(94);
  const Table table(48);
  for (int round = 0; round < 50; ++round) {
    const Kdop kdop = random_kdop(random, table);
    Gram expected = {};
    bounds_kernels(SOBB_ISA_SSE4).add_to_gram(kdop, 0.3F, 1.7F, expected);
    for (const sobb_isa isa : supported_isas()) {
      Gram gram = {};
      bounds_kernels(isa).add_to_gram(kdop, 0.3F, 1.7F, gram);
      for (uint32_t i = 0; i < kMaxDirections; ++i)
        ASSERT_TRUE(same_bits(gram.sum[i], expected.sum[i]));
    }
  }
}

}  // namespace
}  // namespace sobb::test
