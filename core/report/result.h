#pragma once
#include "assemble/mask.h"
#include "memory/array.h"
#include "mlcp.h"

namespace mlcp {

/// One Farkas certificate: entries first .. first + count − 1 of Result::certificate_row and certificate_y.
struct CertificateRange {
  std::int32_t island, first, count;
};

/// What a solve leaves for the caller, in the caller's numbering.
struct Result {
  bool valid = false;             ///< a solve has filled it
  Array<double> v, gamma, w;      ///< n, m, m
  Mask mask;                      ///< states at the end, with the rows' keys
  Array<std::uint8_t> redundant;  ///< m
  Array<std::int32_t> row_island; ///< m, −1 for rows left out
  Array<mlcp_outcome> island_outcome;
  Array<CertificateRange> certificates;
  Array<std::int32_t> certificate_row;
  Array<double> certificate_y;
  Array<mlcp_pivot> trace;
  std::int32_t fallbacks = 0;     ///< islands that a method gave up

  explicit Result(const Memory& m)
      : v(m), gamma(m), w(m), mask(m), redundant(m), row_island(m), island_outcome(m), certificates(m), certificate_row(m),
        certificate_y(m), trace(m) {}
};

}  // namespace mlcp
