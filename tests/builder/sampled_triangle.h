// SPDX-License-Identifier: Apache-2.0
// Points of a triangle that are on it exactly.
#pragma once

#include <vector>

#include "builder/boxes/box.h"

namespace sobb::test {

// 64 bits of mantissa: room for a float times a weight of few bits, summed.
struct Sample {
  long double at[3];
};

// Corners, points of edges, points inside. Weights are of 64ths, so that nothing is rounded unless
// the corners' exponents lie more than thirty apart.
inline std::vector<Sample> sample_triangle(const Corners& corners) {
  static constexpr int kWeights[][3] = {{64, 0, 0},  {0, 64, 0},  {0, 0, 64},   {32, 32, 0},
                                        {0, 13, 51}, {63, 0, 1},  {22, 21, 21}, {1, 1, 62},
                                        {40, 5, 19}, {2, 50, 12}, {62, 1, 1},   {10, 27, 27}};
  std::vector<Sample> samples;
  for (const auto& weight : kWeights) {
    Sample sample;
    for (int k = 0; k < 3; ++k) {
      long double sum = 0;
      for (int i = 0; i < 3; ++i) sum += static_cast<long double>(weight[i]) * corners.at[i][k];
      sample.at[k] = sum / 64;
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace sobb::test
