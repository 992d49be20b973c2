// qpOASES on the bounds-only form: an online active-set method, dense.
#include <qpOASES.hpp>

#include "clock.h"
#include "dense_peer.h"

std::int32_t bench_dense_solve(std::int32_t m, std::int32_t, const double* A, const double* b, const double* lo, const double* hi,
                               double* gamma, double* seconds) {
  qpOASES::Options options;
  options.setToReliable();  // its accurate settings; the default ones stop at the same points or worse
  options.printLevel = qpOASES::PL_NONE;
  qpOASES::int_t steps = 100 * (m + 10);
  const double start = bench::wall_seconds();
  qpOASES::QProblemB problem(m);
  problem.setOptions(options);
  const bool good = problem.init(A, b, lo, hi, steps) == qpOASES::SUCCESSFUL_RETURN;
  *seconds = bench::wall_seconds() - start;
  problem.getPrimalSolution(gamma);
  return good ? 0 : 1;
}
