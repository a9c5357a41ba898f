// SPDX-License-Identifier: Apache-2.0
#include "bounds/directions/principal_axes.h"

#include <algorithm>
#include <cmath>

namespace sobb {
namespace {

// Turns p and q so that m_pq vanishes. The tangent t of the angle is the smaller root of
// t^2 + 2 theta t - 1 = 0, theta = (m_qq - m_pp) / (2 m_pq) (G. Golub, C. Van Loan, "Matrix
// Computations", 8.5).
void rotate(Vector (&m)[3], OrthogonalFrame& frame, size_t p, size_t q) {
  if (m[p][q] == 0) return;
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1);
  const double s = t * c;
  for (Vector& row : m) {
    const double of_p = row[p];
    row[p] = c * of_p - s * row[q];
    row[q] = s * of_p + c * row[q];
  }
  for (size_t k = 0; k < 3; ++k) {
    const double of_p = m[p][k];
    m[p][k] = c * of_p - s * m[q][k];
    m[q][k] = s * of_p + c * m[q][k];
    const double axis_p = frame.axis[p][k];
    frame.axis[p][k] = c * axis_p - s * frame.axis[q][k];
    frame.axis[q][k] = s * axis_p + c * frame.axis[q][k];
  }
}

}  // namespace

OrthogonalFrame principal_axes(const Vector (&matrix)[3]) {
  Vector m[3];
  std::copy(matrix, matrix + 3, m);
  OrthogonalFrame frame = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 12;  // it converges quadratically: half of them would do
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    rotate(m, frame, 0, 1);
    rotate(m, frame, 0, 2);
    rotate(m, frame, 1, 2);
  }
  return frame;
}

}  // namespace sobb
