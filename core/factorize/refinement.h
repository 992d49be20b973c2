#pragma once
#include "factorize/factor.h"

namespace mlcp {

/// K x = b on the nodes that are in, with what is out fixed at its value in x, solved with residuals in extended precision (Wilkinson;
/// Skeel 1980): a few steps make the componentwise backward error of an approximate factor as small as rounding allows.
class Refinement {
 public:
  explicit Refinement(const Memory& m) : residual_(m), scale_(m), correction_(m), best_(m) {}
  void prepare(std::int32_t size);

  /// b: right-hand side by position. x: on entry the values of what is out (−γ of rows at a bound); on return also of what is in.
  /// size: magnitude of the terms besides |K||x|, |b| or more.
  /// returns the componentwise backward error maxᵢ |b − K x|ᵢ / (|K||x| + size)ᵢ reached. steps counts solves after the first.
  double solve(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
               const double* b, const double* size, double* x, std::int64_t& steps, std::int64_t& work);

 private:
  void polish_rows(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor, const double* b,
                   const double* size, double* x, std::int64_t& work);
  double measure(const Island& island, const KktPattern& pattern, const KktValues& values, const Factor& factor,
                 const double* b, const double* size, const double* x, std::int64_t& work);

  std::int32_t off_ = 0;  // rows whose error is above `noisy`, by the last measure
  Array<long double> residual_;
  Array<double> scale_, correction_, best_;
};

}  // namespace mlcp
