#pragma once
#include "factorize/factor.h"

namespace mlcp {

/// K x = b on the nodes that are in, with what is out fixed at its value in x, solved with residuals in extended precision (Wilkinson;
/// Skeel 1980): a few steps make the componentwise backward error of an approximate factor as small as rounding allows. The factor may
/// be that of K with a little compliance: then a step is one of the proximal method, and dependent rows do no harm.
class Refinement {
 public:
  explicit Refinement(const Memory& m) : residual_(m), scale_(m), correction_(m), best_(m) {}
  void prepare(std::int32_t size);

  /// b: right-hand side by position. x: on entry the values of what is out (−γ of rows at a bound); on return also of what is in.
  /// from_x: starts from x of what is in, whose dependent rows keep their share of the load; else from 0, which gives them nearly that of least norm.
  /// size: magnitude of the terms besides |K||x|, |b| or more.
  /// returns the componentwise backward error maxᵢ |b − K x|ᵢ / (|K||x| + size)ᵢ reached. steps counts solves after the first.
  double solve(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
               const double* b, const double* size, double* x, std::int64_t& steps, std::int64_t& work, bool from_x = false);

  /// Magnitude of the terms of node p in the last measurement, of x or of a point next to it.
  double scale(std::int32_t p) const { return scale_[p]; }
  /// The backward error of x as it is.
  double error(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor, const double* b,
               const double* size, const double* x, std::int64_t& work) {
    return measure(island, pattern, values, factor, b, size, x, work).largest();
  }

 private:
  /// Componentwise backward errors, the largest over velocities and over rows; how many rows are above `noisy`, and the largest |w| among them.
  struct Error {
    double momentum = 0, rows = 0;
    std::int32_t off = 0;
    double largest_off = 0;
    double largest() const { return momentum > rows ? momentum : rows; }
  };
  Error measure(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                const double* b, const double* size, const double* x, std::int64_t& work);
  void stop(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor, double* x);

  Array<long double> residual_;
  Array<double> scale_, correction_, best_;
};

}  // namespace mlcp
