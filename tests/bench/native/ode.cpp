// ODE's Dantzig solver as DART packages it: the pivoting method that most engines call when they say "exact".
#include <dart/external/odelcpsolver/lcp.h>

#include <vector>

#include "clock.h"
#include "dense_peer.h"

std::int32_t bench_dense_solve(std::int32_t m, std::int32_t bilateral, const double* A, const double* b, const double* lo,
                               const double* hi, double* gamma, double* seconds) {
  namespace ode = dart::external::ode;
  const std::size_t skip = static_cast<std::size_t>(dPAD(m)), rows = static_cast<std::size_t>(m);
  // A and the right-hand side are overwritten; rows of A are padded
  std::vector<double> matrix(rows * skip), right(rows), low(lo, lo + m), high(hi, hi + m), w(rows);
  std::vector<int> findex(rows, -1);
  for (std::size_t i = 0; i < rows; ++i) {
    std::copy(A + i * rows, A + (i + 1) * rows, matrix.data() + i * skip);
    right[i] = -b[i];
  }
  const double start = bench::wall_seconds();
  const bool good = ode::dSolveLCP(m, matrix.data(), gamma, right.data(), w.data(), bilateral, low.data(), high.data(),
                                   findex.data(), false);
  *seconds = bench::wall_seconds() - start;
  return good ? 0 : 1;
}
