#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "mlcp.h"

namespace bench {

/// A velocity of a problem among those that are to be found.
struct Velocity {
  std::int32_t number;  ///< −1: it is given,
  double given;         ///< as this
};

/// Rows with fixed bounds over velocities to be found, as every solver takes them.
struct PlainRows {
  std::vector<std::int32_t> pointers{0}, columns;
  std::vector<double> values, r, lo, hi, compliance;
  std::vector<std::uint64_t> key;
  std::vector<std::int32_t> source;  ///< the problem's row; −1: a generator of a cone
  /// Σ of the generators of a compliant contact, rows first .. first + count − 1; symmetric, packed.
  struct Block {
    std::int32_t first, count;
    std::vector<double> sigma;
  };
  std::vector<Block> compliant;  ///< ascending

  PlainRows() = default;
  /// J of given velocities goes into r. facets: of the pyramid in place of each friction cone, which becomes a row a facet: a unilateral one
  /// along normal + µ tangent (Anitescu 2006), without the normal's own; in the plane two. 0: frictionless, contacts are their normals.
  /// fails: std::runtime_error, bounds that hang on impulses.
  PlainRows(const mlcp_problem* problem, std::span<const Velocity> velocity, std::int32_t facets);
};

}  // namespace bench
