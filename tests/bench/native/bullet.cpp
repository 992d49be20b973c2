// Bullet's copy of the same solver, as it is distributed: single precision.
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>

#include <algorithm>
#include <vector>

#include "clock.h"
#include "dense_peer.h"

std::int32_t bench_dense_solve(std::int32_t m, std::int32_t bilateral, const double* A, const double* b, const double* lo,
                               const double* hi, double* gamma, double* seconds) {
  const std::size_t rows = static_cast<std::size_t>(m);
  // unlike ODE's its rows are not padded
  std::vector<btScalar> matrix(A, A + rows * rows), right(rows), low(lo, lo + m), high(hi, hi + m), w(rows), x(rows);
  std::vector<int> findex(rows, -1);
  std::transform(b, b + m, right.begin(), [](double value) { return static_cast<btScalar>(-value); });
  btDantzigScratchMemory scratch;
  const double start = bench::wall_seconds();
  const bool good = btSolveDantzigLCP(m, matrix.data(), x.data(), right.data(), w.data(), bilateral, low.data(), high.data(),
                                      findex.data(), scratch);
  *seconds = bench::wall_seconds() - start;
  std::copy(x.begin(), x.end(), gamma);
  return good ? 0 : 1;
}
